"""Small CMake projects made by a seed: packages as people write them, of statements that CMake can run alone."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

STEMS = ("alpha", "beta", "gamma", "delta", "epsilon", "zeta")
FOLDERS = ("src", "src/core", "nodes")


@dataclass
class Project:
    """The files of one project, by path."""

    name: str
    ros: int
    files: dict[str, str] = field(default_factory=dict)


def make(seed: int) -> Project:
    """Return the project of a seed; the same seed gives the same project."""
    return _Maker(random.Random(seed), seed).project()


class _Maker:
    def __init__(self, rng: random.Random, seed: int) -> None:
        self.rng = rng
        self.made = Project(f"pkg_{seed}", rng.choice((1, 2)))
        self.count = 0
        self.options: list[str] = []

    def project(self) -> Project:
        """Write sources, helpers, subdirectories and the file that binds them."""
        self._sources()
        lines = self._head()
        helpers = self._helpers()
        lines += helpers.lines
        for _ in range(self.rng.randint(3, 7)):
            lines += self._statement("", helpers, 0)
        lines += self._installs("")
        lines += self._subdirectories(helpers)
        lines += ["ament_package()"] if self.made.ros == 2 else []
        self.made.files["CMakeLists.txt"] = "\n".join(lines) + "\n"
        return self.made

    def fresh(self, word: str) -> str:
        """A name that nothing else has."""
        self.count += 1
        return f"{word}{self.count}"

    def _sources(self) -> None:
        files = self.made.files
        for folder in FOLDERS:
            for stem in STEMS:
                files[f"{folder}/{stem}.cpp"] = "int main() { return 0; }\n"
        files["src/alpha.hpp"] = files["include/thing/alpha.hpp"] = "#pragma once\n"
        for name in ("one", "two"):
            files[f"scripts/{name}.py"] = "#!/usr/bin/env python3\n"
            files[f"launch/{name}.launch"] = "<launch/>\n"
            files[f"config/{name}.yaml"] = "a: 1\n"
        build = "ament_cmake" if self.made.ros == 2 else "catkin"
        shape = 3 if self.made.ros == 2 else 2
        files["package.xml"] = (
            f'<package format="{shape}"><name>{self.made.name}</name><version>1.0.0</version>'
            f'<description>d</description><maintainer email="a@b.c">m</maintainer><license>l</license>'
            f"<buildtool_depend>{build}</buildtool_depend>"
            + (f"<export><build_type>{build}</build_type></export>" if self.made.ros == 2 else "")
            + "</package>\n"
        )

    def _head(self) -> list[str]:
        lines = [f"cmake_minimum_required(VERSION {self.rng.choice(('3.5', '3.8', '3.14', '3.16'))})"]
        lines += [f"project({self.made.name} VERSION 1.{self.rng.randint(0, 9)}.2)"]
        if self.made.ros == 2:
            lines += ["find_package(ament_cmake REQUIRED)", "find_package(rclcpp REQUIRED)"]
            lines += ["find_package(rclcpp_components REQUIRED)"]
        else:
            lines += ["find_package(catkin REQUIRED COMPONENTS roscpp)", "catkin_package()"]
        for _ in range(self.rng.randint(0, 2)):
            self.options.append(self.fresh("WITH_OPT"))
            lines.append(f'option({self.options[-1]} "text" {self.rng.choice(("ON", "OFF"))})')
        return lines

    # -- functions and macros of the tree

    def _helpers(self) -> _Helpers:
        found = _Helpers()
        for _ in range(self.rng.randint(1, 3)):
            name = self.fresh("add_thing")
            shape = self.rng.choice(_SHAPES)
            text = "\n".join(shape.body(name, self.rng.choice(("function", "macro")) if shape.either else "function"))
            found.calls.append((name, shape))
            if self.rng.random() < 0.5:
                found.lines += text.split("\n")
            else:
                path = f"cmake/{name}.cmake"
                guard = "include_guard()\n" if self.rng.random() < 0.3 else ""
                self.made.files[path] = guard + text + "\n"
                found.lines += self._include(path)
        return found

    def _include(self, path: str) -> list[str]:
        name = path.rpartition("/")[2].removesuffix(".cmake")
        return self.rng.choice(
            (
                [f"include({path})"],
                [f"include(${{CMAKE_CURRENT_LIST_DIR}}/{path})"],
                ["list(APPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)", f"include({name})"],
                [f"foreach(f {name})", "  include(${CMAKE_CURRENT_SOURCE_DIR}/cmake/${f}.cmake)", "endforeach()"],
            )
        )

    def _subdirectories(self, helpers: _Helpers) -> list[str]:
        if self.rng.random() < 0.6:
            return []
        folder = self.rng.choice(("tools", "plugins/inner"))
        for stem in STEMS[:3]:
            self.made.files[f"{folder}/{stem}.cpp"] = "int main() { return 0; }\n"
        up = self.fresh("FROM_TOP")
        lines: list[str] = []
        for _ in range(self.rng.randint(1, 3)):
            lines += self._statement("", helpers, 1, below=True)
        lines += [f"add_executable({self.fresh('sub')} alpha.cpp ${{{up}}})"]
        lines += [f"add_executable({self.fresh('${PROJECT_NAME}_sub')} ${{CMAKE_CURRENT_SOURCE_DIR}}/beta.cpp)"]
        lines += ["install(FILES gamma.cpp DESTINATION share/${PROJECT_NAME}/sub)"]
        out = self.fresh("TO_TOP")
        lines += [f"set({out} nodes/alpha.cpp PARENT_SCOPE)"]
        self.made.files[f"{folder}/CMakeLists.txt"] = "\n".join(lines) + "\n"
        source = self.rng.choice(("${PROJECT_SOURCE_DIR}/src/zeta.cpp", "${CMAKE_CURRENT_SOURCE_DIR}/nodes/zeta.cpp"))
        after = [f"add_executable({self.fresh('after')} ${{{out}}})"]
        return [f"set({up} {source})", f"add_subdirectory({folder})", *after]

    # -- statements

    def _statement(self, indent: str, helpers: _Helpers, depth: int, below: bool = False) -> list[str]:
        """One statement that ends in targets, perhaps inside a condition, a loop or a helper."""
        kinds: list[Callable[[], list[str]]] = [lambda: self._target(below), lambda: self._target(below)]
        kinds += [lambda: self._helper_call(helpers, below), lambda: self._components(below)]
        if depth < 2:
            kinds += [
                lambda: self._if(helpers, depth, below),
                lambda: self._foreach(below),
                lambda: self._while(below),
                lambda: self._testing(below),
                lambda: self._early(below),
            ]
        return [indent + line for line in self.rng.choice(kinds)()]

    def _root(self, below: bool) -> str:
        """A folder of sources as an argument is written."""
        if below:
            return "${PROJECT_SOURCE_DIR}/" + self.rng.choice(FOLDERS)
        start = self.rng.choice(("", "", "./", "${CMAKE_CURRENT_SOURCE_DIR}/", "${PROJECT_SOURCE_DIR}/"))
        return start + self.rng.choice(FOLDERS)

    def _target(self, below: bool) -> list[str]:
        lines, variable = self._list(below)
        return lines + self._build(f"${{{variable}}}", below)

    def _build(self, sources: str, below: bool) -> list[str]:
        name = self.fresh(self.rng.choice(("node", "lib", "${PROJECT_NAME}_n")))
        made = self.rng.choice(
            (
                [f"add_executable({name} {sources})"],
                [f"add_library({name} SHARED {sources})"],
                [f"add_library({name} {sources})"],
                [f"add_executable({name})", f"target_sources({name} PRIVATE {sources})"],
                [f"set(TARGET_NAME {name})", f"add_executable(${{TARGET_NAME}} {sources})"],
                [f'string(TOLOWER "{name}" lowered)', f"add_library(${{lowered}} STATIC {sources})"],
            )
        )
        real = name.lower() if "lowered" in made[-1] else name
        if self.rng.random() < 0.2 and "lowered" not in made[-1]:
            made = [*made, f'set_target_properties({real} PROPERTIES OUTPUT_NAME out_{self.count} PREFIX "")']
        if self.rng.random() < 0.5:
            where = "lib" if self.rng.random() < 0.5 else "lib/${PROJECT_NAME}"
            target = "${lowered}" if "lowered" in made[-1] else name
            made = [*made, f"install(TARGETS {target} DESTINATION {where})"]
        return made

    def _list(self, below: bool) -> tuple[list[str], str]:
        """Lines that make a variable that holds sources, and its name."""
        name = self.fresh("SRCS")
        root = self._root(below)
        some = self.rng.sample(STEMS, 4)
        paths = " ".join(f"{root}/{stem}.cpp" for stem in some)
        starts = (
            [f"set({name} {paths})"],
            [f'set({name} "{root}/{some[0]}.cpp;{root}/{some[1]}.cpp" {root}/{some[2]}.cpp)'],
            [
                f"set({name} {' '.join(some)})",
                f"list(TRANSFORM {name} PREPEND {root}/)",
                f"list(TRANSFORM {name} APPEND .cpp)",
            ],
            [f"list(APPEND {name} {paths})"],
            [f"file(GLOB {name} {self._globbed(root, below)}/*.cpp)"],
            [f"file(GLOB {name} {self._globbed(root, below)}/[a-d]*.cpp {self._globbed(root, below)}/*eta.cpp)"],
            [f"file(GLOB_RECURSE {name} {self._globbed(root, below)}/*a.cpp)", *self._unique(name)],
            [f"aux_source_directory({root} {name})"],
            [f'string(REPLACE core/ "" {name} {root}/{some[0]}.cpp)'],
            [f'string(REGEX REPLACE "(alpha|beta|gamma)" "delta" {name} "{root}/{some[0]}.cpp")'],
            [f"set(stem_{name} {some[0]})", f"set({name} {root}/${{stem_{name}}}.cpp)"],
            [
                f"set(which_{name} {some[0]})",
                f"set(path_{some[0]} {root}/{some[1]}.cpp)",
                f"set({name} ${{path_${{which_{name}}}}})",
            ],
            [
                f'set(text_{name} "{some[0]} {some[1]}")',
                f"separate_arguments(text_{name})",
                f'list(TRANSFORM text_{name} REPLACE "^(.+)$" "{root}/\\\\1.cpp" OUTPUT_VARIABLE {name})',
            ],
            [f"get_filename_component({name} {self._absolute(root, below)}/{some[0]}.cpp ABSOLUTE)"],
            [
                f"get_filename_component(dir_{name} {root}/{some[0]}.cpp DIRECTORY)",
                f"set({name} ${{dir_{name}}}/{some[1]}.cpp)",
            ],
            [
                f"get_filename_component(stem_{name} {root}/{some[0]}.hpp NAME_WE)",
                f"set({name} {root}/${{stem_{name}}}.cpp)",
            ],
            [
                f'math(EXPR at_{name} "(7 + {self.rng.randint(0, 5)}) % 3")',
                f"set(all_{name} {paths})",
                f"list(GET all_{name} ${{at_{name}}} {name})",
            ],
            [f"set(ALL_{name} {paths})", f"list(SUBLIST ALL_{name} 1 2 {name})"],
            [f'set({name} {root}/{some[0]}.cpp CACHE STRING "doc")'],
            [
                f"set_property(GLOBAL APPEND PROPERTY P_{name} {root}/{some[0]}.cpp)",
                f"get_property({name} GLOBAL PROPERTY P_{name})",
            ],
            [f"set(FN_{name} {root}/{some[0]}.cpp)", f'string(CONCAT {name} "${{FN_{name}}}" ";{root}/{some[1]}.cpp")'],
            [
                f"set(J_{name} {some[0]} {some[1]})",
                f'string(JOIN ".cpp;{root}/" {name} ${{J_{name}}})',
                f'set({name} "{root}/${{{name}}}.cpp")',
            ],
            [
                f'string(CONFIGURE "@PROJECT_NAME@" cfg_{name} @ONLY)',
                f'string(REPLACE "${{PROJECT_NAME}}" "{root}/{some[0]}.cpp" {name} "${{cfg_{name}}}")',
            ],
        )
        lines = list(self.rng.choice(starts))
        for _ in range(self.rng.randint(0, 3)):
            lines += self._change(name, root, below)
        if self.rng.random() < 0.2:
            lines += [
                f'if(NOT "{self.rng.choice(STEMS)}" IN_LIST {name})',
                *(f"  {x}" for x in self._change(name, root, below)),
                "endif()",
            ]
        return lines, name

    def _unique(self, name: str) -> list[str]:
        return [f'list(FILTER {name} EXCLUDE REGEX "/(CMakeFiles|build)/")']

    def _globbed(self, root: str, below: bool) -> str:
        del below
        return root.removeprefix("./")

    def _absolute(self, root: str, below: bool) -> str:
        return root if below or root.startswith("$") else f"${{CMAKE_CURRENT_SOURCE_DIR}}/{root}"

    def _change(self, name: str, root: str, below: bool) -> list[str]:
        del below
        stem = self.rng.choice(STEMS)
        path = f"{root}/{stem}.cpp"
        number = self.rng.randint(0, 9)
        return list(
            self.rng.choice(
                (
                    [f"list(APPEND {name} {path})"],
                    [f"list(PREPEND {name} {path})"],
                    [f"list(INSERT {name} 0 {path})"],
                    [f"list(REMOVE_ITEM {name} {root}/{stem}.cpp ${{CMAKE_CURRENT_SOURCE_DIR}}/src/{stem}.cpp)"],
                    [f"list(REMOVE_DUPLICATES {name})"],
                    [f"list(REVERSE {name})"],
                    [f"list(SORT {name})"],
                    [f'list(FILTER {name} EXCLUDE REGEX ".*{stem}.*")'],
                    [f'list(FILTER {name} INCLUDE REGEX "/[abdgz][a-z]*\\\\.cpp$")'],
                    [f"set({name} ${{{name}}} {path})"],
                    [f'set({name} "${{{name}}};{path}")'],
                    [
                        f"list(LENGTH {name} len_{name})",
                        f"if(len_{name} GREATER 3)",
                        f"  list(REMOVE_AT {name} -1)",
                        "endif()",
                    ],
                    [
                        f"list(FIND {name} {path} at_{name})",
                        f"if(at_{name} EQUAL -1)",
                        f"  list(APPEND {name} {path})",
                        "endif()",
                    ],
                    [
                        f"if(EXISTS ${{PROJECT_SOURCE_DIR}}/src/{stem}.cpp)",
                        f"  list(APPEND {name} {path})",
                        "else()",
                        f"  set({name})",
                        "endif()",
                    ],
                    [
                        f"if(NOT EXISTS ${{PROJECT_SOURCE_DIR}}/src/none.cpp AND {number} LESS 5)",
                        f"  list(APPEND {name} {path})",
                        "endif()",
                    ],
                    [f'if("{stem}" MATCHES "^([a-z])eta$")', f"  list(APPEND {name} {root}/beta.cpp)", "endif()"],
                    [
                        f'if(PROJECT_VERSION VERSION_LESS "1.{number}")',
                        f"  list(APPEND {name} {path})",
                        "else()",
                        f"  list(APPEND {name} {root}/zeta.cpp)",
                        "endif()",
                    ],
                    [f'list(TRANSFORM {name} REPLACE "{stem}" "alpha")', f"list(REMOVE_DUPLICATES {name})"],
                    [f'string(REPLACE "{stem}" "beta" {name} "${{{name}}}")'],
                    [f'string(REGEX REPLACE "/{stem}[.]cpp" "/delta.cpp" {name} "${{{name}}}")'],
                    [f'string(APPEND {name} ";{path}")'],
                    [
                        f"unset(unused_{name})",
                        f"if(NOT DEFINED unused_{name})",
                        f"  list(APPEND {name} {path})",
                        "endif()",
                    ],
                    [f"list(POP_BACK {name} last_{name})", f"list(APPEND {name} {path})"],
                )
            )
        )

    # -- blocks

    def _if(self, helpers: _Helpers, depth: int, below: bool) -> list[str]:
        lines = [f"if({self._condition()})", *self._statement("  ", helpers, depth + 1, below)]
        if self.rng.random() < 0.4:
            lines += [f"elseif({self._condition()})", *self._statement("  ", helpers, depth + 1, below)]
        if self.rng.random() < 0.6:
            lines += ["else()", *self._statement("  ", helpers, depth + 1, below)]
        return [*lines, "endif()"]

    def _condition(self) -> str:
        number = self.rng.randint(0, 9)
        simple = [
            f"{number} GREATER 4",
            f"NOT {number} EQUAL 3",
            f'"${{PROJECT_NAME}}" STREQUAL "pkg_{number}"',
            "EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/src/alpha.cpp",
            "IS_DIRECTORY ${PROJECT_SOURCE_DIR}/nodes",
            "DEFINED PROJECT_NAME",
            "UNIX",
            "WIN32",
            "NOT APPLE",
            f"PROJECT_VERSION VERSION_GREATER_EQUAL 1.{number}",
            "TRUE",
            "OFF",
            "TARGET no_such_target",
            "COMMAND add_executable",
            'PROJECT_NAME MATCHES "pkg_[0-4]"',
            f'"a{number}" STRLESS "a5"',
            *self.options,
            *(f"NOT {name}" for name in self.options),
        ]
        first = self.rng.choice(simple)
        if self.rng.random() < 0.3:
            return f"({first} OR {self.rng.choice(simple)}) AND NOT ({self.rng.choice(simple)})"
        return (
            f"{first} {self.rng.choice(('AND', 'OR'))} {self.rng.choice(simple)}" if self.rng.random() < 0.3 else first
        )

    def _foreach(self, below: bool) -> list[str]:
        name, root = self.fresh("loop"), self._root(below)
        stems = self.rng.sample(STEMS, 3)
        words = " ".join(stems)
        lists = self.fresh("L")
        heads = (
            [f"foreach(x {words})"],
            [f"set({lists} {words})", f"foreach(x IN LISTS {lists})"],
            [f"set({lists} {words})", f"foreach(x IN LISTS {lists} ITEMS zeta)"],
            [f"foreach(x IN ITEMS {words})"],
            [f"set({lists} {words})", f"foreach(x ${{{lists}}})"],
        )
        if self.rng.random() < 0.25:
            return self._numbered(name, root, stems)
        skip = self.rng.choice(
            (
                [],
                [],
                [f"  if(x STREQUAL {stems[1]})", "    continue()", "  endif()"],
                [f'  if("${{x}}" STREQUAL "{stems[2]}")', "    break()", "  endif()"],
            )
        )
        body = self.rng.choice(
            (
                [f"  add_executable({name}_${{x}} {root}/${{x}}.cpp)"],
                [f"  add_library(${{PROJECT_NAME}}_{name}_${{x}} SHARED {root}/${{x}}.cpp)"],
                [f"  list(APPEND all_{name} {root}/${{x}}.cpp)"],
                [
                    f"  add_executable({name}_${{x}} {root}/${{x}}.cpp)",
                    f"  install(TARGETS {name}_${{x}} RUNTIME DESTINATION lib/${{PROJECT_NAME}})",
                ],
                [
                    "  string(TOUPPER ${x} upper)",
                    f"  set(V_${{upper}} {root}/${{x}}.cpp)",
                    f"  add_executable({name}_${{upper}} ${{V_${{upper}}}})",
                ],
            )
        )
        tail = [f"add_library({name}_all ${{all_{name}}})"] if "all_" in body[0] else []
        return [*self.rng.choice(heads), *skip, *body, "endforeach()", *tail]

    def _numbered(self, name: str, root: str, stems: list[str]) -> list[str]:
        lists = self.fresh("Z")
        return self.rng.choice(
            (
                [
                    f"foreach(i RANGE 1 {self.rng.randint(1, 4)})",
                    f"  add_executable({name}_${{i}} {root}/{stems[0]}.cpp)",
                    "endforeach()",
                ],
                ["foreach(i RANGE 0 6 2)", f"  add_executable({name}_${{i}} {root}/{stems[0]}.cpp)", "endforeach()"],
                ["foreach(i RANGE 2)", f"  add_executable({name}_${{i}} {root}/{stems[0]}.cpp)", "endforeach()"],
                [
                    f"set({lists}A {' '.join(stems)})",
                    f"set({lists}B x y z)",
                    f"foreach(a_ IN LISTS {lists}A)",
                    f"  list(FIND {lists}A ${{a_}} i)",
                    f"  list(GET {lists}B ${{i}} b_)",
                    f"  add_executable({name}_${{b_}} {root}/${{a_}}.cpp)",
                    "endforeach()",
                ],
            )
        )

    def _while(self, below: bool) -> list[str]:
        name, root = self.fresh("count"), self._root(below)
        return [
            f"set({name} 0)",
            f"while({name} LESS {self.rng.randint(1, 3)})",
            f"  add_executable(turn_{name}_${{{name}}} {root}/{self.rng.choice(STEMS)}.cpp)",
            f'  math(EXPR {name} "${{{name}}} + 1")',
            "endwhile()",
        ]

    def _testing(self, below: bool) -> list[str]:
        switch = "BUILD_TESTING" if self.made.ros == 2 else "CATKIN_ENABLE_TESTING"
        command = "ament_add_gtest" if self.made.ros == 2 else "catkin_add_gtest"
        root = self._root(below)
        return [f"if({switch})", f"  {command}({self.fresh('check')} {root}/{self.rng.choice(STEMS)}.cpp)", "endif()"]

    def _early(self, below: bool) -> list[str]:
        """A function that returns before it builds, or not."""
        name, root = self.fresh("maybe"), self._root(below)
        return [
            f"function({name} name)",
            f"  if({self._condition()})",
            "    return()",
            "  endif()",
            f"  add_executable(${{name}} {root}/{self.rng.choice(STEMS)}.cpp)",
            "endfunction()",
            f"{name}({self.fresh('perhaps')})",
        ]

    def _components(self, below: bool) -> list[str]:
        if self.made.ros == 1:
            return self._target(below)
        name, root = self.fresh("comp"), self._root(below)
        return [
            f"add_library({name} SHARED {root}/{self.rng.choice(STEMS)}.cpp)",
            f'rclcpp_components_register_node({name} PLUGIN "a::{name}" EXECUTABLE {name}_exe)',
            f"ament_target_dependencies({name} rclcpp)",
        ]

    def _helper_call(self, helpers: _Helpers, below: bool) -> list[str]:
        name, shape = self.rng.choice(helpers.calls)
        return list(shape.call(name, self.fresh("made"), self._root(below), self.rng))

    def _installs(self, folder: str) -> list[str]:
        del folder
        share = "share/${PROJECT_NAME}" if self.made.ros == 2 else "${CATKIN_PACKAGE_SHARE_DESTINATION}"
        programs = "lib/${PROJECT_NAME}" if self.made.ros == 2 else "${CATKIN_PACKAGE_BIN_DESTINATION}"
        every = [
            [f"install(DIRECTORY launch config DESTINATION {share})"],
            [f"install(DIRECTORY launch/ DESTINATION {share}/launch)"],
            ['install(DIRECTORY include/thing/ DESTINATION include/thing FILES_MATCHING PATTERN "*.hpp")'],
            [f"install(PROGRAMS scripts/one.py DESTINATION {programs})"],
            [f"install(FILES config/one.yaml config/two.yaml DESTINATION {share}/config)"],
            [
                "set(parts launch config)",
                "foreach(part ${parts})",
                f"  install(DIRECTORY ${{part}} DESTINATION {share})",
                "endforeach()",
            ],
            [
                "file(GLOB FILES_TO_INSTALL RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} config/*.yaml)",
                f"install(FILES ${{FILES_TO_INSTALL}} DESTINATION {share})",
            ],
            ["file(GLOB PYS scripts/*.py)", f"install(PROGRAMS ${{PYS}} DESTINATION {programs})"],
            [f"install(PROGRAMS scripts/two.py DESTINATION {programs} RENAME two)"],
            ["include(GNUInstallDirs)", "install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/doc)"],
            [f"set(DEST {share})", "install(FILES launch/one.launch DESTINATION ${DEST})"],
        ]
        if self.made.ros == 1:
            every.append([f"catkin_install_python(PROGRAMS scripts/one.py scripts/two.py DESTINATION {programs})"])
        lines: list[str] = []
        for chosen in self.rng.sample(every, self.rng.randint(1, 4)):
            lines += chosen
        return lines


@dataclass
class _Helpers:
    lines: list[str] = field(default_factory=list)
    calls: list[tuple[str, _Shape]] = field(default_factory=list)


class _Shape:
    """A function or macro that makes targets, and how it is called."""

    either = True

    def body(self, name: str, kind: str) -> Iterator[str]:
        raise NotImplementedError

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        raise NotImplementedError


class _Positional(_Shape):
    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} target source)", "  add_executable(${target} ${source} ${ARGN})")
        yield from ("  install(TARGETS ${target} DESTINATION lib/${PROJECT_NAME})", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        yield f"{name}({target} {root}/{rng.choice(STEMS)}.cpp {root}/zeta.cpp)"


class _Keywords(_Shape):
    def body(self, name: str, kind: str) -> Iterator[str]:
        yield f"{kind}({name})"
        yield '  cmake_parse_arguments(ARG "SHARED;QUIET" "NAME" "SOURCES;DEPS" ${ARGN})'
        yield from ("  if(ARG_SHARED)", "    add_library(${ARG_NAME} SHARED ${ARG_SOURCES})", "  else()")
        yield from ("    add_executable(${ARG_NAME} ${ARG_SOURCES})", "  endif()")
        yield from ("  if(ARG_DEPS)", "    target_link_libraries(${ARG_NAME} ${ARG_DEPS})", "  endif()", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        shared = " SHARED" if rng.random() < 0.5 else ""
        yield f"{name}(NAME {target}{shared} SOURCES {root}/{rng.choice(STEMS)}.cpp {root}/beta.cpp DEPS m)"


class _Parsed(_Shape):
    either = False

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield f"{kind}({name} target)"
        yield '  cmake_parse_arguments(PARSE_ARGV 1 P "" "ONE" "MANY")'
        yield from ("  add_executable(${target} ${P_ONE} ${P_MANY} ${P_UNPARSED_ARGUMENTS})", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        yield f"{name}({target} {root}/alpha.cpp ONE {root}/beta.cpp MANY {root}/{rng.choice(STEMS[2:])}.cpp)"


class _Returning(_Shape):
    either = False

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} out folder)", "  set(result)", "  foreach(stem ${ARGN})")
        yield from ("    list(APPEND result ${folder}/${stem}.cpp)", "  endforeach()")
        yield from ("  set(${out} ${result} PARENT_SCOPE)", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        stems = " ".join(rng.sample(STEMS, 2))
        yield from (f"{name}({target}_SOURCES {root} {stems})", f"add_library({target} ${{{target}_SOURCES}})")


class _Counting(_Shape):
    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} target)", "  if(${ARGC} GREATER 2)", "    add_library(${target} ${ARGV1} ${ARGV2})")
        yield from ("  else()", "    add_library(${target} ${ARGN})", "  endif()", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        more = f" {root}/gamma.cpp" if rng.random() < 0.5 else ""
        yield f"{name}({target} {root}/alpha.cpp{more})"


class _Shadowing(_Shape):
    """What a function sets is gone after it; what a macro sets stays."""

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} target folder)", "  set(picked ${folder}/delta.cpp)")
        yield from ("  add_library(${target} ${picked})", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        yield from (f"set(picked {root}/{rng.choice(STEMS)}.cpp)", f"{name}({target} {root})")
        yield f"add_executable({target}_after ${{picked}})"


_SHAPES: tuple[_Shape, ...] = (_Positional(), _Keywords(), _Parsed(), _Returning(), _Counting(), _Shadowing())
