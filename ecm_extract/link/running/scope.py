"""Which definitions a name has at a place: locals, parameters, members, constants, module globals."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence, Set
from typing import Final, NamedTuple

from ecm_parsers.source import expr as kinds
from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Text
from ecm_parsers.source.facts import Constant, Statement

from ecm_extract.infer.held import Held
from ecm_extract.infer.places import whole_of
from ecm_extract.infer.pointing import refers
from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.texts import makes_text
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import expressions, names_in
from ecm_extract.link.index.nesting import Nesting
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.base_types import BaseTypes
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.visible_variables import VisibleVariables

_FLAGS: Final = {"store_true": "false", "store_false": "true"}


class Definition(NamedTuple):
    """One assignment: the statement `func.body[at]`."""

    func: Func
    at: int

    @property
    def statement(self) -> Statement:
        """The assigning statement."""
        return self.func.fact.body[self.at]


class Scope:
    """Definition look-ups over a program, each function and class indexed once.

    `ways` gives what a variable may hold at a place; whoever runs functions sets it.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self.nesting = Nesting(program)
        self.base_types = BaseTypes(program)
        self.visible = VisibleVariables()
        self.ways: Callable[[Expr, Env], Sequence[Sequence[Held]]] = _nothing
        self._locals: dict[Func, dict[str, list[int]]] = {}
        self._options: dict[tuple[File, str], Expr] | None = None
        self._passed: dict[Func, dict[str, list[tuple[int, Call, int]]]] = {}
        self._members: dict[Cls, dict[str, list[Definition]]] = {}
        self._changing: dict[Cls, dict[str, list[Func]]] = {}
        self._fields: dict[Func, dict[str, list[int]]] = {}
        self._outside: dict[tuple[str, str], list[Definition]] | None = None
        self._class_fields: dict[Cls, dict[str, list[Definition]]] = {}

    def locals_of(self, func: Func) -> dict[str, list[int]]:
        """Return name -> indices of the statements that bind it in a function."""
        known = self._locals.get(func)
        if known is None:
            known = defaultdict(list)
            for at, statement in enumerate(func.fact.body):
                if isinstance(statement.target, Name) and statement.kind != "init":
                    known[statement.target.id].append(at)
            self._locals[func] = known
        return known

    def passed(self, func: Func, name: str) -> list[tuple[int, Call, int]]:
        """Return (statement, call, argument index) of the calls that a local is handed to."""
        known = self._passed.get(func)
        if known is None:
            known = defaultdict(list)
            for at, calls in enumerate(func.calls):
                for call in calls:
                    for index, arg in enumerate(call.args):
                        if isinstance(arg, Name):
                            known[arg.id].append((at, call, index))
            self._passed[func] = known
        return known.get(name, [])

    def declared_type(self, name: str, env: Env) -> str:
        """Return the written type of a variable at a place: local, parameter, member, constant; empty when unknown."""
        holder = self.holding(name, env.func)
        written = self._written_type(name, holder, env) if holder is not None else ""
        return written or self.member_type(name, env.this or env.func.cls)

    def holding(self, name: str, func: Func) -> Func | None:
        """Return the function whose variable or parameter a name means: itself, or one that it is declared in."""
        around = (func, *self.nesting.around(func))
        return next((each for each in around if name in self.locals_of(each) or name in each.given), None)

    def declaration(self, name: str, func: Func, env: Env) -> int | None:
        """Return the statement that declares a variable of C++, of several in blocks of a function the one seen."""
        body, places = func.fact.body, self.locals_of(func).get(name, ())
        lets = [at for at in places if body[at].kind in {"let", "each"}]
        if len(lets) < 2 or func is not env.func or func.file.language != "cpp":
            return None
        return self.visible.declared(func, lets, env.at)

    def _written_type(self, name: str, func: Func, env: Env) -> str:
        body, places = func.fact.body, self.locals_of(func).get(name, ())
        seen = self.declaration(name, func, env)
        lets = [body[at].type for at in places if body[at].kind == "let" and body[at].type and seen in {None, at}]
        given = [parameter.type for parameter in func.fact.params if parameter.name == name]
        return next((written for written in lets if plain(written) != "auto"), next(iter(given), ""))

    def member_type(self, name: str, cls: Cls | None) -> str:
        """Return the written type of a data member, bases included."""
        for entry in self.program.ancestry(cls) if cls is not None else ():
            field = entry.fields.get(name)
            if field is not None and cls is not None:
                return self.base_types.within(field.type, entry, cls)
        return ""

    def members(self, name: str, cls: Cls) -> list[Definition]:
        """Return the assignments of a data member in all methods of a class (bases are separate classes)."""
        known = self._members.get(cls)
        if known is None:
            known = defaultdict(list)
            for method in cls.methods:
                own = {parameter.name for parameter in method.fact.params}
                for at, statement in enumerate(method.fact.body):
                    target = _member_target(statement, own)
                    if target and statement.value is not None:
                        known[target].append(Definition(method, at))
            self._members[cls] = known
        return known.get(name, [])

    def owner(self, name: str, cls: Cls, env: Env) -> Cls | None:
        """Return the class that declares the data member of an object which a name means at a place (see `declaring`).

        Args:
            name: the member.
            cls: the class of the object.
            env: the place: in a method of that class or of a base, or elsewhere.
        """
        asking = env.func.holder
        inside = asking is not None and asking in self.program.ancestry(cls)
        return self.declaring(name, asking if inside and asking is not None else cls)

    def declaring(self, name: str, cls: Cls) -> Cls | None:
        """Return the class whose member the methods of a class mean by a name; None where one name is one member.

        A class of C++ that declares a member has one of its own, beside that of a base which is called alike.
        """
        if cls.file.language != "cpp":
            return None
        return next((entry for entry in self.program.ancestry(cls) if name in entry.fields), None)

    def changing(self, name: str, cls: Cls) -> list[Func]:
        """Return the methods of a class that may give a data member something else: they, or functions within them."""
        known = self._changing.get(cls)
        if known is None:
            known = self._changing[cls] = defaultdict(list)
            for method in cls.methods:
                within = (method, *self.nesting.inner(method))
                for target in sorted({target for func in within for target in _touched(func)}):
                    known[target].append(method)
        return known.get(name, [])

    def fields(self, func: Func) -> dict[str, list[int]]:
        """Return field -> indices of the statements of a function that assign it on an object other than its own."""
        known = self._fields.get(func)
        if known is None:
            known = self._fields[func] = defaultdict(list)
            for at, statement in enumerate(func.fact.body):
                target = statement.target
                if isinstance(target, Member) and target.base != THIS and statement.kind == "set":
                    known[target.name] += [at] * (not _begins(target, statement, func))
        return known

    def assigned_outside(self, name: str, language: str) -> Sequence[Definition]:
        """Return the assignments of a field of that name of something else than the own object of a function."""
        if self._outside is None:
            self._outside = defaultdict(list)
            for func in (func for group in self.program.functions.values() for func in group):
                for field, indices in self.fields(func).items():
                    self._outside[func.file.language, field] += [Definition(func, at) for at in indices]
        return self._outside.get((language, name), ())

    def class_fields(self, cls: Cls) -> dict[str, list[Definition]]:
        """Return field -> the assignments of it on other objects in all methods of a class."""
        known = self._class_fields.get(cls)
        if known is None:
            known = self._class_fields[cls] = defaultdict(list)
            for method in cls.methods:
                for name, indices in self.fields(method).items():
                    known[name] += [Definition(method, at) for at in indices]
        return known

    def constant(self, name: str, env: Env) -> tuple[Constant, File] | None:
        """Return the constant that `name` means at a place, with the file it stands in."""
        cls = env.func.cls
        scope = f"{cls.qualified}::{env.func.fact.name}" if cls is not None else env.scope
        found = self.program.constant_named(name, env.func.file, scope)
        if found is None or (found.constant.value is None and "enum" not in found.constant.traits):
            return None
        return found.constant, found.file

    def option(self, name: str, file: File) -> Expr | None:
        """Return the default of a command line option that a Python file adds with `add_argument`."""
        if self._options is None:
            self._options = {}
            for functions in self.program.functions.values():
                for func in functions:
                    if func.file.language == "python":
                        self._options |= {(func.file, key): value for key, value in _options(func)}
        return self._options.get((file, name))


