"""The base class that a plugin is exported for, in its macro and in its description."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from ecm_checker.contract import Evidence
from ecm_parsers.plugin_xml import PluginClass

from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

_ORDER = {"PLUGINLIB_EXPORT_CLASS": (0, 1), "PLUGINLIB_REGISTER_CLASS": (1, 2), "PLUGINLIB_DECLARE_CLASS": (2, 3)}
"""Which arguments of a macro are the class and its base."""

_NAME = re.compile(r"[\w:]+")


class Mismatch(msgspec.Struct, frozen=True):
    """A described class whose macro exports it for another base, with the place of the macro."""

    entry: PluginClass
    path: str
    base: str
    place: Evidence


def mismatches(workspace: Workspace) -> Iterator[tuple[PackageFacts, Mismatch]]:
    """Yield the first class of each pair of bases that a description and the macros of its package name."""
    aliases = {alias.name for file in workspace.linker.program.files for alias in file.facts.aliases}
    for package in workspace.packages:
        exported = {name: (base, place) for name, base, place in _exported(workspace, package)}
        seen = set()
        for path, classes in package.plugins.items():
            for entry in classes:
                base, place = exported.get(_joined(entry.type), ("", None))
                pair = (path, entry.base_class_type, base)
                if place and pair not in seen and differ(entry.base_class_type, base) and not _of(base) & aliases:
                    seen.add(pair)
                    yield package, Mismatch(entry, path, base, place)


def differ(first: str, second: str) -> bool:
    """Tell whether two types have other names: a namespace may be left out, and a plain name may be an alias."""
    ours, theirs = _NAME.findall(_joined(first)), _NAME.findall(_joined(second))
    return bool(ours) and len(ours) == len(theirs) and not all(map(_agree, ours, theirs))


def _exported(workspace: Workspace, package: PackageFacts) -> Iterator[tuple[str, str, Evidence]]:
    """(class, base, place) of the export macros of pluginlib in a package."""
    for file in workspace.linker.program.files:
        for macro in file.facts.macros if file.package == package.name else ():
            at = _ORDER.get(macro.name)
            if at is not None and len(macro.args) == at[1] + 1:
                yield _joined(macro.args[at[0]]), _joined(macro.args[at[1]]), Evidence(file.path, macro.line)


def _of(base: str) -> set[str]:
    return {name.rpartition("::")[2] for name in _NAME.findall(base)}


def _agree(first: str, second: str) -> bool:
    longer, shorter = sorted((first.strip(":"), second.strip(":")), key=len, reverse=True)
    return longer == shorter or longer.endswith(f"::{shorter}")


def _joined(text: str) -> str:
    return "".join(text.split())
