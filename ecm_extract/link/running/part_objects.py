"""Objects that are parts of others, or that stand in an expression: the beginnings of the constructors that make them.

Of a member this is known when one constructor makes it, and nobody calls anything of it that changes it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import MAX_DEPTH, Env, Instance, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class PartObjects:
    """Finds what makes such objects; who changes a member is worked out once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._steady: dict[tuple[Cls, str], bool] = {}
        self._shown: dict[tuple[Func, Call], Expr | None] = {}

    def maker(self, expr: Expr | None, env: Env) -> Env | None:
        """Return the beginning of the constructor that makes an object; None of others."""
        if env.func.file.language != "cpp" or env.depth > MAX_DEPTH:
            return None
        if isinstance(expr, Call):
            return self.folder.states.constructor(expr, env) or self._returned(expr, env)
        name = self._member(expr, env)
        return self._of_member(name, env) if name else None

    def shown(self, call: Call, func: Func) -> Expr | None:
        """Return the part of an object that a method does nothing with but give a reference to; None of other calls.

        Of Python also the variable that a function beside the one at hand, or within it, does nothing with but give.
        """
        key = (func, call)
        if key not in self._shown:
            self._shown[key] = None  # who asks in a circle
            self._shown[key] = self._shown_by(call, func)
        return self._shown[key]

    def _shown_by(self, call: Call, func: Func) -> Expr | None:
        own = isinstance(call.callee, Name) and (func.cls is not None or func.file.language == "python")
        base = call.callee.base if isinstance(call.callee, Member) else THIS if own else None
        if base is None or call.args or call.keywords:
            return None
        callee = self.folder.flow.target(call, func, len(func.fact.body))
        if func.file.language == "python":
            return self._given_by(callee, base, func) if callee is not None else None
        cls = callee.cls if callee is not None else None
        if callee is None or cls is None or "reference" not in callee.fact.traits or len(callee.fact.body) != 1:
            return None
        if own and (func.cls is None or cls not in self.folder.program.ancestry(func.cls)):
            return None
        derived = (method for entry in self.folder.program.derived(cls) for method in entry.methods)
        if any(method.fact.name == callee.fact.name for method in derived):
            return None
        given = callee.fact.body[0].value
        if given == THIS:
            return base
        name = own_name(given)
        return Member(base, name) if name in cls.fields else None

    def _given_by(self, callee: Func, base: Expr, func: Func) -> Expr | None:
        """What a function of Python gives that does nothing else: a member of its object, a variable around both."""
        body = callee.fact.body
        given = body[0].value if len(body) == 1 and body[0].kind == "return" and not callee.fact.decorators else None
        if isinstance(given, Member) and given.base == THIS:
            return Member(base, given.name) if base != THIS or func.cls is not None else None
        if not isinstance(given, Name) or given.id in callee.given or callee.file is not func.file:
            return None
        inside = self.folder.nesting.enclosing(callee) is func
        return given if inside or given.id not in self.folder.flow.effects(func).own else None

    def _member(self, expr: Expr | None, env: Env) -> str:
        """The member of the object at hand that an expression is, in a lambda that of the method around it."""
        key = self.folder.flow.effects(env.func).key(expr)
        if key.startswith("."):
            return key[1:] if key.count(".") == 1 else ""
        around = env.func if isinstance(expr, Name) and "lambda" in env.func.fact.traits else None
        while around is not None and key not in self.folder.flow.effects(around).own:
            if around.cls is not None:
                return key
            around = self.folder.nesting.enclosing(around)
        return ""

    def _returned(self, expr: Call, env: Env) -> Env | None:
        """What makes the object that a function of the tree returns."""
        call = invocation_of(expr, env)
        callee = self.folder.returns.meant(call, env)
        if callee is None or not by_value(callee.fact.returns):
            return None
        found = self.folder.returns.returned(callee, call, env.deeper(env.depth + 1))
        value, place = found[0] if len(found) == 1 else (None, env)
        return self.maker(value, place) if isinstance(value, Call) else None

    # --- members -------------------------------------------------------------------------------------------

    def _of_member(self, name: str, env: Env) -> Env | None:
        owner = env.this or self.folder.nesting.object_of(env.func)
        cls = self._class_of(name, owner, env)
        if owner is None or cls is None or not self._is_steady(name, cls, owner):
            return None
        makers = [func for func in owner.methods if func.is_constructor and func.fact.body]
        begun = [(func, at) for func in makers for at in _beginnings(name, func)]
        if len(begun) != 1 or len(makers) != 1:
            return None
        func, at = begun[0]
        known = env.made if env.made is not None and env.made.maker is func else None
        place = Env(func, at, known.args if known is not None else {}, this=owner, made=known, depth=env.depth + 1)
        return self._begun(cls, name, place)

    def _class_of(self, name: str, owner: Cls | None, env: Env) -> Cls | None:
        written = owner.fields[name].type if owner is not None and name in owner.fields else ""
        return self.folder.objects.class_written(written, env) if by_value(written) else None

    def _begun(self, cls: Cls, name: str, place: Env) -> Env | None:
        """The constructor that an initialiser calls, with what it gets there."""
        value = place.func.fact.body[place.at].value
        given = value.args if isinstance(value, Call) and value.callee == Name(name) else (value,) if value else ()
        call = invocation_of(Call(Name(cls.fact.name), tuple(given)), place)
        maker = self.folder.objects.constructor(cls, call)
        if maker is None or not maker.fact.body:
            return None
        args = bind(maker, call, place)
        return Env(maker, 0, args, this=cls, made=Instance(cls, args, {}, maker), depth=place.depth + 1)

    def _is_steady(self, name: str, cls: Cls, owner: Cls) -> bool:
        """Whether no method changes a member once it is made: what is called of it changes nothing."""
        known = self._steady.get((owner, name))
        if known is None:
            self._steady[owner, name] = False  # who asks in a circle
            program = self.folder.program
            lineage = (*program.ancestry(owner), *program.derived(owner))
            changing = [method for entry in lineage for method in self.folder.scope.changing(name, entry)]
            inner = [func for method in changing for func in (method, *self.folder.nesting.inner(method))]
            calm = all(self._leaves(name, cls, func) for func in inner)
            outside = self.folder.states.callers.may_be_written_outside(name, changing[0]) if changing else False
            known = self._steady[owner, name] = calm and not outside
        return known

    def _leaves(self, name: str, cls: Cls, func: Func) -> bool:
        """Whether a function does nothing with a member but make it, and call what changes nothing."""
        changes = self.folder.flow.outline(func).changes
        begun = sum(1 for _ in _beginnings(name, func))
        for key in (f".{name}", name):
            if changes.get(key, 0) > begun or any(each.startswith(f"{key}.") for each in changes):
                return False
        named = [callee.name for group in func.calls for call in group if (callee := _on(call, name)) is not None]
        return all(self._is_calm(method, cls) for method in named)

    def _is_calm(self, method: str, cls: Cls) -> bool:
        """Whether no method of a name of a class changes a member of its object, or gives others a way to."""
        lineage = self.folder.program.ancestry(cls)
        found = [each for entry in lineage for each in entry.methods if each.fact.name == method and each.fact.body]
        given = (each for each in found if "reference" in each.fact.traits)
        shown = all(each.fact.returns.startswith("const ") for each in given)
        return bool(found) and shown and all(self.folder.methods.leaves(each, cls) for each in found)


def _on(call: Call, name: str) -> Member | None:
    """The method that a call means of a member of the object at hand; None for other calls."""
    callee = call.callee
    base = callee.base if isinstance(callee, Member) else None
    return callee if isinstance(callee, Member) and base in (Name(name), Member(THIS, name)) else None


def _beginnings(name: str, func: Func) -> Iterator[int]:
    for at, statement in enumerate(func.fact.body):
        if statement.kind == "init" and statement.target == Name(name):
            yield at
