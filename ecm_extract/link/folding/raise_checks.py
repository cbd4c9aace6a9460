"""When operations of the standard libraries raise: each check by the name that infer/raising.toml gives it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op

from ecm_extract.infer.compute import NULL, UNKNOWN, is_number
from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.walk import children
from ecm_extract.link.running.env import Bound, Env, invocation_of
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TABLE, _LIST, _TEXT = 0, 1, 2
_WHOLE: Final = re.compile(r"\s*[+-]?[0-9]")
_NUMBER: Final = re.compile(r"\s*[+-]?([0-9]|\.[0-9]|inf|nan)", re.IGNORECASE)
MAX_DIGITS: Final = 9
"""Digits of a number that every type of C++ holds."""


class Asked(NamedTuple):
    """An operation, and where it stands."""

    folder: Folder
    expr: Expr
    env: Env

    @property
    def args(self) -> tuple[Expr, ...]:
        """What it is called with, the index of a subscript, the right side of an operator."""
        if isinstance(self.expr, Call):
            return self.expr.args
        return self.expr.operands[1:] if isinstance(self.expr, Op) else ()

    @property
    def base(self) -> Expr | None:
        """What it is called on, or takes an element of."""
        if isinstance(self.expr, Call):
            return invocation_of(self.expr, self.env).receiver or _receiver(self.expr)
        if isinstance(self.expr, Op):
            return self.expr.operands[0]
        return self.expr.base if isinstance(self.expr, Member) else None

    @property
    def python(self) -> bool:
        """Whether it is Python's."""
        return self.env.func.file.language == "python"

    def data(self, expr: Expr | None) -> list[Any]:
        """Return the data that an expression may be; nothing where any of it is not proved."""
        values = self.folder.fold(expr, self.env)
        found = [data_in(value) if is_proved(value) else UNKNOWN for value in values]
        return [] if UNKNOWN in found else found

    def items(self, expr: Expr | None) -> list[Bound] | None:
        """Return the elements of a list; None where not all are known."""
        return self.folder.lists.items(expr, self.env)


class Checked(NamedTuple):
    """Whether an operation raises, None where that is open; whether it is one of a table, a list or a text."""

    raises: bool | None
    form: int = _TABLE


def _all(found: Iterable[bool]) -> bool | None:
    listed = set(found)
    return listed.pop() if len(listed) == 1 else None


def _always(_: Asked) -> Checked:
    return Checked(True)


def _absent(asked: Asked) -> Checked:
    """A key that a table lacks, an index beyond a list or a text."""
    if len(asked.args) != 1:
        return Checked(None)
    entries = asked.folder.tables.entries(asked.base, asked.env)
    if entries is not None:
        return Checked(_lacks(asked, [entry.key for entry in entries]), _TABLE)
    at = asked.data(asked.args[0])
    if not at or not all(isinstance(index, int) for index in at):
        return Checked(None)
    items = asked.items(asked.base)
    if items is not None:
        return Checked(_all(_is_beyond(index, len(items), asked.python) for index in at), _LIST)
    texts = asked.data(asked.base)
    known = bool(texts) and all(isinstance(text, str) for text in texts)
    verdict = _all(_is_beyond(index, len(text), asked.python) for index in at for text in texts) if known else None
    return Checked(verdict, _TEXT)


def _is_beyond(index: int, length: int, python: bool) -> bool:
    return not (-length if python else 0) <= index < length


def _lacks(asked: Asked, keys: Sequence[Bound]) -> bool | None:
    """Whether a table has none of its keys alike; reading one by `[]` in C++ gives a table that key."""
    alike = {_alike(asked, key) for key in keys}
    if True in alike:
        return False
    return None if None in alike or (not asked.python and _may_be_made(asked)) else True


def _alike(asked: Asked, key: Bound) -> bool | None:
    flow = asked.folder.flow
    return flow.alike(asked.args[0], Name("#key"), flow.naming(asked.env, {"#key": key}))


def _may_be_made(asked: Asked) -> bool:
    """Whether the function at hand reads the same table by `[]`."""
    effects = asked.folder.flow.effects(asked.env.func)
    root = effects.key(asked.base)
    return any(
        effects.key(each.operands[0]) == root
        for statement in asked.env.func.fact.body
        for each in _subscripts(statement.value)
    )


def _subscripts(expr: Expr | None) -> Iterable[Op]:
    if isinstance(expr, Op) and expr.op == "[]" and expr.operands:
        yield expr
    for part in children(expr) if expr is not None else ():
        yield from _subscripts(part)


