"""QoS from the expressions that real code writes."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.contract import Qos

CPP = 'class D : public rclcpp::Node {{ D() : Node("d") {{ {setup} create_publisher<std_msgs::msg::String>("a", {qos}); }} }};'
PYTHON = """
from rclpy.node import Node
from rclpy.qos import *
from std_msgs.msg import String
class D(Node):
    def __init__(self):
        super().__init__('d')
        {setup}
        self.create_publisher(String, 'a', {qos})
"""
CPP_ROWS = [
    ("", "5", ("reliable", "volatile", "keep_last", 5)),
    ("", "rclcpp::SensorDataQoS()", ("best_effort", "volatile", "keep_last", 5)),
    (
        "",
        "rclcpp::QoS(3).best_effort().transient_local()",
        ("best_effort", "transient_local", "keep_last", 3),
    ),
    ("", "rclcpp::QoS(rclcpp::KeepLast(7)).reliable()", ("reliable", "volatile", "keep_last", 7)),
    ("", "rclcpp::QoS(rclcpp::KeepAll())", ("reliable", "volatile", "keep_all", None)),
    ("", "rmw_qos_profile_sensor_data", ("best_effort", "volatile", "keep_last", 5)),
    ("", "tf2_ros::StaticListenerQoS()", ("reliable", "transient_local", "keep_last", 100)),
    ("auto q = rclcpp::QoS(1); q.transient_local();", "q", ("reliable", "transient_local", "keep_last", 1)),
    (
        "rclcpp::QoS q{2}; q.reliability(rclcpp::ReliabilityPolicy::BestEffort);",
        "q",
        ("best_effort", "volatile", "keep_last", 2),
    ),
    ("rclcpp::SensorDataQoS q;", "q", ("best_effort", "volatile", "keep_last", 5)),
    ("rclcpp::SensorDataQoS q; q.keep_last(1);", "q", ("best_effort", "volatile", "keep_last", 1)),
    (
        "auto p = rmw_qos_profile_default; p.depth = 50;",
        "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(p), p)",
        ("reliable", "volatile", "keep_last", 50),
    ),
    (
        "",
        "rclcpp::QoS(rclcpp::KeepLast(1), rmw_qos_profile_sensor_data)",
        ("best_effort", "volatile", "keep_last", 1),
    ),
    (
        "rclcpp::QoS q(rclcpp::KeepLast(2), rmw_qos_profile_sensor_data);",
        "q",
        ("best_effort", "volatile", "keep_last", 2),
    ),
    (
        "rclcpp::QoS q{rclcpp::KeepAll(), rmw_qos_profile_sensor_data};",
        "q",
        ("best_effort", "volatile", "keep_all", None),
    ),
    (
        "",
        "rclcpp::QoS(rclcpp::QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_ALL, 4))",
        ("reliable", "volatile", "keep_all", 4),
    ),
    (
        "rmw_qos_profile_t p = {RMW_QOS_POLICY_HISTORY_KEEP_LAST, 3, BestEffort, TransientLocal, RMW_QOS_DEADLINE_DEFAULT};",
        "rclcpp::QoS(rclcpp::QoSInitialization(p.history, p.depth), p)",
        ("best_effort", "transient_local", "keep_last", 3),
    ),
    (
        "rmw_qos_profile_t p = {RMW_QOS_POLICY_HISTORY_KEEP_LAST, 3, BestEffort};",
        "p",
        ("best_effort", "system_default", "keep_last", 3),
    ),
]
UNSEEN = ("unknown", "unknown", "unknown", None)
CPP_UNSEEN = [
    ("", "profile_from(somewhere)", UNSEEN),
    ("", "given_qos", UNSEEN),
    ("", "rclcpp::QoS(queue_size)", UNSEEN),
    ("std::size_t given = count();", "rclcpp::QoS(given)", ("reliable", "volatile", "keep_last", None)),
    ('auto n = declare_parameter("n", 4);', "n", ("reliable", "volatile", "keep_last", 4)),
    ("", "rclcpp::QoS(2).reliability(level)", ("unknown", "volatile", "keep_last", 2)),
    ("", "rclcpp::QoS(2).keep_last(count)", ("reliable", "volatile", "keep_last", None)),
    ("", "rclcpp::QoS(2).reliability(SystemDefault)", ("system_default", "volatile", "keep_last", 2)),
    (
        "",
        "rclcpp::QoS(1).durability(latch ? TransientLocal : Volatile)",
        ("reliable", "unknown", "keep_last", 1),
    ),
    (
        'auto latch = declare_parameter("latch", true);',
        "rclcpp::QoS(1).durability(latch ? TransientLocal : Volatile)",
        ("reliable", "transient_local", "keep_last", 1),
    ),
    (
        "auto level = fast ? BestEffort : Reliable;",
        "rclcpp::QoS(1).reliability(level)",
        ("unknown", "volatile", "keep_last", 1),
    ),
    (
        "rclcpp::QoS q(1); if (fast) { q.best_effort(); q.keep_last(1); }",
        "q",
        ("unknown", "volatile", "keep_last", 1),
    ),
    (
        'declare_parameter<int>("n", 4); int n = 5; get_parameter("n", n);',
        "n",
        ("reliable", "volatile", "keep_last", 4),
    ),
    ("auto q = rclcpp::QoS(5); ask(q);", "outside(q)", UNSEEN),
    (
        "",
        "fast ? rclcpp::QoS(1).best_effort() : rclcpp::QoS(1)",
        ("unknown", "volatile", "keep_last", 1),
    ),
    (
        "",
        "rclcpp::QoS(rclcpp::QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 6))",
        ("reliable", "volatile", "keep_last", 6),
    ),
]
PYTHON_ROWS = [
    ("", "10", ("reliable", "volatile", "keep_last", 10)),
    ("", "qos_profile_sensor_data", ("best_effort", "volatile", "keep_last", 5)),
    (
        "",
        "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
        ("reliable", "transient_local", "keep_last", 1),
    ),
    (
        "q = QoSProfile(depth=4); q.reliability = QoSReliabilityPolicy.BEST_EFFORT",
        "q",
        ("best_effort", "volatile", "keep_last", 4),
    ),
]


def four(qos: Qos | None) -> tuple[str | None, str | None, str | None, int | None]:
    assert qos is not None
    return qos.reliability, qos.durability, qos.history, qos.depth


@pytest.mark.parametrize(("setup", "qos", "expected"), CPP_ROWS, ids=[row[1] for row in CPP_ROWS])
def test_cpp_qos(workspace: Any, setup: str, qos: str, expected: tuple[Any, ...]) -> None:
    """Presets, setters and variables give the four policies that matter most."""
    entry = workspace.package({"src/d.cpp": CPP.format(setup=setup, qos=qos)}).only("publisher")
    assert four(entry.qos) == expected


CONSTANTS = """
const rclcpp::QoS LATEST(rclcpp::KeepLast(1), rmw_qos_profile_sensor_data);
static const rmw_qos_profile_t written = {
    RMW_QOS_POLICY_HISTORY_KEEP_LAST, 7, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT, RMW_QOS_POLICY_DURABILITY_VOLATILE,
};
const rclcpp::QoS best = rclcpp::QoS(rclcpp::QoSInitialization(written.history, written.depth), written);
const rclcpp::QoS again = best;
"""


@pytest.mark.parametrize(("qos", "depth"), [("LATEST", 1), ("written", 7), ("best", 7), ("again", 7)])
def test_constants_of_headers_are_all_that_they_are_made_with(workspace: Any, qos: str, depth: int) -> None:
    """A profile beside the queue counts, and so do fields that are written out one by one."""
    source = '#include "qos.hpp"\n' + CPP.format(setup="", qos=qos)
    entry = workspace.package({"src/d.cpp": source, "include/qos.hpp": CONSTANTS}).only("publisher")
    assert four(entry.qos) == ("best_effort", "volatile", "keep_last", depth)
    assert entry.qos.defaulted == ()


@pytest.mark.parametrize(("setup", "qos", "expected"), CPP_UNSEEN, ids=[row[1] for row in CPP_UNSEEN])
def test_what_is_set_to_something_unseen_is_no_default(
    workspace: Any, setup: str, qos: str, expected: tuple[Any, ...]
) -> None:
    """A policy that source sets to a value that it does not show is unknown; only unset ones take the default."""
    entry = workspace.package({"src/d.cpp": CPP.format(setup=setup, qos=qos)}).only("publisher")
    assert four(entry.qos) == expected


@pytest.mark.parametrize(("setup", "qos", "expected"), PYTHON_ROWS, ids=[row[1] for row in PYTHON_ROWS])
def test_python_qos(workspace: Any, setup: str, qos: str, expected: tuple[Any, ...]) -> None:
    """Profiles by keyword and by assignment are read alike."""
    entry = workspace.package({"pkg/d.py": PYTHON.format(setup=setup, qos=qos)}).only("publisher")
    assert four(entry.qos) == expected


def test_a_member_that_is_only_declared_is_the_preset_of_its_type(workspace: Any) -> None:
    """What a method sets on it comes on top."""
    text = CPP.format(setup="q_.keep_last(3);", qos="q_").replace("};", "rclcpp::SensorDataQoS q_; };")
    entry = workspace.package({"src/d.cpp": text}).only("publisher")
    assert four(entry.qos) == ("best_effort", "volatile", "keep_last", 3)


def test_unset_policies_are_named_as_defaults(workspace: Any) -> None:
    """What source does not set takes the default and says so."""
    entry = workspace.package({"src/d.cpp": CPP.format(setup="", qos="5")}).only("publisher")
    assert entry.qos is not None
    assert entry.qos.defaulted == ("reliability", "durability")


def test_deadline_and_lease_are_milliseconds(workspace: Any) -> None:
    """Durations are read with their unit."""
    qos = "rclcpp::QoS(1).deadline(std::chrono::milliseconds(100)).liveliness_lease_duration(2s)"
    entry = workspace.package({"src/d.cpp": CPP.format(setup="", qos=qos)}).only("publisher")
    assert entry.qos is not None
    assert (entry.qos.deadline_ms, entry.qos.lease_ms) == (100.0, 2000.0)


def test_ros1_has_a_queue_size_only(workspace: Any) -> None:
    """No DDS policy is invented for ROS 1."""
    text = 'int main(int c, char ** v) { ros::NodeHandle nh; auto p = nh.advertise<std_msgs::String>("a", 7); }'
    assert workspace.package({"src/m.cpp": text}, ros=1).only("publisher").qos == Qos(depth=7)


def test_a_profile_class_of_the_tree_is_what_its_constructor_sets(workspace: Any) -> None:
    """Setters on itself and arguments to the base make the profile."""
    latched = "class Latched : public rclcpp::QoS { public: explicit Latched(const int & depth = 3) : rclcpp::QoS(depth) { this->reliable(); this->transient_local(); } };"
    entry = workspace.package({"src/d.cpp": latched + CPP.format(setup="", qos="Latched()")}).only("publisher")
    assert four(entry.qos) == ("reliable", "transient_local", "keep_last", 3)


AFTER = [
    ("std::bind(&D::f, this, _1), rclcpp::QoS(3).best_effort()", ("best_effort", "volatile", "keep_last", 3)),
    ("[this](const std_msgs::msg::String & m) {}", ("reliable", "volatile", "keep_last", 10)),
]


@pytest.mark.parametrize(("given", "expected"), AFTER, ids=["bind", "lambda"])
def test_a_profile_after_the_callback(workspace: Any, given: str, expected: tuple[Any, ...]) -> None:
    """Some overloads take the profile last: a callback in its place is none."""
    call = f'create_subscription<std_msgs::msg::String>("a", {given});'
    text = f'class D : public rclcpp::Node {{ D() : Node("d") {{ {call} }} }};'
    assert four(workspace.package({"src/d.cpp": text}).only("subscriber").qos) == expected


HELD_CPP = """
class Talker : public rclcpp::Node {
 public:
  explicit Talker(const rclcpp::QoS & profile = rclcpp::QoS(7).transient_local()) : Node("talker"), profile_(profile) {}
  void start() { create_publisher<std_msgs::msg::String>("a", profile_); }
  rclcpp::QoS profile_;
};
int main(int argc, char ** argv) {
  rclcpp::QoS chosen(3);
  chosen.best_effort();
  auto talker = std::make_shared<Talker>(HANDED);
  talker->start();
}
"""
HELD_PYTHON = """
class Talker(Node):
    def __init__(self, profile=None):
        super().__init__('talker')
        if profile is None:
            profile = QoSProfile(depth=7, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.profile = profile
    def start(self):
        self.create_publisher(String, 'a', self.profile)
def main():
    chosen = QoSProfile(depth=3)
    chosen.reliability = ReliabilityPolicy.BEST_EFFORT
    talker = Talker(HANDED)
    talker.start()
"""


@pytest.mark.parametrize("path", ["src/talker.cpp", "pkg/talker.py"])
@pytest.mark.parametrize(
    ("handed", "expected"),
    [
        ("chosen", ("best_effort", "volatile", "keep_last", 3)),
        ("", ("reliable", "transient_local", "keep_last", 7)),
    ],
)
def test_a_profile_that_the_maker_of_a_node_hands_over(
    workspace: Any, path: str, handed: str, expected: tuple[Any, ...]
) -> None:
    """It is kept in a member until the endpoint is made; without it the default holds."""
    imports = "from rclpy.node import Node\nfrom rclpy.qos import *\nfrom std_msgs.msg import String\n"
    text = HELD_CPP if path.endswith(".cpp") else imports + HELD_PYTHON
    assert four(workspace.package({path: text.replace("HANDED", handed)}).only("publisher").qos) == expected
