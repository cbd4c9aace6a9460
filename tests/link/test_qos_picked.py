"""Profiles of QoS that are picked: out of tables and lists, what optionals hold, presets and policies by their names."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
static const rmw_qos_profile_t FAST = {{RMW_QOS_POLICY_HISTORY_KEEP_LAST, 4, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
  RMW_QOS_POLICY_DURABILITY_VOLATILE}};
static rmw_qos_profile_t LOOSE = {{RMW_QOS_POLICY_HISTORY_KEEP_LAST, 4, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
  RMW_QOS_POLICY_DURABILITY_VOLATILE}};
void change(rmw_qos_profile_t & profile) {{ profile.reliability = RMW_QOS_POLICY_RELIABILITY_RELIABLE; }}
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{
    std::vector<rclcpp::QoS> list;
    list.push_back(rclcpp::QoS(1));
    list.push_back(rclcpp::SensorDataQoS());
    std::optional<rclcpp::QoS> none;
    {before}
    create_publisher<std_msgs::msg::String>("out", {profile});
  }}
  {member}
  std::map<std::string, rclcpp::QoS> table_{{{{"scan", rclcpp::SensorDataQoS()}}, {{"slow", rclcpp::QoS(2)}}}};
}};
"""
SENSOR = ("best_effort", 5)
PICKED = [
    ('table_.at("scan")', "", "", SENSOR),
    ('table_.find("slow")->second', "", "", ("reliable", 2)),
    ('table_.at("scan")', "", 'void later() { table_["scan"] = rclcpp::QoS(1); }', ("unknown", None)),
    ("list.back()", "", "", SENSOR),
    ("list.front()", "", "", ("reliable", 1)),
    ("none.value_or(rclcpp::SensorDataQoS())", "", "", SENSOR),
    ("none ? *none : rclcpp::SensorDataQoS()", "", "", SENSOR),
    ("rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(FAST), FAST)", "", "", ("best_effort", 4)),
    ("rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(LOOSE), LOOSE)", "change(LOOSE);", "", ("unknown", None)),
]
PYTHON = """
from rclpy.node import Node
from rclpy.qos import QoSPresetProfiles, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        policy = ReliabilityPolicy.RELIABLE
        if not self.declare_parameter("reliable", False).value:
            policy = ReliabilityPolicy.BEST_EFFORT
        open_ = ReliabilityPolicy.RELIABLE
        if given():
            open_ = ReliabilityPolicy.BEST_EFFORT
        self.create_publisher(String, "out", {profile})
"""
NAMED = [
    ('QoSPresetProfiles["SENSOR_DATA"].value', SENSOR),
    ("QoSPresetProfiles[given()].value", ("unknown", None)),
    ('QoSProfile(depth=5, reliability=ReliabilityPolicy.get_from_short_key("best_effort"))', SENSOR),
    ("QoSProfile(depth=5, reliability=policy)", SENSOR),
    ("QoSProfile(depth=5, reliability=open_)", ("unknown", 5)),
]


def _told(workspace: Any, files: dict[str, str]) -> tuple[str, int | None]:
    found = workspace.package(files).only("publisher").qos
    return found.reliability, found.depth


@pytest.mark.parametrize(("profile", "before", "member", "told"), PICKED, ids=[row[0] + row[2] for row in PICKED])
def test_what_is_picked(workspace: Any, profile: str, before: str, member: str, told: tuple[str, int | None]) -> None:
    """An element counts where nobody changes what it is picked from, and what an optional surely holds or not."""
    assert _told(workspace, {"src/d.cpp": CPP.format(profile=profile, before=before, member=member)}) == told


@pytest.mark.parametrize(("profile", "told"), NAMED, ids=[row[0] for row in NAMED])
def test_what_is_named(workspace: Any, profile: str, told: tuple[str, int | None]) -> None:
    """Presets and policies by their names are these; a policy that a parameter decides is what its default makes it."""
    assert _told(workspace, {"pkg/d.py": PYTHON.format(profile=profile)}) == told
