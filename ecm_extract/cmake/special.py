"""Commands that do more than set variables: files that are run, packages that are found, projects, errors."""

from __future__ import annotations

import posixpath
from collections.abc import Callable
from typing import Final

import msgspec
from ecm_parsers.cmake_blocks import Step, nest
from ecm_parsers.cmake_tokens import Argument, Command, parse_commands

from ecm_extract.cmake import policies
from ecm_extract.cmake.assigned import assigned
from ecm_extract.cmake.files import absolute, placed, tree_path
from ecm_extract.cmake.finding import found_packages
from ecm_extract.cmake.known import known
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.manifests import manifest_of, project_of
from ecm_extract.cmake.run import Place, Run
from ecm_extract.cmake.state import either
from ecm_extract.cmake.values import BINARY, SOURCE, Value, is_known, unknown, written

_STOPS: Final = frozenset({"FATAL_ERROR", "SEND_ERROR"})
_LIST_NAMES: Final = ("CMAKE_CURRENT_LIST_FILE", "CMAKE_CURRENT_LIST_DIR")
_Special = Callable[[Run, Command, tuple[str, ...], Place], bool]


def run_file(run: Run, path: str, place: Place) -> bool:
    """Run a file of the tree; `return` ends it."""
    steps = _read(run, path)
    if steps is None:
        run.open(place, 1, f"{path} cannot be read")
        return True
    outer = {name: run.state.variables.get(name) for name in _LIST_NAMES}
    run.set("CMAKE_CURRENT_LIST_FILE", placed(path))
    run.set("CMAKE_CURRENT_LIST_DIR", placed(posixpath.dirname(path)))
    inside = Place(path, 0, place.depth + 1)
    goes_on = run.bounded(frozenset({"return"}), lambda: run.steps(steps, inside))
    for name, value in outer.items():
        if value is not None:
            run.state.assign(name, value)
    return goes_on


def _read(run: Run, path: str) -> tuple[Step, ...] | None:
    data = run.files.read(path)
    if data is None:
        return None
    parsed = parse_commands(data)
    diagnostics = list(parsed.diagnostics)
    steps = nest(parsed.facts, diagnostics)
    run.outside.assign(assigned(parsed.facts))
    if path not in run.found.paths:
        run.found.paths[path] = None
        for diagnostic in diagnostics:
            run.report(path, diagnostic)
    return steps


