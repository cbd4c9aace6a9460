"""May releases go to a channel or a robot, together with what is there?"""

from __future__ import annotations

from pathlib import Path

import pytest
from ecm_checker.profiles import Profiles, Runtime
from sample import driver, manifest, packages, panel, published, write

from ecm_extract.cli.run import run
from ecm_extract.errors import InputError
from ecm_extract.registry.environments import record, running
from ecm_extract.registry.fit import Fit, fit
from ecm_extract.registry.scope import environment_scope
from ecm_extract.registry.sides import sides_of_environment
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import AuditEntry

_SYSTEM = Profiles(runtime=Runtime(versions={"rclpy": "3.0.0", "std_msgs": "4.0.0"}))


@pytest.fixture
def robot(small: Registry, tmp_path: Path) -> Registry:
    """A robot that runs the driver and the panel, and two newer drivers."""
    published(small, packages(tmp_path / "a", {**driver(), **panel()}))
    published(small, packages(tmp_path / "b", driver("1.1.0")))
    published(small, packages(tmp_path / "c", driver("2.0.0", topic="status")))
    published(small, packages(tmp_path / "d", {**driver("0.9.0")}))
    with small.writing() as session:
        record(session, "robot_7", ["driver@1.0.0", "panel@1.0.0"])
    return small


def _fit(registry: Registry, *releases: str, environment: str = "robot_7") -> Fit:
    with registry.reading() as session:
        return fit(
            session,
            sides_of_environment(session, environment, releases),
            environment_scope(session, environment),
            _SYSTEM,
        )


def test_a_release_that_breaks_nobody_may_go(robot: Registry) -> None:
    """All that it needs is there."""
    assert _fit(robot, "driver@1.1.0").outcome == "accept"


def test_a_release_that_breaks_somebody_may_not(robot: Registry) -> None:
    """The panel listens to what is gone."""
    found = _fit(robot, "driver@2.0.0")
    assert found.outcome == "reject"
    assert found.impacts[0].broken == ("panel@1.0.0",)


def test_releases_that_go_together_follow_each_other(robot: Registry, tmp_path: Path) -> None:
    """The new panel is asked and not the one whose place it takes; its old self is nobody's peer any more."""
    files = panel("1.1.0")
    files["panel/panel/main.py"] = files["panel/panel/main.py"].replace('"state"', '"status"')
    published(robot, packages(tmp_path / "e", files))
    assert _fit(robot, "driver@2.0.0", "panel@1.1.0").outcome == "accept"
    assert _fit(robot, "driver@2.0.0", "panel@1.0.0").outcome == "reject"


def test_a_version_that_others_do_not_take(robot: Registry, tmp_path: Path) -> None:
    """Both directions count: what it needs, and who needs it."""
    files = {**panel("1.1.0")}
    files["panel/package.xml"] = manifest("panel", "1.1.0", {"driver": 'version_gte="2.0.0"'})
    published(robot, packages(tmp_path / "e", files))
    found = _fit(robot, "panel@1.1.0")
    assert [(each.package, each.state, each.found) for each in found.needs] == [("driver", "out_of_range", "1.0.0")]
    assert found.outcome == "reject"
    older = _fit(robot, "driver@0.9.0")
    assert [(each.release, each.state) for each in older.needs] == [("panel@1.0.0", "out_of_range")]


def test_what_is_not_there_and_what_nobody_knows(robot: Registry, tmp_path: Path) -> None:
    """A package that the registry has must be there; of another one nothing is known."""
    files = {"arm/package.xml": manifest("arm", "1.0.0", {"panel": "", "somewhere": ""})}
    published(robot, packages(tmp_path / "e", files))
    with robot.writing() as session:
        record(session, "bench", ["driver@1.0.0"])
    found = _fit(robot, "arm@1.0.0", environment="bench")
    assert {(each.package, each.state) for each in found.needs} == {("panel", "missing"), ("somewhere", "unknown")}


def test_recording_is_audited_and_refuses_two_of_one(robot: Registry) -> None:
    """What runs is replaced by package; `whole` forgets the rest."""
    with robot.writing() as session:
        done = record(session, "robot_7", ["driver@1.1.0"])
        assert [(each.release, each.before) for each in done] == [("driver@1.1.0", "driver@1.0.0")]
        assert [each.version for each in running(session, "robot_7")] == ["1.1.0", "1.0.0"]
        record(session, "robot_7", ["driver@1.1.0"], whole=True)
        assert [each.package for each in running(session, "robot_7")] == ["driver"]
        assert session.query(AuditEntry).filter_by(action="record").count() == 3
    with pytest.raises(InputError, match="two releases of one package"), robot.writing() as session:
        record(session, "robot_7", ["driver@1.1.0", "driver@1.0.0"])


def test_the_commands(robot: Registry, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 0 it may, 1 it may not or nobody knows."""
    place = ["--registry", str(tmp_path / "small.sqlite")]
    system = write(tmp_path, {"system.yaml": "versions: {rclpy: 3.0.0, std_msgs: 4.0.0}\n"}) / "system.yaml"
    assert run(["can-deploy", "robot_7", "driver@1.1.0", "--runtime", str(system), *place]) == 0
    assert run(["can-deploy", "robot_7", "driver@1.1.0", *place]) == 1
    assert "of which the registry knows nothing" in capsys.readouterr().out
    assert run(["can-deploy", "robot_7", "driver@1.1.0", "--fail-on", "reject", *place]) == 0
    assert run(["can-deploy", "robot_7", "driver@2.0.0", "--format", "json", *place]) == 1
    assert run(["can-release", "driver", "1.1.0", "--to", "sandbox", "--runtime", str(system), *place]) == 0
    assert run(["can-release", "driver@1.0.0", "2.0.0", "--runtime", str(system), *place]) == 1
    assert run(["can-release", "driver", "--to", "nowhere", *place]) == 2
    assert run(["can-deploy", "robot_9", "driver", *place]) == 2
    assert run(["registry", "record", "robot_7", "driver@1.1.0", *place]) == 0
    assert "before driver@1.0.0" in capsys.readouterr().out
