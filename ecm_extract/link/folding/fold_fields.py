"""Fields of structures that hold settings: what the functions at hand write to them.

`nh.param("topic", params_.topic, "scan")` or `params.topic = ...` in one method, `params_.topic` in another. The
variables may have different names: what is assigned is told by the class of the structure, what is read by the field.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name

from ecm_extract.infer.places import chosen
from ecm_extract.infer.read_into import ReadInto
from ecm_extract.link.code.expression_text import expression_text
from ecm_extract.link.code.member_paths import below_variable
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import dotted, names_in
from ecm_extract.link.folding.other_objects import OtherObjects, is_one_of_several
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.values import MAX_ALTERNATIVES, Value, alternatives, demoted, parameter, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class FieldFolder:
    """Folds `object.field` by the assignments to that field."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._others = OtherObjects()

    def value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what the field can hold; empty when nothing at hand writes it."""
        return self.folder.guarded(
            ("field", expr, env.func, env.at, env.state), expr.name, lambda: self._value(expr, env)
        )

    def _value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        others = list(self._of_class(expr, env))
        handed = self._by_caller(expr, env) if others else None
        found = [*self._of_functions(expr, env), *others, *([handed] if handed is not None else ())]
        if any(value.confidence != "default" for value in found):
            found += self._set_later(expr, env)
        if found and self._is_pointed_to(expr, env):
            found.append(unknown(expr.name))
        filled = [value for value in found if value.text or value is handed]
        if filled:
            filled += self._left_alone(expr, env)
        return alternatives(filled or found)[:MAX_ALTERNATIVES] if found else ()

    def _is_pointed_to(self, expr: Member, env: Env) -> bool:
        """Tell whether C++ has a pointer to a field, or to a method that changes it: `object.*pointer`."""
        cls, outside = self.folder.objects.class_of(expr.base, env), self.folder.changed_outside
        if cls is None or cls.file.language != "cpp":
            return False
        methods = (
            each.fact.name
            for entry in self.folder.program.ancestry(cls)
            for each in self.folder.scope.changing(expr.name, entry)
        )
        return any(outside.is_pointed_to(name, cls) for name in (expr.name, *methods))

    def _by_caller(self, expr: Member, env: Env) -> Value | None:
        """What only the caller knows of a field, in C++: that of an object that he hands over; None of others."""
        root = below_variable(expr).root
        if not isinstance(root, Name) or root.id not in env.func.given or env.func.file.language != "cpp":
            return None
        is_bound = self.folder.names.argument(root.id, env) is not None
        return unknown(expr.name) if is_bound else parameter(root.id, env.func.is_constructor)

    def _of_functions(self, expr: Member, env: Env) -> Iterator[Value]:
        """What the function at hand writes, and functions that it hands the object to."""
        for func in (env.func, *self._helpers(expr, env)):
            limit = env.at if func is env.func else len(func.fact.body)
            for read in self.folder.reads.written(func, f".{expr.name}"):
                if read.at < limit:
                    yield from self._read(expr, func, read, env)
            for at in self.folder.scope.fields(func).get(expr.name, ()):
                if at < limit:
                    yield from self._set(expr, func, at, env)

    def _left_alone(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """What its class declares a field with, where all that is written to it is written under one condition."""
        cls = self.folder.objects.class_of(expr.base, env) if env.func.file.language == "cpp" else None
        field = cls.fields.get(expr.name) if cls is not None else None
        made = cls is not None and any(method.is_constructor for method in cls.methods)
        default = field.default if field is not None and not made else None
        if default is None or self.folder.reads.written(env.func, f".{expr.name}"):
            return ()
        writers = [
            at in self.folder.flow.outline(func).certain
            for func in (env.func, *self._helpers(expr, env))
            for at in self.folder.scope.fields(func).get(expr.name, ())
        ]
        if writers != [False]:
            return ()
        values = demoted(self.folder.fold(default, Env(env.func, depth=env.depth + 1, this=cls)))
        return tuple([value for value in values if value.text])

    def _of_class(self, expr: Member, env: Env) -> Iterator[Value]:
        """What other methods of the class at hand write."""
        cls = env.this or env.func.cls
        for entry in self.folder.program.ancestry(cls) if cls is not None else ():
            for func, read in self.folder.reads.members(entry, f".{expr.name}"):
                if func is not env.func:
                    yield from self._read(expr, func, read, env)
            for place in self.folder.scope.class_fields(entry).get(expr.name, ()):
                if place.func is not env.func and not self.folder.given_fields.is_set_later(place):
                    yield from self._set(expr, place.func, place.at, env)

    def _set_later(self, expr: Member, env: Env) -> Iterator[Value]:
        """What callbacks take out of parameters that somebody sets: it replaces what is not the default of one, too."""
        cls = env.this or env.func.cls
        for entry in self.folder.program.ancestry(cls) if cls is not None else ():
            for place in self.folder.scope.class_fields(entry).get(expr.name, ()):
                if place.func is not env.func and self.folder.given_fields.is_set_later(place):
                    yield from self._set(expr, place.func, place.at, env)

    def _read(self, expr: Member, func: Func, read: ReadInto, env: Env) -> Iterable[Value]:
        inner = self._inside(func, read.at, env)
        if not isinstance(read.out, Member) or self._is_same_kind(expr, env, read.out, inner) is False:
            return ()
        if self._is_apart(expr, read.out, func, env):
            return (unknown(expr.name),)
        values = self.folder.parameters.parameter_value(read.name, read.default, inner)
        return _of_one(values, expr.name) if self._may_be_others(expr, env, read.out, inner) else values

    def _set(self, expr: Member, func: Func, at: int, env: Env) -> Iterable[Value]:
        statement, inner = func.fact.body[at], self._inside(func, at, env)
        target = statement.target
        if not isinstance(target, Member) or not self._is_meant(expr, env, target, inner):
            return ()
        if self._is_apart(expr, target, func, env):
            return (unknown(expr.name),)
        values = demoted(self.folder.fold(statement.value, inner))
        elsewhere = func is not env.func and func.file.language == "python" and _is_element(target.base)
        others = elsewhere or self._may_be_others(expr, env, target, inner)  # a list may have become another meanwhile
        return _of_one(values, expr.name) if others else values

    def _is_apart(self, expr: Member, target: Member, func: Func, env: Env) -> bool:
        """Tell whether what is written to is a field of an object that the one at hand has nothing to do with."""
        return func is env.func and self._others.are_apart(expr.base, target.base, func)

    def _may_be_others(self, expr: Member, env: Env, target: Member, inner: Env) -> bool:
        """Tell whether what is written to is a field of another object of the class, as far as that is known."""
        if chosen(target.base):
            return True
        members = target.base != expr.base and is_own_member(target.base) and is_own_member(expr.base)
        named = inner.func is env.func and isinstance(target.base, Name) and isinstance(expr.base, Name)
        is_other = members or named or _is_element(target.base) or self._is_own(target.base, inner)
        same = _is_alike(target.base, expr.base) and (inner.func is env.func or not self._is_declared(expr.base, inner))
        return is_other and not same and not self._may_refer(expr.base, target.base, env)

    def _is_own(self, expr: Expr, env: Env) -> bool:
        """Tell whether a variable is an object itself, or points to one that is made for it; so are parts of those."""
        if isinstance(expr, Member):
            return self._is_own(expr.base, env) and by_value(self.folder.objects.type_of(expr, env))
        if not isinstance(expr, Name):
            return False
        begun = [entry.value for entry in env.func.fact.body if entry.kind == "let" and entry.target == expr]
        made = any(value is not None and pointed(value) for value in begun)
        return made or by_value(self.folder.scope.declared_type(expr.id, env))

    def _may_refer(self, expr: Expr, to: Expr, env: Env) -> bool:
        """Tell whether a variable may be another name of an object that a function has."""
        if not isinstance(expr, Name) or not self.folder.scope.declared_type(expr.id, env).endswith(("&", "*")):
            return False
        begun = [entry.value for entry in env.func.fact.body if entry.kind == "let" and entry.target == expr]
        named = {name for value in begun for name in names_in(value)}
        return not begun or not isinstance(to, Name) or to.id in named

    def _is_meant(self, one: Member, env: Env, other: Member, inner: Env) -> bool:
        """Tell whether two objects are of one class, or called the same where a class is not known."""
        same = self._is_same_kind(one, env, other, inner)
        alike = one.base == other.base and (inner.func is env.func or not self._is_declared(one.base, env))
        return alike if same is None else same

    def _is_same_kind(self, one: Member, env: Env, other: Member, inner: Env) -> bool | None:
        """Tell whether the objects of two fields are of one class; None where that is not known."""
        first = self.folder.objects.class_of(one.base, env)
        second = self.folder.objects.class_of(other.base, inner)
        return first is second if first is not None and second is not None else None

    def _is_declared(self, expr: Expr, env: Env) -> bool:
        """Tell whether a variable is one of the function at hand: another function has none of that name in common."""
        name = Name((dotted(expr) or "").partition(".")[0])
        declared = [entry.target for entry in env.func.fact.body if entry.kind in {"let", "each"}]
        return any(name == target or (isinstance(target, Items) and name in target.items) for target in declared)

    def _helpers(self, expr: Member, env: Env) -> Iterator[Func]:
        cls = env.this or env.func.cls
        root = expr.base
        while isinstance(root, Member):
            root = root.base
        for at, call, _ in self.folder.scope.passed(env.func, root.id) if isinstance(root, Name) else ():
            callee = self.folder.objects.callee(invocation_of(call, env.before(at)), env.before(at))
            if at < env.at and callee is not None and callee is not env.func and (cls is None or callee.cls is not cls):
                yield callee

    def _inside(self, func: Func, at: int, env: Env) -> Env:
        if func is env.func:
            return env.before(at)
        return Env(func, at, this=func.cls and (env.this or func.cls), depth=env.depth + 1)


def _of_one(values: Sequence[Value], name: str) -> Sequence[Value]:
    """What one object of a class is given, told of any."""
    return alternatives((*values, unknown(name)))


def _is_alike(one: Expr, other: Expr) -> bool:
    """Whether two objects are written alike, on whatever lines."""
    return one == other or expression_text(one, False) == expression_text(other, False)


def _is_element(expr: Expr) -> bool:
    """Tell whether an object is one of several, or lies in one: `rows[0]`, `(a ? b : c)`; others do not get its own."""
    while isinstance(expr, Member):
        expr = expr.base
    return is_one_of_several(expr) or isinstance(expr, Call) or bool(chosen(expr))
