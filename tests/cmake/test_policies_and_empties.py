"""Policies that change what commands set, and what is empty because nothing has set it."""

from __future__ import annotations

import pytest
from cmake_runs import TOP, facts, targets_of

FILES = ("src/a.cpp", "src/b.cpp", "src/c.cpp")
OLD = "cmake_minimum_required(VERSION 3.5)\n"
NEW = "cmake_minimum_required(VERSION 3.5...3.28)\n"


def sources(lines: str) -> tuple[str, ...]:
    """The sources of a library that is made of V."""
    return targets_of(facts(f"{lines}\nadd_library(n ${{V}})", FILES, {}, ".txt"))["n"].sources


def built(lines: str) -> dict[str, bool | None]:
    """Targets, with whether a build without settings has them."""
    return {name: each.by_default for name, each in targets_of(facts(lines, FILES, {}, ".txt")).items()}


@pytest.mark.parametrize(
    ("lines", "value"),
    [
        (f"{OLD}set(V src/a.cpp)\nset(V src/b.cpp CACHE STRING x)", "src/b.cpp"),
        (f"{NEW}set(V src/a.cpp)\nset(V src/b.cpp CACHE STRING x)", "src/a.cpp"),
        (f"{OLD}cmake_policy(SET CMP0126 NEW)\nset(V src/a.cpp)\nset(V src/b.cpp CACHE STRING x)", "src/a.cpp"),
        (f"{OLD}cmake_policy(VERSION 3.21)\nset(V src/a.cpp)\nset(V src/b.cpp CACHE STRING x)", "src/a.cpp"),
        (f"{OLD}set(V src/a.cpp CACHE STRING x)\nset(V src/b.cpp CACHE STRING x)", "src/a.cpp"),
        (f"{OLD}set(V src/a.cpp CACHE STRING x)\nset(V src/b.cpp CACHE STRING x FORCE)", "src/b.cpp"),
        ('string(SHA1 S "a")\nstring(SUBSTRING ${S} 0 4 V)', "86f7"),
        ("set(L z/a.cpp y/b.cpp)\nlist(SORT L COMPARE FILE_BASENAME)\nlist(GET L 0 V)", "z/a.cpp"),
    ],
)
def test_the_cache_and_variables(lines: str, value: str) -> None:
    """Before 3.21 `set(CACHE)` takes a variable of its name away; sums and sorting by file name are known."""
    assert sources(lines) == (value,)


@pytest.mark.parametrize(
    ("version", "is_on"), [(OLD, True), (NEW, False), (f"{OLD}set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)\n", False)]
)
def test_an_option_over_a_variable(version: str, is_on: bool) -> None:
    """Before 3.13 an option takes the place of a variable."""
    found = built(f"{version}set(W OFF)\noption(W x ON)\nif(W)\nadd_library(on src/a.cpp)\nendif()")
    assert found.get("on", False) is is_on


ON_TOP = "set(W OFF)\noption(W x ON)\nif(W)\nadd_library(on src/a.cpp)\nendif()\n"
SET = "cmake_policy(SET CMP0077 NEW)\n"


@pytest.mark.parametrize(
    ("lines", "is_on"),
    [
        (f"cmake_policy(PUSH)\n{SET}cmake_policy(POP)\n{ON_TOP}", True),
        (f"cmake_policy(PUSH)\n{SET}{ON_TOP}cmake_policy(POP)\n", False),
        (f"{SET}cmake_policy(PUSH)\ncmake_policy(VERSION 3.5)\ncmake_policy(POP)\n{ON_TOP}", False),
        (f"{SET}cmake_policy(VERSION 3.5)\n{ON_TOP}", True),
        (f"cmake_policy(PUSH)\ncmake_policy(PUSH)\n{SET}cmake_policy(POP)\n{ON_TOP}cmake_policy(POP)\n", True),
        (f"cmake_policy(POP)\n{SET}{ON_TOP}", False),
        (f"include(own.cmake)\n{ON_TOP}", True),
        (f"include(own.cmake NO_POLICY_SCOPE)\n{ON_TOP}", False),
        (f"block()\n{SET}endblock()\n{ON_TOP}", True),
        (f"block(SCOPE_FOR POLICIES)\n{SET}endblock()\n{ON_TOP}", True),
        (f"block(SCOPE_FOR VARIABLES)\n{SET}endblock()\n{ON_TOP}", False),
        (f"macro(M)\n{SET}endmacro()\nM()\n{ON_TOP}", False),
        (f"macro(M)\n{ON_TOP}endmacro()\n{SET}M()\n", True),
        (f"function(F)\n{ON_TOP}endfunction()\n{SET}F()\n", True),
        (f"{SET}function(F)\n{ON_TOP}endfunction()\ncmake_policy(SET CMP0077 OLD)\nF()\n", False),
        (f"if(POLICY CMP0054)\n{SET}endif()\n{ON_TOP}", False),
    ],
)
def test_policies_end_with_their_scope(lines: str, is_on: bool) -> None:
    """`PUSH` and `POP`, included files, blocks and definitions have policies of their own."""
    found = targets_of(facts(f"{OLD}{lines}", FILES, {"own": SET}, ".cmake"))
    assert ("on" in found and found["on"].by_default) is is_on


