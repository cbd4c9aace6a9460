"""Which releases are chosen, and why not others."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from ecm_checker.profiles import Embodiment, Policy, Profiles, Runtime
from sample import driver, manifest, packages, panel, published
from scenario import contract, package

from ecm_extract.cli.run import run
from ecm_extract.errors import InputError
from ecm_extract.registry.lock import Lock
from ecm_extract.registry.promotion import deprecate
from ecm_extract.registry.resolution import NoResolutionError, resolve
from ecm_extract.registry.store import Registry
from ecm_extract.registry.wishes import Wish, wish_of


@pytest.fixture
def robot(small: Registry, tmp_path: Path) -> Registry:
    """Drivers of three versions, and a panel that takes the first two."""
    for number, version in enumerate(("1.0.0", "1.1.0", "2.0.0")):
        published(small, packages(tmp_path / str(number), driver(version)))
    files = panel("1.0.0")
    files["panel/package.xml"] = manifest("panel", "1.0.0", {"driver": 'version_gte="1.0.0" version_lt="2.0.0"'})
    published(small, packages(tmp_path / "panel", files))
    return small


def _resolve(registry: Registry, *requests: str, profiles: Profiles = Profiles()) -> Lock:  # noqa: B008
    with registry.reading() as session:
        return resolve(session, [wish_of(each) for each in requests], profiles)


def _names(lock: Lock) -> list[str]:
    return [f"{each.package}@{each.version}" for each in lock.releases]


def test_the_newest_that_fits(robot: Registry) -> None:
    """Without the panel the newest, with it the newest that it takes; the reason stands in the lock."""
    assert _names(_resolve(robot, "driver")) == ["driver@2.0.0"]
    lock = _resolve(robot, "panel")
    assert _names(lock) == ["driver@1.1.0", "panel@1.0.0"]
    assert [(each.release, each.reason) for each in lock.passed] == [
        ("driver@2.0.0", "panel@1.0.0 needs <2.0.0 >=1.0.0")
    ]
    assert {(each.package, each.known) for each in lock.outside} == {("rclpy", False)}
    assert _resolve(robot, "panel") == lock


def test_nothing_fits_in_words(robot: Registry) -> None:
    """The request, what stands against it, and nothing else."""
    with pytest.raises(NoResolutionError) as error:
        _resolve(robot, "panel", "driver>=2")
    needs = "panel needs driver <2.0.0 >=1.0.0"
    assert sorted(error.value.reasons) == ["driver >=2 is requested", "panel is requested", needs]


def test_what_is_deprecated_comes_last(robot: Registry) -> None:
    """It is chosen only when nothing else fits."""
    with robot.writing() as session:
        deprecate(session, "driver@1.1.0", "it stalls", None)
    assert "driver@1.0.0" in _names(_resolve(robot, "panel"))
    assert _names(_resolve(robot, "driver@1.1.0")) == ["driver@1.1.0"]


def test_what_the_robot_lacks_is_left_out(small: Registry) -> None:
    """An older release that does with less, or the reason in words."""
    published(small, (package("1.0.0", contract()),))
    published(small, (package("2.0.0", contract(resources__compute={"cpu_cores": 2, "gpu": True})),))
    arm = {"sensors": ("force_torque@wrist",), "actuators": ("arm_6dof", "gripper")}
    small_robot = Profiles(Embodiment(compute={"cpu_cores": 8, "gpu": False}, **arm))  # type: ignore[arg-type]
    assert _names(_resolve(small, "delivery")) == ["delivery@2.0.0"]
    lock = _resolve(small, "delivery", profiles=small_robot)
    assert _names(lock) == ["delivery@1.0.0"]
    assert "gpu" in lock.passed[0].reason
    with pytest.raises(NoResolutionError, match="left out"):
        _resolve(small, "delivery>=2", profiles=small_robot)


def test_channels_and_versions_that_are_installed(robot: Registry) -> None:
    """Governance names channels; what is installed must be in the range."""
    stable = Profiles(policy=Policy(release_channels=("stable",)))
    with pytest.raises(NoResolutionError, match="it is in sandbox"):
        _resolve(robot, "driver", profiles=stable)
    lock = _resolve(robot, "driver", profiles=Profiles(runtime=Runtime(versions={"rclpy": "3.0.0"})))
    assert [(each.package, each.known) for each in lock.outside] == [("rclpy", True)]


def test_a_name_that_is_not_provided_is_a_clash(small: Registry, tmp_path: Path) -> None:
    """Versions would allow the newest driver, its names do not."""
    launch = "<launch><node pkg='driver' exec='drive'/></launch>\n"
    files = {**panel(), "panel/launch/robot.launch.xml": launch}
    published(small, packages(tmp_path / "a", {**driver(), **files}))
    renamed = driver("1.5.0")
    renamed["driver/setup.py"] = renamed["driver/setup.py"].replace("drive =", "run =")
    published(small, packages(tmp_path / "b", renamed))
    lock = _resolve(small, "panel")
    assert _names(lock) == ["driver@1.0.0", "panel@1.0.0"]
    assert "robot.launch.xml:1 starts drive of driver" in lock.passed[0].reason


@pytest.mark.parametrize(
    ("text", "wish"),
    [
        ("a", Wish("a", "*")),
        ("a@1.2.0", Wish("a", "==1.2.0")),
        ("a>=1,<2", Wish("a", ">=1,<2")),
    ],
)
def test_requests(text: str, wish: Wish) -> None:
    """As people write them."""
    assert wish_of(text) == wish


def test_a_request_that_is_none() -> None:
    """The message says how to write it."""
    with pytest.raises(InputError, match="no range"):
        wish_of("a>>1")


def test_the_command(robot: Registry, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A lock file that comes out the same each time; status 1 with the reason, 2 for what is not there."""
    place = ["--registry", str(tmp_path / "small.sqlite")]
    locks = [tmp_path / "one.json", tmp_path / "two.json"]
    for lock in locks:
        assert run(["resolve", "panel", "--lock", str(lock), "--explain", *place]) == 0
    assert locks[0].read_bytes() == locks[1].read_bytes()
    assert json.loads(locks[0].read_text("utf-8"))["releases"][0]["contract"].startswith("sha256:")
    assert "not driver@2.0.0: panel@1.0.0 needs <2.0.0 >=1.0.0" in capsys.readouterr().out
    assert run(["resolve", "panel", "driver>=2", *place]) == 1
    assert "nothing fits" in capsys.readouterr().out
    assert run(["resolve", "nobody", *place]) == 2
