"""Programs that people wrote, to be run and read like those that are drawn: what a grammar does not come upon.

A file has what stands outside of the node, a line `===`, and then blocks with a line `---` between: each is the body of
a method, so that what one does to variables is nothing to the others. In C++ `PUB(name, 10)` makes a publisher.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from textwrap import indent
from typing import NamedTuple

FOLDER = Path(__file__).parent / "written"
_CPP = """
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"
{includes}
#define PUB create_publisher<std_msgs::msg::String>
namespace p0 {{
{outside}
class Program : public rclcpp::Node {{
 public:
    Program() : Node("node") {{}}
{methods}
    std::string own_ = "own";
    std::vector<std::string> list_;
    std::map<std::string, std::string> table_;
    int count_ = 0;
}};
inline void run(int argc) {{
    Program node;
{calls}
}}
}}
#ifndef BATCH
int main(int argc, char ** argv) {{ p0::run(argc); return 0; }}
#endif
"""
_INCLUDES = (
    "array", "cstring", "deque", "iomanip", "list", "numeric", "regex", "set", "unistd.h", "unordered_map", "variant",
)  # fmt: skip
_PYTHON = """
import collections, copy, dataclasses, enum, functools, itertools, os, re, string, sys, typing
from rclpy.node import Node
from std_msgs.msg import String
{outside}
class Program(Node):
    KIND = "kind"
    def __init__(self):
        super().__init__("node")
        self.own = "own"
        self.names = []
        self.table = {{}}
{methods}
def main():
    node = Program()
{calls}
if __name__ == "__main__":
    main()
"""


_CALL = """    try:
        node.b{at}(len(sys.argv))
    except Exception as error:
        print(error, file=sys.stderr)"""


class Written(NamedTuple):
    """A program with its name."""

    name: str
    text: str


def programs(language: str) -> Iterator[Written]:
    """Yield the programs of a language, `cpp` or `python`."""
    for path in sorted((FOLDER / language).glob("*.txt")):
        outside, _, rest = path.read_text("utf-8").partition("===\n")
        blocks = [block.strip("\n") for block in rest.split("---\n")]
        yield Written(path.stem, _cpp(outside, blocks) if language == "cpp" else _python(outside, blocks))


def _cpp(outside: str, blocks: list[str]) -> str:
    methods = "\n".join(f"    void b{at}(int argc) {{\n{block}\n    }}" for at, block in enumerate(blocks))
    calls = "\n".join(f"    try {{ node.b{at}(argc); }} catch (...) {{}}" for at in range(len(blocks)))
    includes = "\n".join(f"#include <{each}>" for each in _INCLUDES)
    return _CPP.format(includes=includes, outside=outside, methods=methods, calls=calls)


def _python(outside: str, blocks: list[str]) -> str:
    methods = "\n".join(f"    def b{at}(self, argc):\n{indent(block, ' ' * 8)}" for at, block in enumerate(blocks))
    calls = "\n".join(_CALL.format(at=at) for at in range(len(blocks)))
    return _PYTHON.format(outside=outside, methods=methods, calls=calls)
