"""Names by their words: alike on each database."""

from __future__ import annotations

from pathlib import Path

import pytest
from sample import driver, packages, panel, published

from ecm_extract.cli.run import run as main
from ecm_extract.errors import InputError
from ecm_extract.registry.name_search import search
from ecm_extract.registry.scope import EVERYTHING, Scope
from ecm_extract.registry.store import Registry
from ecm_extract.registry.words import searched_words, words_of


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("/robot/cmd_vel_smoothed", "robot cmd vel smoothed"),
        ("nav2_msgs/action/NavigateToPose", "nav2 msgs action navigate to pose navigatetopose"),
        ("move_base::MBFClient", "move base mbf client mbfclient"),
        ("max_speed.x", "max speed x"),
        ("<*>/größe", "größe"),
        ("//", ""),
    ],
)
def test_words_of_names(name: str, words: str) -> None:
    """As people write them."""
    assert searched_words(name) == words


def test_words_stand_in_their_order() -> None:
    """So that neighbours can be searched."""
    assert words_of("aB_cD") == ["a", "b", "c", "d"]


@pytest.fixture
def filled(registry: Registry, tmp_path: Path) -> Registry:
    """Two releases of a driver and what listens to it."""
    published(registry, packages(tmp_path / "a", {**driver(topic="cmd_vel"), **panel()}))
    published(registry, packages(tmp_path / "b", driver("1.1.0", topic="cmd_vel_smoothed", parameter="maxRate")))
    return registry


@pytest.mark.parametrize(
    ("texts", "kind", "names"),
    [
        (["cmd_vel"], "topic", ["cmd_vel_smoothed"]),
        (["CMD vel"], "topic", ["cmd_vel_smoothed"]),
        (["cmd", "smoo"], "topic", ["cmd_vel_smoothed"]),
        (["vel_cmd"], None, []),
        (["md_vel"], None, []),
        (["max_rate"], None, ["maxRate"]),
        (["maxra"], "parameter", ["maxRate"]),
        (["maxRate"], "topic", []),
        (["driver"], "package", ["driver"]),
        (["nobody"], None, []),
    ],
)
def test_names_are_found_by_their_words(filled: Registry, texts: list[str], kind: str | None, names: list[str]) -> None:
    """Of the newest releases, in any writing."""
    with filled.reading() as session:
        found = search(session, texts, EVERYTHING, kind)
    assert [each.name.rpartition("/")[2] for each in found] == names


def test_older_releases_are_searched_when_they_are_asked(filled: Registry) -> None:
    """A scope says which."""
    with filled.reading() as session:
        found = search(session, ["cmd_vel"], Scope("all", (1, 2, 3)))
        assert [(each.name.lstrip("~/"), each.version) for each in found if each.kind == "topic"] == [
            ("cmd_vel", "1.0.0"),
            ("cmd_vel_smoothed", "1.1.0"),
        ]


@pytest.mark.parametrize("bad", ["", "/~", "<*>", "' OR 1=1"])
def test_what_has_no_word_is_told_and_nothing_is_executed(filled: Registry, bad: str) -> None:
    """Marks of a query language are no words."""
    with filled.reading() as session:
        if "OR" in bad:
            assert search(session, [bad], EVERYTHING) == []
            return
        with pytest.raises(InputError, match="there is no word"):
            search(session, [bad], EVERYTHING)


def test_the_command_names_who_provides(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the release."""
    url = str(tmp_path / "registry.sqlite")
    with Registry.create(url) as registry:
        published(registry, packages(tmp_path / "a", driver(topic="cmd_vel")))
    assert main(["registry", "search", "cmd_vel", "--registry", url]) == 0
    assert "driver@1.0.0" in capsys.readouterr().out
    assert main(["registry", "search", "cmd", "--limit", "0", "--registry", url]) == 2
