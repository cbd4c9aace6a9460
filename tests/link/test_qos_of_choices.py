"""A profile that something decides is the decided one: by what a function is given, or by defaults of parameters."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
static const std::map<std::string, rclcpp::QoS> TABLE = {
  {"far", rclcpp::SensorDataQoS()}, {"near", rclcpp::QoS(1).transient_local()}};
rclcpp::QoS by_name(const std::string & name) {
  if (name == "system") return rclcpp::SystemDefaultsQoS();
  if (name == "sensor") return rclcpp::SensorDataQoS();
  throw std::invalid_argument(name);
}
void lossy(rclcpp::QoS & q) { q.best_effort(); }
rclcpp::QoS kept(rclcpp::QoS q) { q.transient_local(); return q; }
class D : public rclcpp::Node {
public:
  D() : Node("d") {
    {body}
  }
  void flagged(bool kept) {
    rclcpp::QoS q(1);
    if (kept) { q.transient_local(); }
    create_publisher<std_msgs::msg::String>("flag", q);
  }
  void add(rclcpp::QoS q) { q.best_effort(); create_publisher<std_msgs::msg::String>("add", q); }
};
int main(int argc, char ** argv) { rclcpp::spin(std::make_shared<D>()); }
"""
BRANCH = 'rclcpp::QoS q(5); if (declare_parameter<bool>("b"{})) {{ q.best_effort(); }} '
MAKE = 'create_publisher<std_msgs::msg::String>("a", {});'
ROWS = [
    (MAKE.format('by_name(declare_parameter<std::string>("kind", "sensor"))'), ("best_effort", "volatile", 5)),
    (MAKE.format("by_name(found())"), ("unknown", "unknown", None)),
    (BRANCH.format(", false") + MAKE.format("q"), ("reliable", "volatile", 5)),
    (BRANCH.format(", true") + MAKE.format("q"), ("best_effort", "volatile", 5)),
    (BRANCH.format("") + MAKE.format("q"), ("unknown", "volatile", 5)),
    ("add(rclcpp::QoS(5));", ("best_effort", "volatile", 5)),
    ("flagged(true);", ("reliable", "transient_local", 1)),
    ("flagged(false);", ("reliable", "volatile", 1)),
    ("flagged(found());", ("reliable", "unknown", 1)),
    ("rclcpp::QoS q(5); lossy(q); " + MAKE.format("q"), ("best_effort", "volatile", 5)),
    (MAKE.format("kept(rclcpp::QoS(4))"), ("reliable", "transient_local", 4)),
    (MAKE.format("rclcpp::SensorDataQoS(rclcpp::KeepLast(1))"), ("best_effort", "volatile", 1)),
    (MAKE.format("rclcpp::BestAvailableQoS()"), ("best_available", "best_available", 10)),
    (MAKE.format('TABLE.at(declare_parameter<std::string>("k", "near"))'), ("reliable", "transient_local", 1)),
    (MAKE.format("TABLE.at(found())"), ("unknown", "unknown", None)),
]
PYTHON = """
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from std_msgs.msg import String
POLICIES = {'lossy': ReliabilityPolicy.BEST_EFFORT, 'safe': ReliabilityPolicy.RELIABLE}
class D(Node):
    def __init__(self):
        super().__init__('d')
        {body}
    def add(self, q=None):
        if q is None:
            q = QoSProfile(depth=3)
        self.create_publisher(String, 'add', q)
    def lossy(self, q):
        q.reliability = ReliabilityPolicy.BEST_EFFORT
        self.create_publisher(String, 'lossy', q)
    def first(self, q=None):
        self.create_publisher(String, 'first', q or QoSProfile(depth=3))
    def of(self, kind):
        q = QoSProfile(depth=2)
        if kind == 'kept':
            q.durability = DurabilityPolicy.TRANSIENT_LOCAL
        return q
    @property
    def own(self):
        return QoSProfile(depth=6, reliability=ReliabilityPolicy.BEST_EFFORT)
def main():
    D()
"""
PUBLISH = "self.create_publisher(String, 'a', {})"
PYTHON_ROWS = [
    ("self.add(QoSProfile(depth=9))", ("reliable", "volatile", 9)),
    ("self.add(qos_profile_sensor_data)", ("best_effort", "volatile", 5)),
    ("self.add()", ("reliable", "volatile", 3)),
    ("self.lossy(QoSProfile(depth=9))", ("best_effort", "volatile", 9)),
    ("q = QoSProfile(depth=9); self.lossy(q); " + PUBLISH.format("q"), ("best_effort", "volatile", 9)),
    ("self.first(QoSProfile(depth=9))", ("reliable", "volatile", 9)),
    ("self.first()", ("reliable", "volatile", 3)),
    (PUBLISH.format("self.of('kept')"), ("reliable", "transient_local", 2)),
    (PUBLISH.format("self.of('other')"), ("reliable", "volatile", 2)),
    (PUBLISH.format("self.of(self.found())"), ("reliable", "unknown", 2)),
    (PUBLISH.format("self.own"), ("best_effort", "volatile", 6)),
    (
        PUBLISH.format("QoSProfile(depth=1, reliability=POLICIES[self.declare_parameter('r', 'lossy').value])"),
        ("best_effort", "volatile", 1),
    ),
    (PUBLISH.format("QoSProfile(depth=1, reliability=POLICIES[found()])"), ("unknown", "volatile", 1)),
]


