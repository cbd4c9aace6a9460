"""A small bug of our own: a driver renames a topic, and a reader of the same repository keeps the old name."""

from __future__ import annotations

from pathlib import Path

from ecm_corpus.interface import Composition, InterfaceCase, Source, Upgrade
from git_repos import commit_all

REPOSITORY = "somebody/driver"

_MANIFEST = """<package format="3"><name>{name}</name><version>{version}</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>Apache-2.0</license>
<depend>rclpy</depend><depend>std_msgs</depend><export><build_type>ament_python</build_type></export></package>
"""
_SETUP = """from setuptools import setup
setup(name='{name}', entry_points={{'console_scripts': ['{name} = {name}.main:main']}})
"""
_NODE = """from rclpy.node import Node
from std_msgs.msg import {type}


class {kind}(Node):
    def __init__(self):
        super().__init__('{name}')
        {call}


def main():
    {kind}()
"""


def driver(topic: str, version: str, type_name: str = "String") -> dict[str, str]:
    """A package whose node publishes a topic."""
    call = f"self.out = self.create_publisher({type_name}, '{topic}', 10)"
    return _package("driver", version, _NODE.format(type=type_name, kind="Driver", name="driver", call=call))


def reader(topic: str) -> dict[str, str]:
    """A package whose node subscribes to a topic."""
    call = f"self.sub = self.create_subscription(String, '{topic}', print, 10)"
    return _package("reader", "1.0.0", _NODE.format(type="String", kind="Reader", name="reader", call=call))


def make_clone(folder: Path, *releases: tuple[str, dict[str, str]], repository: str = REPOSITORY) -> Path:
    """A repository below a folder of clones, with a commit and a tag for each release."""
    place = folder / repository
    place.mkdir(parents=True, exist_ok=True)
    for tag, files in releases:
        for path, text in files.items():
            (place / path).parent.mkdir(parents=True, exist_ok=True)
            (place / path).write_text(text)
        commit_all(place, tag)
    return place


def renamed_topic(clones: Path) -> InterfaceCase:
    """The case, with its clone: 1.1.0 renames the topic `fix`; the reader follows in 1.2.0."""
    make_clone(
        clones,
        ("1.0.0", {**driver("fix", "1.0.0"), **reader("fix")}),
        ("1.1.0", {**driver("raw_fix", "1.1.0"), **reader("fix")}),
        ("1.2.0", {**driver("raw_fix", "1.2.0"), **reader("raw_fix")}),
    )
    old, new = Source(REPOSITORY, "1.0.0", ("driver",)), Source(REPOSITORY, "1.1.0", ("driver",))
    users = {tag: Source(REPOSITORY, tag, ("reader",)) for tag in ("1.1.0", "1.2.0")}
    return InterfaceCase(
        case="R-small",
        substrate="robust",
        states={
            "a": Upgrade(old, new, (users["1.1.0"],)),
            "b": Upgrade(old, new, (users["1.2.0"],)),
            "c": Composition((Source(REPOSITORY, "1.1.0", ("driver", "reader")),)),
            "d": Composition((Source(REPOSITORY, "1.2.0", ("driver", "reader")),)),
        },
    )


def _package(name: str, version: str, main: str) -> dict[str, str]:
    return {
        f"{name}/package.xml": _MANIFEST.format(name=name, version=version),
        f"{name}/setup.py": _SETUP.format(name=name),
        f"{name}/{name}/__init__.py": "",
        f"{name}/{name}/main.py": main,
    }
