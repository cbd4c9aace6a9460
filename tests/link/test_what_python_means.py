"""Names as Python makes them, where that is not what the text of the code suggests."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

NODE = """
import abc
import dataclasses
import dataclasses as dc
import functools
import typing
from pkg import tools
from pkg.tools import Tool
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

@dataclasses.dataclass
class Row:
    name: str = "n"
    space: str = ""
    more: list = dataclasses.field(default_factory=lambda: ["m"])
    kept: str = dataclasses.field(default="k", init=False)
    def full(self): return self.space + "/" + self.name
    def __post_init__(self): self.other = self.name + "_o"
@dataclasses.dataclass
class LongRow(Row):
    last: str = "l"
@dc.dataclass
class Short:
    word: str = "w"
@tools.define
class Odd:
    way: str = "w"
class Strange(metaclass=tools.Maker):
    wish: str = "w"
class Usual(metaclass=abc.ABCMeta):
    wing: str = "w"
class Looked:
    wood = "w"
    def __getattribute__(self, name): return "l"
class Holder:
    def __init__(self, given):
        self.held = given
        tools.note(given)
    def ask(self): return self.held
class Pair(typing.NamedTuple):
    first: str
    second: str = "s"
def collected(name, names=[]):
    names.append(name)
    return "_".join(names)
class Counted:
    made = 0
    def __init__(self): Counted.made += 1

class Named:
    KIND = "kind"
    def __init__(self, name): self._name = name
    @property
    def name(self): return self._name
    @name.setter
    def name(self, name): self._name = "set_" + name
    @staticmethod
    def clean(name): return name.strip("/")
    @classmethod
    def marked(cls, name): return "m_" + name
    def kinds(self, node):
        node.create_publisher(String, "before_" + self.KIND, 10)
        self.KIND = "other"
def around(function):
    @functools.wraps(function)
    def inner(*args): return "around_" + function(*args)
    return inner
@around
def wrapped(name): return name
@functools.lru_cache
def kept(name): return name
@tools.cache
def cached(name): return name
def joined(a, b="b", *more, c="c"): return a + b + "".join(more) + c
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.start()
    def start(self):
{body}
def main():
    rclpy.spin(Demo())
if __name__ == "__main__":
    main()
"""
OPEN = "{"
TOOLS = {
    "pkg/tools.py": "class Tool:\n    @staticmethod\n    def clean(name): return name.strip('/')\n",
    "pkg/__init__.py": "",
    "setup.py": "from setuptools import setup\nsetup(name='pkg', packages=['pkg'], entry_points={'console_scripts': ['d = pkg.d:main']})\n",
}
ROWS = [
    ("a property that is set", 'd = Named("d")\nd.name = "q"\npub(d.name)', [OPEN]),
    ("a function of a class", 'pub(Named.clean("/a/") + Named.marked("b"))', ["am_b"]),
    ("a function of a class of another module", 'pub(tools.Tool.clean("/a/") + Tool.clean("b/"))', ["ab"]),
    ("a variable like a class", 'Named = other()\npub(Named.clean("/a/"))', [OPEN]),
    ("a data class", 'pub(Row("a", "b").full())', ["b/a"]),
    ("a data class by names", 'pub(Row(space="b").full())', ["b/n"]),
    ("what a data class does in the end", 'pub(Row("a").other)', ["a_o"]),
    ("a list of a data class", "pub(Row().more[0] + Row().kept)", ["mk"]),
    ("a data class of another", 'pub(LongRow("a", "b").full())', ["b/a"]),
    ("what a data class has beside another", 'pub(LongRow("a", "b", [], "c").last)', ["l", "{last}"]),
    ("a data class by another name of its module", 'pub(Short("a").word)', ["a"]),
    ("a decorator that is not known", 'pub(Odd("a").way)', ["w", "{way}"]),
    ("a metaclass", 'pub(Strange("a").wish)', ["w", "{wish}"]),
    ("a metaclass that leaves a class as it is", "pub(Usual().wing)", ["w"]),
    ("a class that looks its attributes up itself", "pub(Looked().wood)", ["w", "{wood}"]),
    ("a member whose value is handed on, too", 'pub(Holder("a").ask())', ["a"]),
    ("a named tuple", 'pub(Pair("a").first + Pair("b", "c").second)', ["ac"]),
    ("a variable of a class", 'Counted()\npub("n%d" % Counted.made)', ["n0", "n{made}"]),
    ("a default that calls before have changed", 'collected("a")\npub(collected("b"))', [OPEN]),
    ("a decorator", 'pub(wrapped("a"))', [OPEN]),
    ("a decorator that is called as a known one", 'pub(cached("a"))', [OPEN]),
    ("a decorator that keeps results", 'pub(kept("a"))', ["a"]),
    ("a table of arguments", 'pub(joined("a", **{"b": "x"}))', ["axc"]),
    ("a table that is not known", 'pub(joined("a", **table()))', [OPEN]),
    ("a list of arguments", 'pub(joined(*("a", "x", "y")))', ["axyc"]),
    ("a list that is not known", 'pub(joined("a", *names()))', [OPEN]),
    ("a member that is set behind", "Named('d').kinds(self)", ["before_kind"]),
    ("a member that is set behind, asked again", "d = Named('d')\nd.kinds(self)\nd.kinds(self)", ["before_kind", "before_other"]),
    ("a number of a text", 'pub("n" + str(int("5") * 2) + str(float("2")))', ["n102.0"]),
    ("a list twice", 'l = ["a"]\nm = [l] * 2\nm[0].append("b")\npub("_".join(l))', [OPEN]),
    ("an end behind a break", 'n = "a"\nwhile True:\n    try:\n        break\n    finally:\n        n = "b"\npub(n)', ["b"]),
    ("an end behind a round", 'n = "a"\nfor i in range(2):\n    try:\n        continue\n    finally:\n        n += "b"\npub(n)', ["abb"]),
]  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_names_are_what_the_program_makes(workspace: Any, body: str, expected: list[str]) -> None:
    """One name is told as folded, several as possible; what is not followed has a hole."""
    lines = "\n".join(
        f"{line[: line.index('pub(')]}self.create_publisher(String, {line[line.index('pub(') + 4 : -1]}, 10)"
        if "pub(" in line
        else line
        for line in body.split("\n")
    )
    package = workspace.package({"pkg/d.py": NODE.format(body=indent(lines, " " * 8)), **TOOLS})
    published = (entry for entry in package.interfaces() if entry.role == "publisher")
    found = [entry for entry in published if "kinds" in body or "before" not in entry.name]
    if expected == [OPEN]:
        assert found
        assert all(OPEN in entry.name for entry in found)
    else:
        assert sorted(entry.name for entry in found) == [f"/{name}" for name in expected]
        assert all((entry.confidence in {"folded", "literal"}) == (len(expected) == 1) for entry in found)
