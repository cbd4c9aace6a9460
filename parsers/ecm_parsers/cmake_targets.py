"""CMake calls that build something: ordinary, ament, catkin, CUDA and pybind11 targets, tests, links."""

from __future__ import annotations

import re

import msgspec

from ecm_parsers.cmake_facts import Component, Target, TargetKind
from ecm_parsers.cmake_keywords import first, relative, split
from ecm_parsers.cmake_run import Call

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
)
_SKIPPED = frozenset({"IMPORTED", "ALIAS"})
_VISIBILITY = frozenset({"PUBLIC", "PRIVATE", "INTERFACE", "LINK_PUBLIC", "LINK_PRIVATE", "LINK_INTERFACE_LIBRARIES"})
_LINK_WORDS = _VISIBILITY | {"SYSTEM", "debug", "optimized", "general"}
_BUILDERS: dict[str, TargetKind] = {
    "add_executable": "executable",
    "cuda_add_executable": "executable",
    "ament_auto_add_executable": "executable",
    "rosbuild_add_executable": "executable",
    "add_library": "library",
    "cuda_add_library": "library",
    "ament_auto_add_library": "library",
    "rosbuild_add_library": "library",
    "pybind11_add_module": "library",
    "python3_add_library": "library",
    "nanobind_add_module": "library",
}
_SOURCE_WORDS = _VISIBILITY | {"FILE_SET", "BASE_DIRS", "FILES", "HEADERS", "TYPE"}
_LINKERS = frozenset({"target_link_libraries", "ament_target_dependencies", "ament_auto_target_link_libraries"})
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


def targets(calls: tuple[Call, ...]) -> tuple[Target, ...]:
    """Return the targets that the calls build, in order, with their links and later sources."""
    found: dict[str, Target] = {}
    links: dict[str, list[str]] = {}
    sources: dict[str, list[str]] = {}
    outputs: dict[str, str] = {}
    for call in calls:
        target = _built(call)
        if target is not None:
            found.setdefault(target.name, target)
        elif call.name in _LINKERS and call.args:
            links.setdefault(call.args[0], []).extend(_without(call.args[1:], _LINK_WORDS))
        elif call.name == "target_sources" and call.args:
            sources.setdefault(call.args[0], []).extend(_sources(_without(call.args[1:], _SOURCE_WORDS)))
        elif call.name == "set_target_properties":
            outputs.update(_outputs(call.args))
    return tuple(
        msgspec.structs.replace(
            target,
            links=tuple(dict.fromkeys(links.get(name, ()))),
            sources=tuple(dict.fromkeys((*target.sources, *sources.get(name, ())))),
            output=outputs.get(name, ""),
        )
        for name, target in found.items()
    )


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


def _built(call: Call) -> Target | None:
    """Return the target that a call makes, if it makes one."""
    if not call.args:
        return None
    kind = _BUILDERS.get(call.name)
    if kind is not None:
        return _ordinary(call, kind)
    return _test(call) if _TEST.fullmatch(call.name) else None


def _ordinary(call: Call, kind: TargetKind) -> Target | None:
    rest = call.args[1:]
    if _SKIPPED & set(rest):
        return None
    if kind == "library" and "INTERFACE" in rest[:1]:
        kind = "interface"
    sources = _auto_sources(rest) if call.name.startswith("ament_auto_") else list(rest)
    return Target(call.args[0], kind, call.line, _sources(sources), (), call.is_test)


def _auto_sources(args: tuple[str, ...]) -> list[str]:
    """`ament_auto_add_*` takes all sources of the folders after DIRECTORY."""
    groups = split(args, frozenset({"DIRECTORY"}))
    return groups[""] + [f"{relative(folder).rstrip('/')}/*" for folder in groups.get("DIRECTORY", [])]


def _test(call: Call) -> Target | None:
    """Return a test program; calls that only run an existing target or a launch file make none."""
    groups = split(call.args, _TEST_KEYWORDS)
    name = (groups[""] or groups.get("NAME") or [""])[0]
    sources = [value for value in groups[""][1:] if _SOURCE.fullmatch(value)]
    return Target(name, "test", call.line, _sources(sources), (), True) if sources else None


def _sources(values: list[str]) -> tuple[str, ...]:
    """Return source paths, without the words and generator expressions among them."""
    kept = (value for value in values if value not in _LIBRARY_WORDS and not value.startswith("$<"))
    return tuple(dict.fromkeys(relative(value) for value in kept))


def _without(values: tuple[str, ...], words: frozenset[str]) -> list[str]:
    return [value for value in values if value not in words]
