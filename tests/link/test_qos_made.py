"""QoS of C++ that constants, members and functions are made with: a queue beside a profile, or beside a preset."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.contract import Qos

HEADER = """
const rclcpp::SensorDataQoS PRESET(rclcpp::KeepLast(3));
const rclcpp::QoS COPY{PRESET};
const rclcpp::QoS BOTH = {rclcpp::KeepLast(3), rmw_qos_profile_sensor_data};
namespace inner { inline const rclcpp::QoS BRACED{rclcpp::KeepLast(3), rmw_qos_profile_sensor_data}; }
struct Own { static const rclcpp::QoS KEPT; };
const rclcpp::QoS Own::KEPT(rclcpp::KeepLast(3), rmw_qos_profile_sensor_data);
inline rclcpp::QoS both() { return {rclcpp::KeepLast(3), rmw_qos_profile_sensor_data}; }
inline rclcpp::SensorDataQoS preset() { return {rclcpp::KeepLast(3)}; }
"""
CLASS = """#include "qos.hpp"
class D : public rclcpp::Node {{
  D() : Node("d"), initialised_(rclcpp::KeepLast(3), rmw_qos_profile_sensor_data), preset_(rclcpp::KeepLast(3)) {{
    {setup}
    create_publisher<std_msgs::msg::String>("a", {qos});
  }}
  rclcpp::QoS initialised_;
  rclcpp::SensorDataQoS preset_;
  rclcpp::SensorDataQoS begun_{{rclcpp::KeepLast(3)}};
  rclcpp::QoS braced_{{rclcpp::KeepLast(3), rmw_qos_profile_sensor_data}};
  static constexpr rmw_qos_profile_t fields_ = {{
    RMW_QOS_POLICY_HISTORY_KEEP_LAST, 3, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT, RMW_QOS_POLICY_DURABILITY_VOLATILE}};
}};"""
ROWS = [
    *(("", name) for name in ("PRESET", "COPY", "BOTH", "inner::BRACED", "Own::KEPT", "both()", "preset()")),
    *(("", name) for name in ("initialised_", "preset_", "begun_", "braced_", "fields_")),
    ("std::optional<rclcpp::QoS> q; q.emplace(rclcpp::KeepLast(3), rmw_qos_profile_sensor_data);", "*q"),
    (
        "rclcpp::QoSInitialization i(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 3); rclcpp::QoS q(i, rmw_qos_profile_sensor_data);",
        "q",
    ),
]


def four(qos: Qos | None) -> tuple[str | None, str | None, str | None, int | None]:
    assert qos is not None
    return qos.reliability, qos.durability, qos.history, qos.depth


@pytest.mark.parametrize(("setup", "qos"), ROWS, ids=[row[1] for row in ROWS])
def test_what_it_is_made_with_counts_beside_the_queue(workspace: Any, setup: str, qos: str) -> None:
    """All of them were told reliable, or had nothing told of them."""
    files = {"src/d.cpp": CLASS.format(setup=setup, qos=qos), "include/qos.hpp": HEADER}
    assert four(workspace.package(files).only("publisher").qos) == ("best_effort", "volatile", "keep_last", 3)


def test_a_queue_of_a_profile_is_nothing_but_the_queue(workspace: Any) -> None:
    """`QoSInitialization::from_rmw` leaves the other policies of the profile behind."""
    qos = "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_sensor_data))"
    files = {"src/d.cpp": CLASS.format(setup="", qos=qos), "include/qos.hpp": HEADER}
    assert four(workspace.package(files).only("publisher").qos) == ("reliable", "volatile", "keep_last", 5)
