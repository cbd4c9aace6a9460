"""A role, a kind and its uses that nobody has thought of are rows: every command treats them without a line of code."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import ecm_checker
import made_up
import pytest

import ecm_extract

Run = Callable[..., str]
NORTH, SOUTH, NEAR_NORTH = "/harbour/north_light", "/harbour/south_light", "/harbour/north_lihgt"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Run]:
    """The tool, from a copy whose tables have more rows."""
    code = tmp_path_factory.mktemp("code")
    for package in (ecm_checker, ecm_extract):
        home = Path(str(package.__file__)).parent
        shutil.copytree(home, code / home.name)
    for path, rows in made_up.ROWS.items():
        table = code / path
        before = table.read_text("utf-8") if table.exists() else ""
        table.write_text(before + rows, "utf-8")
    environment = {**os.environ, "PYTHONPATH": str(code), "ECM_CACHE_DIR": str(code / "cache")}
    command = [sys.executable, str(Path(__file__).with_name("answering.py"))]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, env=environment, stdin=pipe, stdout=pipe, text=True) as process:
        yield partial(_answer, process, code)


def _answer(process: subprocess.Popen[str], code: Path, *arguments: object, at: Path | None = None) -> str:
    assert process.stdin is not None
    assert process.stdout is not None
    out, err = code / "out", code / "err"
    asked = {"words": [*map(str, arguments)], "at": str(at or code), "out": str(out), "err": str(err)}
    process.stdin.write(f"{json.dumps(asked)}\n")
    process.stdin.flush()
    assert process.stdout.readline() in {"0\n", "1\n"}, err.read_text("utf-8")
    return out.read_text("utf-8")


def _document(run: Run, tree: Path, package: str) -> Path:
    """The document of a package, stored beside its tree."""
    run(tree, "-o", tree / "documents")
    return tree / "documents" / package / f"{package}.package.json"


def test_a_new_role_is_read_and_told(run: Run, tmp_path: Path) -> None:
    """The contract has the endpoint, the document the name that others use."""
    tower = made_up.write_tower(tmp_path, NORTH)
    document = json.loads(_document(run, tower, "tower").read_text("utf-8"))
    interfaces = document["modules"][0]["signature"]["interfaces"]
    assert [(each["role"], each["name"]) for each in interfaces] == [("beacon_sender", NORTH)]
    assert ("beacon", NORTH) in {(each["kind"], each["name"]) for each in document["provides"]}


@pytest.mark.parametrize("stored", [False, True])
def test_diff_names_who_breaks(run: Run, tmp_path: Path, stored: bool) -> None:
    """A name that is another one breaks the line that uses it, in the words of the rows."""
    old, new = made_up.write_tower(tmp_path / "old", NORTH), made_up.write_tower(tmp_path / "new", SOUTH)
    fleet = made_up.write_ship(tmp_path / "fleet", NORTH)
    sides: tuple[Path, ...] = (old, new, fleet)
    if stored:
        sides = _document(run, old, "tower"), _document(run, new, "tower"), _document(run, fleet, "ship")
    told = run("diff", sides[0], sides[1], "--consumer", sides[2])
    assert "ship/src/ship.cpp:7" in told
    assert f"beacon {NORTH} of tower in tower is now {SOUTH}" in told
    assert "If ignored, the watcher sees nothing, for ever." in told


@pytest.mark.parametrize(("name", "kind", "rule"), [(NORTH, "Bool", "SIG001"), (NEAR_NORTH, "String", "SIG005")])
def test_check_tells_of_a_mismatch(run: Run, tmp_path: Path, name: str, kind: str, rule: str) -> None:
    """The row says which rule tells of two types, and which of names that are nearly one."""
    tower = made_up.write_tower(tmp_path / "tower", name, kind)
    told = run("check", tower, made_up.write_ship(tmp_path / "fleet", NORTH))
    assert rule in told
    assert rule not in run("check", made_up.write_tower(tmp_path / "right", NORTH), tmp_path / "fleet")


@pytest.mark.parametrize(("name", "kind", "rule"), [(NORTH, "Bool", "LNT007"), (NEAR_NORTH, "String", "LNT015")])
def test_lint_tells_of_a_mismatch(run: Run, tmp_path: Path, name: str, kind: str, rule: str) -> None:
    """What a launch file starts together is matched by the rows."""
    made_up.write_ship(made_up.write_tower(tmp_path / "wrong", name, kind), NORTH)
    made_up.write_ship(made_up.write_tower(tmp_path / "right", NORTH), NORTH)
    assert rule in run("lint", "--preview", tmp_path / "wrong")
    assert rule not in run("lint", "--preview", tmp_path / "right")


def test_the_graph_has_the_channel(run: Run, tmp_path: Path) -> None:
    """A new channel is drawn, with both of its sides, and counted."""
    root = made_up.write_ship(made_up.write_tower(tmp_path, NORTH), NORTH)
    told = run("system", made_up.LAUNCH, at=root)
    assert "1 beacon;" in told
    assert "lamp: /tower   eye: /ship" in told
    assert '"node:/tower" -> "beacon:' in run("system", made_up.LAUNCH, "--format", "dot", at=root)


def _with_panel(document: Path, target: Path, knobs: tuple[str, ...]) -> Path:
    """A document with a panel and its knobs, as a parser of panels would fill it; without knobs, without the panel."""
    data = json.loads(document.read_text("utf-8"))
    rows = [_row("knob", "deck", name) for name in knobs]
    data["provides"] += [_row("panel", "", "deck"), *rows] if knobs else []
    target.write_text(json.dumps(data), "utf-8")
    return target


def _row(kind: str, owner: str, name: str) -> dict[str, Any]:
    told = {"conditions": [], "confidence": "literal", "deprecated": None, "type": None, "default": None}
    return {"kind": kind, "owner": owner, "name": name, **told, "evidence": [{"path": "panel.yaml", "line": 1}]}


def _turning(document: Path, knob: str) -> Path:
    """A document of a package that turns a knob."""
    data = json.loads(document.read_text("utf-8"))
    place = {"by": "file ship.yaml", "certainty": "proved", "evidence": [{"path": "ship.yaml", "line": 3}]}
    wanted = {"use": "turns_knob", "kind": "knob", "package": "tower", "owner": "deck", "name": knob}
    data["requires"] = [{**wanted, "type": None, "conditions": [], **place}]
    document.write_text(json.dumps(data), "utf-8")
    return document


def test_a_part_is_gone_for_who_uses_it(run: Run, tmp_path: Path) -> None:
    """A kind that no parser of ours fills is compared as its row says: a part that is gone breaks who names it."""
    tower = _document(run, made_up.write_tower(tmp_path / "tower", NORTH), "tower")
    old = _with_panel(tower, tmp_path / "old.json", ("volume", "speed"))
    new = _with_panel(tower, tmp_path / "new.json", ("speed",))
    ship = _turning(_document(run, made_up.write_ship(tmp_path / "ship", NORTH), "ship"), "volume")
    told = run("diff", old, new, "--consumer", ship)
    assert "knob volume of deck in tower is gone" in told
    assert "ship.yaml:3 turns volume of deck" in told


def test_parts_go_with_their_whole(run: Run, tmp_path: Path) -> None:
    """A whole that is gone is one change, which breaks who names a part of it."""
    tower = _document(run, made_up.write_tower(tmp_path / "tower", NORTH), "tower")
    old = _with_panel(tower, tmp_path / "old.json", ("volume", "speed"))
    ship = _turning(_document(run, made_up.write_ship(tmp_path / "ship", NORTH), "ship"), "volume")
    told = run("diff", old, tower, "--consumer", ship, "--format", "json")
    found = json.loads(told)
    assert [(each["kind"], each["old"]) for each in found["changes"]] == [("panel", "deck")]
    assert "ship.yaml" in {line["path"] for finding in found["findings"] for line in finding["evidence"]}