def _no_number(asked: Asked) -> Checked:
    """A text that does not read as a number."""
    if len(asked.args) != 1:
        return Checked(None)
    data = asked.data(asked.args[0])
    if not data:
        return Checked(None)
    verdicts = [_refuses(asked.expr, each) if asked.python else _refuses_cpp(_NUMBER, each) for each in data]
    return Checked(None if None in verdicts else _all(verdict for verdict in verdicts if verdict is not None))


def _refuses(call: Expr, data: Any) -> bool | None:
    if is_number(data) or isinstance(data, bool):
        return False
    if not isinstance(data, str):
        return None
    whole = isinstance(call, Call) and call.callee == Name("int")
    try:
        (int if whole else float)(data)
    except ValueError:
        return True
    return False


def _refuses_cpp(pattern: re.Pattern[str], data: Any) -> bool | None:
    if not isinstance(data, str) or sum(map(str.isdigit, data)) > MAX_DIGITS:
        return None
    return pattern.match(data) is None


def _no_whole_number(asked: Asked) -> Checked:
    data = asked.data(asked.args[0]) if len(asked.args) == 1 else []
    verdicts = [_refuses_cpp(_WHOLE, each) for each in data]
    return Checked(_all(verdict for verdict in verdicts if verdict is not None) if None not in verdicts else None)


def _exhausted(asked: Asked) -> Checked:
    """`next` of what has no elements; what has some may have given all of them already."""
    if len(asked.args) != 1:
        return Checked(None)
    arg = asked.args[0]
    made = isinstance(arg, Call) and arg.callee == Name("iter") and len(arg.args) == 1
    items = asked.items(arg.args[0] if made and isinstance(arg, Call) else arg)
    return Checked(True) if items == [] else Checked(None)


def _popped(asked: Asked) -> Checked:
    if not asked.args:
        return _empty(asked)
    return _absent(asked) if len(asked.args) == 1 else Checked(None)


def _empty(asked: Asked) -> Checked:
    if asked.folder.tables.entries(asked.base, asked.env) == []:
        return Checked(True, _TABLE)
    items = asked.items(asked.base)
    return Checked(None if items is None else not items, _LIST)


def _missing(asked: Asked) -> Checked:
    """An element that a list lacks, a text that another does not hold."""
    if len(asked.args) != 1:
        return Checked(None)
    items = asked.items(asked.base)
    if items is not None:
        alike = {_alike(asked, item) for item in items}
        return Checked(False if True in alike else None if None in alike else True, _LIST)
    texts, parts = asked.data(asked.base), asked.data(asked.args[0])
    known = texts and parts and all(isinstance(each, str) for each in (*texts, *parts))
    return Checked(_all(part not in text for text in texts for part in parts) if known else None, _TEXT)


def _beyond(asked: Asked) -> Checked:
    texts, starts = asked.data(asked.base), asked.data(asked.args[0]) if asked.args else []
    known = texts and starts and all(isinstance(text, str) for text in texts)
    if not known or not all(isinstance(start, int) for start in starts):
        return Checked(None)
    return Checked(_all(start > len(text.encode()) for text in texts for start in starts))


def _no_value(asked: Asked) -> Checked:
    holds = asked.folder.optionals.holds(asked.base, asked.env) if asked.base is not None and not asked.args else None
    return Checked(None if holds is None else not holds)


def _zero(asked: Asked) -> Checked:
    left, right = asked.data(asked.base), asked.data(asked.args[0])
    if not right or not all(map(is_number, (*left, *right))):
        return Checked(None)
    return Checked(_all(each == 0 for each in right) if left else None)


def _nothing(asked: Asked) -> Checked:
    data = asked.data(asked.base)
    return Checked(True if data and all(each is NULL for each in data) else None)


def _unlike(asked: Asked) -> Checked:
    """More or fewer elements than there are names."""
    target = asked.env.func.fact.body[asked.env.at].target
    items = asked.items(asked.expr)
    if items is None or not isinstance(target, Items):
        return Checked(None)
    if any(unstarred(item) is not item for item in target.items):
        return Checked(len(items) < len(target.items) - 1, _LIST)
    return Checked(len(items) != len(target.items), _LIST)


def _receiver(call: Call) -> Expr | None:
    return call.callee.base if isinstance(call.callee, Member) else None


CHECKS: Final[Mapping[str, Callable[[Asked], Checked]]] = MappingProxyType(
    {
        "always": _always,
        "absent": _absent,
        "no_number": _no_number,
        "no_whole_number": _no_whole_number,
        "exhausted": _exhausted,
        "popped": _popped,
        "empty": _empty,
        "missing": _missing,
        "beyond": _beyond,
        "no_value": _no_value,
        "zero": _zero,
        "nothing": _nothing,
        "unlike": _unlike,
    }
)
