"""Which declaration a C++ name means: what a translation unit sees, scope by scope."""

from __future__ import annotations

from typing import Any

import pytest

NODE = (
    '{kind} {name} {{ void open(rclcpp::Node * n) {{ n->create_publisher<std_msgs::msg::Bool>("{topic}", 1); }} }};\n'
)
MAIN = 'int main(int c, char ** v) {{ auto n = std::make_shared<rclcpp::Node>("n"); {body} }}\n'
BUILD = "project(pkg)\nadd_executable(one src/one.cpp)\nadd_executable(two src/two.cpp)\n"


def part(name: str, topic: str) -> str:
    """A class that publishes a topic."""
    return NODE.format(kind="struct", name=name, topic=topic)


def main(body: str, head: str = "") -> str:
    """A program."""
    return head + MAIN.format(body=body)


def published(workspace: Any, module: str = "one") -> set[str]:
    """Topics that a program publishes."""
    found = workspace.modules().get(f"ecm.pkg.{module}")
    entries = found.signature.interfaces if found is not None else ()
    return {entry.name for entry in entries if entry.role == "publisher"}


TWO_SPACES = f"namespace a {{ {part('Part', 'a')} }} namespace b {{ {part('Part', 'b')} }}\n"
OPEN = "part.open(n.get());"
SCOPES = {
    "qualified": (TWO_SPACES, f"b::Part part; {OPEN}", {"/b"}),
    "using-directive": (f"{TWO_SPACES}using namespace b;\n", f"Part part; {OPEN}", {"/b"}),
    "using-declaration": (f"{TWO_SPACES}using a::Part;\n", f"Part part; {OPEN}", {"/a"}),
    "namespace alias": (f"{TWO_SPACES}namespace short_one = a;\n", f"short_one::Part part; {OPEN}", {"/a"}),
    "typedef": (f"{TWO_SPACES}typedef b::Part Other;\n", f"Other part; {OPEN}", {"/b"}),
    "two that are not told apart": (
        f"{TWO_SPACES}using namespace a;\nusing namespace b;\n",
        f"Part part; {OPEN}",
        set(),
    ),
    "of another namespace": (TWO_SPACES, f"Part part; {OPEN}", set()),
    "a member of a base": (
        f"struct Base {{ {part('Part', 'inner')} }};\nstruct Own : Base {{}};\n{part('Part', 'outer')}",
        f"Own::Part part; {OPEN}",
        {"/inner"},
    ),
    "inline namespace": (
        f"namespace a {{ inline namespace v2 {{ {part('Part', 'new')} }} namespace v1 {{ {part('Part', 'old')} }} }}\n",
        f"a::Part part; {OPEN}",
        {"/new"},
    ),
    "inline namespace, by its name": (
        f"namespace a::inline v2 {{ {part('Part', 'new')} }}\n",
        f"a::v2::Part part; {OPEN}",
        {"/new"},
    ),
    "a namespace that uses another": (
        f"{TWO_SPACES}namespace c {{ using namespace a; }}\n",
        f"c::Part part; {OPEN}",
        {"/a"},
    ),
    "a namespace that uses another, and has its own": (
        f"{TWO_SPACES}namespace c {{ using namespace a; {part('Part', 'own')} }}\n",
        f"c::Part part; {OPEN}",
        {"/own"},
    ),
    "an alias of something outside": (
        f"{part('Part', 'own')} namespace a {{ using Part = elsewhere::Part; }}\n",
        f"a::Part part; {OPEN}",
        set(),
    ),
}


@pytest.mark.parametrize(("head", "body", "topics"), SCOPES.values(), ids=SCOPES)
def test_a_class_is_looked_up_scope_by_scope(workspace: Any, head: str, body: str, topics: set[str]) -> None:
    """Scopes outwards with what their directives and declarations bring; of two that fit none is chosen."""
    workspace.package({"CMakeLists.txt": BUILD, "src/one.cpp": main(body, head)})
    assert published(workspace) == topics


FUNCTION = 'inline void {0}(rclcpp::Node * n) {{ n->create_publisher<std_msgs::msg::Bool>("{1}", 1); }}\n'
FUNCTIONS = {
    "innermost": ("namespace a { %s void go(rclcpp::Node * n) { announce(n); } }\n%s", "a::go(n.get());", {"/inner"}),
    "qualified": ("namespace a { %s }\n%s", "::announce(n.get());", {"/outer"}),
    "of another namespace": ("namespace a { %s }\nnamespace b { %s }\n", "announce(n.get());", set()),
    "outside": ("namespace a { %s }\n%s", "library::announce(n.get());", set()),
}


@pytest.mark.parametrize(("head", "body", "topics"), FUNCTIONS.values(), ids=FUNCTIONS)
def test_a_function_is_looked_up_scope_by_scope(workspace: Any, head: str, body: str, topics: set[str]) -> None:
    """A call means the function of its scope, and a name of a library none of the tree."""
    text = head % (FUNCTION.format("announce", "inner"), FUNCTION.format("announce", "outer"))
    workspace.package({"CMakeLists.txt": BUILD, "src/one.cpp": main(body, text)})
    reached = {
        entry.name
        for entry in workspace.interfaces()
        if entry.role == "publisher" and any(place.path.endswith("one.cpp") for place in entry.evidence)
    }
    assert published(workspace) == topics & reached


