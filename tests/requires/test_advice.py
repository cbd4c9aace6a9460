"""Arguments that a function asks for by a warning, and calls that leave them out."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from ecm_checker.finding import Finding
from ecm_checker.match.packages import Packages
from ecm_checker.operations.system import system
from workspaces import Workspace

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.stored import package_of
from ecm_extract.tree import open_tree

SETUP = """from setuptools import setup
setup(name='{0}', packages=['{0}'])
"""
SENDER = """import warnings


class Sender:
    def __init__(self, name, latch=False, size=None):
        {body}
"""
ASKS = "if size is None:\n            warnings.warn('give a size')"


def said(root: Path, sender: str, user: str) -> list[Finding]:
    workspace = Workspace(root)
    for name, files in (("wires", {"wires/__init__.py": sender}), ("user", {"user/__init__.py": user})):
        workspace.package({**files, "setup.py": SETUP.format(name)}, name=name)
    found = extract(open_tree(root), Options(jobs=1, hub=True, cache=False))
    packages = Packages([package_of(package) for package in found.packages])
    return [each for each in system((), packages=packages).findings if each.rule == "SIG014"]


@pytest.mark.parametrize(
    ("call", "left_out"),
    [
        ("wires.Sender('a')", True),
        ("wires.Sender('a', latch=True)", True),
        ("wires.Sender('a', False)", True),
        ("wires.Sender('a', size=1)", False),
        ("wires.Sender('a', False, 1)", False),
        ("wires.Sender('a', **given)", False),
    ],
)
def test_a_call_that_leaves_out_what_is_asked_for_is_told(tmp_path: Path, call: str, left_out: bool) -> None:
    """It is a warning: the program goes on."""
    user = f"import wires\n\n\ndef make(given):\n    return {call}\n"
    found = said(tmp_path, SENDER.format(body=ASKS), user)
    assert [(each.severity, each.evidence[0].path, each.evidence[0].line) for each in found] == [
        ("warning", "user/user/__init__.py", 5)
    ] * left_out
    assert all("size" in each.message for each in found)


@pytest.mark.parametrize(
    "body",
    [
        "if size is not None:\n            warnings.warn('size is ignored')",
        "if size is None:\n            size = 1\n        warnings.warn('no more')",
        "if size is None:\n            size = 1\n        else:\n            warnings.warn('size is ignored')",
        "if latch is None:\n            warnings.warn('latch')",
    ],
)
def test_a_warning_for_other_reasons_asks_for_nothing(tmp_path: Path, body: str) -> None:
    user = "import wires\n\n\ndef make():\n    return wires.Sender('a')\n"
    assert said(tmp_path, SENDER.format(body=body), user) == []


def test_what_is_asked_for_is_kept_in_documents(tmp_path: Path) -> None:
    workspace = Workspace(tmp_path).package(
        {"wires/__init__.py": SENDER.format(body=ASKS), "setup.py": SETUP.format("wires")}, name="wires"
    )
    found = extract(open_tree(workspace.root), Options(jobs=1, hub=True, cache=False))
    rows = [row for row in package_of(found.packages[0]).provides if row.name == "__init__"]
    assert [row.advised for row in rows] == [("size",)]
    assert "advised" in msgspec.to_builtins(rows[0])
