"""CMake calls that build something: ordinary, ament, catkin, CUDA and pybind11 targets, tests, links."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import msgspec
from ecm_parsers.cmake_facts import Component, Target, TargetKind

from ecm_extract.cmake.auto_package import auto_sources
from ecm_extract.cmake.calls import Call, is_of_build
from ecm_extract.cmake.files import BuildFiles, absolute
from ecm_extract.cmake.genex import decided, has_genex, objects_used, without_objects
from ecm_extract.cmake.include_folders import include_folders
from ecm_extract.cmake.keywords import first, split
from ecm_extract.cmake.lists import all_items
from ecm_extract.cmake.state import both, either
from ecm_extract.cmake.values import is_known

_LIBRARY_WORDS = frozenset(
    {
        "SHARED",
        "STATIC",
        "MODULE",
        "OBJECT",
        "INTERFACE",
        "UNKNOWN",
        "EXCLUDE_FROM_ALL",
        "WIN32",
        "MACOSX_BUNDLE",
    }
    | {"NO_TARGET_LINK_LIBRARIES", "THIN_LTO", "NO_EXTRAS", "OPT_SIZE", "LTO"}
    | {"NO_AUTO_LINK", "NO_AUTO_DEP", "NO_AUTO_EXPORT"}
)
_STATIC = frozenset({"STATIC", "OBJECT", "INTERFACE"})
_SKIPPED = frozenset({"IMPORTED", "ALIAS"})
_VISIBILITY = frozenset({"PUBLIC", "PRIVATE", "INTERFACE", "LINK_PUBLIC", "LINK_PRIVATE", "LINK_INTERFACE_LIBRARIES"})
_FOR_USERS = frozenset({"INTERFACE", "LINK_INTERFACE_LIBRARIES"})
_LINK_WORDS = _VISIBILITY | {"SYSTEM", "debug", "optimized", "general"}
_BUILDERS: dict[str, TargetKind] = {
    "add_executable": "executable",
    "cuda_add_executable": "executable",
    "ament_auto_add_executable": "executable",
    "rosbuild_add_executable": "executable",
    "cs_add_executable": "executable",
    "add_library": "library",
    "cuda_add_library": "library",
    "ament_auto_add_library": "library",
    "rosbuild_add_library": "library",
    "cs_add_library": "library",
    "pybind11_add_module": "library",
    "python3_add_library": "library",
    "nanobind_add_module": "library",
}
_SOURCE_WORDS = frozenset({"FILE_SET", "BASE_DIRS", "FILES", "HEADERS", "TYPE"})
_LINKERS = frozenset({"target_link_libraries", "ament_target_dependencies", "ament_auto_target_link_libraries"})
_GROWING = _LINKERS | {"target_sources", "target_include_directories"}
_TEST = re.compile(r"\w*add_(\w*_)?(gtest|gmock|rostest|nosetests|pytest|test|google_benchmark)\w*")
_TEST_KEYWORDS = frozenset(
    {
        "TIMEOUT",
        "ENV",
        "APPEND_ENV",
        "APPEND_LIBRARY_DIRS",
        "WORKING_DIRECTORY",
        "SKIP_TEST",
        "SKIP_LINKING_MAIN",
    }
    | {
        "SKIP_LINKING_MAIN_LIBRARIES",
        "TEST_NAME",
        "DEPENDENCIES",
        "RUNNER",
        "PYTHON_EXECUTABLE",
        "NAME",
        "COMMAND",
    }
    | {"GENERATE_RESULT_FOR_RETURN_CODE_ZERO", "OUTPUT_FILE", "RESULT_FILE", "ARGS", "LABELS"}
)
_SOURCE = re.compile(r".*\.(c|cc|cpp|cxx|cu|py|test|launch|xml)")
_COMPONENT_WORDS = frozenset(
    {"PLUGIN", "EXECUTABLE", "EXECUTOR", "NODE_PLUGIN", "RESOURCE_INDEX", "NO_UNDEFINED_SYMBOLS"}
)


_REGISTRARS = frozenset({"rclcpp_components_register_node", "rclcpp_components_register_nodes"})


def targets(calls: Sequence[Call], files: BuildFiles) -> dict[str, tuple[Target, ...]]:
    """Return the targets that the calls build, in order, with their links and later sources, by file."""
    found: dict[str, _Growing] = {}
    for call in calls:
        for target in _built(call, files):
            _add(found, target, call)
        for name in _grown(call):
            if name in found:
                _grow(found[name], call)
    for call in calls:
        if call.name == "include_directories":
            _look_in(call, found.values())
    hand_on(found)
    by_path: dict[str, list[Target]] = {}
    for growing in found.values():
        by_path.setdefault(growing.call.path, []).append(growing.target())
    return {path: tuple(made) for path, made in by_path.items()}


def _grown(call: Call) -> tuple[str, ...]:
    """Names of the targets that a call says more of."""
    if call.name == "set_target_properties" and "PROPERTIES" in call.args:
        return call.args[: call.args.index("PROPERTIES")]
    if call.name == "set_property" and call.args[:1] == ("TARGET",) and "SOURCES" in call.args:
        return call.args[1:]
    return call.args[:1] if call.name in _GROWING else ()


def _look_in(call: Call, made: Iterable[_Growing]) -> None:
    """The folders of a whole folder of the build, and those below it."""
    for target in made:
        folder = target.call.folder
        if not call.folder or folder == call.folder or folder.startswith(f"{call.folder}/"):
            target.include_folders += include_folders(call.texts, call, target.call.path)


@dataclass
class _Growing:
    """A target whose sources and links may still be added; `given` are sources for those that use it."""

    first: Target
    call: Call
    sources: _Sources
    links: list[str] = field(default_factory=list)
    uses: list[str] = field(default_factory=list)
    given: list[str] = field(default_factory=list)
    output: str = ""
    include_folders: list[str] = field(default_factory=list)

    def target(self) -> Target:
        """Return what all calls together say."""
        return msgspec.structs.replace(
            self.first,
            links=tuple(dict.fromkeys((*self.first.links, *self.links))),
            sources=tuple(self.sources.every),
            optional=tuple(path for path in self.sources.every if path not in self.sources.default),
            is_open=self.sources.is_open,
            output=self.output,
            include_folders=tuple(dict.fromkeys(self.include_folders)),
        )


@dataclass
class _Sources:
    """Sources of a target: all that it may have, those of a build without settings, and whether others may be."""

    every: dict[str, None] = field(default_factory=dict)
    default: set[str] = field(default_factory=set)
    is_open: bool = False

    def add(self, paths: tuple[str, ...], by_default: bool | None) -> None:
        """Add sources that builds have, those without settings if `by_default`."""
        self.every.update(dict.fromkeys(paths))
        self.is_open |= by_default is None or any("$" in path and not is_of_build(path) for path in paths)
        if by_default:
            self.default.update(paths)


def _add(found: dict[str, _Growing], target: Target, call: Call) -> None:
    """A target that is made in several places is one; builds have it where any of these makes it."""
    known = found.get(target.name)
    if known is None or (known.first.by_default is not True and target.by_default is True):
        sources = _Sources() if known is None else _Sources(dict(known.sources.every))
        found[target.name] = known = _Growing(target, call, sources)
        known.sources.add(target.sources, True)
        known.sources.is_open |= target.is_open
    elif known.first.by_default is not True:
        both_ways = either(known.first.by_default, target.by_default)
        known.first = msgspec.structs.replace(known.first, by_default=both_ways)
        known.sources.add(target.sources, None)
    else:
        known.sources.add(target.sources, False if target.by_default is False else None)


def _grow(target: _Growing, call: Call) -> None:
    if call.name in _LINKERS:
        target.links += _without(call.args[1:], _LINK_WORDS)
        groups = split(call.args[1:], _VISIBILITY)
        target.uses += [name for word, names in groups.items() if word not in _FOR_USERS for name in names]
    elif call.name == "target_sources":
        for at, texts in enumerate((call.texts, *call.others)):
            by_default = both(call.by_default, (at == 0) if call.sure else None)
            # Before 3.13 a path is relative to the folder of the target, not of the call (CMP0076).
            folder = call.folder if call.is_relative_here else target.call.folder
            place = msgspec.structs.replace(call, folder=folder, path=target.call.path)
            given = all_items(_added(texts[1:]))
            target.links += objects_used(given)
            target.given += [absolute(text, folder) for text in _for_users(texts[1:])]
            items = decided(without_objects(given))
            added = _sources(items, place)
            relative = by_default if target.first.by_default else True if by_default is not None else None
            target.sources.add(added, relative)
            target.sources.is_open |= any(map(_is_open, items))
    elif call.name == "set_property":
        sources = all_items(split(call.texts, frozenset({"SOURCES"}))["SOURCES"])
        target.sources.add(_sources(decided(sources), call), call.by_default)
        target.sources.is_open |= any(map(_is_open, sources)) or "APPEND" not in call.args
    elif call.name == "target_include_directories":
        target.include_folders += include_folders(call.texts[1:], call, target.call.path)
    elif call.name == "set_target_properties":
        target.output = _outputs(call.args).get(target.first.name, target.output)


def _added(texts: tuple[str, ...]) -> list[str]:
    """Sources that `target_sources` gives the target itself: those after INTERFACE are for who links it."""
    groups = split(texts, _VISIBILITY | _SOURCE_WORDS)
    return [text for word in ("", "PUBLIC", "PRIVATE", "FILES") for text in groups.get(word, [])]


def _for_users(texts: tuple[str, ...]) -> list[str]:
    """Sources that `target_sources` gives to those that link the target."""
    groups = split(texts, _VISIBILITY | _SOURCE_WORDS)
    return [text for word in ("PUBLIC", "INTERFACE") for text in groups.get(word, [])]


def hand_on(found: dict[str, _Growing]) -> None:
    """Give the sources of a linked target to who links it; through several targets they are not followed."""
    for target in found.values():
        linked = [found[name] for name in target.uses if name in found]
        texts = [text for each in linked for text in each.given]
        target.sources.add(_sources(decided(texts), target.call), True)
        behind = [name for each in linked for name in each.links if name in found and found[name].given]
        target.sources.is_open |= bool(behind) or any(map(_is_open, decided(texts)))


def makes_target(command: str) -> bool:
    """Tell whether a command is one of those that are known to make a target."""
    return command in _BUILDERS or _TEST.fullmatch(command) is not None


def _outputs(args: tuple[str, ...]) -> dict[str, str]:
    """`set_target_properties(a b PROPERTIES OUTPUT_NAME c)` -> c of a and b."""
    if "PROPERTIES" not in args:
        return {}
    at = args.index("PROPERTIES")
    pairs = dict(zip(args[at + 1 :: 2], args[at + 2 :: 2], strict=False))
    return dict.fromkeys(args[:at], pairs["OUTPUT_NAME"]) if "OUTPUT_NAME" in pairs else {}


def components(calls: tuple[Call, ...]) -> tuple[Component, ...]:
    """Return the rclcpp components that the calls register."""
    found: list[Component] = []
    for call in calls:
        if not call.args or call.name not in _REGISTRARS:
            continue
        groups = split(call.args[1:], _COMPONENT_WORDS)
        names = groups[""] if call.name.endswith("nodes") else groups.get("PLUGIN", [])[:1]
        executable = first(groups, "EXECUTABLE")
        found.extend(Component(name, call.args[0], call.line, executable) for name in names)
    return tuple(found)


def _built(call: Call, files: BuildFiles) -> Iterator[Target]:
    """Yield the targets that a call makes: one, or one for each of the arguments that builds may have."""
    kind = _BUILDERS.get(call.name)
    is_test = kind is None and _TEST.fullmatch(call.name) is not None
    for at, texts in enumerate((call.texts, *call.others) if kind is not None or is_test else ()):
        by_default = both(call.by_default, (at == 0) if call.sure else None)
        target = None
        if texts:
            target = _ordinary(call, texts, kind, files) if kind is not None else _test(call, texts)
        if target is not None:
            yield msgspec.structs.replace(target, by_default=by_default)


def _ordinary(call: Call, texts: tuple[str, ...], kind: TargetKind, files: BuildFiles) -> Target | None:
    rest = texts[1:]
    if _SKIPPED & set(rest):
        return None
    if kind == "library" and "INTERFACE" in rest[:1]:
        kind = "interface"
    sources = auto_sources(rest, call, files) if call.name.startswith("ament_auto_") else list(rest)
    return _target(call, texts[0], kind, sources)


def _target(call: Call, name: str, kind: TargetKind, given: list[str]) -> Target:
    given = all_items(given)
    sources = decided(without_objects(given))
    return Target(
        name=call.word(name),
        kind=kind,
        line=call.line,
        sources=_sources(sources, call),
        is_test=kind == "test" or call.is_test,
        conditions=call.conditions,
        is_shared=_is_shared(call) if kind == "library" else False,
        is_objects=kind == "library" and "OBJECT" in call.args[1:2],
        is_open=any(map(_is_open, sources)),
        links=tuple(objects_used(given)),
    )


def _is_open(text: str) -> bool:
    """Tell whether a source is one that only a build knows."""
    return has_genex(text) or not is_known(text)


def _is_shared(call: Call) -> bool | None:
    words = set(call.texts[1:])
    if words & _STATIC:
        return False
    return True if words & {"SHARED", "MODULE"} else call.makes_shared


def _test(call: Call, texts: tuple[str, ...]) -> Target | None:
    """Return a test program; calls that only run an existing target or a launch file make none."""
    groups = split(texts, _TEST_KEYWORDS)
    name = (groups[""] or groups.get("NAME") or [""])[0]
    sources = [value for value in groups[""][1:] if _SOURCE.fullmatch(value)]
    return _target(call, name, "test", sources) if sources else None


def _sources(values: list[str], call: Call) -> tuple[str, ...]:
    """Return source paths, without the words and generator expressions among them."""
    kept = (value for value in values if value not in _LIBRARY_WORDS and value and not has_genex(value))
    return tuple(dict.fromkeys(call.file(value) for value in kept))


def _without(values: tuple[str, ...], words: frozenset[str]) -> list[str]:
    return [value for value in values if value not in words]
