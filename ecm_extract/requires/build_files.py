"""What the build files of a package name of the package itself: files to install, headers and libraries to export."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.finding import Certainty
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.cmake_facts import Command
from ecm_parsers.cmake_tokens import Command as WrittenCommand

from ecm_extract.entities.install_rules import InstallRule, install_rules
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required
from ecm_extract.requires.setup_files import setup_file_requirements

_OPEN: Final = re.compile(r"[$*?\[\]<>@]")
_BUILDERS: Final = frozenset({"configure_file", "add_custom_command", "execute_process", "file", "externalproject_add"})
"""Commands that make files of which they give parts of the path."""
_LIBRARIES: Final = {"catkin_package": "LIBRARIES", "ament_export_libraries": ""}
_OTHER: Final = frozenset({"INCLUDE_DIRS", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS"})
_HEADERS: Final = ("INCLUDE_DIRS", "include")
Written = Callable[[str], Sequence[WrittenCommand]]
"""Gives the commands of a CMake file as they are written; none of one that cannot be read."""


class Words(msgspec.Struct, frozen=True):
    """What the commands of a package say outside of install rules.

    Attributes:
        said: their words. is_open: whether files from elsewhere may say more.
    """

    said: frozenset[str]
    is_open: bool


def build_file_requirements(written: Written, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the build files of a package need of the package; rosbuild installs and exports nothing."""
    yield from setup_file_requirements(facts)
    if facts.root.rosbuild or not facts.cmake:
        return
    words = build_words(written, facts)
    rules = list(install_rules(facts))
    chosen = _of_machines(rules, facts)
    for rule in rules:
        if rule.kind != "TARGETS" and "OPTIONAL" not in rule.words and (rule.path, rule.line) not in chosen:
            yield from _installed(rule, words, facts)
    for path, file in facts.cmake.items():
        for command in file.commands:
            yield from _headers(command, path, facts)
            yield from _libraries(command, path, facts)


def _of_machines(rules: Iterable[InstallRule], facts: PackageFacts) -> frozenset[tuple[str, int]]:
    """Places of rules of which something that is not known chooses the files, one of which is there.

    `lib/${PLATFORM}/a.so` where the processor gives PLATFORM: nobody builds for those that it has no file for.
    """
    open_rules = [rule for rule in rules if rule.by_default is None]
    count = Counter((rule.path, rule.line) for rule in open_rules)
    there = {entry.path for entry in facts.root.files}
    there |= {path[:at] for path in there for at, letter in enumerate(path) if letter == "/"}
    return frozenset(
        (rule.path, rule.line)
        for rule in open_rules
        if count[rule.path, rule.line] > 1 and all(f"{rule.folder}{item}".rstrip("/") in there for item in rule.items)
    )


def build_words(written: Written, facts: PackageFacts) -> Words:
    """Return what the commands of a package say outside of install rules."""
    found: set[str] = set()
    for path in facts.cmake:
        for command in written(path):
            words = [argument.text for argument in command.args]
            found |= set() if command.name == "install" or command.name.startswith("end") else set(words)
            if command.name in _BUILDERS:
                found |= {part for word in words for part in word.split("/")}
    return Words(frozenset(found), any(file.unknown for file in facts.cmake.values()))


def _installed(rule: InstallRule, words: Words, facts: PackageFacts) -> Iterator[Requirement]:
    """Items of a rule; what another command names is perhaps made by it."""
    for item in rule.items:
        path = f"{rule.folder}{item}".rstrip("/")
        name = _below(path, facts)
        if name and not _is_computed(item):
            asks = words.is_open or "EXISTS" in words.said
            made = asks or not words.said.isdisjoint({item, path, path.rpartition("/")[2]})
            certainty: Certainty = "unknown" if made else "likely"
            yield _own("installs_file", name, Place(rule.path, rule.line, f"file {rule.path}"), facts, certainty, item)


def _is_computed(item: str) -> bool:
    """Whether an item is known to CMake only, or stands for a folder that is there, as `.` does."""
    outside = item.startswith(("/", "..")) or "/../" in item
    return outside or not item.rstrip("/.") or _OPEN.search(item) is not None


def _headers(command: Command, path: str, facts: PackageFacts) -> Iterator[Requirement]:
    """The folder of headers that catkin_package is told of, which it looks for."""
    if command.name == "catkin_package" and command.args[:2] == _HEADERS:
        folder = path.rpartition("/")[0]
        name = _below(f"{folder}/{_HEADERS[1]}".lstrip("/"), facts)
        place = Place(path, command.line, f"file {path}")
        yield _own("exports_headers", name, place, facts, "likely", _HEADERS[1])


def _libraries(command: Command, path: str, facts: PackageFacts) -> Iterator[Requirement]:
    """Names after LIBRARIES, or all of them; `target` is the one that is built."""
    if command.name not in _LIBRARIES:
        return
    keyword = _LIBRARIES[command.name]
    built = _built(facts)
    taken = not keyword
    for argument in command.args:
        if argument == keyword or argument in _OTHER:
            taken = argument == keyword
        elif taken and argument and not {"$", "/", "."} & set(argument):
            target = argument if argument in built else ""
            yield _own("exports_library", argument, Place(path, command.line, f"file {path}"), facts, "likely", target)


def _built(facts: PackageFacts) -> frozenset[str]:
    targets = [target for file in facts.cmake.values() for target in file.targets]
    kinds = {"library", "interface"}
    return frozenset(name for each in targets if each.kind in kinds for name in (each.name, each.output) if name)


def _below(path: str, facts: PackageFacts) -> str:
    """A path from the folder of the package; empty for what lies outside of it."""
    root = f"{facts.root.path}/" if facts.root.path else ""
    return path.removeprefix(root) if path.startswith(root) else ""


def _own(use: str, name: str, place: Place, facts: PackageFacts, certainty: Certainty, target: str) -> Requirement:
    return required(use, name, place, certainty, package=facts.name, target=target)
