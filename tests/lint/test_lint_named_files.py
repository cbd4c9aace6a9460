"""Files that launch files name and that are not there (LNT001)."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

BUILD = "project(pkg)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
ROWS = [
    ('<param name="map" value="$(find pkg)/maps/home.yaml"/>', "", False),
    ('<param name="map" value="$(find pkg)/map/home.yaml"/>', "", True),
    ('<param name="map" value="file://$(find pkg)/maps/away.yaml"/>', "", True),
    ('<arg name="map" default="$(find pkg)/maps/away.yaml"/>', "", True),
    ('<arg name="map" default="$(find pkg)/maps/$(arg name).yaml"/>', "", False),
    ('<arg name="map" default="$(find other)/maps/away.yaml"/>', "", False),
    ('<arg name="log" default="$(find pkg)/log/all.csv"/>', "", False),
    ('<!-- <arg name="map" default="$(find pkg)/maps/away.yaml"/> -->', "", False),
    ('<arg name="map" default="$(find pkg)/maps/away.yaml"/>', "configure_file(a.in maps/away.yaml)", False),
    ('<arg name="map" default="$(find pkg)/home.yaml"/>', "install(FILES maps/home.yaml DESTINATION share/pkg)", False),
    ('<arg name="map" default="$(find pkg)/sub/away.yaml"/>', "", False),
]


@pytest.mark.parametrize(("line", "build", "expected"), ROWS)
def test_named_files(workspace: Workspace, line: str, build: str, expected: bool) -> None:
    """What a build makes, a rule installs there, or a submodule holds may be there in time."""
    files = {"CMakeLists.txt": BUILD + build, "launch/a.launch": f"<launch>{line}</launch>", "maps/home.yaml": "a: 1\n"}
    workspace.package(files, ros=1)
    (workspace.root / ".gitmodules").write_text('[submodule "sub"]\n  path = pkg/sub\n', "utf-8")
    found = [finding.rule for finding in lint(workspace.root)]
    assert ("LNT001" in found) is expected


@pytest.mark.parametrize(("archive", "severity"), [("maps/all.zip", "info"), ("all.tar.gz", "warning")])
def test_an_archive_in_its_folder_may_hold_it(workspace: Workspace, archive: str, severity: str) -> None:
    """Somebody unpacks it before the first start."""
    line = '<arg name="map" default="$(find pkg)/maps/away.yaml"/>'
    files = {"CMakeLists.txt": BUILD, "launch/a.launch": f"<launch>{line}</launch>", archive: "PK"}
    workspace.package(files, ros=1)
    assert [finding.severity for finding in lint(workspace.root) if finding.rule == "LNT001"] == [severity]
