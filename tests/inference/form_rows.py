"""Rows of the table of forms: what is written, and what is true of it."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal

import msgspec

HERE = Path(__file__).parent
_PARTS = "---\n"
_CPP = """#include <rclcpp/rclcpp.hpp>
{around}
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{
{body}
  }}
}};
"""
_PYTHON = """from rclpy.node import Node
from std_msgs.msg import String
{around}
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
{body}
"""


class Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One form.

    Attributes:
        id: number in the table and what is special. ros: 1 or 2.
        cpp, python: the constructor of a node, `---` before it when something stands outside of the class.
        files: a package instead; paths that begin with `../` lie in a neighbouring package.
        say: what is compared beside role and name: fields of an endpoint, `qos`, `condition`.
        roles: only endpoints with these roles; empty for all.
        truth: what is true, one line for each endpoint: `module: role name ...`; parts not known are `{}`.
        wrong: why it is not told yet, by language (`cpp`, `python`, `files`); empty when it is.
    """

    id: str
    truth: tuple[str, ...]
    ros: Literal[1, 2] = 2
    cpp: str = ""
    python: str = ""
    files: Mapping[str, str] = {}
    say: tuple[str, ...] = ()
    roles: tuple[str, ...] = ()
    wrong: Mapping[str, str] = {}

    def variants(self) -> Iterator[tuple[str, Mapping[str, str]]]:
        """Yield the language of each twin with its files."""
        if self.files:
            yield "files", self.files
        if self.cpp:
            yield "cpp", {"src/demo.cpp": _whole(_CPP, self.cpp, "    ")}
        if self.python:
            yield "python", {"pkg/demo.py": _whole(_PYTHON, self.python, "        ")}


def _whole(template: str, text: str, indent: str) -> str:
    around, found, body = text.rpartition(_PARTS)
    lines = "\n".join(indent + line for line in (body if found else text).splitlines())
    return template.format(around=around, body=lines)


def rows() -> list[Row]:
    """Return all rows of all tables."""
    tables = sorted(HERE.glob("*.toml"))
    return [row for path in tables for row in msgspec.convert(tomllib.loads(path.read_text("utf-8"))["row"], list[Row])]
