"""The Python expressions of xacro `${...}` and launch `$(eval ...)`, evaluated over a small whitelist; nothing is run.

Sources: wiki.ros.org/xacro "Math expressions", wiki.ros.org/roslaunch/XML "eval", `launch.substitutions`.
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any

from ecm_parsers.expression_binding import Function, bound
from ecm_parsers.expression_limits import (
    MAX_SIZE,
    TOO_LARGE,
    Budget,
    ExpressionError,
    UnknownNameError,
    check_format,
    check_growth,
    check_scalar,
    formatted,
    size_of,
)
from ecm_parsers.expression_names import CONSTANTS, FUNCTIONS, METHODS, MODULES
from ecm_parsers.expression_operators import COMPARE, UNARY, binary
from ecm_parsers.expression_set import Members

MAX_LENGTH = 5_000
MAX_STEPS = 5_000


def evaluate(
    text: str,
    names: Mapping[str, Any],
    budget: Budget | None = None,
    functions: Mapping[str, Callable[..., Any]] = FUNCTIONS,
) -> Any:
    """Evaluate an expression.

    Args:
        text: Python, at most `MAX_LENGTH` characters.
        names: values by name; a name may be dotted (`ns.property`).
        budget: that this expression shares with others; of its own when not given.
        functions: that may be called by name, beside those of all expressions; they raise `ExpressionError`.

    Returns:
        Text, number, truth value, None, list, tuple, dict or set; a `Function` for a `lambda`.

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
        return _Evaluator(names, budget or Budget(), functions).whole(tree.body)
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

    def whole(self, node: ast.expr) -> Any:
        """Return the value of the whole expression, after which no function of it can be called."""
        found = self.value(node)
        self.steps = MAX_STEPS
        if callable(found):
            msg = "The value is a function. Call it."
            raise ExpressionError(msg)
        return found

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
        for table in (self._local, self.names, CONSTANTS, self._functions, FUNCTIONS):
            if name in table:
                return table[name]
        msg = f"`{name}` has no value here. Define it."
        raise UnknownNameError(msg)

    def _attribute(self, node: ast.Attribute) -> Any:
        dotted = ast.unparse(node)
        if dotted in self.names:
            return self.names[dotted]
        if isinstance(node.value, ast.Name) and node.value.id in MODULES:
            return self._named(node.attr)
        owner = self.value(node.value)
        if isinstance(owner, dict) and node.attr in owner:  # xacro lets `a.b` stand for `a['b']`
            return owner[node.attr]
        msg = f"`{dotted}` has no value here. Define it."
        raise UnknownNameError(msg)

    def _operation(self, node: ast.BinOp) -> Any:
        return binary(type(node.op), self.value(node.left), self.value(node.right))

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
            if not COMPARE[type(kind)](left, right):
                return False
            left = right
        return True

    def _call(self, node: ast.Call) -> Any:
        args, keywords = self._items(node.args), self._keywords(node.keywords)
        if isinstance(node.func, ast.Attribute) and not _is_module(node.func.value):
            return self._method(node.func, args, keywords)
        function = self._function(node.func)
        if isinstance(function, Function):
            return self._applied(function, *args, **keywords)
        return function(*map(self._passed, args), **{name: self._passed(value) for name, value in keywords.items()})

    def _function(self, node: ast.expr) -> Any:
        name = node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else None
        if name is not None and name not in self._local and (name in self._functions or name in FUNCTIONS):
            return self._functions.get(name) or FUNCTIONS[name]
        found = self.value(node) if name is None else self._named(name)
        if not isinstance(found, Function) and not callable(found):
            msg = f"`{ast.unparse(node)[:80]}` is no function of expressions. Write it without."
            raise UnknownNameError(msg)
        return found

    def _passed(self, value: Any) -> Any:
        """What a function that is not written in the expression is given: it can call a `lambda`."""
        return partial(self._applied, value) if isinstance(value, Function) else value

    def _applied(self, function: Function, *args: Any, **keywords: Any) -> Any:
        outer, self._local = self._local, function.names(args, keywords)
        try:
            return self.value(function.node.body)
        finally:
            self._local = outer

    def _lambda(self, node: ast.Lambda) -> Function:
        if node.args.kwonlyargs or node.args.kwarg:
            msg = "A lambda with keywords only is not allowed in an expression. Write it without."
            raise ExpressionError(msg)
        return Function(node, self._local, [self.value(each) for each in node.args.defaults])

    def _items(self, nodes: Iterable[ast.expr]) -> list[Any]:
        found: list[Any] = []
        for node in nodes:
            found += list(self.value(node.value)) if isinstance(node, ast.Starred) else [self.value(node)]
        return found

    def _keywords(self, nodes: Iterable[ast.keyword]) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for node in nodes:
            value = self.value(node.value)
            found |= value if node.arg is None else {node.arg: value}
        return found

    def _method(self, func: ast.Attribute, args: list[Any], keywords: dict[str, Any]) -> Any:
        owner = self.value(func.value)
        if func.attr not in METHODS.get(type(owner), frozenset()):
            msg = f"`.{func.attr}()` is no method of expressions. Write it without."
            raise UnknownNameError(msg)
        check_growth(func.attr, owner, args)
        if func.attr == "format":
            return formatted(owner, args, keywords)
        found = getattr(owner, func.attr)(*args, **keywords)
        return list(found) if func.attr in {"keys", "values", "items"} else found

    def _field(self, node: ast.FormattedValue) -> Any:
        found = self.value(node.value)
        if node.conversion != -1:
            found = _CONVERSIONS[chr(node.conversion)](found)
        if node.format_spec is None:
            return found
        spec = self.value(node.format_spec)
        check_format(spec)
        return format(found, spec)

    def _subscript(self, node: ast.Subscript) -> Any:
        return self.value(node.value)[self.value(node.slice)]

    def _slice(self, node: ast.Slice) -> slice:
        return slice(*(None if part is None else self.value(part) for part in (node.lower, node.upper, node.step)))

    def _dict(self, node: ast.Dict) -> dict[Any, Any]:
        found: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            found |= self.value(value) if key is None else {self.value(key): self.value(value)}
        return found

    def _comprehension(self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp) -> list[Any]:
        outer = self._local
        found = [self.value(node.elt) for _ in self._loops(node.generators)]
        self._local = outer
        return Members(found) if isinstance(node, ast.SetComp) else found

    def _dict_comprehension(self, node: ast.DictComp) -> dict[Any, Any]:
        outer = self._local
        found = {self.value(node.key): self.value(node.value) for _ in self._loops(node.generators)}
        self._local = outer
        return found

    def _loops(self, generators: Sequence[ast.comprehension]) -> Iterator[None]:
        """Bind the names of the loops, those of the last one fastest."""
        if not generators:
            yield
            return
        first, *rest = generators
        for item in list(self.value(first.iter)):
            self._local = {**self._local, **dict(bound(first.target, item))}
            if all(self.value(test) for test in first.ifs):
                yield from self._loops(rest)