def test_policies_that_not_every_cmake_knows() -> None:
    """`if(POLICY)` is decided for those that are older than any CMake that builds the package."""
    lines = "".join(f"if(POLICY {each})\nadd_library({each} src/a.cpp)\nendif()\n" for each in ("CMP0057", "CMP0177"))
    assert built(lines) == {"CMP0057": True, "CMP0177": None}


def test_what_the_tree_sets_elsewhere_is_empty() -> None:
    """A variable of the tree that no command has set is empty; one that nothing sets is for who builds."""
    lines = "if(WIN32)\nset(MORE src/b.cpp)\nendif()\nset(V src/a.cpp ${MORE})"
    assert sources(lines) == ("src/a.cpp",)
    assert sources("set(V src/a.cpp ${MORE})") == ("src/a.cpp", "${MORE}")
    assert sources(f"{lines.replace('set(V', 'from_elsewhere(MORE)' + chr(10) + 'set(V')}") == ("src/a.cpp", "${MORE}")


def test_a_default_that_is_set_where_nothing_is() -> None:
    """`if(NOT DEFINED X)` holds in a build without settings; the other way stays open."""
    lines = "if(NOT DEFINED X)\nset(X a)\nendif()\n"
    found = built(f'{lines}if(X STREQUAL "a")\nadd_library(yes src/a.cpp)\nelse()\nadd_library(no src/b.cpp)\nendif()')
    assert found == {"yes": True, "no": False}


def test_packages_that_must_be_there_are_found() -> None:
    """Without a package that is REQUIRED there is no build; of others nothing is known."""
    asks = "if({0}_FOUND)\nadd_library({0}_yes src/a.cpp)\nendif()\n"
    lines = f"find_package(one REQUIRED)\nfind_package(two)\n{asks.format('one')}{asks.format('two')}"
    assert built(lines) == {"one_yes": True, "two_yes": None}


def test_a_file_that_is_not_there_brings_no_target() -> None:
    """An optional file of the tree that is missing makes nothing."""
    lines = "include(${CMAKE_SOURCE_DIR}/none.cmake OPTIONAL)\nif(NOT TARGET x)\nadd_library(yes src/a.cpp)\nendif()"
    assert built(lines) == {"yes": True}


def test_rules_of_some_configurations_are_open() -> None:
    """Whether they are taken is told when the build is installed."""
    (rule,) = facts("install(FILES a DESTINATION share CONFIGURATIONS Release)", FILES, {}, ".txt")[TOP].installs
    assert rule.by_default is None


def test_catkin_simple() -> None:
    """It makes and installs targets by commands of its own."""
    found = facts(
        "cs_add_library(l src/a.cpp)\ncs_add_executable(e src/b.cpp NO_AUTO_LINK)\ncs_install()", FILES, {}, ".txt"
    )
    assert {name: each.sources for name, each in targets_of(found).items()} == {
        "l": ("src/a.cpp",),
        "e": ("src/b.cpp",),
    }
    assert [(rule.items, rule.destination) for rule in found[TOP].installs] == [(("l",), "lib"), (("e",), "lib/p")]


def test_catkin_simple_in_a_folder_without_a_project_of_its_own() -> None:
    """It installs to the project around it, and to its own where the folder begins one."""
    body = "cs_add_executable(e{} src/b.cpp)\ncs_install()"
    lines = "add_subdirectory(inner)\nadd_subdirectory(own)"
    files = {"inner__CMakeLists": body.format(1), "own__CMakeLists": f"project(q)\n{body.format(2)}"}
    found = facts(lines, (*FILES, "inner/src/b.cpp", "own/src/b.cpp"), files, ".txt")
    rules = {rule.items: rule.destination for file in found.values() for rule in file.installs}
    assert rules == {("e1",): "lib/p", ("e2",): "lib/q"}


def test_what_catkin_simple_shares() -> None:
    """`cs_install` installs headers and the folders of a package that have the usual names."""
    listed = ("src/a.cpp", "include/p/a.hpp", "launch/a.launch", "other/b.yaml")
    (file,) = facts("cs_add_library(l src/a.cpp)\ncs_install()", listed, {}, ".txt").values()
    rules = {(rule.kind, rule.items, rule.destination) for rule in file.installs}
    assert rules == {
        ("targets", ("l",), "lib"),
        ("directory", ("include/",), "include"),
        ("directory", ("launch/",), "share/p/launch"),
    }


def test_a_folder_of_modules_comes_first() -> None:
    """`list(INSERT ... 0)` adds to a list of which nothing is known, as APPEND does."""
    lines = "list(INSERT CMAKE_MODULE_PATH 0 ${PROJECT_SOURCE_DIR}/cmake)\ninclude(own)\nadd_library(n ${V})"
    found = facts(lines, FILES, {"cmake__own": "set(V src/a.cpp)"}, ".cmake")
    assert targets_of(found)["n"].sources == ("src/a.cpp",)
