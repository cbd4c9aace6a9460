"""CMake calls that install: rules as they are written, and those that come by themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec
from ecm_parsers.cmake_facts import Install, InstallKind, Target

from ecm_extract.cmake.auto_package import installed_by_auto, installed_by_simple
from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.genex import decided, decided_text
from ecm_extract.cmake.keywords import first, split
from ecm_extract.cmake.known import known
from ecm_extract.cmake.state import both
from ecm_extract.cmake.values import PREFIX

_INSTALL_KINDS: dict[str, InstallKind] = {
    "TARGETS": "targets",
    "PROGRAMS": "programs",
    "DIRECTORY": "directory",
    "FILES": "files",
}
_ONLY_IN = "CONFIGURATIONS"
"""What installs only for some values of CMAKE_BUILD_TYPE, which the end of the build decides."""
_INSTALL_WORDS = frozenset(
    {"DESTINATION", "EXPORT", "RUNTIME", "LIBRARY", "ARCHIVE", "INCLUDES", "PERMISSIONS", "PATTERN", "REGEX"}
    | {"FILES_MATCHING", "USE_SOURCE_PERMISSIONS", "OPTIONAL", "COMPONENT", "RENAME", "FILE_PERMISSIONS"}
    | {"DIRECTORY_PERMISSIONS", "CONFIGURATIONS", "TYPE", "PUBLIC_HEADER", "BUNDLE", "OBJECTS", "EXCLUDE"}
)


def installs(
    calls: tuple[Call, ...], targets: Mapping[str, Target], projects: Mapping[str, str], files: BuildFiles
) -> Iterator[Install]:
    """Yield what is installed where; targets that go to several folders have a rule for each.

    Args:
        calls: of one file.
        targets: of the whole build, by name.
        projects: of the whole build, by folder.
        files: of the tree.
    """
    for call in calls:
        if call.name == "install" and call.args and call.args[0] in _INSTALL_KINDS:
            yield from _each(call, _INSTALL_KINDS[call.args[0]], targets)
        elif call.name == "catkin_install_python":
            yield from _each(call, "python", targets)
        elif call.name == "ament_auto_package":
            yield from installed_by_auto(call, calls, projects, files)
        elif call.name == "cs_install":
            yield from installed_by_simple(call, calls, projects, files)


def _each(call: Call, kind: InstallKind, targets: Mapping[str, Target]) -> Iterator[Install]:
    """The rules of a call; those that only some of the arguments give which builds may have are open."""
    worlds = [tuple(_rules(call, kind, texts, targets)) for texts in (call.texts, *call.others)]
    for rule in dict.fromkeys(rule for rules in worlds for rule in rules):
        if _ONLY_IN in call.texts:
            yield msgspec.structs.replace(rule, by_default=both(call.by_default, None))
            continue
        is_taken = True if all(rule in rules for rules in worlds) else rule in worlds[0] if call.sure else None
        yield msgspec.structs.replace(rule, by_default=both(call.by_default, is_taken))


def _rules(call: Call, kind: InstallKind, texts: tuple[str, ...], targets: Mapping[str, Target]) -> Iterator[Install]:
    args = texts[texts[:1] == ("PROGRAMS",) if kind == "python" else 1 :]
    rule = _install(call, kind, args)
    yield from _parted(rule, call, args, targets) if kind == "targets" else (rule,)


def _install(call: Call, kind: InstallKind, args: tuple[str, ...]) -> Install:
    groups = split(args, _INSTALL_WORDS)
    word = call.word if kind == "targets" else call.file
    return Install(
        kind=kind,
        items=tuple(word(value) for value in decided(groups[""])),
        destination=_below_prefix(decided_text(_destination(args)), call),
        line=call.line,
        conditions=call.conditions,
        words=tuple(word for word in args if word in _INSTALL_WORDS),
        renamed=call.word(first(groups, "RENAME") or ""),
    )


def _destination(args: tuple[str, ...]) -> str:
    """Return the folder of programs (RUNTIME) when it is told, else the first one, else that of the TYPE."""
    found = _told(args)
    kind = args[args.index("TYPE") + 1] if "TYPE" in args[:-1] else ""
    return found.get("RUNTIME") or next(iter(found.values()), known().install_types.get(kind, ""))


def _told(args: tuple[str, ...]) -> dict[str, str]:
    """Folders after DESTINATION by the word before it; one that a variable leaves empty is not told."""
    ends = [at for at, word in enumerate(args[:-1]) if word == "DESTINATION"]
    return {args[at - 1]: args[at + 1] for at in ends if args[at + 1] not in _INSTALL_WORDS}


def _parted(rule: Install, call: Call, words: tuple[str, ...], targets: Mapping[str, Target]) -> Iterator[Install]:
    """Programs go where RUNTIME says, shared libraries where LIBRARY does, others where ARCHIVE does."""
    told = _told(words)
    places: dict[str, list[str]] = {}
    for item in rule.items:
        artefact = _artefact(targets.get(item))
        place = told.get(artefact, None if rule.destination else known().install_artefacts[artefact])
        shown = rule.destination if place is None else _below_prefix(decided_text(place), call)
        places.setdefault(shown, []).append(item)
    for place, items in places.items():
        yield msgspec.structs.replace(rule, items=tuple(items), destination=place)


def _artefact(target: Target | None) -> str:
    if target is None or target.kind != "library":
        return "RUNTIME"
    return "ARCHIVE" if target.is_shared is False else "LIBRARY"


def _below_prefix(destination: str, call: Call) -> str:
    return call.word(destination.removeprefix(PREFIX).lstrip("/") if destination.startswith(PREFIX) else destination)
