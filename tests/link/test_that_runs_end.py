"""Forms that hold or name themselves: who follows them comes to an end."""

from __future__ import annotations

from typing import Any


def test_a_default_that_is_named_like_its_parameter(workspace: Any) -> None:
    """`node=node` takes a variable of the module; asking for the default of the default never ended."""
    code = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
node = Node('demo')
class Listener:
    def listen(self, node=node):
        node.create_subscription(String, 'in', print, 1)
def main():
    Listener().listen()
    rclpy.spin(node)
"""
    assert workspace.package({"pkg/demo.py": code}).only("subscriber").name == "/in"


def test_an_object_that_others_keep_a_way_to(workspace: Any) -> None:
    """Each call of a method made names of fields of fields, twice as many as the one before."""
    code = """
import rclpy
from std_msgs.msg import String
class Task:
    def __init__(self, mission, client, name):
        self.mission, self.client, self.name = mission, client, name
    def execute(self):
        self.client.start(self.name)
class Mission:
    def __init__(self, client=None):
        self.labels = {}
        if client:
            self.client = client
        else:
            self.client = Client('server')
    def label(self, name):
        self.labels[name] = self.labels.get(name, 0) + 1
        return name + str(self.labels[name])
    def task(self, name):
        add(self.label(name), Task(self, self.client, name))
mission = Mission()
rclpy.init()
node = rclpy.create_node('demo')
for pair in [(1, 2), (3, 4), (5, 6), (7, 8), (9, 10)]:
    mission.task('a')
    mission.task('b')
    mission.task('c')
node.create_publisher(String, 'topic', 1)
"""
    assert workspace.package({"pkg/demo.py": code}).only("publisher").name == "/topic"
