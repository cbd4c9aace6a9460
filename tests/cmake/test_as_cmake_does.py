"""What the real CMake showed that a reader must do: expressions, scopes, properties, matches, targets from outside."""

from __future__ import annotations

import pytest
from cmake_runs import TOP, facts, targets_of
from ecm_parsers.cmake_facts import CmakeFile, Install, Target

from ecm_extract.cmake.genex import decided, decided_text

FILES = ("src/a.cpp", "src/b.cpp", "src/sub/c.cpp", "src/sub/c.hpp", "include/p/a.hpp", "launch/a.launch")


def run(text: str, **others: str) -> dict[str, CmakeFile]:
    return facts(text, FILES, others, ".txt")


def targets(text: str, **others: str) -> dict[str, Target]:
    return targets_of(run(text, **others))


def installs(text: str) -> list[Install]:
    return list(run(text)[TOP].installs)


def sources(lines: str) -> tuple[str, ...]:
    """The value of V after some lines."""
    return targets(f"{lines}\nadd_library(n ${{V}})")["n"].sources


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("$<1:a>$<0:b>", "a"),
        ("$<$<BOOL:OFF>:a>", ""),
        ("$<$<NOT:$<BOOL:x-NOTFOUND>>:a>", "a"),
        ("$<IF:$<STREQUAL:a,b>,one,two>", "two"),
        ("$<$<AND:1,$<OR:0,1>>:a>", "a"),
        ("$<$<VERSION_LESS:1.9,1.10>:a>", "a"),
        ("$<$<PLATFORM_ID:Linux,Darwin>:a>$<$<PLATFORM_ID:Windows>:b>", "a"),
        ("$<BUILD_INTERFACE:a>$<INSTALL_INTERFACE:b>", "a"),
        ("$<UPPER_CASE:ab>$<COMMA>", "AB,"),
        ("$<JOIN:a;b,->", "a-b"),
        ("$<$<IN_LIST:b,a;b>:yes>", "yes"),
        ("$<0:$<CONFIG>>x", "x"),
        ("x$<CONFIG>", "x$<CONFIG>"),
        ("$<$<AND:0,$<CONFIG:Debug>>:a>", ""),
        ("$<IF:$<CONFIG:Debug>,a,b>", "$<IF:$<CONFIG:Debug>,a,b>"),
        ("$<BOOL:\x01X\x02>", "$<BOOL:\x01X\x02>"),
        ("$<unclosed", "$<unclosed"),
    ],
)
def test_expressions(text: str, value: str) -> None:
    """What files alone decide is evaluated; what only a build knows stays as it is."""
    assert decided_text(text) == value


def test_expressions_over_lists() -> None:
    """One expression may come as several arguments; what is not decided stays as one open item."""
    assert decided(["$<$<BOOL:1>:a", "b>", "c"]) == ["a", "b", "c"]
    assert decided(["$<$<CONFIG:Debug>:a", "b>", "c"]) == ["$<?>", "c"]


def test_expressions_in_sources() -> None:
    """An option decides; the other side stands beside, and nothing is open."""
    found = targets("option(X text ON)\nadd_library(n a.cpp $<$<BOOL:${X}>:b.cpp> $<$<PLATFORM_ID:Windows>:w.cpp>)")[
        "n"
    ]
    assert (found.sources, found.optional, found.is_open) == (("a.cpp", "b.cpp"), (), False)
    assert targets("add_library(n a.cpp $<$<CONFIG:Debug>:b.cpp>)")["n"].is_open


def test_objects_of_a_library_are_linked() -> None:
    """They are no sources that nobody knows."""
    found = targets("add_library(o OBJECT a.cpp)\nadd_executable(n b.cpp $<TARGET_OBJECTS:o>)")["n"]
    assert (found.sources, found.links, found.is_open) == (("b.cpp",), ("o",), False)


