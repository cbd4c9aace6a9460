"""LNT011: Python uses a name that its file, or the module of the workspace that it is of, does not bind."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.cmake_facts import Command
from ecm_parsers.source.expr import Expr, Member, Name
from ecm_parsers.source.python_names import loose_names

from ecm_extract.link.units import File
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT011",
    name="python_name_unbound",
    dimension="versioning",
    severity="error",
    who="source",
    consequence="Python stops with ModuleNotFoundError when it gets there",
    resolution="use the name that is bound, import it, or restore it",
)
MAX_DEPTH = 30
_SHOWN = 5
_AT_USE = "Python stops with ImportError or AttributeError at each of these lines"
_NO_NAME = "Python stops with NameError when it gets there"
_GENERATED = frozenset({"msg", "srv", "action", "cfg"})
_BUILDS_MODULES = re.compile(r"pybind|python_add_module|swig|sip_|boost_python|generate_parameter", re.IGNORECASE)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report imports from, and attributes of, Python modules whose every name is known, and names of no module.

    Not asked of the engine: names that modules bind privately are no provisions of a package yet.
    """
    yield from _loose(workspace)
    names = _names(workspace)
    modules = _modules(workspace, names)
    yield from _missing_modules(workspace, modules, names)
    users: dict[tuple[str, str], list[Evidence]] = {}
    owners: dict[tuple[str, str], str] = {}
    for file in workspace.linker.program.files:
        if file.language != "python":
            continue
        for module, name, line in _used(file, modules):
            if name not in modules[module]:
                users.setdefault((module, name), []).append(Evidence(file.path, line))
                owners.setdefault((module, name), file.package)
    for module in sorted({module for module, _ in users}):
        lost = {name: places for (owner, name), places in users.items() if owner == module}
        yield _unbound(module, lost, modules[module], owners[module, next(iter(lost))])


def _unbound(module: str, lost: dict[str, list[Evidence]], bound: set[str], package: str) -> Finding:
    """One finding for all that is asked of a module in vain: the module is the cause, its users are listed."""
    first = next(iter(lost))
    near = nearest(first, bound) if len(lost) == 1 else None
    places = list(dict.fromkeys(place for each in lost.values() for place in each))
    shown = ", ".join(list(lost)[:_SHOWN]) + (f" and {len(lost) - _SHOWN} more" if len(lost) > _SHOWN else "")
    text = f"module {module} binds no {shown}" + (f"; it binds {near}" if near else "")
    entity = Entity("function", f"{module}.{first}", near or "")
    return RULE.finding(text, entity, package, places, certainty="proved", consequence=_AT_USE)


def _loose(workspace: Workspace) -> Iterator[Finding]:
    """Names that a file uses and binds nowhere."""
    for file in workspace.linker.program.files:
        if file.language != "python" or file.package not in workspace.by_name or file.path.endswith("conf.py"):
            continue  # Sphinx gives its conf.py names
        for name, line in workspace.files.parsed(file.path, loose_names) or ():
            text = f"{file.path} uses {name}, which nothing in it defines or imports"
            entity = Entity("function", name)
            place = [Evidence(file.path, line)]
            yield RULE.finding(text, entity, file.package, place, certainty="likely", consequence=_NO_NAME)


def _names(workspace: Workspace) -> set[str]:
    """Every importable module of the workspace."""
    files = [file for file in workspace.linker.program.files if file.language == "python"]
    return {name for file in files if (name := _module_name(file, workspace)) is not None}


def _modules(workspace: Workspace, names: set[str]) -> dict[str, set[str]]:
    """Return the names that each importable module of the workspace binds; open modules are left out."""
    files = [file for file in workspace.linker.program.files if file.language == "python"]
    found: dict[str, set[str]] = {}
    for file in files:
        module = _module_name(file, workspace)
        if module is None or any(entry.name == "*" for entry in file.facts.imports) or _is_dynamic(file):
            continue
        found[module] = _bound(file)
    for package in workspace.packages:  # and what CMake compiles into it
        if package.name in found:
            found[package.name] |= _compiled(package)
    for module in names:  # a package binds its modules
        parent, _, last = module.rpartition(".")
        if parent in found:
            found[parent].add(last)
    return found


