"""Profiles of QoS that somebody else changes: functions those of modules and namespaces, and other names elements."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.facts import Constant

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.outline import Outline
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import File
from ecm_extract.link.running.env import Env
from ecm_extract.resolve.cpp_constants import Stated

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_FIXED: Final = frozenset({"const", "constexpr"})
"""Traits of variables of C++ that nobody changes."""


class ChangedProfiles:
    """Tells whether profiles are changed behind their use."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def elsewhere(self, expr: Name | Member, variable: Constant, file: File, env: Env) -> bool:
        """Tell whether functions change a profile, or fields of it, that a module or a namespace has."""
        if file.language == "cpp":
            fixed = not _FIXED.isdisjoint(variable.traits) and not variable.type.endswith(("*", "&"))
            return not fixed and bool(self.folder.outside.changers(dotted_name(expr).replace(".", "::"), env.func))
        if self.folder.names.shared.is_changed(Stated(file, variable)):
            return True
        outlines = (self.folder.flow.outline(func) for func in self.folder.program.functions_in(file))
        return not variable.scope and any(_changes(each, variable.name) for each in outlines if not each.is_module)

    def by_other_name(self, element: Expr, env: Env) -> bool:
        """Tell whether a function of Python changes fields of what it took out of the table that an element is of."""
        outline = self.folder.flow.outline(env.func)
        root = outline.effects.root(element.callee if isinstance(element, Call) else element)
        fields = {key.rpartition(".")[0] for key in outline.changes if "." in key[1:]} if outline.python else set()
        named = (each for each in env.func.fact.body if fields.intersection(outline.bound_keys(each.target)))
        return any(
            outline.effects.key(one) == root
            for each in named
            for one in shared_names(each.value, outline.func.fact.body)
        )


def _changes(outline: Outline, name: str) -> bool:
    """Tell whether a function changes a variable of its module, or a field of one."""
    own = name in outline.effects.own and name not in outline.func.fact.shared
    return not own and any(f"{key}.".startswith(f"{name}.") for key in outline.changes)
