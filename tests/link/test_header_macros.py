"""What macros of headers stand for is told of the files that call them."""

from __future__ import annotations

import time
from typing import Any

import pytest
from ecm_parsers.source.facts import Replacement, SourceFile

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.macros.reached import Reached
from ecm_extract.macros.undecided import declaring_macros
from ecm_extract.tree import open_tree

GET = "#define GET(name, value) node->declare_parameter(#name, value)\n"
SHORT = GET + "#define GET_RATE() GET(rate, 10)\n"
OTHER = '#define GET(name, value) node->declare_parameter("other_" #name, value)\n'
CALL = """
#include <rclcpp/rclcpp.hpp>
#include "{header}"
void ask(rclcpp::Node::SharedPtr node, std::string name, int value) {{ node->declare_parameter(name, value); }}
int main() {{ auto node = std::make_shared<rclcpp::Node>("demo"); {call} }}
"""
CMAKE = "add_executable(d src/d.cpp)"
ROWS = [
    ("its header", {"src/get.hpp": GET}, "get.hpp", "GET(rate, 10);", ["rate"]),
    ("its header includes it", {"src/get.hpp": GET, "src/all.hpp": '#include "get.hpp"\n'}, "all.hpp", "GET(rate, 10);", ["rate"]),
    ("a macro that leads to it", {"src/get.hpp": SHORT}, "get.hpp", "GET_RATE();", ["rate"]),
    ("a header that it does not include", {"src/get.hpp": GET, "src/all.hpp": ""}, "all.hpp", "GET(rate, 10);", []),
    ("two headers differ", {"src/get.hpp": GET, "src/other.hpp": OTHER, "src/all.hpp": '#include "get.hpp"\n#include "other.hpp"\n'},
     "all.hpp", "GET(rate, 10);", []),
    ("a function of the file", {"src/get.hpp": "#define GET(name, value) ask(node, #name, value)\n"}, "get.hpp", "GET(rate, 10);", ["rate"]),
    ("a name put together of two", {"src/get.hpp": GET + "#define CALL(what) G##what(rate, 10)\n"}, "get.hpp", "CALL(ET);", ["rate"]),
    ("undefined behind it", {"src/get.hpp": GET + "#undef GET\n"}, "get.hpp", "GET(rate, 10);", []),
]  # fmt: skip


@pytest.mark.parametrize(
    ("files", "header", "call", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS]
)
def test_calls_of_macros_of_headers(
    workspace: Any, files: dict[str, str], header: str, call: str, expected: list[str]
) -> None:
    """A macro of a header that the file includes declares what it declares; one of two that differ is not known."""
    source = CALL.format(header=header, call=call)
    package = workspace.package({**files, "src/d.cpp": source, "CMakeLists.txt": CMAKE})
    assert [
        entry.name for entry in package.interfaces() if entry.role == "parameter" and "{" not in entry.name
    ] == expected


LOGS = "#define GET(name, value) std::log::write(#name, value)\n"
HELPED = "#define GET(name, value) ask(node, #name, value)\n"
SAID = [
    ("one of both declares", GET, OTHER, ["cpp-macros"]),
    ("one calls what declares", HELPED, HELPED.replace("#name", '"a_" #name'), ["cpp-macros"]),
    ("neither declares", LOGS, LOGS.replace("write", "skip"), []),
]


@pytest.mark.parametrize(("one", "other", "codes"), [row[1:] for row in SAID], ids=[row[0] for row in SAID])
def test_two_headers_that_differ_are_said(workspace: Any, one: str, other: str, codes: list[str]) -> None:
    """Nothing is told of the call, so that this is told, and limits what anybody says of the tree."""
    files = {"src/get.hpp": one, "src/other.hpp": other}
    source = CALL.format(header="get.hpp", call="GET(rate, 10);").replace("int main", '#include "other.hpp"\nint main')
    found = workspace.package({**files, "src/d.cpp": source, "CMakeLists.txt": CMAKE})
    assert not any(entry.role == "parameter" and "{" not in entry.name for entry in found.interfaces())
    read = extract(open_tree(workspace.root), Options(jobs=1))
    assert [each.code for each in read.diagnostics if each.path.endswith("d.cpp")] == codes
    assert [each.reason for each in read.unread if each.path.endswith("d.cpp")] == ["undecided"] * len(codes)


def test_bodies_that_invite_to_try_all_ways_take_no_time() -> None:
    """Words, spaces and signs of templates by the thousand: with each way tried, the time grew by the square."""
    bodies = [b"a" * 2000 + b" " * 2000, b"a<" * 2000, b"a<b " * 1000, (b"a" + b" " * 50) * 80]
    macros = tuple([Replacement(b"GET", None, body) for body in bodies])
    begun = time.process_time()
    assert declaring_macros(SourceFile("cpp", undecided=macros), {"get"}) == []
    assert time.process_time() - begun < 1


def test_macros_that_break_a_file_are_left_out_and_told(workspace: Any) -> None:
    """Where what macros stand for is no code for the parser, the classes of the file are told as they are written."""
    header = "#define ASK(n) declare_parameter(#n, 1); ((( {{{ case\n"
    source = (
        '#include "rclcpp/rclcpp.hpp"\n#include "pkg/rows.hpp"\nnamespace a {\n'
        'class D : public rclcpp::Node {\npublic:\n  D() : Node("d") {\n'
        '    create_publisher<std_msgs::msg::String>("out", 1);\n    ASK(rate)\n  }\n};\n}\n'
    )
    workspace.package({"include/pkg/rows.hpp": header, "src/d.cpp": source}, name="pkg")
    read = extract(open_tree(workspace.root), Options(jobs=1))
    names = {
        each.name for package in read.packages for module in package.modules for each in module.signature.interfaces
    }
    assert "/out" in names
    assert [each.reason for each in read.unread] == ["undecided"]


def test_a_file_is_read_with_the_macros_that_it_may_come_to() -> None:
    """Those that it names and those that these name, where one calls something; all where names are put together."""
    get, short, other = (
        Replacement(name, params, body)
        for name, params, body in (
            (b"GET", (b"name",), b"ask(name)"),
            (b"SHORT", None, b"GET(rate)"),
            (b"OTHER", (b"name",), b"say(name)"),
        )
    )
    reached = Reached()
    assert reached.by(b"int SHORT;", (other, get, short)) == [get, short]
    assert not reached.by(b"int rate;", (other, get, short))
    assert reached.by(b"int SHORT; a ## b", (other, get, short)) == (other, get, short)
    assert not reached.by(b"int SIZE;", (Replacement(b"SIZE", None, b"3"), get))
