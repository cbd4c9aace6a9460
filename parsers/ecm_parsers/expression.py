"""The Python expressions of xacro `${...}` and launch `$(eval ...)`, evaluated over a small whitelist; nothing is run.

Sources: wiki.ros.org/xacro "Math expressions", wiki.ros.org/roslaunch/XML "eval", `launch.substitutions`.
"""

from __future__ import annotations

import ast
import math
import operator
import warnings
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.expression_limits import (
    MAX_SIZE,
    TOO_LARGE,
    Budget,
    ExpressionError,
    UnknownNameError,
    bounded_range,
    check_growth,
    check_repetition,
    check_scalar,
    formatted,
    power,
    size_of,
)
from ecm_parsers.expression_set import KINDS, Members, is_of

MAX_LENGTH = 5_000
MAX_STEPS = 5_000

_BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.FloorDiv: operator.floordiv,
        ast.Mod: operator.mod,
    }
)
_UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = MappingProxyType(
    {ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: operator.not_}
)
_COMPARE: Mapping[type[ast.cmpop], Callable[[Any, Any], bool]] = MappingProxyType(
    {
        ast.Eq: operator.eq,
        ast.NotEq: operator.ne,
        ast.Lt: operator.lt,
        ast.LtE: operator.le,
        ast.Gt: operator.gt,
        ast.GtE: operator.ge,
        ast.In: lambda item, items: item in items,
        ast.NotIn: lambda item, items: item not in items,
        ast.Is: operator.is_,
        ast.IsNot: operator.is_not,
    }
)
_FUNCTIONS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        **{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt")},
        **{name: getattr(math, name) for name in ("radians", "degrees", "floor", "ceil", "fabs", "exp", "log")},
        **{name: getattr(math, name) for name in ("log10", "hypot", "fmod", "isnan", "isinf", "copysign", "trunc")},
        "pow": lambda base, exponent: power(base, exponent),
        "abs": abs,
        "int": int,
        "float": float,
        "str": str,
        "bool": bool,
        "len": len,
        "min": min,
        "max": max,
        "round": lambda number, digits=0: round(number, digits) if abs(digits) < 30 else number,
        "sum": sum,
        "sorted": sorted,
        "list": list,
        "tuple": tuple,
        "set": Members,
        "isinstance": is_of,
        "dict": dict,
        "any": any,
        "all": all,
        "range": lambda *bounds: bounded_range(*bounds),
        "zip": lambda *items: list(zip(*items, strict=False)),
        "enumerate": lambda items: list(enumerate(items)),
    }
)
_CONSTANTS: Mapping[str, Any] = MappingProxyType(
    {"pi": math.pi, "e": math.e, "inf": math.inf, "nan": math.nan, "true": True, "false": False}
)
_METHODS: Mapping[type, frozenset[str]] = MappingProxyType(
    {
        str: frozenset(
            {"lower", "upper", "strip", "lstrip", "rstrip", "split", "join", "startswith", "endswith", "replace"}
            | {"title", "capitalize", "isdigit", "find", "count", "format"}
        ),
        dict: frozenset({"get", "keys", "values", "items"}),
        list: frozenset({"index", "count"}),
        tuple: frozenset({"index", "count"}),
    }
)
_MODULES = frozenset({"math", "xacro", "python", "np", "numpy"})


def evaluate(
    text: str,
    names: Mapping[str, Any],
    budget: Budget | None = None,
    functions: Mapping[str, Callable[..., Any]] = _FUNCTIONS,
) -> Any:
    """Evaluate an expression.

    Args:
        text: Python, at most `MAX_LENGTH` characters.
        names: values by name; a name may be dotted (`ns.property`).
        budget: that this expression shares with others; of its own when not given.
        functions: that may be called by name, beside those of all expressions; they raise `ExpressionError`.

    Returns:
        Text, number, truth value, None, list, tuple or dict.

    Raises:
        UnknownNameError: a name has no value.
        ExpressionError: no expression of the whitelist, too large, or wrong (division by zero, types).
    """
    if len(text) > MAX_LENGTH:
        msg = f"The expression is longer than {MAX_LENGTH} characters. Shorten it."
        raise ExpressionError(msg)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text.strip(), mode="eval")
        return _Evaluator(names, budget or Budget(), functions).value(tree.body)
    except ExpressionError:
        raise
    except (SyntaxError, ValueError, TypeError, ArithmeticError, LookupError, AttributeError) as error:
        msg = f"`{text.strip()[:80]}` cannot be evaluated: {error}. Correct it."
        raise ExpressionError(msg) from error
    except (RecursionError, MemoryError) as error:
        msg = "The expression nests too deeply. Split it."
        raise ExpressionError(msg) from error


