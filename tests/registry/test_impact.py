"""Who breaks when a release takes the place of another one."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from ecm_checker.match.packages import Packages, broken
from sample import driver, packages, panel, published, write

from ecm_extract.cli.run import run
from ecm_extract.diff.model import RefInfo
from ecm_extract.diff.run import Request, compare
from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Options
from ecm_extract.registry.environments import record
from ecm_extract.registry.impact import Impact, impact_of
from ecm_extract.registry.impact_side import Side
from ecm_extract.registry.publish import Origin
from ecm_extract.registry.scope import EVERYTHING, Scope, distribution_scope, environment_scope
from ecm_extract.registry.sides import two_sides
from ecm_extract.registry.store import Registry
from ecm_extract.stored import Stored

_BREAKS = [
    pytest.param(driver("2.0.0", parameter="frequency"), "panel/config/driver.yaml:3", id="a parameter"),
    pytest.param(driver("2.0.0", topic="status"), "panel/panel/main.py:9", id="a topic"),
]


def _impact(registry: Registry, new: str | None = None, scope: Scope = EVERYTHING) -> Impact:
    with registry.reading() as session:
        sides = two_sides(session, "driver", new)
        assert sides.before is not None
        return impact_of(session, sides.before, sides.after, scope)


@pytest.mark.parametrize(("files", "line"), _BREAKS)
def test_the_line_that_breaks_is_named(registry: Registry, tmp_path: Path, files: dict[str, str], line: str) -> None:
    """Before the release is published as well as after."""
    published(registry, packages(tmp_path / "a", {**driver(), **panel()}), Origin("robot", "1.0.0", "a" * 40))
    before = _impact(registry, str(write(tmp_path / "b", files)))
    published(registry, packages(tmp_path / "b", files))
    after = _impact(registry)
    for found in (before, after):
        assert found.broken == ("panel@1.0.0",)
        assert [f"{at.path}:{at.line}" for each in found.errors for user in each.users for at in user.lines] == [line]


@pytest.mark.parametrize(("files", "line"), _BREAKS)
def test_the_answer_is_that_of_diff(small: Registry, tmp_path: Path, files: dict[str, str], line: str) -> None:
    """From rows that a query selected as from the whole documents; the matching engine says so too."""
    olds = packages(tmp_path / "a", {**driver(), **panel()})
    news = packages(tmp_path / "b", files)
    published(small, olds)
    published(small, news)
    before, users, after = olds[:1], olds[1:], news[:1]
    infos = RefInfo("old", None), RefInfo("new", None)
    sides = Stored("old", None, before), Stored("new", None, after)
    request = Request(*sides, None, "driver", infos, (Stored("users", None, users),), (), Options(jobs=1))
    told = {(each.message, each.resolution, each.severity) for each in compare(request).findings}
    found = _impact(small)
    assert told == {(each.message, each.instead, each.severity) for each in found.breaks}
    lines = {
        f"{at.path}:{at.line}"
        for each in broken(Packages(users), Packages(before), Packages(after))
        for at in each.requirement.evidence
    }
    assert lines <= {f"{at.path}:{at.line}" for each in found.breaks for user in each.users for at in user.lines}


def test_the_newest_release_of_others_is_asked(small: Registry, tmp_path: Path) -> None:
    """Who has followed already does not break."""
    published(small, packages(tmp_path / "a", {**driver(), **panel()}))
    files = panel("1.1.0")
    files["panel/panel/main.py"] = files["panel/panel/main.py"].replace('"state"', '"status"')
    published(small, packages(tmp_path / "b", files))
    published(small, packages(tmp_path / "c", driver("2.0.0", topic="status")))
    assert _impact(small).broken == ()


def test_an_environment_is_asked_for_what_it_runs(small: Registry, tmp_path: Path) -> None:
    """A robot that still runs the old panel breaks, one without it does not."""
    test_the_newest_release_of_others_is_asked(small, tmp_path)
    with small.writing() as session:
        record(session, "robot_7", ["driver@1.0.0", "panel@1.0.0"])
        record(session, "bench", ["driver@1.0.0"])
    with small.reading() as session:
        robot, bench = (environment_scope(session, name) for name in ("robot_7", "bench"))
        with pytest.raises(InputError, match="nothing is recorded"):
            environment_scope(session, "robot_8")
    assert _impact(small, scope=robot).broken == ("panel@1.0.0",)
    assert _impact(small, scope=bench).broken == ()


@pytest.mark.parametrize(
    "text",
    [
        "repositories:\n  robot:\n    release: {packages: [driver, panel, arm], version: 1.0.0-2}\n",
        (
            "repositories:\n  robot: {type: git, url: https://example.org/robot.git, version: 1.0.0}\n"
            "  arm: {type: git, url: https://example.org/arm, version: main}\n"
        ),
    ],
)
def test_a_distribution_is_asked_and_what_is_not_stored_is_told(small: Registry, tmp_path: Path, text: str) -> None:
    """A rosdistro and a workspace file; nothing is known of what is not stored."""
    origin = Origin("https://example.org/robot", "1.0.0", "a" * 40)
    published(small, packages(tmp_path / "a", {**driver(), **panel()}), origin)
    published(small, packages(tmp_path / "b", driver("2.0.0", topic="status")))
    file = tmp_path / "set.yaml"
    file.write_text(text, "utf-8")
    with small.reading() as session:
        scope = distribution_scope(session, str(file))
    found = _impact(small, scope=scope)
    assert found.broken == ("panel@1.0.0",)
    assert len(found.missing) == 1
    assert "arm" in found.missing[0]


def test_a_computed_name_may_be_any(small: Registry, tmp_path: Path) -> None:
    """What its keys cannot narrow is still matched."""
    computed = driver()
    computed["driver/driver/main.py"] = computed["driver/driver/main.py"].replace('"state"', "self.get_name() + x()")
    published(small, packages(tmp_path / "a", {**computed, **panel()}))
    published(small, packages(tmp_path / "b", driver("2.0.0", topic="status")))
    with small.reading() as session:
        sides = two_sides(session, "driver", None)
        assert isinstance(sides.before, Side)
        impact_of(session, sides.before, sides.after, EVERYTHING)


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 1 and the line, in each format; a first release breaks nobody."""
    monkeypatch.setenv("ECM_REGISTRY", str(tmp_path / "registry.sqlite"))
    with Registry.create() as registry:
        published(registry, packages(tmp_path / "a", {**driver(), **panel()}))
    new = str(write(tmp_path / "b", driver("2.0.0", parameter="frequency")))
    for form in ("text", "json", "markdown"):
        capsys.readouterr()
        assert run(["impact", "driver", new, "--format", form]) == 1
        out = capsys.readouterr().out
        assert "panel/config/driver.yaml" in out
        assert "sets rate" in out
    assert json.loads(_out(capsys, ["impact", "driver", new, "--format", "json"]))["schema"] == "ecm-extract/impact/1"
    assert run(["impact", "driver", new, "--fail-on", "never"]) == 0
    assert run(["impact", "panel"]) == 2
    assert run(["impact", "driver", "9.9.9"]) == 2
    assert run(["impact", "panel", new]) == 2


def _out(capsys: pytest.CaptureFixture[str], words: list[str]) -> str:
    capsys.readouterr()
    run(words)
    return capsys.readouterr().out
