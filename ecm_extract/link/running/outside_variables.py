"""Variables of namespaces of C++ that one function alone changes, which programs run once: who changed them, and when.

Until that function changes such a variable it is as it was declared, and nobody that it calls changes it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Set
from functools import cached_property
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Name, Op

from ecm_extract.infer.places import whole_of
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.resolve.cpp_constants import Stated, is_defined

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class OutsideVariables:
    """Tells which functions change variables of namespaces; each variable is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._changers: dict[Stated, Set[Func] | None] = {}
        self._written: dict[Stated, Mapping[Func, str] | None] = {}

    def is_followed(self, name: str, func: Func) -> bool:
        """Tell whether nobody but one function that runs once changes a variable, and that is the function at hand."""
        own = self._meant(name, func)
        changers = self._of(own) if own is not None else None
        return changers is not None and (not changers or (changers == {func} and self.folder.runs_once.of(func)))

    def is_untouched(self, name: str, func: Func) -> bool:
        """Tell whether a name means a variable of a namespace that no function changes."""
        own = self._meant(name, func)
        return own is not None and self._of(own) == frozenset()

    def changers(self, name: str, func: Func) -> Mapping[Func, str]:
        """Return the functions that give a variable something, with its key there; none where not all are known."""
        own = self._meant(name, func)
        found = self._of(own) if own is not None else None
        written = self.written(own) if own is not None and found else None
        return (
            {each: written[each] for each in found} if found and written is not None and found <= set(written) else {}
        )

    def _meant(self, name: str, func: Func) -> Stated | None:
        if func.file.language != "cpp":
            return None
        return self.folder.objects.file_scope.meant(name, func)

    def _of(self, variable: Stated) -> Set[Func] | None:
        """The functions that may change a variable and may run; None where it is not known who does."""
        if variable not in self._changers:
            self._changers[variable] = None  # who asks in a circle
            self._changers[variable] = self._found(variable)
        return self._changers[variable]

    def _found(self, variable: Stated) -> Set[Func] | None:
        if variable.constant.name in self._referred:
            return None
        found: set[Func] = set()
        means = [entry for entry in self._mentions.get(variable.constant.name, ()) if self._may_mean(*entry, variable)]
        if any(_is_given_out(func, written) for func, written in means):
            return None
        for func, written in means:
            outline = self.folder.flow.outline(func)
            variable_there = outline.effects.key(Name(written))
            changed = any(key == variable_there or key.startswith(f"{variable_there}.") for key in outline.changes)
            found.update([func] if changed and not self.folder.runs_once.never(func) else [])
        watched = any(_is_given_out(func, written, const=True) for func, written in means)
        return None if found and watched else frozenset(found)

    def written(self, variable: Stated) -> Mapping[Func, str] | None:
        """Return the functions that name a variable, with its key there; None where it has other names as well."""
        if variable not in self._written:
            self._written[variable] = self._named(variable)
        return self._written[variable]

    def _named(self, variable: Stated) -> Mapping[Func, str] | None:
        means = [entry for entry in self._mentions.get(variable.constant.name, ()) if self._may_mean(*entry, variable)]
        if variable.constant.name in self._referred or any(_is_given_out(*entry, const=True) for entry in means):
            return None
        found = {func: self.folder.flow.effects(func).key(Name(written)) for func, written in means}
        return found if len(found) == len(means) else None

    def _is_hidden(self, func: Func, written: str) -> bool:
        """Whether a function, or one that it is declared in, has a variable of its own of that name."""
        around: Func | None = func
        while around is not None and written not in self.folder.flow.effects(around).own:
            around = self.folder.nesting.enclosing(around) if "lambda" in around.fact.traits else None
        return around is not None

    def _may_mean(self, func: Func, written: str, variable: Stated) -> bool:
        """Whether a name in a function may mean a variable: what is declared here may be defined in another file."""
        own = self._is_hidden(func, written)
        if own or self.folder.scope.member_type(written, func.cls):
            return False
        meant = self._meant(written, func)
        return meant is None or _may_be_one(meant, variable)

    @cached_property
    def _referred(self) -> Set[str]:
        """The last names of what other variables of namespaces are references to, or point to."""
        stated = (constant for group in self.folder.program.constants.values() for _, constant in group)
        referring = (entry for entry in stated if entry.type.endswith("&") or _is_address(entry.value))
        roots = (_root(entry.value) for entry in referring)
        return frozenset(root.rsplit("::", 1)[-1] for root in roots)

    @cached_property
    def _mentions(self) -> Mapping[str, Iterable[tuple[Func, str]]]:
        """Last name of a constant or variable -> the functions that mention it, and how they write it, in order."""
        found: dict[str, dict[tuple[Func, str], None]] = defaultdict(dict)
        program = self.folder.program
        for func in (func for group in program.functions.values() for func in group if func.file.language == "cpp"):
            for written in _names(func):
                last = written.rsplit("::", 1)[-1]
                if last in program.constants:
                    found[last][func, written] = None
        return found


def _names(func: Func) -> Iterator[str]:
    for statement in func.fact.body:
        yield from (expr.id for expr, _ in expressions(statement) if isinstance(expr, Name))


def _may_be_one(one: Stated, other: Stated) -> bool:
    """Whether two variables may be one that is declared twice: those defined twice are of two programs or files."""
    if is_defined(one.constant) and is_defined(other.constant):
        return one == other
    return one.constant.scope == other.constant.scope


def _is_given_out(func: Func, name: str, const: bool = False) -> bool:
    """Whether a function takes the address of a variable, refers to it by another name, or returns a reference.

    Args:
        func: the function.
        name: the variable, as the function writes it.
        const: whether a reference counts that changes nothing, but sees what others change.
    """
    for statement in func.fact.body:
        root = _root(statement.value)
        refers = statement.kind in {"let", "each"} and statement.type.endswith(("&", "*"))
        refers = refers and (const or "const" not in statement.type.split())
        returns = statement.kind == "return" and "reference" in func.fact.traits
        if root == name and (refers or returns):
            return True
        if any(_is_address(expr) and _root(expr) == name for expr, _ in expressions(statement)):
            return True
    return False


def _is_address(expr: Expr | None) -> bool:
    return isinstance(expr, Op) and expr.op == "&" and len(expr.operands) == 1


def _root(expr: Expr | None) -> str:
    """The variable that an expression is, or is a part of."""
    while expr is not None and not isinstance(expr, Name):
        expr = whole_of(expr)
    return expr.id if expr is not None else ""
