"""The files of drawn projects beside their CMakeLists.txt, and folders of a build that are found, not named."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field

from cmake_helpers import STEMS

FOLDERS = ("src", "src/core", "nodes")
_FILE = "==="


@dataclass
class Project:
    """The files of one project, by path."""

    name: str
    ros: int
    files: dict[str, str] = field(default_factory=dict)


def put_sources(made: Project) -> None:
    """Write sources, and what is installed, into a project."""
    files = made.files
    for folder in FOLDERS:
        for stem in STEMS:
            files[f"{folder}/{stem}.cpp"] = "int main() { return 0; }\n"
    files["src/alpha.hpp"] = files["include/thing/alpha.hpp"] = "#pragma once\n"
    for name in ("one", "two"):
        files[f"scripts/{name}.py"] = "#!/usr/bin/env python3\n"
        files[f"launch/{name}.launch"] = "<launch/>\n"
        files[f"config/{name}.yaml"] = "a: 1\n"
    files["config/sources.txt"] = "alpha.cpp\ncore/beta.cpp\n"
    files["config/version.txt"] = "4.2.1\n"
    files["package.xml"] = _manifest(made)


def _manifest(made: Project) -> str:
    build = "ament_cmake" if made.ros == 2 else "catkin"
    shape = 3 if made.ros == 2 else 2
    return (
        f'<package format="{shape}"><name>{made.name}</name><version>1.0.0</version>'
        f'<description>d</description><maintainer email="a@b.c">m</maintainer><license>l</license>'
        f"<buildtool_depend>{build}</buildtool_depend>"
        + (f"<export><build_type>{build}</build_type></export>" if made.ros == 2 else "")
        + "</package>\n"
    )


def put_parts(made: Project, rng: random.Random) -> list[str]:
    """Write folders that a build finds by a pattern; returns the lines that find them."""
    for part in rng.sample(STEMS, 2):
        own = f"project(part_{part})\n" if rng.random() < 0.5 else ""
        made.files[f"parts/{part}/{part}.cpp"] = "int main() { return 0; }\n"
        made.files[f"parts/{part}/CMakeLists.txt"] = (
            f"{own}add_executable(part_{part} {part}.cpp ${{PROJECT_NAME}}.cpp)\n"
            if own
            else f"add_executable(${{PROJECT_NAME}}_part_{part} {part}.cpp ${{FOR_PARTS}})\n"
        )
        if own:
            made.files[f"parts/{part}/part_{part}.cpp"] = "\n"
    made.files["parts/README.md"] = "parts\n"
    return _found(rng)


def _found(rng: random.Random) -> list[str]:
    where = "${CMAKE_CURRENT_SOURCE_DIR}/parts"
    by_file = [
        "file(GLOB lists ${CMAKE_CURRENT_SOURCE_DIR}/parts/*/CMakeLists.txt)",
        "foreach(list ${lists})",
        "  get_filename_component(folder ${list} PATH)",
        "  add_subdirectory(${folder})",
        "endforeach()",
    ]
    by_folder = [
        f"file(GLOB kids RELATIVE {where} {where}/*)",
        "foreach(kid ${kids})",
        f"  if(IS_DIRECTORY {where}/${{kid}})",
        "    add_subdirectory(parts/${kid})",
        "  endif()",
        "endforeach()",
    ]
    return ["set(FOR_PARTS ${CMAKE_CURRENT_SOURCE_DIR}/src/zeta.cpp)", *rng.choice((by_file, by_folder))]


def parted(lines: Sequence[str]) -> tuple[dict[str, str], list[str]]:
    """Take the files that a statement begins with off its lines; `=== path` begins one, `===` alone ends the last."""
    files: dict[str, str] = {}
    rest: list[str] = []
    path = ""
    for line in lines:
        if line.startswith(_FILE):
            path = line.removeprefix(_FILE).strip()
            files |= {path: ""} if path else {}
        elif path:
            files[path] += f"{line}\n"
        else:
            rest.append(line)
    return files, rest