def test_a_header_beside_is_no_header_that_is_included(workspace: Any) -> None:
    """Two headers of one name in sibling folders: each program has what its own declares (R1)."""
    files = {}
    for folder, name in (("a", "one"), ("b", "two")):
        files[f"{folder}/main_window.hpp"] = "struct Window { void open(rclcpp::Node * n); };\n"
        files[f"{folder}/main_window.cpp"] = (
            '#include "main_window.hpp"\n'
            f'void Window::open(rclcpp::Node * n) {{ n->create_publisher<std_msgs::msg::Bool>("{name}", 1); }}\n'
        )
        files[f"{folder}/{name}.cpp"] = main("Window part; " + OPEN, '#include "main_window.hpp"\n')
    sources = {"one": "a/one.cpp a/main_window.cpp", "two": "b/two.cpp b/main_window.cpp"}
    build = "".join(f"add_executable({name} {listed})\n" for name, listed in sources.items())
    files["CMakeLists.txt"] = f"project(pkg)\n{build}"
    workspace.package(files)
    assert (published(workspace, "one"), published(workspace, "two")) == ({"/one"}, {"/two"})


def test_an_angled_include_is_not_looked_for_beside_the_file(workspace: Any) -> None:
    """`<part.hpp>` is the header of the folders of the target."""
    build = "project(pkg)\nadd_executable(one src/one.cpp)\ntarget_include_directories(one PRIVATE inc)\n"
    files = {"CMakeLists.txt": build, "src/part.hpp": part("Part", "beside"), "inc/part.hpp": part("Part", "inc")}
    workspace.package({**files, "src/one.cpp": main(f"Part part; {OPEN}", "#include <part.hpp>\n")})
    assert published(workspace) == {"/inc"}


def test_what_is_not_included_is_not_meant(workspace: Any) -> None:
    """A class of the same package that the translation unit does not see is none of its."""
    files = {"src/two.cpp": main(f"Part part; {OPEN}", part("Part", "two")), "src/one.cpp": main(f"Part part; {OPEN}")}
    workspace.package({"CMakeLists.txt": BUILD, **files})
    assert (published(workspace, "one"), published(workspace, "two")) == (set(), {"/two"})


def test_a_definition_of_the_target_is_meant(workspace: Any) -> None:
    """One declaration, two programs that define it each for themselves."""
    files = {"include/pkg/setup.hpp": "void announce(rclcpp::Node * n);\n"}
    for name in ("one", "two"):
        body = f'n->create_publisher<std_msgs::msg::Bool>("{name}", 1);'
        files[f"src/{name}_setup.cpp"] = f'#include "pkg/setup.hpp"\nvoid announce(rclcpp::Node * n) {{ {body} }}\n'
        files[f"src/{name}.cpp"] = main("announce(n.get());", '#include "pkg/setup.hpp"\n')
    build = "".join(f"add_executable({name} src/{name}.cpp src/{name}_setup.cpp)\n" for name in ("one", "two"))
    workspace.package({"CMakeLists.txt": f"project(pkg)\ninclude_directories(include)\n{build}", **files})
    assert (published(workspace, "one"), published(workspace, "two")) == ({"/one"}, {"/two"})


def test_a_member_defined_through_another_name_of_its_class_is_inside_it(workspace: Any) -> None:
    """After `using space::Part` its members are defined as those of `Part`, and see what `space` has."""
    head = 'namespace space { struct Inner { Inner(rclcpp::Node * n) { n->create_publisher<A>("inner", 1); } };\n'
    head += "struct Part { void open(rclcpp::Node * n); }; }\nusing space::Part;\n"
    head += "void Part::open(rclcpp::Node * n) { Inner inner(n); }\n"
    workspace.package({"CMakeLists.txt": BUILD, "src/one.cpp": main(f"Part part; {OPEN}", head)})
    assert published(workspace) == {"/inner"}


CONSTANTS = {
    "own namespace": ('namespace b { const char NAME[] = "b"; } namespace a { const char NAME[] = "a"; %s }', "/a"),
    "other file of the package": ("namespace a { %s }", None),
    "two values": ('#ifdef X\n#define NAME "x"\n#else\n#define NAME "y"\n#endif\nnamespace a { %s }', None),
}


@pytest.mark.parametrize(("head", "topic"), CONSTANTS.values(), ids=CONSTANTS)
def test_a_constant_is_looked_up_scope_by_scope(workspace: Any, head: str, topic: str | None) -> None:
    """What another source of the package calls the same is another constant; of two values none is claimed."""
    go = "void go(rclcpp::Node * n) { n->create_publisher<std_msgs::msg::Bool>(NAME, 1); }"
    files = {"src/one.cpp": main("a::go(n.get());", head % go), "src/two.cpp": main("", 'const char NAME[] = "two";\n')}
    workspace.package({"CMakeLists.txt": BUILD, **files})
    found = [entry for entry in workspace.interfaces() if entry.role == "publisher"]
    assert [entry.name for entry in found] == [topic or "/{NAME}"]
    assert [entry.confidence for entry in found] == ["folded" if topic else "pattern"]


MAKER = (
    "struct Part {{ void open(rclcpp::Node * n, const std::string & t)"
    ' {{ n->create_publisher<A>(t + "/{0}", 1); }} }};\n'
)
INHERITED = f"""namespace core {{
{MAKER.format("core")} using PartPtr = std::shared_ptr<Part>;
struct Base {{ PartPtr part; }};
}}
namespace other {{
{MAKER.format("other")} struct Own : core::Base {{ void go(rclcpp::Node * n) {{ part->open(n, "told"); }} }};
}}
"""


def test_the_type_of_an_inherited_member_is_looked_up_where_the_base_stands(workspace: Any) -> None:
    """The base names the class of its member by a name of its own namespace, here a pointer to it."""
    text = main("other::Own own; own.go(n.get());", INHERITED)
    workspace.package({"CMakeLists.txt": BUILD, "src/one.cpp": text})
    told = {entry.name for entry in workspace.interfaces() if entry.name.startswith("/told")}
    assert told == {"/told/core"}