@pytest.mark.parametrize(
    ("lines", "value"),
    [
        ("set(V a)\nblock()\nset(V b)\nendblock()", ("a",)),
        ("set(V a)\nblock(PROPAGATE V)\nset(V b)\nendblock()", ("b",)),
        ("set(V ${V} a)", ("a",)),
        ('function(f)\nset(V ${V} ${ARGN} CACHE INTERNAL "")\nendfunction()\nf(a)\nf(b)', ("a", "b")),
        (
            "function(f)\nset_property(GLOBAL APPEND PROPERTY P ${ARGN})\nendfunction()\nf(a)\nf(b)\nget_property(V GLOBAL PROPERTY P)",
            ("a", "b"),
        ),
        ("set_property(DIRECTORY PROPERTY P a)\nget_directory_property(V P)", ("a",)),
        ("add_library(m a.cpp b.cpp)\nget_target_property(V m SOURCES)", ("a.cpp", "b.cpp")),
        ("add_library(m SHARED a.cpp)\nget_target_property(V m TYPE)", ("SHARED_LIBRARY",)),
        ('if("x/abc.cpp" MATCHES "([a-z]+)[.]cpp$")\nset(V ${CMAKE_MATCH_1})\nendif()', ("abc",)),
        ('string(REGEX MATCH "([a-z])([0-9])" M "a1")\nset(V ${CMAKE_MATCH_2}${CMAKE_MATCH_COUNT})', ("12",)),
        ("set(V b c a)\nlist(SORT V ORDER DESCENDING)", ("c", "b", "a")),
        ("set(P src/a.b.cpp)\ncmake_path(GET P STEM V)", ("a",)),
        ("set(P src/a.b.cpp)\ncmake_path(GET P EXTENSION LAST_ONLY V)", (".cpp",)),
        ("cmake_path(APPEND V src sub c.cpp)", ("src/sub/c.cpp",)),
        ('cmake_language(EVAL CODE "set(V a)")', ("a",)),
        (
            "include(CMakeDependentOption)\noption(A text ON)\ncmake_dependent_option(B text ON A OFF)\nset(V ${B})",
            ("ON", "OFF"),
        ),
        ("include(none.txt OPTIONAL RESULT_VARIABLE R)\nif(NOT R)\nset(V a)\nendif()", ("a",)),
    ],
)
def test_values(lines: str, value: tuple[str, ...]) -> None:
    """Commands do to variables what CMake does."""
    assert sources(lines) == value


@pytest.mark.parametrize(
    ("condition", "verdict"),
    [
        ("CMAKE_VERSION VERSION_LESS 3.1", False),
        ('"${CMAKE_VERSION}" VERSION_GREATER_EQUAL "3.14"', True),
        ("NOT CMAKE_BUILD_TYPE", True),
        ("IS_SYMLINK ${CMAKE_SOURCE_DIR}/src", False),
        ("EDITION STREQUAL one", False),
    ],
)
def test_what_a_build_without_settings_has(condition: str, verdict: bool) -> None:
    """One arm is that of such a build."""
    found = targets(f"if({condition})\nadd_library(yes a.cpp)\nelse()\nadd_library(no a.cpp)\nendif()")
    assert {name for name, target in found.items() if target.by_default} == {"yes" if verdict else "no"}


def test_newer_versions_of_cmake_are_not_known() -> None:
    """CMake may be newer than what the file asks for."""
    assert targets("if(CMAKE_VERSION VERSION_LESS 3.20)\nadd_library(n a.cpp)\nendif()")["n"].by_default is None


def test_a_build_may_be_told_what_nothing_sets() -> None:
    """`cmake -DEDITION=one` is the other side; a word that a macro was given is no such name."""
    found = targets("if(EDITION STREQUAL one)\nadd_library(n a.cpp)\nendif()")["n"]
    assert (found.by_default, found.conditions) == (False, ("EDITION STREQUAL one",))
    macro = "macro(m kind)\nif(${kind} STREQUAL one)\nadd_library(n a.cpp)\nendif()\nendmacro()\nm(two)"
    assert targets(macro) == {}


