"""What a package may have beside what it provides: names that its build may make, kinds of which it may have any.

A program that is built and not installed is no provision, and yet whoever starts it does not ask for something that is
not there. Where a build was not understood, any name may be.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile
from pathlib import PurePosixPath
from typing import Final

from ecm_parsers.cmake_facts import CmakeFile
from ecm_parsers.cmake_tokens import Command, parse_commands

from ecm_extract.entities.install_rules import installed_targets, tells_installed
from ecm_extract.entities.python_names import MODULE, makes_modules
from ecm_extract.read.facts import PackageFacts
from ecm_extract.tree import Tree

PROGRAM: Final = "executable"
MESSAGE: Final = "message"
LIBRARY: Final = "library"
_LIBRARIES: Final = frozenset({"library", "interface"})
_PROGRAMS: Final = frozenset({"programs", "python"})
_COMPUTED: Final = frozenset("${*?")
_DEFINES: Final = frozenset({"macro", "function"})
_SHAPES: Final = {".msg": "msg", ".idl": "msg", ".srv": "srv", ".action": "action"}
_ROS_2: Final = 2


def possible_names(facts: PackageFacts) -> dict[str, set[str]]:
    """Return names by kind that the build of a package may make; those that it provides may be among them."""
    return {PROGRAM: _programs(facts), MESSAGE: _messages(facts), LIBRARY: _libraries(facts)}


def open_kinds(facts: PackageFacts, makers: frozenset[str]) -> tuple[str, ...]:
    """Return the kinds of which a package may have names that nothing tells.

    Args:
        facts: of the package.
        makers: commands of the tree that make programs, see `makers_of`.
    """
    kinds = []
    if not _tells_programs(facts) or _asks(facts, makers):
        kinds.append(PROGRAM)
    if not facts.interfaces:
        kinds.append(MESSAGE)  # it may generate them
    if not _tells_libraries(facts):
        kinds.append(LIBRARY)
    if makes_modules(facts):
        kinds.append(MODULE)
    return tuple(kinds)


def runs_files(facts: PackageFacts) -> bool:
    """Whether any file of a package may be started by its name.

    ROS 1 looks through the whole package, and install rules of CMake may take any; of a Python package of ROS 2
    only what its setup.py installs, where that is written out.
    """
    installed = _set_up(facts)
    is_python = facts.ros == _ROS_2 and bool(facts.setups) and not facts.cmake
    return not is_python or any("*" in name or "{" in name for name in installed)


def makers_of(tree: Tree) -> frozenset[str]:
    """Return the commands that CMake modules of a tree define with an `add_executable` inside, in lower case."""
    modules = [entry.path for entry in tree.files() if entry.path.endswith(".cmake")]
    parsed = (parse_commands(data).facts for _, data in tree.read_many(modules)) if modules else ()
    return frozenset(name for commands in parsed for name in _making(commands))


def _programs(facts: PackageFacts) -> set[str]:
    targets = [target for file in facts.cmake.values() for target in file.targets]
    built = {name for each in targets if each.kind == PROGRAM for name in (each.name, each.output) if name}
    built |= {entry.executable for file in facts.cmake.values() for entry in file.components if entry.executable}
    built |= {entry.name for setup in facts.setups.values() for entry in setup.entry_points}
    built |= {name for file in facts.cmake.values() for name in _made(file)}
    maybe = {word for file in facts.cmake.values() for word in file.foreign}
    installs = [each for file in facts.cmake.values() for each in file.installs]
    maybe |= {item for each in installs if each.kind == "targets" for item in each.items}
    built |= {each.renamed for each in installs if each.kind in _PROGRAMS and each.renamed}
    maybe |= {item.rpartition("/")[2] for each in installs if each.kind in _PROGRAMS for item in each.items}
    return built | (maybe - {target.name for target in targets}) | {name.rpartition("/")[2] for name in _set_up(facts)}


def _set_up(facts: PackageFacts) -> set[str]:
    """Files that setup.py installs."""
    scripts = {name for setup in facts.setups.values() for name in setup.scripts}
    return scripts | {file for setup in facts.setups.values() for data in setup.data_files for file in data.files}


def _made(file: CmakeFile) -> Iterator[str]:
    """Names of what custom commands make."""
    for command in file.commands:
        if command.name == "add_custom_command" and command.args[:1] == ("OUTPUT",):
            outputs = takewhile(lambda word: not word.isupper(), command.args[1:])
            yield from (output.rpartition("/")[2] for output in outputs)


def _libraries(facts: PackageFacts) -> set[str]:
    """Libraries that others may find: those that are installed, and all that are built where that is not told."""
    targets = [target for file in facts.cmake.values() for target in file.targets if target.kind in _LIBRARIES]
    kept = installed_targets(facts) if tells_installed(facts) else {target.name for target in targets}
    return {name for target in targets if target.name in kept for name in (target.name, target.output) if name}


def _messages(facts: PackageFacts) -> set[str]:
    """Definitions that a build file lists, or that lie in the package, and that are no provisions of it."""
    listed = {f"{entry.path.rpartition('/')[2]}" for file in facts.cmake.values() for entry in file.interfaces}
    listed |= {entry.path.rpartition("/")[2] for entry in facts.root.files}
    paths = [PurePosixPath(name) for name in listed]
    read = {PurePosixPath(path).name for path in facts.interfaces}
    return {f"{facts.name}/{_SHAPES[path.suffix]}/{path.stem}" for path in paths if _is_other(path, read)}


def _is_other(path: PurePosixPath, read: set[str]) -> bool:
    return path.suffix in _SHAPES and path.name not in read and "$" not in path.name


def _tells_programs(facts: PackageFacts) -> bool:
    """Tell whether the build files leave no name of a program open."""
    if any(file.malformed or file.unknown for file in facts.cmake.values()):
        return False
    targets = [target for file in facts.cmake.values() for target in file.targets]
    return bool(facts.cmake or facts.setups) and not any(_COMPUTED & set(target.name) for target in targets)


def _tells_libraries(facts: PackageFacts) -> bool:
    """Tell whether the build files leave no name of a library open."""
    files = facts.cmake.values()
    targets = [target for file in files for target in file.targets if target.kind in _LIBRARIES]
    computed = any("$" in name for target in targets for name in (target.name, target.output))
    return not facts.root.rosbuild and not any(file.unknown for file in files) and not computed


def _making(commands: tuple[Command, ...]) -> Iterator[str]:
    """Names of the functions and macros around each `add_executable`."""
    name = ""
    for command in commands:
        if command.name in _DEFINES and command.args:
            name = command.args[0].text.lower()
        elif command.name == "add_executable" and name:
            yield name
        elif command.name.removeprefix("end") in _DEFINES:
            name = ""


def _asks(facts: PackageFacts, makers: frozenset[str]) -> bool:
    """Tell whether a build file calls one of these commands without naming a program."""
    called = (command for file in facts.cmake.values() for command in file.commands if not command.args)
    return any(command.name in makers for command in called)