def _told(found: Any, body: str) -> tuple[str, str, int | None]:
    helper = next((name for name in ("add", "flag", "lossy", "first") if name in body), "")
    made = "a" if "create_publisher" in body else helper
    qos = next(entry.qos for entry in found.interfaces() if entry.name == f"/{made}")
    return qos.reliability, qos.durability, qos.depth


@pytest.mark.parametrize(("body", "expected"), ROWS, ids=[row[0][:50] for row in ROWS])
def test_a_profile_is_the_one_that_is_decided_for(workspace: Any, body: str, expected: Any) -> None:
    """What functions do to a profile counts; without a default for what decides it is unknown."""
    assert _told(workspace.package({"src/d.cpp": CPP.replace("{body}", body)}), body) == expected


@pytest.mark.parametrize(("body", "expected"), PYTHON_ROWS, ids=[row[0][:50] for row in PYTHON_ROWS])
def test_a_profile_of_python_is_the_one_that_is_decided_for(workspace: Any, body: str, expected: Any) -> None:
    """The same; an object that is handed over is not None."""
    assert _told(workspace.package({"pkg/d.py": PYTHON.replace("{body}", body)}), body) == expected


@pytest.mark.parametrize(("latch", "expected"), [("true", "transient_local"), ("false", None), ("argc > 1", "unknown")])
def test_a_flag_that_is_handed_on_decides_whether_a_publisher_of_ros1_is_latched(
    workspace: Any, latch: str, expected: str | None
) -> None:
    """Whoever calls the method knows it, also where nothing asks for the flag."""
    text = f"""
class D {{
public:
  explicit D(int argc) {{ begin({latch}); }}
  void begin(bool latched) {{ pub_ = nh_.advertise<std_msgs::String>("a", 1, latched); }}
  ros::NodeHandle nh_;
  ros::Publisher pub_;
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "d"); D d(argc); ros::spin(); }}
"""
    found = workspace.package({"src/d.cpp": text}, ros=1)
    assert found.only("publisher").qos.durability == expected


def test_a_flag_that_is_handed_on_by_its_name_in_python(workspace: Any) -> None:
    """Keywords are arguments, too."""
    text = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
class D:
    def __init__(self):
        self.begin(True, 7)
    def begin(self, latched, size):
        self.pub = rospy.Publisher('a', String, queue_size=size, latch=latched)
if __name__ == '__main__':
    rospy.init_node('d')
    D()
"""
    qos = workspace.package({"scripts/d.py": text}, ros=1).only("publisher").qos
    assert (qos.depth, qos.durability) == (7, "transient_local")