@pytest.mark.parametrize(
    ("found", "name", "is_open"),
    [
        ("find_package(rclcpp)", "no_such", False),
        ("find_package(rclcpp)", "rclcpp::rclcpp", True),
        ("find_package(catkin REQUIRED COMPONENTS roscpp)", "p_generate_messages_cpp", True),
        ("find_package(Other)", "no_such", True),
        ("find_package(ament_cmake)\nament_add_gtest(no_such a.cpp)", "no_such", True),
        ("find_package(ament_cmake)\nwrap(x)", "no_such", True),
        ("include(CTest)", "no_such", True),
    ],
)
def test_targets_from_outside(found: str, name: str, is_open: bool) -> None:
    """Packages of the table bring targets of certain names only, others any."""
    made = targets(f"{found}\nif(TARGET {name})\nadd_library(with a.cpp)\nendif()")
    assert ("with" in made) is is_open


def test_sources_for_who_links() -> None:
    """Sources after INTERFACE or PUBLIC are compiled by those that link the target."""
    found = targets(
        "add_library(m INTERFACE)\ntarget_sources(m INTERFACE a.cpp)\nadd_executable(n b.cpp)\ntarget_link_libraries(n PRIVATE m)"
        "\nadd_library(l c.cpp)\ntarget_link_libraries(l INTERFACE m)"
    )
    assert {name: target.sources for name, target in found.items()} == {
        "m": (),
        "n": ("b.cpp", "a.cpp"),
        "l": ("c.cpp",),
    }


def test_sources_that_a_property_adds() -> None:
    """`set_property(TARGET ... APPEND PROPERTY SOURCES ...)` is as good as `target_sources`."""
    found = targets("add_executable(n a.cpp)\nset_property(TARGET n APPEND PROPERTY SOURCES b.cpp)")["n"]
    assert (found.sources, found.is_open) == (("a.cpp", "b.cpp"), False)


def test_files_that_the_build_makes_are_known() -> None:
    """They are no files of the tree, and open nothing."""
    found = targets('add_executable(n "" ${CMAKE_CURRENT_BINARY_DIR}/g.cpp a.cpp)')["n"]
    assert (found.sources, found.is_open) == (("${CMAKE_BINARY_DIR}/g.cpp", "a.cpp"), False)


def test_any_file_can_be_included() -> None:
    """The name of a file beside needs no suffix; one that is not there is told."""
    assert set(targets("include(more.txt)", more="add_library(n a.cpp)")) == {"n"}
    assert [entry.line for entry in run("include(none.txt)")[TOP].unknown] == [3]


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("install(FILES a.yaml TYPE DATA)", [("a.yaml", "share")]),
        ("add_library(n SHARED a.cpp)\nadd_executable(x a.cpp)\ninstall(TARGETS n x)", [("n", "lib"), ("x", "bin")]),
        ("install(FILES a $<0:b> DESTINATION share/$<IF:1,x,y>)", [("a", "share/x")]),
        ("install(DIRECTORY a DESTINATION ${CMAKE_INSTALL_PREFIX}/share)", [("a", "share")]),
    ],
)
def test_places_of_installing(text: str, rows: list[tuple[str, str]]) -> None:
    """Where CMake puts what has no destination of its own, or one that is computed."""
    assert [(rule.items[0], rule.destination) for rule in installs(text)] == rows


def test_a_rule_that_all_builds_have_is_one() -> None:
    """What differs in words that change no place makes no second rule."""
    text = "option(X text ON)\nif(X)\nset(D lib)\nelse()\nset(D lib64)\nendif()\nadd_executable(n a.cpp)\n"
    text += "install(TARGETS n RUNTIME DESTINATION bin LIBRARY DESTINATION ${D})"
    assert [(rule.destination, rule.by_default) for rule in installs(text)] == [("bin", True)]


def test_what_ament_auto_package_installs() -> None:
    """Headers, libraries, programs and the folders that it is told."""
    text = (
        "find_package(ament_cmake_auto)\nament_auto_add_library(n SHARED DIRECTORY src)\n"
        "ament_auto_add_executable(x src/a.cpp)\nament_auto_package(INSTALL_TO_SHARE launch)"
    )
    assert targets(text)["n"].sources == ("src/a.cpp", "src/b.cpp", "src/sub/c.cpp")
    assert [(rule.kind, rule.items, rule.destination) for rule in installs(text)] == [
        ("directory", ("include/",), "include"),
        ("targets", ("n",), "lib"),
        ("targets", ("x",), "lib/p"),
        ("directory", ("launch",), "share/p"),
    ]
