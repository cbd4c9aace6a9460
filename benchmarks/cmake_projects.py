"""Small CMake projects made by a seed: packages as people write them, of statements that CMake can run alone."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field

from cmake_forms import FORMS, PLACES, written
from cmake_helpers import SHAPES, STEMS, Shape
from cmake_tree import FOLDERS, Project, parted, put_parts, put_sources


def make(seed: int) -> Project:
    """Return the project of a seed; the same seed gives the same project."""
    return _Maker(random.Random(seed), seed).project()


class _Maker:
    def __init__(self, rng: random.Random, seed: int) -> None:
        self.rng = rng
        self.made = Project(f"pkg_{seed}", rng.choice((1, 2)))
        self.count = 0
        self.options: list[str] = []
        self.auto = self.made.ros == 2 and rng.random() < 0.3

    def project(self) -> Project:
        """Write sources, helpers, subdirectories and the file that binds them."""
        put_sources(self.made)
        lines = self._head()
        helpers = self._helpers()
        lines += helpers.lines
        for _ in range(self.rng.randint(3, 7)):
            lines += self._statement("", helpers, 0)
        lines += self._installs()
        lines += self._subdirectories(helpers)
        lines += put_parts(self.made, self.rng) if self.rng.random() < 0.2 else []
        lines += [self._end()] if self.made.ros == 2 else []
        self.made.files["CMakeLists.txt"] = "\n".join(lines) + "\n"
        return self.made

    def fresh(self, word: str) -> str:
        """A name that nothing else has."""
        self.count += 1
        return f"{word}{self.count}"

    def _end(self) -> str:
        return "ament_auto_package(INSTALL_TO_SHARE launch config)" if self.auto else "ament_package()"

    def _head(self) -> list[str]:
        lines = [f"cmake_minimum_required(VERSION {self.rng.choice(('3.5', '3.8', '3.14', '3.16'))})"]
        lines += [f"project({self.made.name} VERSION 1.{self.rng.randint(0, 9)}.2)"]
        if self.made.ros == 2:
            lines += ["find_package(ament_cmake REQUIRED)", "find_package(rclcpp REQUIRED)"]
            lines += ["find_package(rclcpp_components REQUIRED)"]
            lines += ["find_package(ament_cmake_auto REQUIRED)"] if self.auto else []
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
            shape = self.rng.choice(SHAPES)
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
        kinds += [lambda: self._stated(below)] * 4
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
        given = {
            "name": name,
            "root": root,
            "globbed": root.removeprefix("./"),
            "absolute": self._absolute(root, below),
            "number": str(self.rng.randint(0, 5)),
            **dict(zip("abcd", some, strict=True)),
        }
        lines = written(self.rng.choice(FORMS["lists"]), given)
        for _ in range(self.rng.randint(0, 3)):
            lines += self._change(name, root)
        if self.rng.random() < 0.2:
            lines += [
                f'if(NOT "{self.rng.choice(STEMS)}" IN_LIST {name})',
                *(f"  {x}" for x in self._change(name, root)),
                "endif()",
            ]
        return lines, name

    def _absolute(self, root: str, below: bool) -> str:
        return root if below or root.startswith("$") else f"${{CMAKE_CURRENT_SOURCE_DIR}}/{root}"

    def _change(self, name: str, root: str) -> list[str]:
        given = {"stem": self.rng.choice(STEMS), "number": str(self.rng.randint(0, 9)), "name": name, "root": root}
        return written(self.rng.choice(FORMS["changes"]), given)

    def _if(self, helpers: _Helpers, depth: int, below: bool) -> list[str]:
        lines = [f"if({self._condition()})", *self._statement("  ", helpers, depth + 1, below)]
        if self.rng.random() < 0.4:
            lines += [f"elseif({self._condition()})", *self._statement("  ", helpers, depth + 1, below)]
        if self.rng.random() < 0.6:
            lines += ["else()", *self._statement("  ", helpers, depth + 1, below)]
        return [*lines, "endif()"]

    def _condition(self) -> str:
        number = self.rng.randint(0, 9)
        given = {"number": str(number)}
        simple = [line for form in FORMS["conditions"] for line in written(form, given)]
        simple += [*self.options, *(f"NOT {name}" for name in self.options)]
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
        given = {"lists": self.fresh("Z"), "number": str(self.rng.randint(1, 4)), "name": name, "root": root}
        given |= dict(zip("abc", stems, strict=True))
        return written(self.rng.choice(FORMS["numbered"]), given)

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

    def _stated(self, below: bool) -> list[str]:
        """One of the whole statements."""
        root = self._root(below)
        given = {
            "name": self.fresh("st"),
            "root": root,
            "absolute": self._absolute(root.removeprefix("./"), below),
            "number": str(self.rng.randint(0, 9)),
            "option": self.rng.choice(self.options) if self.options else "UNIX",
            "on_off": self.rng.choice(("ON", "OFF")),
            **dict(zip("abcd", self.rng.sample(STEMS, 4), strict=True)),
            **PLACES[self.made.ros],
        }
        forms = FORMS["statements"] + FORMS[f"statements_ros{self.made.ros}"] * 2
        form = self.rng.choice(forms + (FORMS["statements_auto"] * 4 if self.auto and not below else []))
        form = form.replace("${CMAKE_CURRENT_SOURCE_DIR}/config", "${PROJECT_SOURCE_DIR}/config")
        files, lines = parted(written(form, given))
        self.made.files |= files
        return lines

    def _helper_call(self, helpers: _Helpers, below: bool) -> list[str]:
        name, shape = self.rng.choice(helpers.calls)
        return list(shape.call(name, self.fresh("made"), self._root(below), self.rng))

    def _installs(self) -> list[str]:
        forms = FORMS["installs"] + (FORMS["installs_ros1"] if self.made.ros == 1 else [])
        chosen = self.rng.sample(forms, self.rng.randint(1, 4))
        return [line for form in chosen for line in written(form, PLACES[self.made.ros])]


@dataclass
class _Helpers:
    lines: list[str] = field(default_factory=list)
    calls: list[tuple[str, Shape]] = field(default_factory=list)
