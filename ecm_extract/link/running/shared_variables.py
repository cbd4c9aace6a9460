"""Variables of Python that others reach by a name with a dot or by an import: who changes them from anywhere."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name
from ecm_parsers.source.python_dataclasses import is_unchangeable

from ecm_extract.infer.effects import is_plain, is_within
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.decorators import is_of_class
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.resolve.cpp_constants import Stated

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_NAMES: Final = 6
"""Variables that one object has, each given by the next: `state = low.output.state`."""


class SharedVariables:
    """Tells whether a variable of a module, or of a class, is changed by somebody who does not stand in its own body.

    Who changes something of the same name behind a dot is taken to change it: whose it is need not be known.
    """

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Stated, bool] = {}
        self._naming: dict[str, list[Func]] | None = None

    def is_changed(self, stated: Stated) -> bool:
        """Tell whether anybody but the functions of its own module may change a variable."""
        known = self._known.get(stated)
        if known is None:
            known = self._known[stated] = self._is_built(stated) or self._by_others(stated)
        return known

    def _by_others(self, stated: Stated) -> bool:
        changed = any(self._changes(func, stated) for func in self._by_name().get(stated.constant.name, ()))
        return changed or self._is_kept(stated) or self._is_of_class(stated)

    def _is_built(self, stated: Stated) -> bool:
        """Whether the body of its class changes a variable again after it gave it its value."""
        for func in self._by_name().get(stated.constant.name, ()) if stated.constant.scope else ():
            own = _defined(func, stated)
            if own and self.folder.flow.outline(func).changes.get(own, 0) > 1:
                return True
        return False

    def _is_of_class(self, stated: Stated) -> bool:
        """Whether somebody changes an attribute of that name of a class, which he may have by another name."""
        name, scope = stated.constant.name, stated.constant.scope
        of_file = self.folder.program.classes_in(stated.file) if scope else ()
        owner = next((each for each in of_file if each.qualified == scope), None)
        return owner is not None and self.folder.begun_objects.attributes.may_change(name, owner, owner)

    def _is_kept(self, stated: Stated) -> bool:
        """Whether somebody keeps a list, a table or an object by another name, by which it is changed."""
        constant = stated.constant
        for kept in self.folder.kept_parts.of(constant.name) if not self._stays(stated) else ():
            func, key, root = kept.func, kept.key, kept.key.rpartition(".")[0]
            if self._leads_to(root, func, stated) if root or constant.scope else self._means(key, func, stated):
                return True
        return False

    def _changes(self, func: Func, stated: Stated) -> bool:
        name, outline = stated.constant.name, self.folder.flow.outline(func)
        changed = outline.given if self._stays(stated) else outline.changes  # who gets a text leaves it
        own = _defined(func, stated)
        others = [key for key in changed if not own or not is_within(key, own)]
        roots = [root for key in others for root in _before(name, key)]
        if any(self._leads_to(root, func, stated) for root in roots) or _gives_its_class(func, stated):
            return True
        is_local = name in outline.effects.own and func.fact.name != "<module>" and name not in func.fact.shared
        changes = any(key == name or key.startswith(f"{name}.") for key in changed)
        return changes and not is_local and self._means(name, func, stated)

    def _leads_to(self, root: str, func: Func, stated: Stated) -> bool:
        """Whether what stands before the dot may have the variable: its module, its class, or an object of that."""
        constant = stated.constant
        if not constant.scope:
            return self._means(f"{root}.{constant.name}", func, stated)
        cls = self.folder.program.class_named(root, func.file, func.scope) if root else None
        if cls is not None:
            return self._has(cls, stated)
        named = root.rpartition(".")[2] in {last_name(constant.scope), "cls", "__class__"}
        named = named or (not root and is_of_class(func))
        return named or not self._stays(stated)

    def _has(self, cls: Cls, stated: Stated) -> bool:
        """Whether a class has a variable of its own or of the nearest base that has one of its name."""
        lineage = self.folder.program.ancestry(cls)
        owner = next((each for each in lineage if stated.constant.name in each.fields), None)
        return owner is None or (owner.qualified == stated.constant.scope and owner.file is stated.file)

    def _stays(self, stated: Stated) -> bool:
        """Whether nobody can change what a variable is, but only give it something else: a text, a named tuple."""
        meant: Stated | None = stated
        for _ in range(MAX_NAMES):
            value = meant.constant.value if meant is not None else None
            if meant is None or is_plain(value):
                return meant is not None
            if isinstance(value, Call):
                return self._makes_unchangeable(value, meant)
            named = dotted_name(value) if isinstance(value, Name | Member) else ""
            meant = self.folder.program.constant_named(named, meant.file) if named else None
        return False

    def _makes_unchangeable(self, made: Call, stated: Stated) -> bool:
        program = self.folder.program
        cls = program.class_named(dotted_name(made.callee), stated.file, stated.constant.scope)
        lineage = program.ancestry(cls) if cls is not None else ()
        return bool(lineage) and all(is_unchangeable(each.fact, each.file.facts.imports) for each in lineage)

    def _means(self, dotted: str, func: Func, stated: Stated) -> bool:
        """Whether a name means the variable in a file that imports it, or its module."""
        imports = dotted.partition(".")[0] in func.file.imported
        return imports and self.folder.program.constant_named(dotted, func.file) == stated

    def _by_name(self) -> dict[str, list[Func]]:
        """The functions of Python by the names in their bodies."""
        if self._naming is None:
            self._naming = {}
            program = self.folder.program
            files = (file for file in program.files if file.language == "python")
            for func in (func for file in files for func in program.functions_in(file)):
                for name in self.folder.shifting.names(func):
                    self._naming.setdefault(name, []).append(func)
        return self._naming


def _before(name: str, key: str) -> Iterator[str]:
    """Yield what stands before a name behind a dot: of a variable, or of a field of it."""
    parts = key.split(".")
    return (".".join(parts[:at]) for at, part in enumerate(parts) if at and part == name)


def _gives_its_class(func: Func, stated: Stated) -> bool:
    """Tell whether a function gives the class of its object something of that name: `type(self).topic = "x"`."""
    targets = (entry.target for entry in func.fact.body if entry.kind == "set")
    named = (each.base for each in targets if isinstance(each, Member) and each.name == stated.constant.name)
    return bool(stated.constant.scope) and Call(Name("type"), (THIS,)) in map(_without_place, named)


def _without_place(expr: Expr) -> Expr:
    return Call(expr.callee, expr.args) if isinstance(expr, Call) else expr


def _defined(func: Func, stated: Stated) -> str:
    """The variable of a class as the body of its module names it that gives it its value; empty in other bodies."""
    constant = stated.constant
    lines = (each for each in func.fact.body if each.line == constant.line and func.file is stated.file)
    named = (each.target for each in lines if each.value == constant.value and isinstance(each.target, Member))
    return next((dotted_name(target) for target in named if target.name == constant.name), "")
