"""Calls whose result can be taken only once now: a shared future that became a plain one.

Source: `std::future::get` leaves the future without a state; of a `std::shared_future` it may be called again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Call, Member, Name

from ecm_extract.diff.model import Located
from ecm_extract.entities.side import Workspace
from ecm_extract.link.units import Func
from ecm_extract.link.walk import expressions
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_FUTURE: Final = re.compile(r"future", re.IGNORECASE)
_SHARED: Final = re.compile(r"shared", re.IGNORECASE)


def result_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines of C++ that take such a result once more."""
    changes = {located.pair.old.name: located for located in index.of_kind("method") if located.pair.old is not None}
    changes = {name: located for name, located in changes.items() if _no_longer_shared(located)}
    if not changes:
        return
    for functions in workspace.program.functions.values():
        for func in functions:
            if func.file.language == "cpp":
                yield from _of(func, changes)


def _no_longer_shared(located: Located) -> bool:
    """Whether a form keeps its parameters and gives a future that is no longer shared."""
    old, new = located.pair.old, located.pair.new
    if old is None or new is None:
        return False
    before = {form.types: form.returns for form in old.forms}
    return any(_is_shared(before.get(form.types, "")) and _is_single(form.returns) for form in new.forms)


def _is_shared(written: str) -> bool:
    return _FUTURE.search(written) is not None and _SHARED.search(written) is not None


def _is_single(written: str) -> bool:
    return _FUTURE.search(written) is not None and _SHARED.search(written) is None


def _of(func: Func, changes: dict[str, Located]) -> Iterator[Use]:
    held: dict[str, Located] = {}
    for statement in func.fact.body:
        value = statement.value
        if statement.kind == "let" and isinstance(statement.target, Name) and isinstance(value, Call):
            callee = value.callee
            if isinstance(callee, Member) and callee.name in changes and len(value.args) == 1:
                held[statement.target.id] = changes[callee.name]
    for name, located in held.items():
        lines = [line for statement in func.fact.body for expr, line in expressions(statement) if _takes(expr, name)]
        if len(lines) > 1:
            place = Place(func.file.package, func.file.path, lines[1])
            called = located.change.old
            yield use_at(located, place, f"takes the result of {called} again with {name}.get()", "likely")


def _takes(expr: object, name: str) -> bool:
    callee = expr.callee if isinstance(expr, Call) else None
    return isinstance(callee, Member) and callee.name == "get" and callee.base == Name(name)