def _include(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    name = args[0] if args else ""
    module = known().modules.get(name)
    if module is not None:
        _know(run, module)
        return True
    path = _included(run, name)
    _tell_found(run, args, path)
    if path is not None:
        return _with_own_policies(run, path, args, place)
    if not _is_nowhere(run, name):
        run.brought.find([name])
    if "OPTIONAL" not in args and ("/" in name or "." in name or not is_known(name)):
        run.open(place, command.line, f"include of {written(name)}")
    return True


def _with_own_policies(run: Run, path: str, args: tuple[str, ...], place: Place) -> bool:
    """Run an included file; what it does to policies ends with it, unless it has no scope of them."""
    before = policies.held(run.state.variables)
    goes_on = run_file(run, path, place)
    if "NO_POLICY_SCOPE" not in args:
        policies.put_back(run.state, before)
    return goes_on


def _tell_found(run: Run, args: tuple[str, ...], path: str | None) -> None:
    """`include(name RESULT_VARIABLE found)`: the path, or that there is none."""
    for name in args[args.index("RESULT_VARIABLE") + 1 :][:1] if "RESULT_VARIABLE" in args else ():
        missing = "NOTFOUND" if _is_nowhere(run, args[0]) else unknown(name)
        run.set(name, missing if path is None else placed(path))


def _is_nowhere(run: Run, name: str) -> bool:
    """Tell whether a file that is asked for by its path would lie in the tree and does not."""
    path = tree_path(absolute(name, run.folder())) if "/" in name and is_known(name) else None
    return path is not None and not run.files.has(path) and not run.files.is_absent(path)


def _included(run: Run, name: str) -> str | None:
    """Path of an included module or file, in this order; None of one that is not in the tree."""
    folders = items(run.look().get("CMAKE_MODULE_PATH") or "") if "/" not in name else []
    wanted = [f"{absolute(folder, run.folder())}/{name}.cmake" for folder in folders]
    paths = [tree_path(each) for each in (*wanted, absolute(name, run.folder()))]
    return next((path for path in paths if path is not None and run.files.has(path)), None)


def _guard(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del command, args
    if place.path in run.guarded:
        run.state.leave("return")
        return False
    run.guarded.add(place.path)
    return True


def _subdirectory(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    folder = tree_path(absolute(args[0], run.folder())) if args else None
    path = f"{folder}/CMakeLists.txt"
    if not folder or not run.files.has(path):
        run.open(place, command.line, f"add_subdirectory of {written(args[0]) if args else 'nothing'}")
        return True
    run.state.enter({})
    run.set("CMAKE_CURRENT_SOURCE_DIR", placed(folder))
    run.set("CMAKE_CURRENT_BINARY_DIR", f"{BINARY}/{folder}")
    goes_on = run_file(run, path, place)
    run.state.end()
    return goes_on


def _find_package(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del command, place
    run.outside.add(args)
    run.brought.find(found_packages(args))
    for name in args:
        _know(run, known().packages.get(name, {}))
    if "REQUIRED" in args and is_known(args[0]):
        run.set(f"{args[0]}_FOUND", "1")  # without it there is no build
    return True


def _pkg_config(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del command, place
    run.outside.add(args[:1])
    run.brought.find(args[:1])
    return True


def _know(run: Run, table: dict[str, str]) -> None:
    project = run.look().get("PROJECT_NAME") or unknown("PROJECT_NAME")
    for variable, text in table.items():
        run.set(variable, text.format(project=project))


def _told_by_manifest(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del place
    manifest = manifest_of(run.files, run.folder())
    for name, what in known().from_manifest[command.name].items():
        run.set(name.format(*args, ""), getattr(manifest, what, None) or unknown(what))
    return True


def _project(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del command, place
    if not args:
        return True
    name = args[0] if is_known(args[0]) else project_of(run.files, run.folder()) or args[0]
    version = args[args.index("VERSION") + 1] if "VERSION" in args[:-1] else ""
    parts = [*version.split("."), "", "", ""]
    look = run.look()
    told = {"NAME": name, "VERSION": version}
    told |= {"SOURCE_DIR": look.get("CMAKE_CURRENT_SOURCE_DIR") or SOURCE}
    told |= {"BINARY_DIR": look.get("CMAKE_CURRENT_BINARY_DIR") or BINARY}
    told |= {"VERSION_MAJOR": parts[0], "VERSION_MINOR": parts[1], "VERSION_PATCH": parts[2]}
    for what, text in told.items():
        run.set(f"PROJECT_{what}", text)
        run.set(f"{name}_{what}", text)
    if run.state.depth == 1:
        run.set("CMAKE_PROJECT_NAME", name)
    return True


def _require(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del command, place
    version = "".join(args[args.index("VERSION") + 1 :][:1]) if "VERSION" in args else ""
    for change in policies.of_version(version):
        run.state.assign(change.name, Value((change.text,)))
    run.minimum = tuple(int(part) for part in version.partition("...")[0].split(".") if part.isdigit())
    return True


def _message(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    """An error ends the configuration, so no build goes on from it.

    Where every build comes to it, something is missing that a build has, such as a submodule: what follows is read.
    """
    if not _STOPS & set(args[:1]):
        return True
    if run.state.path.conditions:
        return False
    run.open(place, command.line, "an error that ends the configuration")
    return True


def _target(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del command, place
    if args and is_known(args[0]):
        run.targets[args[0]] = either(run.targets.get(args[0], False), run.state.path.by_default)
    return True


def _language(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    """`cmake_language(CALL name args...)` and `(EVAL CODE text...)`; other forms run what only the build has."""
    if args[:1] == ("CALL",) and len(args) > 1:
        words = tuple(Argument(text, command.line, "bracket") for text in args[2:])
        return run.handlers.command(run, Command(args[1].lower(), words, command.line), place)
    if args[:2] == ("EVAL", "CODE") and all(map(is_known, args)):
        return _code(run, " ".join(args[2:]), msgspec.structs.replace(place, caller_line=command.line))
    run.open(place, command.line, "cmake_language")
    return True


def _code(run: Run, text: str, place: Place) -> bool:
    """Run a text as if it stood in the file."""
    parsed = parse_commands(text.encode())
    return run.steps(nest(parsed.facts, list(parsed.diagnostics)), place.deeper())


def _fetched(run: Run, command: Command, args: tuple[str, ...], place: Place) -> bool:
    del args
    run.open(place, command.line, command.name)
    return True


SPECIAL: Final[dict[str, _Special]] = {
    **dict.fromkeys(known().from_manifest, _told_by_manifest),
    "add_executable": _target,
    "add_library": _target,
    "add_subdirectory": _subdirectory,
    "ament_auto_find_build_dependencies": _find_package,
    "cmake_language": _language,
    "cmake_minimum_required": _require,
    "externalproject_add": _fetched,
    "fetchcontent_makeavailable": _fetched,
    "fetchcontent_populate": _fetched,
    "find_package": _find_package,
    "include": _include,
    "include_guard": _guard,
    "message": _message,
    "pkg_check_modules": _pkg_config,
    "pkg_search_module": _pkg_config,
    "project": _project,
}
