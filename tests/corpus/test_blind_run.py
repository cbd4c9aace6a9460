"""Blind runs over real git repositories: what they find, that they repeat, and that they cannot see the story."""

from __future__ import annotations

import lzma
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
from corpus_repos import REPOSITORY, driver, make_clone, reader, renamed_topic
from ecm_corpus.again import judged_again
from ecm_corpus.blind import Run, results_document, run_blind, write_outcome
from ecm_corpus.chain import broken_links
from ecm_corpus.documents import SUFFIX, digest, keep, kept, packed, stored, unpacked
from ecm_corpus.guard import BlindnessError
from ecm_corpus.interface import Composition, InterfaceCase, Source
from ecm_corpus.results import Results
from ecm_corpus.verdict import check_findings
from judged_cases import Judged

from ecm_extract.errors import InputError


def test_an_upgrade_names_the_consumer_that_keeps_the_old_name(judged: Judged) -> None:
    states = judged.states
    broken = [finding for finding in states["a"].findings["diff"] if finding.severity == "error"]
    assert [finding.rule for finding in broken] == ["VER001"]
    assert broken[0].evidence[0].path == "reader/reader/main.py"
    assert [f.rule for f in states["a"].findings["check"] if f.severity == "error"] == ["SIG010", "VER008"]


def test_the_consumer_that_followed_is_quiet(judged: Judged) -> None:
    states = judged.states
    assert states["b"].findings["diff"] == ()
    assert [f for f in states["b"].findings["check"] if f.severity == "error"] == []


def test_two_runs_give_the_same_bytes(judged: Judged) -> None:
    """An upgrade and a composition, with the cache and without, in one process and in several."""
    case = msgspec.structs.replace(judged.small, states={name: judged.small.states[name] for name in ("a", "c")})
    one = run_blind([case], Run(judged.clones, cache=False, jobs=1))
    two = run_blind([case], Run(judged.clones, cache=True, jobs=2))
    three = run_blind([case], Run(judged.clones, cache=True, jobs=2))
    assert results_document(one.results) == results_document(two.results) == results_document(three.results)
    assert one.files == two.files == three.files


def test_the_rebuilt_documents_are_those_that_were_stored(judged: Judged, golden: object) -> None:
    """A case rebuilt from its clone gives, byte for byte, the documents under version control."""
    outcome, state = judged.outcome, judged.states["a"]
    for side in ("old/driver", "new/driver", "consumer/reader"):
        golden(f"corpus/{side.replace('/', '_')}.json", outcome.files[state.documents[side]].decode())  # type: ignore[operator]


def test_the_store_holds_what_the_results_name_and_nothing_else(judged: Judged, tmp_path: Path) -> None:
    outcome = judged.outcome
    (tmp_path / "out" / "documents").mkdir(parents=True)
    (tmp_path / "out" / "documents" / f"old{SUFFIX}").write_bytes(b"")
    write_outcome(outcome, tmp_path / "out")
    named = {name for case in outcome.results.cases for s in case.states.values() for name in s.documents.values()}
    assert kept(tmp_path / "out" / "documents").keys() == named
    read = msgspec.json.decode((tmp_path / "out" / "results.json").read_bytes(), type=Results)
    assert read == outcome.results


def test_the_checker_says_the_same_of_stored_documents(judged: Judged) -> None:
    outcome = judged.outcome
    for state in judged.states.values():
        sides: dict[str, list[object]] = {}
        for name, mark in state.documents.items():
            sides.setdefault(name.partition("/")[0], []).extend(unpacked(outcome.files[mark]))
        assert check_findings(sides) == state.findings["check"]  # type: ignore[arg-type]


def test_what_is_judged_again_from_the_store_is_the_same(judged: Judged, tmp_path: Path) -> None:
    """Nothing but the documents is needed; what is not the checker's finding of today is replaced."""
    outcome = judged.outcome
    write_outcome(outcome, tmp_path / "out")
    results = outcome.results
    first = results.cases[0]
    quiet = msgspec.structs.replace(first.states["a"], findings={**first.states["a"].findings, "check": ()})
    changed = msgspec.structs.replace(first, states={**first.states, "a": quiet})
    cases = (changed, *results.cases[1:])
    again = judged_again(msgspec.structs.replace(results, cases=cases), tmp_path / "out" / "documents")
    assert again == results


@pytest.mark.parametrize("change", [b"", b"[]", lzma.compress(b"[]")])
def test_a_store_file_that_was_changed_is_refused(tmp_path: Path, change: bytes) -> None:
    data = packed(())
    keep(digest(data), data, tmp_path)
    assert stored(digest(data), tmp_path) == data
    kept(tmp_path)[digest(data)].write_bytes(change)
    with pytest.raises(InputError, match="was changed"):
        stored(digest(data), tmp_path)


def test_a_missing_clone_is_reported_with_its_url_and_costs_no_other_case(judged: Judged) -> None:
    lost = InterfaceCase("R-lost", "robust", {"a": Composition((Source("nobody/nothing", "1.0.0"),))})
    results = run_blind([judged.other, lost], Run(judged.clones)).results
    assert results.cases[0].missing == ("https://github.com/nobody/nothing",)
    assert results.cases[0].states == {}
    assert results.cases[1].states.keys() == {"a"}


