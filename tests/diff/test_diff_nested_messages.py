"""Messages that hold each other: each type is looked at once, however many ways lead through it."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest
from diff_repos import package, release

from ecm_extract.cli.run import run
from ecm_extract.diff.wire import MAX_SHOWN, Step, way_text

CHAIN = 60
SECONDS = 20


def test_a_chain_of_messages_with_many_ways_through_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Three fields of the one before in each make 3^60 ways; all whose layout changes are told."""
    manifest = package("lib_msgs")
    links = {f"msg/M{at}.msg": "".join(f"M{at - 1} {name}\n" for name in "abc") for at in range(1, CHAIN)}
    release(tmp_path / "lib", {"package.xml": manifest, **links, "msg/M0.msg": "float64 x\n"}, "1.0.0")
    release(tmp_path / "lib", {"msg/M0.msg": "float32 x\n"}, "1.1.0")
    started = time.process_time()
    run(["diff", "1.0.0", "1.1.0", "--repo", str(tmp_path / "lib"), "--format", "json", "--no-cache"])
    assert time.process_time() - started < SECONDS
    text = capsys.readouterr().out
    assert {f"lib_msgs/msg/M{at}" for at in (1, 35, CHAIN - 1)} <= {
        change["old"] for change in json.loads(text)["changes"]
    }


def test_a_long_way_is_shown_by_its_ends() -> None:
    """The fields in the middle are left out, so that no text grows with the number of types."""
    ways = {f"m{at}": Step(f"f{at}", f"m{at - 1}") for at in range(1, 100)}
    text = way_text("m99", {**ways, "m0": None})
    assert text.startswith("f99.f98.")
    assert text.endswith(".f2.f1 (m0)")
    assert text.count(".f") < MAX_SHOWN