_CONVERSIONS: Mapping[str, Callable[[Any], str]] = MappingProxyType({"r": repr, "s": str, "a": ascii})
_READERS: Mapping[type[ast.expr], Callable[[_Evaluator, Any], Any]] = MappingProxyType(
    {
        ast.Constant: lambda _, node: node.value,
        ast.Name: _Evaluator._name,
        ast.Attribute: _Evaluator._attribute,
        ast.BinOp: _Evaluator._operation,
        ast.UnaryOp: lambda self, node: UNARY[type(node.op)](self.value(node.operand)),
        ast.BoolOp: _Evaluator._logic,
        ast.Compare: _Evaluator._compare,
        ast.IfExp: lambda self, node: self.value(node.body if self.value(node.test) else node.orelse),
        ast.Call: _Evaluator._call,
        ast.Subscript: _Evaluator._subscript,
        ast.Slice: _Evaluator._slice,
        ast.List: lambda self, node: self._items(node.elts),
        ast.Tuple: lambda self, node: tuple(self._items(node.elts)),
        ast.Set: lambda self, node: Members(self._items(node.elts)),
        ast.Dict: _Evaluator._dict,
        ast.ListComp: _Evaluator._comprehension,
        ast.GeneratorExp: _Evaluator._comprehension,
        ast.SetComp: _Evaluator._comprehension,
        ast.DictComp: _Evaluator._dict_comprehension,
        ast.Lambda: _Evaluator._lambda,
        ast.JoinedStr: lambda self, node: "".join(str(self.value(part)) for part in node.values),
        ast.FormattedValue: _Evaluator._field,
    }
)


def _is_module(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id in MODULES


__all__ = ["Budget", "ExpressionError", "UnknownNameError", "evaluate"]
