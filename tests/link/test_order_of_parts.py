"""Bounds of reading statements of Python in the order in which their parts run: a name is right, or a gap is told."""

from __future__ import annotations

from typing import Any

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.link.running.in_order import MAX_PARTS
from ecm_extract.link.running.names_by_calls import MAX_REACHED
from ecm_extract.tree import open_tree

_HEAD = """
from rclpy.node import Node
from std_msgs.msg import String
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.name = "before"
        self.create_publisher(String, {name}, 10)
    def change(self, given=""):
        self.name = "after"
        return "/"
"""


def test_a_call_behind_many_others_may_change_what_is_read_next(workspace: Any) -> None:
    """However many functions a call leads through, what it changes counts for what the statement reads behind it."""
    count = MAX_REACHED + 20
    chain = [f"    def f{at}(self):\n        return self.f{at + 1}()\n" for at in range(count)]
    chain.append(f"    def f{count}(self):\n        return self.change()\n")
    text = _HEAD.format(name="self.f0() + self.name") + "".join(chain)
    names = [one.name for one in workspace.package({"d.py": text}).interfaces() if one.role == "publisher"]
    assert "/before" not in names


def test_a_statement_of_too_many_parts_is_a_gap(workspace: Any) -> None:
    """Beyond the bound a name may be stale, so the line is told as one that is not followed."""
    name = " + ".join(["self.change()", *["self.change(self.name)"] * (MAX_PARTS // 2), "self.name"])
    workspace.package({"d.py": _HEAD.format(name=name)})
    found = extract(open_tree(workspace.root), Options(jobs=1))
    assert ("values-left-out", 8) in [(entry.code, entry.line) for entry in found.diagnostics]
    assert [entry.reason for entry in found.unread] == ["unfollowed"]


def test_a_loop_over_a_long_table_is_followed(workspace: Any) -> None:
    """A table of parameters has as many entries as it has."""
    table = "\n".join(f'    "p{at}": {at},' for at in range(200))
    loop = "\n        for key, value in TABLE.items():\n            self.declare_parameter(key, value)\n"
    text = f"TABLE = {{\n{table}\n}}\n" + _HEAD.format(name='"a"').replace("\n    def change", loop + "    def change")
    found = [one for one in workspace.package({"d.py": text}).interfaces() if one.role == "parameter"]
    assert {(one.name, one.default) for one in found} == {(f"p{at}", at) for at in range(200)}
