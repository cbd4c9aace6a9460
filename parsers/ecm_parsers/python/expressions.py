"""Expressions of Python, over values that may be unknown."""

from __future__ import annotations

import ast
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.classes import member
from ecm_parsers.python.formats import as_formatted
from ecm_parsers.python.library import LIBRARY
from ecm_parsers.python.models import Models
from ecm_parsers.python.operators import binary, compare, signed, subscript, truth
from ecm_parsers.python.spelling import source_of
from ecm_parsers.python.values import (
    Class,
    Function,
    Many,
    Method,
    Modelled,
    Module,
    Object,
    Reference,
    Scope,
    Text,
    Unknown,
    Value,
    expanded,
    hashable,
    merged_text,
    template_of,
)
from ecm_parsers.python.watching import Watcher
from ecm_parsers.result import Diagnostic
from ecm_parsers.template import Substitution, Template, negated

MAX_STEPS = 60_000
MAX_WORK = 2_000_000
"""Items of the lists and maps that expressions give, those inside each other included."""
_CUT = "This text has more parts than are read; it and what is built of it stay unknown. Build it in fewer steps."


class TooLongError(Exception):
    """The file takes more steps to read than any needs; `line` is where that was noticed."""

    def __init__(self, line: int) -> None:
        super().__init__(line)
        self.line = line


