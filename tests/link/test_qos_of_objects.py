"""A profile that another object keeps is what its class makes of it, or what it is where the object is handed on."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from std_msgs.msg import String
class Part:
    def __init__(self, node):
        node.create_publisher(String, 'chatter', node.kept)
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.kept = qos_profile_sensor_data
        {before}
        self.part = Part(self)
        {after}
def main():
    rclpy.init()
    rclpy.spin(Demo())
"""
SENSOR, ONE, OPEN = ("best_effort", 5), ("reliable", 1), ("unknown", None)


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("pass", "pass", SENSOR),
        ("self.kept = QoSProfile(depth=1)", "pass", ONE),
        ("pass", "self.kept = QoSProfile(depth=1)", SENSOR),
        ("self.kept = found()", "pass", OPEN),
    ],
)
def test_a_profile_of_a_node_that_is_handed_on(
    workspace: Any, before: str, after: str, expected: tuple[str, int | None]
) -> None:
    """A part of a node makes its endpoints with the profile that the node has when it makes the part."""
    workspace.package({"pkg/demo.py": PYTHON.format(before=before, after=after)})
    qos = workspace.only("publisher").qos
    assert (qos.reliability, qos.depth) == expected


KEPT = """
class Part:
    def __init__(self, node):
        self._node = node
        self.open()
    def open(self):
        self._node.create_publisher(String, {name}, self._node.kept)
"""


@pytest.mark.parametrize(
    ("name", "expected"),
    [("'chatter'", "/chatter"), ("self._node.topic", "/own"), ("f'{self._node.topic}/x'", "/own/x")],
)
def test_what_a_part_reads_of_the_node_that_it_keeps(workspace: Any, name: str, expected: str) -> None:
    """A part keeps the node and asks it for names and profiles, in whatever method."""
    head, _, rest = PYTHON.format(before="self.topic = 'own'", after="pass").partition("class Part:")
    demo = rest[rest.index("class Demo") :]
    workspace.package({"pkg/demo.py": f"{head}{KEPT.format(name=name)}{demo}"})
    entry = workspace.only("publisher")
    assert (entry.name, entry.qos.reliability, entry.qos.depth) == (expected, *SENSOR)


@pytest.mark.parametrize(
    ("after", "further"),
    [
        ("self.topic, self.kept = 'other', 4", ""),
        ("pass", "def change(node):\n    node.topic = found()\n    node.kept = found()\n"),
    ],
)
def test_a_node_that_changes_is_not_what_it_was_when_it_was_kept(workspace: Any, after: str, further: str) -> None:
    """What is given something again, by itself or by others, is not told where a later method asks for it."""
    head, _, rest = PYTHON.format(before="self.topic = 'own'", after=after).partition("class Part:")
    part = KEPT.format(name="self._node.topic").replace("self.open()", "pass")
    workspace.package({"pkg/demo.py": f"{head}{part}{rest[rest.index('class Demo') :]}{further}"})
    entry = workspace.only("publisher")
    assert (entry.name, entry.qos.reliability, entry.qos.depth) == ("/{topic}", *OPEN)


CPP = """
#include <rclcpp/rclcpp.hpp>
struct Settings {{
  rclcpp::QoS kept = rclcpp::QoS(1).best_effort();
}};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{ {body} }}
  void open() {{ create_publisher<std_msgs::msg::String>("chatter", settings_.kept); }}
  Settings settings_;
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<Demo>()); }}
"""


@pytest.mark.parametrize(
    ("body", "expected"), [("open();", ("best_effort", 1)), ("settings_.kept = found(); open();", OPEN)]
)
def test_a_profile_in_settings(workspace: Any, body: str, expected: tuple[str, int | None]) -> None:
    """Settings that nobody changes are as they are declared; of others nothing is known."""
    qos = workspace.package({"src/demo.cpp": CPP.format(body=body)}).only("publisher").qos
    assert (qos.reliability, qos.depth) == expected


ROWS_OF_PYTHON = """
import rclpy
from dataclasses import dataclass
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from std_msgs.msg import String
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
@dataclass(frozen=True)
class Row:
    name: str
    qos: QoSProfile = QoSProfile(depth=3)
class Config:
    def __init__(self, name, qos=None):
        self.name = name
        if qos is not None:
            self.qos = qos
        else:
            self.qos = QoSProfile(depth=3)
ROWS = [{kind}('fast', qos_profile_sensor_data), {kind}('kept', qos=LATCHED), {kind}('plain')]
class Part:
    def __init__(self, node, row):
        node.create_publisher(String, row.name, row.qos)
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        for row in ROWS:
            {body}
"""
OF_ROWS = {
    "/fast": ("best_effort", "volatile", 5),
    "/kept": ("reliable", "transient_local", 1),
    "/plain": ("reliable", "volatile", 3),
}


@pytest.mark.parametrize("kind", ["Row", "Config"])
@pytest.mark.parametrize("body", ["self.create_publisher(String, row.name, row.qos)", "Part(self, row)"])
def test_each_object_of_a_list_has_its_own_profile(workspace: Any, kind: str, body: str) -> None:
    """The constructor that made the object decides, with what it was given."""
    found = workspace.package({"pkg/demo.py": ROWS_OF_PYTHON.format(kind=kind, body=body)}).interfaces()
    told = {each.name: each.qos for each in found if each.name in OF_ROWS}
    assert {name: (qos.reliability, qos.durability, qos.depth) for name, qos in told.items()} == OF_ROWS


def test_a_profile_of_an_object_that_others_change_is_unknown(workspace: Any) -> None:
    """What its constructor makes is not what it holds later."""
    body = "row.qos = found()\n            self.create_publisher(String, row.name, row.qos)"
    found = workspace.package({"pkg/demo.py": ROWS_OF_PYTHON.format(kind="Config", body=body)}).interfaces()
    assert {each.qos.reliability for each in found if each.name in OF_ROWS} == {"unknown"}


CHANGED_ELSEWHERE = {
    "pkg/demo.py": """
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
class Kept:
    QOS = QoSProfile(depth=1)
QOS = QoSProfile(depth=1)
def fix():
    {name}.reliability = ReliabilityPolicy.BEST_EFFORT
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        fix()
        self.create_publisher(String, 't', {name})
""",
    "src/demo.cpp": """
#include <rclcpp/rclcpp.hpp>
static rclcpp::QoS {name}(1);
static void fix() {{ {name}.best_effort(); }}
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{ fix(); create_publisher<std_msgs::msg::String>("t", {name}); }}
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<Demo>()); }}
""",
}


@pytest.mark.parametrize(
    ("path", "name"), [("pkg/demo.py", "QOS"), ("pkg/demo.py", "Kept.QOS"), ("src/demo.cpp", "kept_qos")]
)
def test_a_profile_of_a_module_that_functions_change_is_unknown(workspace: Any, path: str, name: str) -> None:
    """It was told as it is declared, whoever changes it."""
    found = workspace.package({path: CHANGED_ELSEWHERE[path].format(name=name)}).only("publisher")
    assert (found.qos.reliability, found.qos.depth) == OPEN
