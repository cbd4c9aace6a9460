"""Operators: concatenation, conditionals, formats, subscripts, arithmetic, comparisons."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Name, Op, Text

from ecm_extract.infer.compute import NULL, UNKNOWN, formatted, operate, streamed
from ecm_extract.link.folding import formats
from ecm_extract.link.folding.buffers import cut
from ecm_extract.link.folding.held_formats import with_text
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import (
    MAX_ALTERNATIVES,
    Hole,
    Value,
    alternatives,
    constant,
    demoted,
    joined,
    literal,
    lowered,
    unknown,
)

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_AS_TEXT: Final = frozenset({"", "%s", "!s"})
"""Formats that give a text as it is: `{}`, `%s`, `{!s}`."""


class OperatorFolder:
    """Folds what an operator makes of its operands."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def op(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """Concatenation, conditionals, formats, subscripts, arithmetic, comparisons."""
        inner = env.before(env.at)
        work = _OPERATORS.get(expr.op)
        if work is not None:
            return work(self, expr, inner)
        if len(expr.operands) == 2:
            return self._binary(expr, inner)
        return (unknown("value"),)

    def _sum(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """Texts side by side, or a sum; in C++ a stream writes what is added to it."""
        if self.folder.streams.overwrites(expr, env):
            return (unknown("value"),)
        if self.folder.streams.writes(expr, env):
            return self.folder.streams.written(expr, env)
        groups = [self.folder.fold(operand, env) for operand in expr.operands]
        if len(groups) == 1:
            return groups[0]
        if len(groups) == 2 and any(value.data is not None for group in groups for value in group):
            return self._added(groups, env)
        if env.func.file.language == "cpp" and len(groups) > 2:
            groups = [self.folder.streams.values(operand, env) for operand in expr.operands]
        return joined(self._written(group, env) for group in groups)

    def _added(self, groups: list[tuple[Value, ...]], env: Env) -> tuple[Value, ...]:
        python = env.func.file.language == "python"
        if not python and any(value.data is None and _has_text(value) for group in groups for value in group):
            return (unknown("value"),)  # a number that is added to a text moves where it begins, or is a character
        pairs = list(product(*groups))
        if not python or len(pairs) > MAX_ALTERNATIVES:
            return self._computed(groups, python)
        made = [self._pair(*pair) for pair in pairs if not any(value.data is NULL for value in pair)]
        return alternatives(value for values in made for value in values) or (unknown("value"),)

    def _pair(self, left: Value, right: Value) -> tuple[Value, ...]:
        """One value and another: a text stands beside whatever is no number. Who adds `None` to anything raises."""
        is_text = any(_has_text(value) or not value.parts for value in (left, right))
        are_texts = is_text and left.data is None and right.data is None
        return joined([(left,), (right,)]) if are_texts else self._computed([(left,), (right,)], python=True)

    def _computed(self, groups: list[tuple[Value, ...]], python: bool) -> tuple[Value, ...]:
        return self.folder.combined(groups, lambda data: operate("+", data[0], data[1], python), "value")

    def _written(self, values: tuple[Value, ...], env: Env) -> tuple[Value, ...]:
        if env.func.file.language == "python":
            return self.folder.shown(values, env)
        return tuple([_streamed(value) for value in values])

    def _conditional(self, expr: Op, env: Env) -> tuple[Value, ...]:
        holds, likely = self.folder.flow.truths.verdict(expr.operands[0], env)
        if holds is not None:
            return demoted(self.folder.fold(expr.operands[1 if holds else 2], env))
        if likely is not None:
            return lowered(self.folder.fold(expr.operands[1 if likely else 2], env), "default")
        return alternatives(value for operand in expr.operands[1:] for value in self.folder.fold(operand, env))

    def _percent(self, expr: Op, env: Env) -> tuple[Value, ...]:
        text, operand, *room = expr.operands
        text = with_text(text, env, self.folder) if env.func.file.language == "python" else text
        if not isinstance(text, Text):
            return self._binary(expr, env)
        found = joined(self.folder.calls.folded_parts(formats.percent(text.value, operand), env))
        return cut(found, self.folder.fold(room[0], env)) if room else found

    def _either(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """`a or b` in Python is one of the two; in C++ it is a truth value."""
        if env.func.file.language != "python":
            holds = self.folder.flow.truth(expr, env)
            return (unknown("value"),) if holds is None else (constant(holds),)
        found: list[Value] = []
        for operand in expr.operands:
            found += self.folder.fold(operand, env)
            holds = self.folder.flow.truth(operand, env)
            if holds is not None and holds is (expr.op == "||"):
                break
            if holds is not None:
                found = [] if operand is not expr.operands[-1] else found
        return alternatives(found) or (unknown("value"),)

    def _negated(self, expr: Op, env: Env) -> tuple[Value, ...]:
        if expr.op == "!":
            holds = self.folder.flow.truth(expr, env)
            return (unknown("value"),) if holds is None else (constant(holds)._replace(confidence="folded"),)
        return self.folder.combined(
            [self.folder.fold(expr.operands[0], env)], lambda data: operate("-", 0, data[0], True), "value"
        )

    def _minus(self, expr: Op, env: Env) -> tuple[Value, ...]:
        return self._negated(expr, env) if len(expr.operands) == 1 else self._binary(expr, env)

    def _subscript(self, expr: Op, env: Env) -> tuple[Value, ...]:
        return self.folder.lists.elements(expr.operands[0], env, expr.operands[1])

    def _address(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """What a pointer points to; behind one to a character stands the rest of its text."""
        if len(expr.operands) > 1:
            return (unknown("value"),)
        pointed = expr.operands[0]
        found = self.folder.fold(pointed, env)
        of_text = (
            isinstance(pointed, Op) and pointed.op == "[]" and self.folder.lists.items(pointed.operands[0], env) is None
        )
        return (unknown("value"),) if of_text and any(_has_text(value) for value in found) else found

    def _formatted(self, expr: Op, env: Env) -> tuple[Value, ...]:
        spec = expr.operands[1]
        text = spec.value if isinstance(spec, Text) else "?"
        python = env.func.file.language == "python"
        values = self.folder.fold(expr.operands[0], env)
        if text in _AS_TEXT and all(value.data is None for value in values):
            return values
        return self.folder.combined([values], lambda data: formatted(data[0], text, python), _name_of(values))

    def _binary(self, expr: Op, env: Env) -> tuple[Value, ...]:
        python = env.func.file.language == "python"
        if expr.op in {"in", "not in"}:
            return self._within(expr, env)
        searched = None if python else self.folder.searches.compared(expr, env)
        if searched is not None:
            return searched
        groups = [self.folder.fold(operand, env) for operand in expr.operands]
        joins = expr.op == "/" and any(_has_text(value) and value.data is None for value in groups[0])
        if joins:  # paths
            return joined([groups[0], (literal("/"),), groups[1]])
        return self.folder.combined(groups, lambda data: operate(expr.op, data[0], data[1], python), "value")

    def _within(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """`x in names`: every element is known, or nothing is told."""
        items = self.folder.lists.in_any_order(expr.operands[1], env)
        if items is None:
            groups = [self.folder.fold(operand, env) for operand in expr.operands]
            return self.folder.combined(groups, lambda data: operate(expr.op, data[0], data[1], True), "value")
        found = [
            self.folder.flow.alike(expr.operands[0], Name("#item"), self.folder.flow.naming(env, {"#item": item}))
            for item in items
        ]
        if None in found and True not in found:
            return (unknown("value"),)
        return (constant((True in found) is (expr.op == "in"))._replace(confidence="folded"),)


def _streamed(value: Value) -> Value:
    if value.data is None:
        return value
    text = streamed(value.data)
    return unknown("value") if text is UNKNOWN else value._replace(parts=(text,), data=None)


def _has_text(value: Value) -> bool:
    return any(isinstance(part, str) for part in value.parts)


def _name_of(values: Sequence[Value]) -> str:
    """What a value that is not known is called."""
    parts = values[0].parts if values else ()
    return next((part.label for part in parts if isinstance(part, Hole)), "value")


_Work = Callable[[OperatorFolder, Op, Env], tuple[Value, ...]]
_OPERATORS: Final[Mapping[str, _Work]] = MappingProxyType(
    {
        "+": OperatorFolder._sum,
        "?:": OperatorFolder._conditional,
        "%": OperatorFolder._percent,
        "||": OperatorFolder._either,
        "&&": OperatorFolder._either,
        "!": OperatorFolder._negated,
        "-": OperatorFolder._minus,
        "[]": OperatorFolder._subscript,
        "format": OperatorFolder._formatted,
        "&": OperatorFolder._address,
    }
)
