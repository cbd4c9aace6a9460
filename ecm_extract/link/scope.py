"""Which definitions a name has at a place: locals, parameters, members, constants, module globals."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import NamedTuple

from ecm_parsers.source.expr import Call, Expr, Member, Name, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.env import Env
from ecm_extract.link.program import Program
from ecm_extract.link.units import Cls, File, Func


class Definition(NamedTuple):
    """One assignment: the statement `func.body[at]`."""

    func: Func
    at: int

    @property
    def statement(self) -> Statement:
        """The assigning statement."""
        return self.func.fact.body[self.at]


class Scope:
    """Definition look-ups over a program, each function and class indexed once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._locals: dict[int, dict[str, list[int]]] = {}
        self._options: dict[tuple[int, str], Expr] | None = None
        self._passed: dict[int, dict[str, list[tuple[int, Call, int]]]] = {}
        self._members: dict[int, dict[str, list[Definition]]] = {}
        self._fields: dict[int, dict[str, list[int]]] = {}
        self._class_fields: dict[int, dict[str, list[Definition]]] = {}

    def locals_of(self, func: Func) -> dict[str, list[int]]:
        """Return name -> indices of the statements that bind it in a function."""
        known = self._locals.get(id(func))
        if known is None:
            known = defaultdict(list)
            for at, statement in enumerate(func.fact.body):
                if isinstance(statement.target, Name) and statement.kind != "init":
                    known[statement.target.id].append(at)
            self._locals[id(func)] = known
        return known

    def local(self, name: str, env: Env) -> list[Definition]:
        """Return the assignments of a local that can reach the place, latest first.

        Going back, the first one whose block encloses everything since ends the search: it has surely happened.
        """
        indices = self.locals_of(env.func).get(name)
        if not indices:
            return []
        body = env.func.fact.body
        reaching: list[Definition] = []
        lowest, seen = _depth_at(body, env.at), min(env.at, len(body))
        for at in reversed(indices):
            if at >= env.at:
                continue
            lowest = min([lowest, *(statement.depth for statement in body[at + 1 : seen])])
            seen = at + 1
            if body[at].value is not None:
                reaching.append(Definition(env.func, at))
                if body[at].depth <= lowest:
                    break
        return reaching

    def is_certain(self, name: str, env: Env) -> bool:
        """Tell whether one of the assignments that reach the place has surely happened."""
        found = self.local(name, env)
        if not found:
            return False
        since = env.func.fact.body[found[-1].at + 1 : env.at + 1]
        return found[-1].statement.depth <= min((statement.depth for statement in since), default=0)

    def passed(self, func: Func, name: str) -> list[tuple[int, Call, int]]:
        """Return (statement, call, argument index) of the calls that a local is handed to."""
        known = self._passed.get(id(func))
        if known is None:
            known = defaultdict(list)
            for at, calls in enumerate(func.calls):
                for call in calls:
                    for index, arg in enumerate(call.args):
                        if isinstance(arg, Name):
                            known[arg.id].append((at, call, index))
            self._passed[id(func)] = known
        return known.get(name, [])

    def declared_type(self, name: str, env: Env) -> str:
        """Return the written type of a variable at a place: local, parameter, member, constant; empty when unknown."""
        body = env.func.fact.body
        for at in self.locals_of(env.func).get(name, ()):
            if body[at].kind == "let" and body[at].type and body[at].type != "auto":
                return body[at].type
        for parameter in env.func.fact.params:
            if parameter.name == name:
                return parameter.type
        return self.member_type(name, env.this or env.func.cls)

    def member_type(self, name: str, cls: Cls | None) -> str:
        """Return the written type of a data member, bases included."""
        for entry in self.program.ancestry(cls) if cls is not None else ():
            field = entry.fields.get(name)
            if field is not None:
                return field.type
        return ""

    def members(self, name: str, cls: Cls) -> list[Definition]:
        """Return the assignments of a data member in all methods of a class (bases are separate classes)."""
        known = self._members.get(id(cls))
        if known is None:
            known = defaultdict(list)
            for method in cls.methods:
                own = {parameter.name for parameter in method.fact.params}
                for at, statement in enumerate(method.fact.body):
                    target = _member_target(statement, own)
                    if target and statement.value is not None:
                        known[target].append(Definition(method, at))
            self._members[id(cls)] = known
        return known.get(name, [])

    def fields(self, func: Func) -> dict[str, list[int]]:
        """Return field -> indices of the statements of a function that assign it on an object other than its own."""
        known = self._fields.get(id(func))
        if known is None:
            known = self._fields[id(func)] = defaultdict(list)
            for at, statement in enumerate(func.fact.body):
                target = statement.target
                if isinstance(target, Member) and target.base != Name("this") and statement.kind == "set":
                    known[target.name].append(at)
        return known

    def class_fields(self, cls: Cls) -> dict[str, list[Definition]]:
        """Return field -> the assignments of it on other objects in all methods of a class."""
        known = self._class_fields.get(id(cls))
        if known is None:
            known = self._class_fields[id(cls)] = defaultdict(list)
            for method in cls.methods:
                for name, indices in self.fields(method).items():
                    known[name] += [Definition(method, at) for at in indices]
        return known

    def constant(self, name: str, env: Env) -> tuple[Expr, Func | None, File] | None:
        """Return the value of a constant that `name` means at a place, with the file it stands in."""
        cls = env.func.cls
        scope = f"{cls.qualified}::{env.func.fact.name}" if cls is not None else env.scope
        found = self.program.constant_named(name, env.func.file, scope)
        return (found.constant.value, None, found.file) if found is not None and found.constant.value else None

    def option(self, name: str, file: File) -> Expr | None:
        """Return the default of a command line option that a Python file adds with `add_argument`."""
        if self._options is None:
            self._options = {}
            for functions in self.program.functions.values():
                for func in functions:
                    if func.file.language == "python":
                        self._options |= {(id(func.file), key): value for key, value in _options(func)}
        return self._options.get((id(file), name))


def _member_target(statement: Statement, params: set[str]) -> str:
    target = statement.target
    if isinstance(target, Member) and target.base == Name("this"):
        return target.name
    if (
        isinstance(target, Name)
        and statement.kind in {"set", "init"}
        and (statement.kind == "init" or target.id not in params)
    ):
        return target.id
    return ""


def _options(func: Func) -> Iterator[tuple[str, Expr]]:
    for calls in func.calls:
        for call in calls:
            if isinstance(call.callee, Member) and call.callee.name == "add_argument":
                keywords = dict(call.keywords)
                dest = keywords.get("dest") or next((arg for arg in call.args if _is_long(arg)), None)
                if isinstance(dest, Text) and "default" in keywords:
                    yield dest.value.lstrip("-").replace("-", "_"), keywords["default"]


def _is_long(arg: Expr) -> bool:
    return isinstance(arg, Text) and (arg.value.startswith("--") or not arg.value.startswith("-"))


def _depth_at(body: tuple[Statement, ...], at: int) -> int:
    return body[at].depth if at < len(body) else 0
