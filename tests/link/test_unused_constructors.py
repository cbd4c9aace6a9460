"""What a constructor makes that nobody of the tree calls is of no program."""

from __future__ import annotations

from typing import Any

import pytest

PROGRAM = """
#include <ros/ros.h>
class Nav {{
 public:
  Nav(ros::NodeHandle & n) {{ sub_ = n.subscribe("fixed", 1, cb); }}
  Nav(ros::NodeHandle & n, const std::string & topic) {{ sub_ = n.subscribe(topic, 1, cb); }}
  ros::Subscriber sub_;
}};
{more}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle n;
  {made}
  ros::spin();
}}
"""
HOLDER = "struct Holder {{ Nav nav_; explicit Holder(ros::NodeHandle & n) : nav_({args}) {{}} }};"
BASE = 'struct Own : Nav { explicit Own(ros::NodeHandle & n) : Nav(n, "own") {} };'
ONE, BOTH = ["/fixed"], ["/fixed", "/given"]
OPEN = ["/fixed", "/{n}/{topic}"]
"""What the other constructor makes is told where somebody may call it whom nobody sees."""
ROWS = [
    ("a variable", "", "Nav nav(n);", ONE),
    ("a pointer", "", "Nav * nav; nav = new Nav(n);", ONE),
    ("a shared pointer", "", "auto nav = std::make_shared<Nav>(n);", ONE),
    ("a member", HOLDER.format(args="n"), "Holder holder(n);", ONE),
    ("the other one", "", 'Nav nav(n, "given");', ["/given"]),
    ("both", "", 'Nav nav(n); Nav other(n, "given");', BOTH),
    ("in a list", "", 'std::vector<Nav> all; all.emplace_back(n, "given"); Nav nav(n);', BOTH),
    ("by a template", "", "Nav nav(n); make<Nav>(n);", OPEN),
    ("by another name", "using Other = Nav;", 'Nav nav(n); Other other(n, "given");', BOTH),
    ("in braces that are assigned", "", 'Nav nav(n); nav = {n, "given"};', OPEN),
    ("in braces that are handed", "void use(const Nav & nav) {}", 'Nav nav(n); use({n, "given"});', OPEN),
    ("in braces that are returned", 'Nav made(ros::NodeHandle & n) { return {n, "given"}; }', "Nav nav(n);", OPEN),
    ("in an array", "", 'Nav nav(n); Nav all[1] = {{n, "given"}};', OPEN),
    ("in place", "", 'Nav nav(n); std::optional<Nav> other; other.emplace(n, "given");', BOTH),
    (
        "a member by its default",
        'struct Holder { ros::NodeHandle n; Nav nav_{n, "given"}; };',
        "Nav nav(n);",
        ["/fixed"],
    ),
    ("a class that derives from it", BASE, "Nav nav(n); Own own(n);", ["/fixed", "/own"]),
]


@pytest.mark.parametrize(("more", "made", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_objects_have_what_the_constructor_makes_that_is_called(
    workspace: Any, more: str, made: str, expected: list[str]
) -> None:
    """Constructors are told apart by the number of arguments, where all that makes objects is seen."""
    build = "project(pkg)\nadd_executable(demo src/demo.cpp)\n"
    package = workspace.package({"CMakeLists.txt": build, "src/demo.cpp": PROGRAM.format(more=more, made=made)}, ros=1)
    assert sorted(each.name for each in package.interfaces() if each.role == "subscriber") == expected
