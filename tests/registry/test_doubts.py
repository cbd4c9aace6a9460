"""Nobody is told that nothing breaks while something was not read, or a name is computed."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from ecm_checker.hub.package import Package
from ecm_checker.wire import NotRead
from sample import driver, manifest, packages, panel, published

from ecm_extract.cli.run import run as main
from ecm_extract.registry.impact import Impact, impact_of
from ecm_extract.registry.questions import Asked, who_uses
from ecm_extract.registry.releases import find_release
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.sides import stored_side_of
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify

_LISTENER = """import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import {type}


class Listener(Node):
    def __init__(self, prefix):
        super().__init__("listener")
        self.create_subscription({type}, f"{{prefix}}{rest}", self.show, 10)

    def show(self, message):
        print(message.data)


def main():
    rclpy.init()
    rclpy.spin(Listener(sys.argv[1]))
"""


def _listener(rest: str, message: str = "String") -> dict[str, str]:
    setup = 'from setuptools import setup\nsetup(name="listener", packages=["listener"])\n'
    return {
        "listener/package.xml": manifest("listener", "1.0.0", {"std_msgs": ""}),
        "listener/setup.py": setup,
        "listener/listener/__init__.py": "",
        "listener/listener/main.py": _LISTENER.format(type=message, rest=rest),
    }


def _cut(package: Package, reason: str = "too-large", carries: bool = True) -> Package:
    return msgspec.structs.replace(package, unread=(NotRead(f"{package.name}/src/big.cpp", reason, carries),))


def _upgrade(registry: Registry, place: Path, beside: tuple[Package, ...], new: str = "status") -> Impact:
    """What breaks when the topic of the driver gets another name."""
    published(registry, (*packages(place / "a", driver()), *beside))
    published(registry, packages(place / "b", driver("2.0.0", topic=new)))
    with registry.reading() as session:
        old, after = (stored_side_of(session, find_release(session, f"driver@{each}")) for each in ("1.0.0", "2.0.0"))
        return impact_of(session, old, after, EVERYTHING)


@pytest.mark.parametrize(
    ("reason", "carries", "told"),
    [
        ("too-large", True, True),
        ("malformed", True, True),
        ("submodule", True, True),
        ("ignored", True, False),
        ("too-large", False, False),
    ],
)
def test_files_that_were_not_read_are_told(
    registry: Registry, tmp_path: Path, reason: str, carries: bool, told: bool
) -> None:
    """What a project leaves out on purpose, and a picture, are no doubt."""
    other = _cut(packages(tmp_path / "c", panel())[0], reason, carries)
    found = _upgrade(registry, tmp_path, (msgspec.structs.replace(other, requires=()),))
    assert [(each.release, each.path) for each in found.doubts] == [("panel@1.0.0", "panel/src/big.cpp")] * told
    assert found.is_whole is not told
    with registry.reading() as session:
        assert verify(session).problems == ()


@pytest.mark.parametrize(
    ("rest", "message", "told"),
    [("", "String", True), ("/state", "String", True), ("/other", "String", False), ("", "Int8", False)],
)
def test_computed_names_that_may_be_it_are_told(
    small: Registry, tmp_path: Path, rest: str, message: str, told: bool
) -> None:
    """One that ends otherwise, or is of another type, is none."""
    found = _upgrade(small, tmp_path, packages(tmp_path / "c", _listener(rest, message)))
    assert [each.release for each in found.doubts if each.line] == ["listener@1.0.0"] * told


def test_nothing_is_doubted_where_nothing_changed(small: Registry, tmp_path: Path) -> None:
    """Whoever was not read cannot break of it."""
    assert _upgrade(small, tmp_path, (_cut(packages(tmp_path / "c", panel())[0]),), "state").is_whole


def test_a_release_that_was_not_read_as_a_whole_is_told(small: Registry, tmp_path: Path) -> None:
    """Its changes are not all known."""
    published(small, packages(tmp_path / "a", driver()))
    published(small, (_cut(packages(tmp_path / "b", driver("1.0.1"))[0]),))
    with small.reading() as session:
        sides = (stored_side_of(session, find_release(session, f"driver@{each}")) for each in ("1.0.0", "1.0.1"))
        found = impact_of(session, *sides, EVERYTHING)
    assert [each.release for each in found.doubts] == ["driver@1.0.1"]


def test_who_uses_tells_who_may(small: Registry, tmp_path: Path) -> None:
    """Beside those who do."""
    published(small, (*packages(tmp_path / "a", driver()), *packages(tmp_path / "b", _listener(""))))
    with small.reading() as session:
        found = who_uses(session, "driver", Asked("state"), EVERYTHING)
    assert [(each.release, "computed" in each.why) for each in found.doubts] == [("listener@1.0.0", True)]


def test_the_commands_tell_it_by_their_status(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`nobody breaks` with status 0 is said of what was read as a whole only."""
    url = str(tmp_path / "registry.sqlite")
    with Registry.create(url) as registry:
        other = msgspec.structs.replace(_cut(packages(tmp_path / "c", panel())[0]), requires=())
        _upgrade(registry, tmp_path, (other,))
    assert main(["impact", "driver", "--registry", url]) == 1
    out = capsys.readouterr().out
    assert "nobody is known to break, and not everything is known" in out
    assert "not known: panel@1.0.0 panel/src/big.cpp was not read: too-large" in out
    assert main(["impact", "driver", "--fail-on", "error", "--registry", url]) == 0
    assert main(["registry", "who-uses", "driver", "--registry", url]) == 1
    assert main(["can-release", "driver", "--registry", url]) == 1
    assert "not known: panel@1.0.0" in capsys.readouterr().out
