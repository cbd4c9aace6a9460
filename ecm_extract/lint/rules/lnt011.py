"""LNT011: Python uses a name that its file, or the module of the workspace that it is of, does not bind."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from pathlib import PurePosixPath

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.python_names import loose_names

from ecm_extract.entities.python_names import MODULE, NAME
from ecm_extract.lint.known import Asked, Known
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
_SHOWN = 5
_AT_USE = "Python stops with ImportError or AttributeError at each of these lines"
_NO_NAME = "Python stops with NameError when it gets there"
Users = dict[str, list[Asked]]
"""What is required in vain, by the name that is."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report names that a file uses and binds nowhere: a slip inside of one file."""
    for file in workspace.linker.program.files:
        facts = workspace.by_name.get(file.package)
        if file.language != "python" or facts is None or file.path.endswith("conf.py"):
            continue  # Sphinx gives its conf.py names
        if _is_generated(PurePosixPath(file.path), facts):
            continue
        for name, line in workspace.files.parsed(file.path, loose_names) or ():
            text = f"{file.path} uses {name}, which nothing in it defines or imports"
            entity = Entity("function", name)
            place = [Evidence(file.path, line)]
            yield RULE.finding(text, entity, file.package, place, certainty="likely", consequence=_NO_NAME)


def _is_generated(path: PurePosixPath, facts: PackageFacts) -> bool:
    """Tell whether genpy has made a file of an interface of its package: `msg/_State.py` of `msg/State.msg`."""
    name = f"{path.parent.name}/{path.stem.removeprefix('_')}.{path.parent.name}"
    return path.stem.startswith("_") and any(f"/{each}".endswith(f"/{name}") for each in facts.interfaces)


def tell(known: Known) -> Iterator[Finding]:
    """Report imports from, and attributes of, modules whose every name is known, and modules that are not there."""
    absent: Users = defaultdict(list)
    for asked in known.asked("imports_module"):
        if asked.match.state == "dangling":
            absent[f"{asked.requirement.owner}.{asked.requirement.name}"].append(asked)
    modules = [name for package in known.packages.by_name for name in known.names(package, MODULE)]
    yield from (_absent(name, found, modules) for name, found in absent.items())
    lost: dict[str, Users] = defaultdict(lambda: defaultdict(list))
    for asked in known.asked("takes_name"):
        if asked.match.state == "dangling":
            lost[asked.requirement.owner][asked.requirement.name].append(asked)
    yield from (_unbound(module, lost[module], known) for module in sorted(lost))


def _absent(module: str, users: list[Asked], modules: list[str]) -> Finding:
    last = module.rpartition(".")[2]
    near = next((name for name in sorted(modules) if name.rpartition(".")[2] == last), "")
    text = f"there is no module {module}" + (f"; there is {near}" if near else "")
    return RULE.finding(text, Entity("function", module, near), users[0].consumer.name, _places(users))


def _unbound(module: str, lost: Users, known: Known) -> Finding:
    """One finding for all that is asked of a module in vain: the module is the cause, its users are listed."""
    users = [each for found in lost.values() for each in found]
    first = next(iter(lost))
    bound = known.members(users[0].requirement.package or "", module, NAME)
    near = nearest(first, bound) if len(lost) == 1 else None
    shown = ", ".join(list(lost)[:_SHOWN]) + (f" and {len(lost) - _SHOWN} more" if len(lost) > _SHOWN else "")
    text = f"module {module} binds no {shown}" + (f"; it binds {near}" if near else "")
    entity = Entity("function", f"{module}.{first}", near or "")
    return RULE.finding(text, entity, users[0].consumer.name, _places(users), consequence=_AT_USE)


def _places(users: list[Asked]) -> list[Evidence]:
    return list(dict.fromkeys(place for each in users for place in each.requirement.evidence))
