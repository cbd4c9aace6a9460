"""Stored documents say the same as the sources that they were made of: changes, findings and verdict, byte for byte."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from diff_repos import node, package, release

from ecm_extract.cli.run import run
from ecm_extract.diff.formats import json as diff_json
from ecm_extract.diff.model import RefInfo
from ecm_extract.diff.run import Request, compare
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.report.folder import write_document, write_manifests
from ecm_extract.report.json_document import DOCUMENT_NAME, json_document
from ecm_extract.stored import Stored, read_stored
from ecm_extract.tree import Tree, open_tree

FIXTURES = Path(__file__).parents[2] / "fixtures" / "lint"
PAIRS = sorted(path for path in FIXTURES.iterdir() if (path / "bad").is_dir() and (path / "good").is_dir())
INFOS = (RefInfo("bad", None, ""), RefInfo("good", None, ""))
OPTIONS = Options(jobs=1, cache=False)
ARM = {"alpha/package.xml": package("alpha")}
MESSAGE = "alpha/msg/Reach.msg"

Files = dict[str, str | None]


def document_of(old: Tree | Stored, new: Tree | Stored) -> str:
    """What a comparison says; the old side uses the new one as well."""
    return diff_json.render(compare(Request(old, new, None, "pair", INFOS, consumers=(old,), options=OPTIONS)))


def stored(tree: Tree, folder: Path) -> Iterator[Stored]:
    """The tree as an extract document and as documents of its packages."""
    extraction = extract(tree, msgspec.structs.replace(OPTIONS, hub=True))
    yield read_stored(str(write_document(json_document(extraction), folder / DOCUMENT_NAME)))
    write_manifests(extraction, folder / "packages")
    yield read_stored(str(folder / "packages"))


@pytest.mark.parametrize("pair", PAIRS, ids=lambda path: path.name)
def test_documents_of_a_pair_say_what_its_sources_say(pair: Path, tmp_path: Path) -> None:
    old, new = (open_tree(str(pair / side)) for side in ("bad", "good"))
    expected = document_of(old, new)
    for before, after in zip(stored(old, tmp_path / "bad"), stored(new, tmp_path / "good"), strict=True):
        assert document_of(before, after) == expected


def publisher(*names: str) -> str:
    """A node that publishes these topics."""
    return node(*(f'create_publisher<std_msgs::msg::Bool>("{name}", 10);' for name in names))


TREES: dict[str, tuple[Files, Files]] = {
    "changelog outside of packages": (
        {**ARM, "alpha/src/arm.cpp": publisher("speed_limit", "tool")},
        {
            "CHANGELOG.md": "- speed_limit is called velocity_bound from now on\n",
            "alpha/src/arm.cpp": publisher("velocity_bound", "other", "tool"),
        },
    ),
    "folders in another order than the names of packages": (
        {
            "a/package.xml": package("zeta"),
            "a/src/arm.cpp": publisher("one", "two"),
            "b/package.xml": package("alpha"),
            "b/src/arm.cpp": publisher("three", "four"),
        },
        {"a/src/arm.cpp": publisher("three", "five"), "b/src/arm.cpp": publisher("one", "six")},
    ),
    "a comment answers the change": (
        {**ARM, MESSAGE: "int32 far\nint32 near\n"},
        {MESSAGE: "# ecm: ignore[LNT019] known\nint64 far\nint32 near\n"},
    ),
    "a comment answers what is gone": (
        {**ARM, MESSAGE: "int32 far\nint32 near\n"},
        {MESSAGE: "int32 far\n# ecm: ignore[LNT019] known\n"},
    ),
    "one side leaves out what is in no package": (
        {**ARM, MESSAGE: "int32 far\n", "docs/conf.py": "import alpha\n"},
        {"ecm.toml": "[extract]\nexclude = ['docs/*']\n"},
    ),
    "a package in the root, another one inside": (
        {
            "package.xml": package("alpha"),
            "msg/Reach.msg": "int32 far\n",
            "sub/package.xml": package("beta"),
            "sub/msg/Far.msg": "int32 far\n",
        },
        {"msg/Reach.msg": "int64 far\n", "sub/msg/Far.msg": "int8 far\n"},
    ),
    "a file moves into a package": (
        {**ARM, "drafts/Reach.msg": "int32 far\n"},
        {"drafts/Reach.msg": None, MESSAGE: "int32 far\n"},
    ),
}


@pytest.mark.parametrize("releases", TREES.values(), ids=TREES)
def test_documents_of_two_releases_say_what_their_refs_say(
    releases: tuple[Files, Files], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    repo = tmp_path / "repo"
    for tag, files in zip(("1.0.0", "2.0.0"), releases, strict=True):
        release(repo, files, tag)
        for form in ("json", "yaml"):
            run(["extract", str(repo), "--ref", tag, "--format", form, "-o", str(tmp_path / form / tag), "--no-cache"])
    capsys.readouterr()
    expected = said("1.0.0", "2.0.0", repo, capsys)
    for form in ("json", "yaml"):
        assert said(str(tmp_path / form / "1.0.0"), str(tmp_path / form / "2.0.0"), repo, capsys) == expected


def said(old: str, new: str, repo: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, Any]]:
    """Status and document of a comparison, apart from how its sides are called."""
    status = run(["diff", old, new, "--repo", str(repo), "--format", "json", "--jobs", "1", "--no-cache"])
    document = json.loads(capsys.readouterr().out)
    return status, document | {side: document[side]["commit"] for side in ("old", "new")}


def test_without_the_repository_a_comment_answers_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    repo = tmp_path / "repo"
    for tag, files in zip(("1.0.0", "2.0.0"), TREES["a comment answers the change"], strict=True):
        release(repo, files, tag)
        run(["extract", str(repo), "--ref", tag, "--format", "json", "-o", str(tmp_path / tag), "--no-cache"])
    capsys.readouterr()
    (tmp_path / "elsewhere").mkdir()
    _, document = said(str(tmp_path / "1.0.0"), str(tmp_path / "2.0.0"), tmp_path / "elsewhere", capsys)
    assert [change["accepted"] for change in document["changes"]] == [False]