def _member_target(statement: Statement, params: set[str]) -> str:
    target = statement.target
    if is_own_member(target):
        return target.name
    if (
        isinstance(target, Name)
        and statement.kind in {"set", "init"}
        and (statement.kind == "init" or target.id not in params)
    ):
        return target.id
    return ""


def _begins(target: Member, statement: Statement, func: Func) -> bool:
    """Tell whether the body of a class of Python gives it an attribute, as its fields tell."""
    if func.fact.name != "<module>" or statement.depth or not isinstance(target.base, Name):
        return False
    owners = (each for each in func.file.facts.classes if each.name == target.base.id and not each.scope)
    return any(each.line <= statement.line <= each.end_line for each in owners)


def _touched(method: Func) -> Set[str]:
    """Names of members, or of what may be one, that a method assigns, calls a method of, or hands to somebody."""
    own = {parameter.name for parameter in method.fact.params}
    own |= {s.target.id for s in method.fact.body if s.kind == "let" and isinstance(s.target, Name)}
    targets: list[Expr | None] = [s.target for s in method.fact.body if s.kind != "let"]
    targets += [unstarred(part) for target in targets if isinstance(target, Items) for part in target.items]
    for call in (call for calls in method.calls for call in calls):
        targets += [call.callee.base if isinstance(call.callee, Member) else None, *call.args]
    found = {name for target in targets if (name := _reached(target, own))}
    if method.file.language == "python":
        return _meant(method, found)
    local = {name for target in targets if (name := _reached(target, set())) in own}
    return found | (_meant(method, local) - own)


