"""CMake calls that install: rules as they are written, and those that come by themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec
from ecm_parsers.cmake_facts import Install, InstallKind, Target

from ecm_extract.cmake.auto_package import installed_by_auto
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
_INSTALL_WORDS = frozenset(
    {"DESTINATION", "EXPORT", "RUNTIME", "LIBRARY", "ARCHIVE", "INCLUDES", "PERMISSIONS", "PATTERN", "REGEX"}
    | {"FILES_MATCHING", "USE_SOURCE_PERMISSIONS", "OPTIONAL", "COMPONENT", "RENAME", "FILE_PERMISSIONS"}
    | {"DIRECTORY_PERMISSIONS", "CONFIGURATIONS", "TYPE", "PUBLIC_HEADER", "BUNDLE", "OBJECTS", "EXCLUDE"}
)


def installs(calls: tuple[Call, ...], targets: Mapping[str, Target], files: BuildFiles) -> Iterator[Install]:
    """Yield what is installed where; targets that go to several folders have a rule for each.

    Args:
        calls: of one file.
        targets: of the whole build, by name.
        files: of the tree.
    """
    for call in calls:
        if call.name == "install" and call.args and call.args[0] in _INSTALL_KINDS:
            for rule in _each(call, _INSTALL_KINDS[call.args[0]]):
                yield from _parted(rule, call, targets) if rule.kind == "targets" else (rule,)
        elif call.name == "catkin_install_python":
            yield from _each(call, "python")
        elif call.name == "ament_auto_package":
            yield from installed_by_auto(call, calls, files)


def _each(call: Call, kind: InstallKind) -> Iterator[Install]:
    """One rule, or one for each of the arguments that builds may have."""
    for at, texts in enumerate((call.texts, *call.others)):
        by_default = both(call.by_default, (at == 0) if call.sure else None)
        yield _install(call, kind, texts[texts[:1] == ("PROGRAMS",) if kind == "python" else 1 :], by_default)


def _install(call: Call, kind: InstallKind, args: tuple[str, ...], by_default: bool | None) -> Install:
    groups = split(args, _INSTALL_WORDS)
    word = call.word if kind == "targets" else call.file
    return Install(
        kind=kind,
        items=tuple(word(value) for value in decided(groups[""])),
        destination=_below_prefix(decided_text(_destination(args)), call),
        line=call.line,
        conditions=call.conditions,
        by_default=by_default,
        words=tuple(word for word in args if word in _INSTALL_WORDS),
        renamed=call.word(first(groups, "RENAME") or ""),
    )


def _destination(args: tuple[str, ...]) -> str:
    """Return the folder of programs (RUNTIME) when it is told, else the first one, else that of the TYPE."""
    found = {args[i - 1]: args[i + 1] for i, arg in enumerate(args[:-1]) if arg == "DESTINATION"}
    kind = args[args.index("TYPE") + 1] if "TYPE" in args[:-1] else ""
    return found.get("RUNTIME") or next(iter(found.values()), known().install_types.get(kind, ""))


def _parted(rule: Install, call: Call, targets: Mapping[str, Target]) -> Iterator[Install]:
    """Programs go where RUNTIME says, shared libraries where LIBRARY does, others where ARCHIVE does."""
    words = call.texts
    told = {words[at - 1]: words[at + 1] for at, word in enumerate(words[:-1]) if word == "DESTINATION"}
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
