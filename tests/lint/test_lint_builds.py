"""A repository may hold several workspaces."""

from __future__ import annotations

from typing import Any

import pytest
from lint_fixtures import lint

from ecm_extract.discover import PackageRoot
from ecm_extract.extraction_model import Options
from ecm_extract.lint.builds import builds
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.tree import open_tree

ROWS = [
    (["a", "b"], [["a", "b"]]),
    (["1/a", "1/b", "2/a", "c"], [["c"], ["1/a", "1/b"], ["2/a"]]),
    (["x/1/a", "x/2/a", "x/3/b", "c"], [["c"], ["x/3/b"], ["x/1/a"], ["x/2/a"]]),
    (["x/1/ros1/a", "x/1/ros2/a", "x/2/a"], [["x/1/ros1/a"], ["x/1/ros2/a"], ["x/2/a"]]),
]


@pytest.mark.parametrize(("paths", "expected"), ROWS, ids=[" ".join(row[0]) for row in ROWS])
def test_groups(paths: list[str], expected: list[list[str]]) -> None:
    """No group holds a name twice, and what stands once stays together."""
    packages = [PackageFacts(PackageRoot(path, None, ())) for path in paths]
    assert [[package.root.path for package in group] for group in builds(packages)] == expected


def test_a_package_is_that_of_its_own_workspace(workspace: Any) -> None:
    """The first exercise has the file that its launch file includes, the second has not."""
    text = '<launch><include file="$(find demo)/launch/b.launch"/></launch>'
    for name in ("one", "two"):
        workspace.package({"launch/a.launch": text}, ros=1, name=f"{name}/demo")
        manifest = workspace.root / name / "demo" / "package.xml"
        manifest.write_text(manifest.read_text().replace(f"{name}/demo", "demo"))
    (workspace.root / "one" / "demo" / "launch" / "b.launch").write_text("<launch/>")
    found = [each.evidence[0].path for each in lint(workspace.root) if each.rule == "LNT001"]
    assert found == ["two/demo/launch/a.launch"]


@pytest.mark.parametrize(("inner", "expected"), [("maps", []), ("other", ["demo/maps/launch/a.launch"])])
def test_a_package_within_a_package_hides_no_other_of_its_name(inner: str, expected: list[str], workspace: Any) -> None:
    """No build tool looks for packages within a package: the name means the one elsewhere, which has the file."""
    text = f'<launch><include file="$(find {inner})/launch/c.launch"/></launch>'
    workspace.package({"launch/b.launch": "<launch/>"}, ros=1, name="demo")
    workspace.package({"launch/c.launch": "<launch/>"}, ros=1, name="maps")
    workspace.package({"launch/a.launch": text}, ros=1, name="demo/maps")
    manifest = workspace.root / "demo" / "maps" / "package.xml"
    manifest.write_text(manifest.read_text().replace("demo/maps", inner))
    assert [each.evidence[0].path for each in lint(workspace.root) if each.rule == "LNT001"] == expected


def test_files_of_a_hidden_package_are_still_read(workspace: Any) -> None:
    """They are files of the package around it."""
    for name in ("demo", "maps", "demo/maps"):
        workspace.package({"launch/a.launch": "<launch></group></launch>"}, ros=1, name=name)
    manifest = workspace.root / "demo" / "maps" / "package.xml"
    manifest.write_text(manifest.read_text().replace("demo/maps", "maps"))
    found = [(each.subjects, each.evidence[0].path) for each in lint(workspace.root) if each.rule == "LNT061"]
    assert (("demo",), "demo/maps/launch/a.launch") in [(tuple(names), path) for names, path in found]
    assert len(found) == 3


def test_a_package_that_is_hidden_is_told(workspace: Any) -> None:
    """It is not judged as one of its own, and nothing else says so; one that no other hides is."""
    for name in ("demo", "maps", "demo/maps", "demo/other"):
        workspace.package({}, ros=1, name=name)
        manifest = workspace.root / name / "package.xml"
        manifest.write_text(manifest.read_text().replace(name, name.rpartition("/")[2]))
    tree = open_tree(workspace.root)
    findings_of(Workspace(tree, Options(jobs=1)))
    assert [each.path for each in tree.diagnostics if each.code == "package-hidden"] == ["demo/maps/package.xml"]
