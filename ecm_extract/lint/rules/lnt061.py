"""LNT061: a launch file, description, package.xml or CMakeLists.txt is not well-formed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.cmake_run import run
from ecm_parsers.result import Diagnostic
from ecm_parsers.xml_tree import parse_xml

from ecm_extract.discover import is_test_path
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT061",
    name="file_not_well_formed",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="whoever reads the file stops there with an error: roslaunch, xacro, CMake or the build tool",
    resolution="correct the line, and escape & as &amp; and < as &lt; in XML",
)
_XML = (".launch", ".launch.xml", ".xacro", "/package.xml")
_CMAKE = frozenset({"cmake-syntax", "cmake-unclosed", "cmake-unbalanced"})
_MARKS = (b"{{", b"{%", b"@(", b"<%", b"[ROBOT")
"""Of templates that somebody fills in."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report the first problem of each file that a strict reader refuses."""
    for package in workspace.packages:
        for entry in package.root.files:
            path = entry.path
            if is_test_path(path, package.root.path) or "template" in path.lower():
                continue
            if not f"/{path}".endswith((*_XML, "/CMakeLists.txt")):
                continue
            data = workspace.files.read(path) or b""
            problem = _problem(path, data) if data.strip() else None
            if problem is not None and not any(mark in data for mark in _MARKS):
                entity = Entity("file", path)
                text = f"{path} is not well-formed ({_reason(problem)})"
                yield RULE.finding(text, entity, package.name, [Evidence(path, problem.line)], certainty="proved")


def _problem(path: str, data: bytes) -> Diagnostic | None:
    if path.endswith("CMakeLists.txt"):
        return next((each for each in run(data, {}).diagnostics if each.code in _CMAKE), None)
    return next((each for each in parse_xml(data).diagnostics if each.code == "xml-malformed"), None)


def _reason(problem: Diagnostic) -> str:
    """What is wrong, without what to do."""
    message = problem.message.removeprefix("Not well-formed: ").removesuffix(" Correct the XML.")
    return message.replace("; the line is skipped", "").rstrip(".")
