"""Classes of Python whose base a constant chooses: a node where the client library is there, else a stand-in."""

from __future__ import annotations

from typing import Any

SERVICE = """
try:
    from rclpy.node import Node
    from std_srvs.srv import Empty
    HAVE_ROS = True
except ImportError:
    HAVE_ROS = False
    class Node:
        def __init__(self, name):
            pass

class Service(Node if HAVE_ROS else object):
    def __init__(self):
        if HAVE_ROS:
            super().__init__('service')
        self.declare_parameter('rate', 2.0)
        self.made = self.create_service(Empty, '~/reset', self.reset)
"""
ARM = """
import rclpy
from rclpy.node import Node
from pkg.service import Service

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.declare_parameter('port', 'a')
        self.service = Service()

def main():
    rclpy.init()
    rclpy.spin(Arm())
"""
SETUP = "from setuptools import setup\nsetup(name='pkg', packages=['pkg'], entry_points={'console_scripts': ['arm = pkg.arm:main']})\n"


def test_a_class_that_may_derive_from_a_node_is_a_node_of_its_own(workspace: Any) -> None:
    """What it declares was told of the node that makes it."""
    files = {"setup.py": SETUP, "pkg/__init__.py": "", "pkg/service.py": SERVICE, "pkg/arm.py": ARM}
    modules = workspace.package(files).modules()
    found = {name: {entry.name for entry in module.signature.interfaces} for name, module in modules.items()}
    assert found == {"ecm.pkg.arm": {"port"}, "ecm.pkg.service": {"rate", "/service/reset"}}