class _Evaluator:
    """Walks one expression; counts what it does."""

    def __init__(self, names: Mapping[str, Any], budget: Budget, functions: Mapping[str, Callable[..., Any]]) -> None:
        self.names = names
        self._functions = functions
        self.steps = 0
        self._budget = budget
        self._local: dict[str, Any] = {}

    def value(self, node: ast.expr) -> Any:
        self.steps += 1
        if self.steps > MAX_STEPS:
            msg = "The expression takes too long to evaluate. Simplify it."
            raise ExpressionError(msg)
        self._budget.spend(5)  # before the value is made: nothing is made once the budget is spent
        reader = _READERS.get(type(node))
        if reader is None:
            msg = f"{type(node).__name__} is not allowed in an expression. Write it without."
            raise ExpressionError(msg)
        found = reader(self, node)
        check_scalar(found)
        size = size_of(found)
        self._budget.spend(size)
        if size > MAX_SIZE:
            raise ExpressionError(TOO_LARGE)
        return found

    def _name(self, node: ast.Name) -> Any:
        return self._named(node.id)

    def _named(self, name: str) -> Any:
        for table in (self._local, self.names, _CONSTANTS, KINDS):
            if name in table:
                return table[name]
        msg = f"`{name}` has no value here. Define it."
        raise UnknownNameError(msg)

    def _attribute(self, node: ast.Attribute) -> Any:
        dotted = ast.unparse(node)
        if dotted in self.names:
            return self.names[dotted]
        if isinstance(node.value, ast.Name) and node.value.id in _MODULES:
            return self._named(node.attr)
        owner = self.value(node.value)
        if isinstance(owner, dict) and node.attr in owner:  # xacro lets `a.b` stand for `a['b']`
            return owner[node.attr]
        msg = f"`{dotted}` has no value here. Define it."
        raise UnknownNameError(msg)

    def _operation(self, node: ast.BinOp) -> Any:
        left, right = self.value(node.left), self.value(node.right)
        if isinstance(node.op, ast.Pow):
            return power(left, right)
        function = _BINARY.get(type(node.op))
        if function is None:
            msg = f"{type(node.op).__name__} is not allowed in an expression. Write it without."
            raise ExpressionError(msg)
        if isinstance(node.op, ast.Mult):
            check_repetition(left, right)
        if isinstance(node.op, ast.Mod) and isinstance(left, str):
            msg = "Formatting with % is not allowed in an expression. Use +."
            raise ExpressionError(msg)
        return function(left, right)

    def _logic(self, node: ast.BoolOp) -> Any:
        wanted = isinstance(node.op, ast.Or)
        value: Any = None
        for part in node.values:
            value = self.value(part)
            if bool(value) is wanted:
                break
        return value

    def _compare(self, node: ast.Compare) -> bool:
        left = self.value(node.left)
        for kind, part in zip(node.ops, node.comparators, strict=True):
            right = self.value(part)
            if not _COMPARE[type(kind)](left, right):
                return False
            left = right
        return True

    def _call(self, node: ast.Call) -> Any:
        args = [self.value(arg) for arg in node.args]
        keywords = {str(entry.arg): self.value(entry.value) for entry in node.keywords if entry.arg}
        if isinstance(node.func, ast.Attribute) and not _is_module(node.func.value):
            return self._method(node.func, args, keywords)
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        function = self._functions.get(name) or _FUNCTIONS.get(name)
        if function is None:
            msg = f"`{name}` is no function of expressions. Write it without."
            raise UnknownNameError(msg)
        return function(*args, **keywords)

    def _method(self, func: ast.Attribute, args: list[Any], keywords: dict[str, Any]) -> Any:
        owner = self.value(func.value)
        if func.attr not in _METHODS.get(type(owner), frozenset()):
            msg = f"`.{func.attr}()` is no method of expressions. Write it without."
            raise UnknownNameError(msg)
        check_growth(func.attr, owner, args)
        if func.attr == "format":
            return formatted(owner, args, keywords)
        found = getattr(owner, func.attr)(*args)
        return list(found) if func.attr in {"keys", "values", "items"} else found

    def _field(self, node: ast.FormattedValue) -> Any:
        if node.format_spec is not None or node.conversion != -1:
            msg = "A format of an f-string is not allowed in an expression. Use `format`."
            raise ExpressionError(msg)
        return self.value(node.value)

    def _subscript(self, node: ast.Subscript) -> Any:
        return self.value(node.value)[self.value(node.slice)]

    def _slice(self, node: ast.Slice) -> slice:
        return slice(*(None if part is None else self.value(part) for part in (node.lower, node.upper, node.step)))

    def _dict(self, node: ast.Dict) -> dict[Any, Any]:
        return {
            self.value(key): self.value(value)
            for key, value in zip(node.keys, node.values, strict=True)
            if key is not None
        }

    def _comprehension(self, node: ast.ListComp | ast.GeneratorExp) -> list[Any]:
        if len(node.generators) != 1 or not isinstance(node.generators[0].target, ast.Name):
            msg = "Only one plain loop is allowed in an expression. Simplify it."
            raise ExpressionError(msg)
        loop = node.generators[0]
        name, outer, found = loop.target.id, dict(self._local), []  # type: ignore[attr-defined]
        for item in list(self.value(loop.iter)):
            self._local = {**outer, name: item}
            if all(self.value(test) for test in loop.ifs):
                found.append(self.value(node.elt))
        self._local = outer
        return found


_READERS: Mapping[type[ast.expr], Callable[[_Evaluator, Any], Any]] = MappingProxyType(
    {
        ast.Constant: lambda _, node: node.value,
        ast.Name: _Evaluator._name,
        ast.Attribute: _Evaluator._attribute,
        ast.BinOp: _Evaluator._operation,
        ast.UnaryOp: lambda self, node: _UNARY[type(node.op)](self.value(node.operand)),
        ast.BoolOp: _Evaluator._logic,
        ast.Compare: _Evaluator._compare,
        ast.IfExp: lambda self, node: self.value(node.body if self.value(node.test) else node.orelse),
        ast.Call: _Evaluator._call,
        ast.Subscript: _Evaluator._subscript,
        ast.Slice: _Evaluator._slice,
        ast.List: lambda self, node: [self.value(item) for item in node.elts],
        ast.Tuple: lambda self, node: tuple([self.value(item) for item in node.elts]),
        ast.Dict: _Evaluator._dict,
        ast.ListComp: _Evaluator._comprehension,
        ast.GeneratorExp: _Evaluator._comprehension,
        ast.JoinedStr: lambda self, node: "".join(str(self.value(part)) for part in node.values),
        ast.FormattedValue: _Evaluator._field,
    }
)


def _is_module(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id in _MODULES


__all__ = ["Budget", "ExpressionError", "UnknownNameError", "evaluate"]
