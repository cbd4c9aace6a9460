"""What a run of CMake files knows: values through commands, conditions that stay open, files that are included."""

from __future__ import annotations

import pytest
from cmake_runs import TOP, facts, targets_of
from ecm_parsers.cmake_facts import CmakeFile, Target

from ecm_extract.cmake import BuildFiles, evaluate, stated

SOURCES = ("src/a.cpp", "src/b.cpp", "src/sub/c.cpp", "inc/a.hpp")


def run(text: str, **included: str) -> dict[str, CmakeFile]:
    return facts(text, SOURCES, included, ".cmake")


def targets(text: str, **included: str) -> dict[str, Target]:
    return targets_of(run(text, **included))


def sources(lines: str) -> tuple[str, ...]:
    """The value of V after some lines."""
    return targets(f"{lines}\nadd_library(n ${{V}})")["n"].sources


@pytest.mark.parametrize(
    ("lines", "value"),
    [
        ("set(V a b)\nlist(REVERSE V)", ("b", "a")),
        ("set(V b a b)\nlist(REMOVE_DUPLICATES V)\nlist(SORT V)", ("a", "b")),
        ("set(V a b c)\nlist(REMOVE_AT V 1 -1)", ("a",)),
        ("set(V a c)\nlist(INSERT V 1 b)", ("a", "b", "c")),
        ('set(V a.x b.y)\nlist(FILTER V EXCLUDE REGEX "[.]y$")', ("a.x",)),
        ('set(V a b)\nlist(TRANSFORM V REPLACE "(.)" "x\\\\1")', ("xa", "xb")),
        ("set(V a b c)\nlist(TRANSFORM V TOUPPER AT 0 -1)", ("A", "b", "C")),
        ("set(L a b c)\nlist(SUBLIST L 1 2 V)", ("b", "c")),
        ("set(L a b)\nlist(GET L 1 0 V)", ("b", "a")),
        ("set(V a b)\nlist(POP_FRONT V)", ("b",)),
        ('set(L a b)\nlist(JOIN L "-" V)', ("a-b",)),
        ("set(L a b)\nlist(FIND L b V)", ("1",)),
        ('string(REGEX REPLACE "([a-z]+)_x" "\\\\1_y" V "a_x b_x")', ("a_y b_y",)),
        ('string(REGEX MATCH "[0-9]+" V "ab12c3")', ("12",)),
        ('string(REGEX MATCHALL "[0-9]" V "1a2")', ("1", "2")),
        ('string(SUBSTRING "abcdef" 2 3 V)', ("cde",)),
        ('string(REPLACE "a" "b" V "aca")', ("bcb",)),
        ("string(MAKE_C_IDENTIFIER 1-a V)", ("_1_a",)),
        ('set(N 7)\nmath(EXPR V "(${N} + 1) / 3 * 2 % 5")', ("4",)),
        ('math(EXPR V "-7 / 2")', ("-3",)),
        ("get_filename_component(V src/a.b.cpp NAME_WE)", ("a",)),
        ("get_filename_component(V src/a.b.cpp LAST_EXT)", (".cpp",)),
        ("get_filename_component(V src/a.cpp ABSOLUTE)", ("src/a.cpp",)),
        ("file(RELATIVE_PATH V ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/inc/a.hpp)", ("../inc/a.hpp",)),
        ("file(GLOB V src/*)", ("src/a.cpp", "src/b.cpp", "src/sub")),
        (
            "file(GLOB_RECURSE V RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/src src/[a-c].cpp)",
            ("a.cpp", "b.cpp", "sub/c.cpp"),
        ),
        ("set(A V)\nset(${A} x)", ("x",)),
        ("set(V a)\nunset(V)\nlist(APPEND V b)", ("b",)),
        ("foreach(i RANGE 1 5 2)\nlist(APPEND V x${i})\nendforeach()", ("x1", "x3", "x5")),
        ("set(A 1 2)\nset(B x y)\nforeach(a b IN ZIP_LISTS A B)\nlist(APPEND V ${a}${b})\nendforeach()", ("1x", "2y")),
        ("foreach(i a b c)\nif(i STREQUAL b)\ncontinue()\nendif()\nlist(APPEND V ${i})\nendforeach()", ("a", "c")),
        ("foreach(i a b c)\nif(i STREQUAL b)\nbreak()\nendif()\nlist(APPEND V ${i})\nendforeach()", ("a",)),
        ('set(i 0)\nwhile(i LESS 2)\nlist(APPEND V x${i})\nmath(EXPR i "${i} + 1")\nendwhile()', ("x0", "x1")),
        ("function(f out)\nset(${out} ${ARGN} PARENT_SCOPE)\nendfunction()\nf(V a b)", ("a", "b")),
        ("function(f)\nset(V no)\nendfunction()\nset(V a)\nf()", ("a",)),
        ("macro(m)\nset(V yes)\nendmacro()\nset(V a)\nm()", ("yes",)),
        ("function(f)\nreturn()\nset(V no PARENT_SCOPE)\nendfunction()\nset(V a)\nf()", ("a",)),
        (
            "set_property(GLOBAL APPEND PROPERTY P a)\nset_property(GLOBAL APPEND PROPERTY P b)\nget_property(V GLOBAL PROPERTY P)",
            ("a", "b"),
        ),
    ],
)
def test_values(lines: str, value: tuple[str, ...]) -> None:
    """Each command gives what CMake gives."""
    assert sources(lines) == value


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("1 LESS 2 AND NOT 2 LESS 1", True),
        ("TRUE OR FALSE AND FALSE", False),
        ("(OFF OR ON) AND YES", True),
        ('"b" IN_LIST L', True),
        ("ABSENT_IN_L IN_LIST L", False),
        ("PROJECT_VERSION VERSION_GREATER_EQUAL 1.2", True),
        ('"1.10" VERSION_LESS "1.9"', False),
        ('PROJECT_NAME MATCHES "^p$"', True),
        ("EXISTS ${CMAKE_SOURCE_DIR}/src/a.cpp", True),
        ("IS_DIRECTORY ${CMAKE_SOURCE_DIR}/src", True),
        ("DEFINED PROJECT_NAME", True),
        ("WIN32", False),
        ("COMMAND add_library", True),
        ("TARGET before", True),
        ("TARGET never", False),
    ],
)
def test_conditions_that_are_decided(condition: str, holds: bool) -> None:
    """One arm runs, and nothing is open."""
    text = f"set(L a b)\nadd_library(before a.cpp)\nif({condition})\nadd_library(yes a.cpp)\nelse()\nadd_library(no a.cpp)\nendif()"
    found = targets(text)
    assert set(found) == {"before", "yes" if holds else "no"}
    assert all(target.by_default and not target.conditions for target in found.values())