def _meant(method: Func, names: Set[str]) -> Set[str]:
    """Names with those that they are bound to, or to what comes from them."""
    known, python = set(names), method.file.language == "python"
    binding = [entry for entry in method.fact.body if python or refers(entry)]
    while more := {name for entry in binding for name in _bound_to(entry, known)} - known:
        known |= more
    return known


def _bound_to(statement: Statement, names: Set[str]) -> Iterator[str]:
    """Yield the names and the members in what a statement binds one of some names to; a new text is none of them."""
    if makes_text(statement.value):
        return
    target = statement.target
    parts = map(unstarred, target.items) if isinstance(target, Items) else (target,)
    if statement.kind != "do" and any(isinstance(part, Name) and part.id in names for part in parts):
        yield from (expr.name for expr, _ in expressions(statement) if is_own_member(expr))
        yield from names_in(statement.value)


def _reached(expr: Expr | None, own: set[str]) -> str:
    """The name of the member that an expression is or leads into; `own` are the names of the method itself."""
    while expr is not None:
        if isinstance(expr, Name):
            return "" if expr.id in own else expr.id
        if is_own_member(expr):
            return expr.name
        expr = whole_of(expr)
    return ""


def _options(func: Func) -> Iterator[tuple[str, Expr]]:
    for calls in func.calls:
        for call in calls:
            if isinstance(call.callee, Member) and call.callee.name == "add_argument":
                keywords = _with_flag(dict(call.keywords))
                dest = keywords.get("dest") or next((arg for arg in call.args if _is_long(arg)), None)
                if isinstance(dest, Text) and "default" in keywords:
                    yield dest.value.lstrip("-").replace("-", "_"), keywords["default"]


def _with_flag(keywords: dict[str, Expr]) -> dict[str, Expr]:
    """`action="store_true"` is false unless it is given."""
    action = keywords.get("action")
    flag = _FLAGS.get(action.value) if isinstance(action, Text) else None
    return keywords if flag is None else {"default": kinds.Constant(flag), **keywords}


def _is_long(arg: Expr) -> bool:
    return isinstance(arg, Text) and (arg.value.startswith("--") or not arg.value.startswith("-"))


def _nothing(expr: Expr, env: Env) -> Sequence[Sequence[Held]]:
    return ()