class Expressions(ABC):
    """Evaluates expressions; whoever reads statements says what calls and assignments do.

    Attributes:
        attributes: what the file gives to what is not its own, by dotted name.
        steps: evaluated nodes. line: that is being read. problem: the first text that was too large to be kept.
    """

    IS_STRICT = False
    """Whether what may be is never told as what is."""

    def __init__(self, models: Models, watcher: Watcher | None = None) -> None:
        self.models = models
        self.watcher = watcher or Watcher()
        self.steps = 0
        self.line = 0
        self.problem: Diagnostic | None = None
        self.attributes: dict[str, Value] = {}
        self._work = 0

    @abstractmethod
    def call_of(self, node: ast.Call, scope: Scope) -> Value:
        """Return what a call gives."""

    @abstractmethod
    def loaded(self, value: Value) -> Value:
        """Return the data of a YAML file that a value names, else the value."""

    @abstractmethod
    def call(self, function: Function, given: Arguments) -> Value:
        """Return what a function of the file or of its modules returns."""

    @abstractmethod
    def chosen(self, holds: Template, first: Value, second: Value, name: str) -> Value:
        """Return what a name, or an expression, holds that depends on a condition."""

    @abstractmethod
    def method(self, owner: Value, name: str, given: Arguments, written: ast.expr) -> Value:
        """Return what a method of a value gives, which may change it; `written` is where it is called."""

    @abstractmethod
    def assign(self, target: ast.expr, value: Value, scope: Scope) -> None:
        """Bind a value to what stands on the left side."""

    def value(self, node: ast.expr | None, scope: Scope) -> Value:
        """Return the value of an expression."""
        if node is None:
            return None
        self.step()
        reader = self._EXPRESSIONS.get(type(node))
        found = reader(self, node, scope) if reader is not None else Unknown(source_of(node))
        self._weigh(found, node.lineno)
        if isinstance(found, Reference):
            found = self.attributes.get(found.path, self.models.constants.get(found.path, found))
        return self.kept(found, node)

    def kept(self, found: Value, node: ast.expr) -> Value:
        """Return the value of an expression as it is handed on."""
        return found

    def _weigh(self, found: Value, line: int) -> None:
        """Count what a value holds; whoever uses it walks over all of that."""
        if isinstance(found, Text) and found.is_cut:
            self.problem = self.problem or Diagnostic("warning", "launch-text-cut", line, _CUT)
        elif isinstance(found, list | tuple | dict):
            self._work += expanded(found, MAX_WORK - self._work)
            self.step(0)

    def _name(self, node: ast.Name, scope: Scope) -> Value:
        found = scope.find(node.id)
        known = found is not None or _is_set(node.id, scope)
        return found if known else Reference(node.id)

    def _attribute(self, node: ast.Attribute, scope: Scope) -> Value:
        found = self.attribute(self.value(node.value, scope), node.attr, node.lineno)
        return Unknown(source_of(node)) if isinstance(found, Unknown) else found

    def attribute(self, owner: Value, name: str, line: int = 0) -> Value:
        """Return an attribute of a value, Unknown when it is not known; `line` is where it is read."""
        if isinstance(owner, Reference):
            return Reference(f"{owner.path}.{name}")
        if name == "parent" and isinstance(owner, Text | str):
            return LIBRARY["dirname"](Arguments((owner,), {}, 0))
        if isinstance(owner, Modelled):
            return owner.attribute(name)
        if isinstance(owner, Module) and name != "load_module":
            return owner.scope.names.get(name, Reference(f"{owner.name}.{name}"))
        if isinstance(owner, Class | Object):
            return self._member(owner, name, line)
        return owner if isinstance(owner, Unknown) else Method(owner, name)

    def _member(self, owner: Class | Object, name: str, line: int) -> Value:
        if isinstance(owner, Object) and name in owner.attributes:
            return owner.attributes[name]
        found = member(owner if isinstance(owner, Class) else owner.cls, name, owner)
        if isinstance(found, Function) and found.kind == "property" and found.first:
            return self.call(found, Arguments((), {}, line))
        return Unknown(name) if found is None else found

    def _subscript(self, node: ast.Subscript, scope: Scope) -> Value:
        owner, key = self.value(node.value, scope), self.value(node.slice, scope)
        if isinstance(owner, Reference) and owner.last in self.models.tables:
            return self.models.tables[owner.last](Arguments((key,), {}, node.lineno))
        found = subscript(self.loaded(owner), key)
        return Unknown(source_of(node)) if isinstance(found, Unknown) else found

    def _slice(self, node: ast.Slice, scope: Scope) -> Value:
        bounds = [self.value(part, scope) for part in (node.lower, node.upper, node.step)]
        fine = all(bound is None or isinstance(bound, int) for bound in bounds) and bounds[2] != 0
        return slice(*bounds) if fine else Unknown("slice")

    def _list(self, node: ast.List | ast.Tuple | ast.Set, scope: Scope) -> Value:
        items: list[Value] = []
        for element in node.elts:
            if isinstance(element, ast.Starred):
                more = self.value(element.value, scope)
                items += [Many(more)] if (listed := self.items(more)) is None else listed
            else:
                items.append(self.value(element, scope))
        return tuple(items) if isinstance(node, ast.Tuple) else items

    def _dict(self, node: ast.Dict, scope: Scope) -> Value:
        table: dict[Value, Value] = {}
        for key_node, value_node in zip(node.keys, node.values, strict=True):
            value = self.value(value_node, scope)
            if key_node is None:
                self.method(table, "update", Arguments((value,), {}, node.lineno), value_node)
                continue
            key = self.value(key_node, scope)
            if isinstance(key, list | tuple):
                key = merged_text(template_of(key))
            if hashable(key):
                table[key] = value
        return table

    def _comprehension(self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp, scope: Scope) -> Value:
        rounds = self._loops(node.generators, Scope({}, scope))
        return [Many(self.value(node.elt, inner)) if many else self.value(node.elt, inner) for inner, many in rounds]

    def _dict_comprehension(self, node: ast.DictComp, scope: Scope) -> Value:
        table: dict[Value, Value] = {}
        for inner, many in self._loops(node.generators, Scope({}, scope)):
            key, value = self.value(node.key, inner), self.value(node.value, inner)
            entry = (Many(key) if many else key, value)
            self.method(table, "__setitem__", Arguments(entry, {}, node.lineno), node.key)
        return table

    def _loops(
        self, generators: list[ast.comprehension], scope: Scope, *, many: bool = False
    ) -> Iterator[tuple[Scope, bool]]:
        """Yield the names of each round, and whether it stands for any number of them."""
        if not generators:
            yield scope, many
            return
        first, *rest = generators
        for item in self.rounds(first.iter, first.target, scope):
            self.assign(first.target, item.each if isinstance(item, Many) else item, scope)
            tests = [truth(self.value(test, scope)) for test in first.ifs]
            if False not in tests:
                perhaps = isinstance(item, Many) or (self.IS_STRICT and tests.count(True) < len(tests))
                yield from self._loops(rest, scope, many=many or perhaps)

    def rounds(self, node: ast.expr, target: ast.expr, scope: Scope) -> list[Value]:
        """Return what a loop goes through: any number of elements where that is not known."""
        items = self.items(self.value(node, scope))
        unknown = Many(Unknown(source_of(target)))
        if items is None:
            return [unknown]
        return [unknown if isinstance(item, Many) and isinstance(item.each, Unknown) else item for item in items]

    def _binary(self, node: ast.BinOp, scope: Scope) -> Value:
        return binary(node.op, self.value(node.left, scope), self.value(node.right, scope))

    def _bool(self, node: ast.BoolOp, scope: Scope) -> Value:
        conjunction = isinstance(node.op, ast.And)
        open_parts: list[Template] = []
        value: Value = conjunction
        for part in node.values:
            value = self.value(part, scope)
            if part is not node.values[-1]:
                self.watcher.tested(value, part.lineno)
            holds = truth(value)
            if isinstance(holds, bool):
                if holds is not conjunction:
                    return self._decided(value, open_parts, conjunction=conjunction)
                continue
            if part is node.values[-1] and not open_parts:
                return value
            open_parts.append(holds)
        if not open_parts:
            return value
        return Text((Substitution("and" if conjunction else "or", tuple(open_parts)),))

    def _decided(self, value: Value, open_parts: list[Template], *, conjunction: bool) -> Value:
        """What a part gives that decides: behind parts that may decide it is one of several."""
        if not open_parts or (isinstance(value, bool) and not self.IS_STRICT):
            return value
        holds = (Substitution("or", tuple(negated(part) if conjunction else part for part in open_parts)),)
        return self.chosen(holds, Text(open_parts[0]), value, "")

    def _unary(self, node: ast.UnaryOp, scope: Scope) -> Value:
        value = self.value(node.operand, scope)
        if isinstance(node.op, ast.Not):
            self.watcher.tested(value, node.lineno)
            holds = truth(value)
            return not holds if isinstance(holds, bool) else Text(negated(holds))
        return signed(node.op, value) if isinstance(value, int | float) else Unknown(source_of(node))

    def _compare(self, node: ast.Compare, scope: Scope) -> Value:
        values = [self.value(part, scope) for part in (node.left, *node.comparators)]
        for at, kind in enumerate(node.ops):
            self.watcher.compared(kind, values[at], values[at + 1], node.lineno)
        results = [compare(op, values[at], values[at + 1]) for at, op in enumerate(node.ops)]
        return Unknown(source_of(node)) if len(results) > 1 or isinstance(results[0], Unknown) else results[0]

    def _if_expression(self, node: ast.IfExp, scope: Scope) -> Value:
        tested = self.value(node.test, scope)
        self.watcher.tested(tested, node.lineno)
        holds = truth(tested)
        if isinstance(holds, bool):
            return self.value(node.body if holds else node.orelse, scope)
        return self.chosen(holds, self.value(node.body, scope), self.value(node.orelse, scope), source_of(node))

    def _joined(self, node: ast.JoinedStr, scope: Scope) -> Value:
        parts = tuple(part for value in node.values for part in template_of(self.value(value, scope)))
        return merged_text(parts, is_str=True)

    def _formatted(self, node: ast.FormattedValue, scope: Scope) -> Value:
        value = self.value(node.value, scope)
        spec = self.value(node.format_spec, scope)
        if spec is not None and not isinstance(spec, str):
            return Unknown(source_of(node.value))
        conversion = f"!{chr(node.conversion)}" if node.conversion >= 0 else ""
        return merged_text(as_formatted(value, conversion + (f":{spec}" if spec else "")), is_str=True)

    def items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes over, None when that is not known."""
        value = self.loaded(value)
        if isinstance(value, Modelled):
            return value.items
        return list(value) if isinstance(value, list | tuple | dict) else None

    def step(self, count: int = 1) -> None:
        """Count steps.

        Raises:
            TooLongError: the file takes too many.
        """
        self.steps += count
        if self.steps > MAX_STEPS or self._work > MAX_WORK:
            raise TooLongError(self.line)

    _EXPRESSIONS: dict[type[ast.expr], Callable[..., Value]] = {  # noqa: RUF012  # read only, one row per node
        ast.Constant: lambda _, node, __: node.value,
        ast.Name: _name,
        ast.Attribute: _attribute,
        ast.Subscript: _subscript,
        ast.Slice: _slice,
        ast.List: _list,
        ast.Tuple: _list,
        ast.Set: _list,
        ast.Dict: _dict,
        ast.ListComp: _comprehension,
        ast.GeneratorExp: _comprehension,
        ast.SetComp: _comprehension,
        ast.DictComp: _dict_comprehension,
        ast.BinOp: _binary,
        ast.BoolOp: _bool,
        ast.UnaryOp: _unary,
        ast.Compare: _compare,
        ast.IfExp: _if_expression,
        ast.JoinedStr: _joined,
        ast.FormattedValue: _formatted,
        ast.Call: lambda self, node, scope: self.call_of(node, scope),
        ast.Lambda: lambda _, node, scope: Function(node, scope),
    }


def _is_set(name: str, scope: Scope) -> bool:
    current: Scope | None = scope
    while current is not None:
        if name in current.names:
            return True
        current = current.parent
    return False