def test_an_option_has_a_default_and_another_side() -> None:
    """What a build without settings has is known; what it may have stands beside with its condition."""
    found = targets(
        "option(WITH_X text OFF)\nset(S a.cpp)\nif(WITH_X)\nlist(APPEND S x.cpp)\nadd_library(x x.cpp)\nendif()\nadd_library(n ${S})"
    )
    assert (found["x"].by_default, found["x"].conditions) == (False, ("WITH_X",))
    assert (found["n"].sources, found["n"].optional, found["n"].is_open) == (("a.cpp", "x.cpp"), ("x.cpp",), False)


def test_what_a_package_decides_is_open() -> None:
    """Of a condition over what a package sets both arms may run, and sources that hang on it are open."""
    found = targets(
        "find_package(X)\nif(X_FOUND)\nset(S a.cpp)\nadd_library(with a.cpp)\nelse()\nset(S b.cpp)\nendif()\nadd_library(n ${S})"
    )
    assert found["with"].by_default is None
    assert found["n"].is_open


def test_a_path_that_ends_is_not_joined() -> None:
    """Behind an error only those builds go on that have no error."""
    found = targets(
        "find_package(X)\nif(NOT X_FOUND)\nset(S no.cpp)\nmessage(FATAL_ERROR no)\nelse()\nset(S a.cpp)\nendif()\nadd_library(n ${S})"
    )
    assert found["n"].sources == ("a.cpp",)


def test_a_return_that_may_happen() -> None:
    """What stands behind it is built unless it did."""
    found = targets("option(STOP text OFF)\nif(STOP)\nreturn()\nendif()\nadd_library(n a.cpp)")
    assert found["n"].by_default is True
    found = targets("option(STOP text ON)\nif(STOP)\nreturn()\nendif()\nadd_library(n a.cpp)")
    assert found["n"].by_default is False


def test_a_variable_that_another_command_is_given_is_open() -> None:
    """A command from elsewhere may set what it is told the name of; the old value stays possible."""
    found = targets("set(S a.cpp)\nwrap_sources(S b.hpp)\nadd_library(n ${S})")["n"]
    assert (found.sources, found.is_open) == (("a.cpp", "${S}"), True)


def test_included_files_run_where_they_are_included() -> None:
    """Functions and variables of included files are there afterwards; their own targets have their own lines."""
    programs = "macro(program name)\nadd_executable(${name} src/${name}.cpp)\nendmacro()\nadd_executable(own src/b.cpp)\nset(W a)"
    files = run("foreach(f programs)\ninclude(cmake/${f}.cmake)\nendforeach()\nprogram(${W})", cmake__programs=programs)
    assert [(t.name, t.sources, t.line) for t in files[TOP].targets] == [("a", ("src/a.cpp",), 6)]
    assert [(t.name, t.sources, t.line) for t in files["cmake/programs.cmake"].targets] == [
        ("own", ("../src/b.cpp",), 4)
    ]


