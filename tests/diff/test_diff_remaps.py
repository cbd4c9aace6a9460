"""Remaps connect: they are what a rename breaks."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release, write

from ecm_extract.cli.run import run

ROOT = "project({name})\nadd_executable({name} src/{name}.cpp)\ninstall(TARGETS {name} DESTINATION lib/{name})\n"
PUBLISHES = 'p_ = create_publisher<std_msgs::msg::Bool>("%s", 1);'
LISTENS = 's_ = create_subscription<std_msgs::msg::Bool>("%s", 1, nullptr);'


def _lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], listens: str, launch: str, below: str = ""
) -> dict[str, list[int]]:
    repo, user = tmp_path / "arm", tmp_path / "user"
    for tag, name in (("1.0.0", "events/bumper"), ("2.0.0", "events/contact")):
        files = {"CMakeLists.txt": ROOT.format(name="arm"), "src/arm.cpp": node(PUBLISHES % (below + name))}
        release(repo, {"package.xml": package("arm", tag), **files}, tag)
    files = {
        "CMakeLists.txt": ROOT.format(name="user"),
        "src/user.cpp": node(LISTENS % listens),
        "launch/a.launch.xml": launch,
    }
    write(user, {"package.xml": package("user"), **files})
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--consumer", str(user), "--format", "json", "--no-cache"])
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["findings"]
    places = [
        each for entry in found for each in entry["evidence"] if each["path"] in {"src/user.cpp", "launch/a.launch.xml"}
    ]
    return {
        path: [each["line"] for each in places if each["path"] == path] for path in {each["path"] for each in places}
    }


LAUNCH = '<launch>\n<node pkg="{pkg}" exec="{pkg}">\n<remap from="{old}" to="{new}"/>\n</node>\n</launch>\n'


@pytest.mark.parametrize(
    ("listens", "launch", "expected"),
    [
        ("events/bumper", "<launch/>", {"src/user.cpp": [7]}),
        ("events/bumper", LAUNCH.format(pkg="user", old="events/bumper", new="base/other"), {}),
        ("hit", LAUNCH.format(pkg="user", old="hit", new="events/bumper"), {"launch/a.launch.xml": [3]}),
        ("hit", LAUNCH.format(pkg="arm", old="events/bumper", new="hit"), {"launch/a.launch.xml": [3]}),
        ("hit", LAUNCH.format(pkg="arm", old="events/cliff", new="hit"), {}),
    ],
)
def test_a_remap_is_what_breaks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], listens: str, launch: str, expected: dict[str, list[int]]
) -> None:
    """The line that names the old name, in a launch file as in a program; a program that is led elsewhere does not."""
    assert _lines(tmp_path, capsys, listens, launch) == expected


NAMED = """<launch>
<node pkg="{pkg}" exec="{pkg}" name="{name}">
<remap from="{name}/{old}" to="{new}"/>
</node>
</launch>
"""


@pytest.mark.parametrize(
    ("listens", "launch", "expected"),
    [
        ("~/events/bumper", NAMED.format(name="u", pkg="user", old="events/bumper", new="base/events/bumper"), True),
        ("~/hit", NAMED.format(name="u", pkg="user", old="hit", new="base/events/bumper"), True),
        ("~/events/bumper", NAMED.format(name="u", pkg="user", old="events/bumper", new="base/other"), False),
        ("hit", NAMED.format(name="a", pkg="arm", old="events/bumper", new="hit"), True),
    ],
)
def test_a_name_below_the_node_is_its_private_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], listens: str, launch: str, expected: bool
) -> None:
    """`u/events/bumper` of the node `u` is `~/events/bumper`; who listens is not who speaks."""
    found = _lines(tmp_path, capsys, listens, launch, "~/")
    assert found == ({"launch/a.launch.xml": [3]} if expected else {})
