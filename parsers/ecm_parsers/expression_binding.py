"""Names that an expression binds: the variables of a loop, and the parameters of a `lambda`."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ecm_parsers.expression_limits import ExpressionError


@dataclass(frozen=True, slots=True, eq=False)
class Function:
    """A `lambda`; names that it does not bind are those of the expression that calls it.

    Attributes:
        node: as it is written. local: names of the loops around it. defaults: values of its last parameters.
    """

    node: ast.Lambda
    local: Mapping[str, Any]
    defaults: Sequence[Any]

    def names(self, args: Sequence[Any], keywords: Mapping[str, Any]) -> dict[str, Any]:
        """Return the names that its body has when it is called.

        Raises:
            ExpressionError: it does not take what it is given.
        """
        own = [entry.arg for entry in (*self.node.args.posonlyargs, *self.node.args.args)]
        defaults = zip(own[len(own) - len(self.defaults) :], self.defaults, strict=True)
        given = {**dict(defaults), **dict(zip(own, args, strict=False)), **keywords}
        more = self.node.args.vararg
        if given.keys() != set(own) or (len(args) > len(own) and more is None):
            msg = "A function of the expression is given other arguments than it takes. Correct it."
            raise ExpressionError(msg)
        rest = {} if more is None else {more.arg: tuple(args[len(own) :])}
        return {**self.local, **given, **rest}

    def __str__(self) -> str:
        """Return what stands for it where a text is asked for."""
        return "<function>"


def bound(target: ast.expr, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the names that a loop gives values to, for one item.

    Raises:
        ExpressionError: the target is no name and no row of names.
        ValueError: the item has another number of parts.
    """
    if isinstance(target, ast.Name):
        yield target.id, value
    elif isinstance(target, ast.Tuple | ast.List):
        yield from _unpacked(target.elts, list(value))
    else:
        msg = "A loop in an expression binds names only. Simplify it."
        raise ExpressionError(msg)


def _unpacked(targets: Sequence[ast.expr], values: list[Any]) -> Iterator[tuple[str, Any]]:
    stars = [at for at, each in enumerate(targets) if isinstance(each, ast.Starred)]
    if stars:
        first, last = stars[0], len(values) - (len(targets) - stars[0] - 1)
        values = [*values[:first], values[first:last], *values[last:]]
    for target, value in zip(targets, values, strict=True):
        yield from bound(target.value if isinstance(target, ast.Starred) else target, value)