def _missing_modules(workspace: Workspace, modules: dict[str, set[str]], names: set[str]) -> Iterator[Finding]:
    """Imports of modules that a Python package of the workspace does not hold; what a build makes is left out."""
    users: dict[str, list[tuple[File, int]]] = {}
    for file in workspace.linker.program.files:
        for entry in file.facts.imports if file.language == "python" else ():
            parent, _, last = entry.module.rpartition(".")
            if parent not in modules or last in modules[parent] | _GENERATED or entry.module in names:
                continue
            if not _is_compiled(parent.partition(".")[0], workspace):
                users.setdefault(entry.module, []).append((file, entry.line))
    for module, found in users.items():
        last = module.rpartition(".")[2]
        near = next((name for name in sorted(names) if name.rpartition(".")[2] == last), None)
        text = f"there is no module {module}" + (f"; there is {near}" if near else "")
        places = list(dict.fromkeys(Evidence(file.path, line) for file, line in found))
        yield RULE.finding(text, Entity("function", module, near or ""), found[0][0].package, places)


def _compiled(package: PackageFacts) -> set[str]:
    """Names of the libraries that a package builds: one of them may be an extension module."""
    targets = [target for file in package.cmake.values() for target in file.targets if target.kind == "library"]
    return {target.output or target.name for target in targets}


def _is_compiled(name: str, workspace: Workspace) -> bool:
    """Tell whether the build of a package may add modules to it."""
    package = workspace.by_name.get(name)
    files = package.cmake.values() if package is not None else ()
    return any(_is_of_modules(command) for file in files for command in file.commands)


def _is_of_modules(command: Command) -> bool:
    """Tell whether a command makes what Python imports, or looks for a library that does."""
    return "MODULE" in command.args or any(_BUILDS_MODULES.search(word) for word in (command.name, *command.args))


def _module_name(file: File, workspace: Workspace) -> str | None:
    """`pkg/src/pkg/a.py` and `pkg/pkg/a.py` are module `pkg.a`."""
    parts = file.path.removesuffix(".py").split("/")
    if not file.path.endswith(".py") or file.package not in workspace.by_name:
        return None
    root = workspace.by_name[file.package].root.path
    inside = file.path.removeprefix(f"{root}/").removesuffix(".py").split("/") if root else parts
    inside = inside[1:] if inside[:1] == ["src"] else inside
    if inside[:1] != [file.package]:
        return None
    return ".".join(inside[:-1] if inside[-1] == "__init__" else inside)


def _is_dynamic(file: File) -> bool:
    """A module with `__getattr__`, or that writes into `globals()`, binds what it likes."""
    names = {function.name for function in file.facts.functions}
    texts = (statement.value for function in file.facts.functions for statement in function.body)
    return "__getattr__" in names or any("globals" in _called(text) or "setattr" in _called(text) for text in texts)


def _called(expr: Expr | None) -> str:
    callee = getattr(expr, "callee", None)
    return callee.id if isinstance(callee, Name) else ""


def _bound(file: File) -> set[str]:
    facts = file.facts
    bound = {entry.name for entry in facts.functions if not entry.scope} | {entry.name for entry in facts.classes}
    bound |= {entry.name for entry in facts.constants} | {entry.name for entry in facts.aliases}
    for entry in facts.imports:
        bound.add(entry.alias or entry.name or entry.module.split(".")[0])
    for function in facts.functions:
        if function.name == "<module>":
            for statement in function.body:
                bound |= set(_targets(statement.target))
    return bound | {"__name__", "__file__", "__doc__", "__path__", "__version__", "__all__", "__author__"}


def _targets(target: Expr | None) -> Iterator[str]:
    if isinstance(target, Name):
        yield target.id
    for item in getattr(target, "items", ()):
        yield from _targets(item)


def _used(file: File, modules: dict[str, set[str]]) -> Iterator[tuple[str, str, int]]:
    aliases = {}
    for entry in file.facts.imports:
        full = f"{entry.module}.{entry.name}" if entry.name else entry.module
        if entry.name and entry.module in modules and full not in modules and entry.name != "*":
            yield entry.module, entry.name, entry.line
        if full in modules and (entry.alias or entry.name):
            aliases[entry.alias or entry.name] = full
    for function in file.facts.functions:
        for statement in function.body:
            for name, attribute in _attributes(statement.value):
                if name in aliases and not _is_rebound(name, file):
                    yield aliases[name], attribute, statement.line


def _is_rebound(name: str, file: File) -> bool:
    return any(
        name in _targets(statement.target) or any(parameter.name == name for parameter in function.params)
        for function in file.facts.functions
        for statement in function.body
    )


def _attributes(expr: object, depth: int = 0) -> Iterator[tuple[str, str]]:
    if isinstance(expr, Member) and isinstance(expr.base, Name):
        yield expr.base.id, expr.name
    if depth > MAX_DEPTH:
        return
    for name in getattr(expr, "__struct_fields__", ()):
        value = getattr(expr, name)
        for item in value if isinstance(value, tuple) else (value,):
            if isinstance(item, tuple):
                for part in item:
                    yield from _attributes(part, depth + 1)
            else:
                yield from _attributes(item, depth + 1)
