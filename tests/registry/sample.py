"""A robot of three packages in several releases: messages, a driver that has a parameter, and what starts it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ecm_checker.hub.package import Package

from ecm_extract.registry.publish import Origin, Published, make_ready, publish
from ecm_extract.registry.sources import packages_of
from ecm_extract.registry.store import Registry
from ecm_extract.tree import open_tree

_MANIFEST = """<package format="3"><name>{name}</name><version>{version}</version>{depends}
<export><build_type>ament_python</build_type></export></package>
"""
_SETUP = """from setuptools import setup
setup(name="{name}", packages=["{name}"], entry_points={{"console_scripts": ["{exe} = {name}.main:main"]}})
"""
_DRIVER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("{parameter}", 10.0)
        self.publisher = self.create_publisher(String, "{topic}", 10)


def main():
    rclpy.init()
    rclpy.spin(Driver())
"""
_PANEL = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Panel(Node):
    def __init__(self):
        super().__init__("panel")
        self.create_subscription(String, "state", self.show, 10)

    def show(self, message):
        print(message.data)


def main():
    rclpy.init()
    rclpy.spin(Panel())
"""
_CONFIG = """driver:
  ros__parameters:
    rate: 20.0
"""


def manifest(name: str, version: str, depends: Mapping[str, str] | None = None) -> str:
    """A package.xml; ranges are written as attributes, `version_gte="1.0"`."""
    lines = "".join(f"<depend {attribute}>{other}</depend>" for other, attribute in (depends or {}).items())
    return _MANIFEST.format(name=name, version=version, depends=lines)


def driver(version: str = "1.0.0", parameter: str = "rate", topic: str = "state") -> dict[str, str]:
    """The files of the driver."""
    return {
        "driver/package.xml": manifest("driver", version, {"rclpy": ""}),
        "driver/setup.py": _SETUP.format(name="driver", exe="drive"),
        "driver/driver/__init__.py": "",
        "driver/driver/main.py": _DRIVER.format(parameter=parameter, topic=topic),
    }


def panel(version: str = "1.0.0") -> dict[str, str]:
    """The files of a package that listens to the driver and configures it."""
    return {
        "panel/package.xml": manifest("panel", version, {"driver": 'version_gte="1.0.0"'}),
        "panel/setup.py": _SETUP.format(name="panel", exe="show"),
        "panel/panel/__init__.py": "",
        "panel/panel/main.py": _PANEL,
        "panel/config/driver.yaml": _CONFIG,
    }


def write(root: Path, files: Mapping[str, str]) -> Path:
    """Write files below a folder."""
    for path, text in files.items():
        target = root / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, "utf-8")
    return root


def packages(root: Path, files: Mapping[str, str]) -> tuple[Package, ...]:
    """Extract the packages that files make."""
    return packages_of(open_tree(write(root, files)), 1)


def published(registry: Registry, found: tuple[Package, ...], origin: Origin | None = None) -> list[Published]:
    """Publish packages in one transaction."""
    ready = [make_ready(each) for each in found]
    with registry.writing() as session:
        return publish(session, ready, origin or Origin("robot"))
