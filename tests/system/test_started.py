"""What a launch starts, as provisions and requirements that the checker asks."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from workspaces import Workspace

from ecm_extract.cli.run import run
from ecm_extract.extraction_model import Options
from ecm_extract.system.model import Given
from ecm_extract.system.started import started_package
from ecm_extract.system.system import read_system
from ecm_extract.tree import open_tree

LAUNCH = """<launch>
  <arg name="manager" default="arm_manager"/>
  <group {ns}>
    <node pkg="nodelet" type="nodelet" name="$(arg manager)" args="manager"/>
  </group>
  <node pkg="nodelet" type="nodelet" name="hand" args="load hand/Hand {slash}$(arg manager)"/>
  <node pkg="keys" type="keys" name="keys"><remap from="command" to="/arm_manager/command"/></node>
</launch>
"""


def launched(workspace: Workspace, ns: str = "", slash: str = "") -> Path:
    workspace.package({"launch/arm.launch": LAUNCH.format(ns=ns, slash=slash)}, 1)
    return workspace.root


def said(root: Path, capsys: pytest.CaptureFixture[str]) -> list[tuple[str, str]]:
    run(["check", str(root), "--launch", "pkg/launch/arm.launch", "--format", "json"])
    found = json.loads(capsys.readouterr().out)["findings"]
    return [(each["rule"], each["message"]) for each in found if each["rule"] in {"SIG015", "SIG016"}]


def test_names_are_what_the_launch_makes_of_them(workspace: Workspace) -> None:
    system = read_system(
        open_tree(launched(workspace, 'ns="left"', "/")), ["pkg/launch/arm.launch"], Given(), Options(cache=False)
    )
    package = started_package(system)
    assert {each.name for each in package.provides} == {"/left/arm_manager", "hand", "keys"}
    rows = {(each.use, each.name, each.target, each.by) for each in package.requires}
    assert rows == {
        ("loads_into", "arm_manager", "/arm_manager", "node /hand"),
        ("remaps", "command", "/arm_manager/command", "node /keys"),
    }


def test_a_container_that_is_named_absolutely_is_told(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    """Only the evaluated launch shows that both come of one argument."""
    found = said(launched(workspace, slash="/"), capsys)
    assert [rule for rule, message in found if "/arm_manager is absolute" in message] == ["SIG015"]


def test_a_relative_container_is_right(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    assert said(launched(workspace), capsys) == []


def test_a_name_below_a_node_in_a_namespace_is_told(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    found = said(launched(workspace, 'ns="left"'), capsys)
    assert [rule for rule, message in found if "only /left/arm_manager is started" in message] == ["SIG016"]