@pytest.mark.parametrize(
    "line",
    [
        "include(${X_DIR}/more.cmake)",
        "add_subdirectory(not/there)",
        "include(FetchContent)\nFetchContent_MakeAvailable(y)",
    ],
)
def test_what_is_not_read_is_told(line: str) -> None:
    """Files that are not there may build more."""
    (entry,) = run(f"find_package(X)\n{line}")[TOP].unknown
    assert entry.line == 3 + line.count("\n") + 1


def test_libraries_are_shared_as_the_build_says() -> None:
    """Without a word it is BUILD_SHARED_LIBS that decides, which catkin turns on."""
    found = targets(
        "add_library(a a.cpp)\nset(BUILD_SHARED_LIBS ON)\nadd_library(b b.cpp)\nadd_library(c STATIC c.cpp)"
    )
    assert {name: target.is_shared for name, target in found.items()} == {"a": None, "b": True, "c": False}
    assert targets("find_package(catkin)\nadd_library(a a.cpp)")["a"].is_shared is True


def test_folders_of_headers() -> None:
    """Those of the target, then those of the whole folder."""
    text = "include_directories(inc)\nadd_library(n a.cpp)\ntarget_include_directories(n PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)"
    assert targets(text)["n"].include_folders == ("src", "inc")


def test_catkin_folders_are_known() -> None:
    """The variables of catkin_destinations are folded."""
    text = "find_package(catkin REQUIRED)\ninstall(FILES a DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/x)"
    assert run(text)[TOP].installs[0].destination == "share/p/x"


def test_an_error_that_all_builds_come_to() -> None:
    """A tree without its submodules does not configure; what stands behind the error is read, and open."""
    file = run("if(NOT EXISTS ${CMAKE_SOURCE_DIR}/lib/x)\nmessage(FATAL_ERROR no)\nendif()\nadd_library(n a.cpp)")[TOP]
    assert [target.name for target in file.targets] == ["n"]
    assert [entry.line for entry in file.unknown] == [4]


def test_libraries_and_programs_go_to_their_own_folders() -> None:
    """One rule names a folder for each kind of artefact."""
    text = "add_library(l SHARED a.cpp)\nadd_library(s STATIC a.cpp)\nadd_executable(e a.cpp)\ninstall(TARGETS l s e ARCHIVE DESTINATION ar LIBRARY DESTINATION lib RUNTIME DESTINATION bin)"
    installs = run(text)[TOP].installs
    assert {item: rule.destination for rule in installs for item in rule.items} == {"l": "lib", "s": "ar", "e": "bin"}


@pytest.mark.parametrize(
    ("condition", "verdict"),
    [
        ("EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/fw/lib", None),
        ("IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/fw", None),
        ("EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/fw.txt", False),
        ("EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/src/a.cpp", True),
    ],
)
def test_what_this_copy_lacks_is_not_known_to_be_missing(condition: str, verdict: bool | None) -> None:
    """A submodule that is not checked out hides no target: the condition stays with it."""
    text = f"project(p)\nif({condition})\nadd_executable(n src/a.cpp)\nendif()\n".encode()
    files = BuildFiles([TOP, "src/a.cpp"], {TOP: text, "src/a.cpp": b""}.get, ["fw"])
    found = [target for file in stated(evaluate(files, TOP)).values() for target in file.targets]
    assert [bool(target.conditions) for target in found] == ([] if verdict is False else [verdict is None])


_MANIFEST = (
    "<package format='2'><name>talker</name><version>1.2.3</version><buildtool_depend>{}</buildtool_depend></package>"
)


@pytest.mark.parametrize(
    ("begin", "tool", "name"),
    [
        ("extract_package_metadata(pkg)\nproject(${pkg_extracted_name})", "other", "talker_node"),
        ("read_it(pkg)\nproject(${pkg_name})", "catkin", "talker_node"),
        ("read_it(pkg)\nproject(${pkg_name})", "other", "${PROJECT_NAME}_node"),
        ("project(own)", "catkin", "own_node"),
    ],
)
def test_a_project_may_be_named_by_its_package_xml(begin: str, tool: str, name: str) -> None:
    """Commands of the table read it; what nobody knows is its name too where a build tool insists on that."""
    text = f"find_package(helper REQUIRED)\n{begin}\nadd_executable(${{PROJECT_NAME}}_node a.cpp)\n"
    held = {TOP: text.encode(), "package.xml": _MANIFEST.format(tool).encode(), "a.cpp": b""}
    (target,) = (each for file in stated(evaluate(BuildFiles(held, held.get), TOP)).values() for each in file.targets)
    assert target.name.startswith("$") if name.startswith("$") else target.name == name