def test_a_clone_without_the_ref_is_reported_with_the_ref(tmp_path: Path) -> None:
    make_clone(tmp_path, ("1.0.0", driver("fix", "1.0.0")))
    case = InterfaceCase("R-lost", "robust", {"a": Composition((Source(REPOSITORY, "9.9.9"),))})
    assert run_blind([case], Run(tmp_path)).results.cases[0].missing == (f"https://github.com/{REPOSITORY} at 9.9.9",)


def test_two_repositories_are_one_workspace(tmp_path: Path) -> None:
    """A reader in one repository meets the driver of another; a type that differs is seen by the checker."""
    case = renamed_topic(tmp_path)
    make_clone(tmp_path, ("2.0.0", driver("raw_fix", "2.0.0", "Int32")), repository="other/numbers")
    both = Composition((Source(REPOSITORY, "1.2.0", ("reader",)), Source("other/numbers", "2.0.0", ("driver",))))
    case = InterfaceCase("R-two", "robust", {"a": both})
    found = run_blind([case], Run(tmp_path)).results.cases[0].states["a"].findings["check"]
    assert [finding.rule for finding in found if finding.severity != "info"] == ["SIG001"]
    assert {place.path.split("/")[0] for place in found[0].evidence} == {"driver", "numbers"}


@pytest.mark.parametrize("what", ["finding", "interface", "order"])
def test_the_chain_tells_what_was_changed(judged: Judged, what: str) -> None:
    small, other, results = judged.small, judged.other, judged.outcome.results
    assert broken_links(results, [small, other]) == ()
    if what == "interface":
        changed = msgspec.structs.replace(small, substrate="ros2")
        told = broken_links(results, [changed, other])
        assert told == ("R-small: its interface part is not the one that was judged",)
        return
    first, second = results.cases
    if what == "order":
        cases = (second, first)
    else:
        quiet = msgspec.structs.replace(first.states["a"], findings={})
        cases = (msgspec.structs.replace(first, states={**first.states, "a": quiet}), second)
    assert broken_links(msgspec.structs.replace(results, cases=cases), [small, other]) != ()


_REACH = """
import os, subprocess, sys
from pathlib import Path
from ecm_corpus.guard import BlindnessError, shut_out_narratives
story = Path(sys.argv[1])
link = story.parents[1] / 'link.yaml'
link.symlink_to(story)
shut_out_narratives()
ways = [lambda: story.read_text(), lambda: os.open(story, os.O_RDONLY), lambda: link.read_text(),
        lambda: os.listdir(story.parent), lambda: list(os.scandir(story.parent)),
        lambda: (os.chdir(story.parent), open(story.name))[1], lambda: os.link(story, 'copy'),
        lambda: subprocess.run(['cat', story]), lambda: os.system('true')]
for way in ways:
    try:
        way()
    except BlindnessError:
        continue
    sys.exit('reached the story')
if os.fork() == 0:
    try:
        story.read_text()
    except BlindnessError:
        os._exit(0)
    os._exit(1)
sys.exit(os.waitstatus_to_exitcode(os.wait()[1]))
"""


def test_the_process_of_a_blind_run_cannot_open_a_narrative(tmp_path: Path) -> None:
    story = tmp_path / "cases" / "narrative" / "R-1.yaml"
    story.parent.mkdir(parents=True)
    story.write_text("story")
    done = subprocess.run([sys.executable, "-c", _REACH, str(story)], capture_output=True, check=False, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_case_that_names_a_narrative_as_its_clone_is_stopped(tmp_path: Path) -> None:
    """Were the clones below the narratives, the process would stop instead of reading there."""
    make_clone(tmp_path / "narrative", ("1.0.0", driver("fix", "1.0.0")))
    case = InterfaceCase("R-peek", "robust", {"a": Composition((Source(REPOSITORY, "1.0.0"),))})
    with pytest.raises(Exception, match=BlindnessError.__name__):
        run_blind([case], Run(tmp_path / "narrative"))


_LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([
        Node(package='driver', executable='driver', remappings=[('raw_fix', '{name}')]),
        Node(package='reader', executable='reader'),
    ])
"""


@pytest.mark.parametrize(("name", "rules"), [("fix", ["SIG001"]), ("other", [])])
def test_a_launch_file_says_what_is_composed(tmp_path: Path, name: str, rules: list[str]) -> None:
    """The same two modules conflict in a launch that brings them together, and in no other."""
    files = {**driver("raw_fix", "1.0.0", "Int32"), **reader("fix"), "driver/launch/x.launch.py": _LAUNCH}
    files["driver/launch/x.launch.py"] = _LAUNCH.replace("{name}", name)
    make_clone(tmp_path, ("1.0.0", files))
    state = Composition((Source(REPOSITORY, "1.0.0"),), ("driver/driver/launch/x.launch.py",))
    results = run_blind([InterfaceCase("R-launch", "robust", {"a": state})], Run(tmp_path)).results
    found = results.cases[0].states["a"].findings["check"]
    assert [finding.rule for finding in found if finding.severity == "error"] == rules
