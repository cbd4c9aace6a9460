"""Message, service and action classes that Python expressions mean: imports, arguments, variables, attributes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from ecm_checker.hub.roles import Role, roles
from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op
from ecm_parsers.source.python_literal import NULL

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.folding.chosen_objects import sides_of
from ecm_extract.link.interfaces.sent_as import wrapped
from ecm_extract.link.interfaces.type_found import ACTION, UNKNOWN_TYPE, TypeFound
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.interfaces.types import Types


class PythonTypes:
    """Follows a class from where it is asked for to where it is imported."""

    def __init__(self, types: Types) -> None:
        self.types = types
        self.folder = types.folder

    def of(self, expr: Name | Member, env: Env, role: Role) -> TypeFound:
        """Return the type that a name means at a place."""
        dotted = dotted_name(expr)
        head, *rest = dotted.split(".")
        imported = env.func.file.imported.get(head)
        found = self._imported(dotted, ".".join([imported, *rest]), env, role) if imported is not None else None
        if (found is not None and found.name is not None) or env.depth > MAX_DEPTH:
            return found or UNKNOWN_TYPE
        stated = self.folder.module_objects.each(expr, env) if isinstance(expr, Member) else []
        if stated:
            return self._of_each(stated, env, role)
        if found is not None:
            return UNKNOWN_TYPE
        return self._variable(expr, env, role) if isinstance(expr, Name) else self._attribute(expr, env, role)

    def of_choice(self, expr: Expr, env: Env, role: Role) -> TypeFound | None:
        """Return the type that a choice gives, `A if new else B`, or the one of both sides; None of anything else."""
        if env.func.file.language != "python" or not isinstance(expr, Op) or expr.op != "?:":
            return None
        sides = sides_of(Bound(expr, env.before(env.at)), self.folder)
        found = {self.types.expression(side.expr, side.env.deeper(env.depth + 1), role) for side in sides}
        return found.pop() if len(found) == 1 else UNKNOWN_TYPE

    def wrapped(self, expr: Expr, env: Env) -> Expr | None:
        """Return the class of which a call makes another one of the same message: `numpy_msg(Image)`."""
        if env.func.file.language != "python" or not isinstance(expr, Call):
            return None
        at = wrapped(self.types.program.outside(dotted_name(expr.callee), env.func.file))
        return expr.args[at] if at is not None and at < len(expr.args) else None

    def returned(self, expr: Expr, env: Env, role: Role) -> TypeFound:
        """Return the class that a function of the tree gives wherever it returns: `def kind(self): return Image`."""
        if env.func.file.language != "python" or not isinstance(expr, Call) or env.depth > MAX_DEPTH:
            return UNKNOWN_TYPE
        call, returns = invocation_of(expr, env), self.folder.returns
        callee = returns.meant(call, env)
        if callee is None or self.folder.redefined.may_be(callee, call, env) or not self.folder.steps.take(env):
            return UNKNOWN_TYPE
        with self.folder.steps:
            given = returns.returned(callee, call, env.deeper(env.depth + 1))
            found = {self.types.expression(value, place, role) for value, place in given}
        return found.pop() if len(found) == 1 else UNKNOWN_TYPE

    def _imported(self, dotted: str, path: str, env: Env, role: Role) -> TypeFound:
        """What is below a `msg`, `srv` or `action`; what a module has is what it is called outside."""
        full = self.types.full(path.replace(".", "::"), role) if path.count(".") > 1 and path[0] != "." else None
        outside = self.types.program.outside(dotted, env.func.file) if full is None else ""
        whole = f"{env.func.file.package}.{outside.lstrip('.')}" if outside.startswith(".") else outside
        return TypeFound(full or (self.types.full(whole.replace(".", "::"), role) if whole.count(".") > 1 else None))

    def _variable(self, expr: Name, env: Env, role: Role) -> TypeFound:
        bound = self.folder.names.argument(expr.id, env)
        if bound is not None:
            return self.types.expression(bound.expr, bound.env, role)
        if expr.id in env.func.given:
            return TypeFound(None, frozenset({expr.id}))
        helds = [held for way in self.folder.flow.ways(expr, env) for held in way]
        if any(_handed(held).how != "given" for held in helds):
            return self._only(helds, env, role)
        return self._starred(expr.id, env, role)

    def _attribute(self, expr: Member, env: Env, role: Role) -> TypeFound:
        """`self.kind`: what methods give it, else what the class or its nearest base says."""
        cls = env.this or env.func.cls
        if expr.base != THIS or cls is None:
            spelled = self._spelled_out(dotted_name(expr), env, role)
            return spelled if spelled.name is not None else self._of_object(expr, env, role)
        given = (held for held, _ in self.folder.members.sources(expr.name, cls, env))
        found = self._only(given, env, role)
        return found if found.name is not None or found.open else self._declared(expr.name, env, role)

    def _of_each(self, stated: Iterable[Bound], env: Env, role: Role) -> TypeFound:
        """The one type that the members of all objects are which one may be."""
        members = ((each.expr, each.env.deeper(env.depth + 1)) for each in stated if isinstance(each.expr, Member))
        found = {self._of_object(member, place, role) for member, place in members}
        return found.pop() if len(found) == 1 else UNKNOWN_TYPE

    def _of_object(self, expr: Member, env: Env, role: Role) -> TypeFound:
        """`self.types.kind`: what the constructor of the one object that this is leaves there, if nobody changes it."""
        maker = self.folder.makers.of_python(expr.base, env)
        if maker is None or maker.this is None or self._is_given_elsewhere(expr.name):
            return UNKNOWN_TYPE
        given = self.folder.members.sources(expr.name, maker.this, maker)
        return self._only((held for held, _ in given), env, role)

    def _is_given_elsewhere(self, name: str) -> bool:
        """Whether others than methods give a field of that name of some object anything but `None`, no type."""
        given = (entry.statement.value for entry in self.folder.scope.assigned_outside(name, "python"))
        return any(value != NULL for value in given)

    def _spelled_out(self, dotted: str, env: Env, role: Role) -> TypeFound:
        """`pkg.msg.Name` of a module that the file only takes names of: one of its stars binds the package itself."""
        module = dotted.rpartition(".")[0]
        taken = "." in module and any(entry.module == module for entry in env.func.file.facts.imports)
        return TypeFound(self.types.full(dotted.replace(".", "::"), role)) if taken else UNKNOWN_TYPE

    def _declared(self, name: str, env: Env, role: Role) -> TypeFound:
        cls = env.this or env.func.cls
        lineage = self.folder.program.ancestry(cls) if cls is not None else ()
        for owner in lineage:
            default = owner.fields[name].default if name in owner.fields else None
            if default is not None:
                place = self.folder.names.at_file(owner.file, env)
                return self.types.expression(default, Env(place.func, depth=env.depth + 1), role)
        return UNKNOWN_TYPE

    def _only(self, given: Iterable[Held], env: Env, role: Role) -> TypeFound:
        """The type that a variable surely holds, else what that depends on."""
        found = dict.fromkeys(self._held(given, env, role))
        return next(iter(found)) if len(found) == 1 else next((entry for entry in found if entry.open), UNKNOWN_TYPE)

    def _held(self, given: Iterable[Held], env: Env, role: Role) -> Iterator[TypeFound]:
        for held in map(_handed, given):
            if held.how != "value" or held.expr is None or held.env is None:
                yield UNKNOWN_TYPE
            else:
                yield self.types.expression(held.expr, held.env.deeper(env.depth + 1), role)

    def _starred(self, name: str, env: Env, role: Role) -> TypeFound:
        """What the star imports of types bring, the last one that has the name."""
        starred = [entry.module for entry in env.func.file.facts.imports if entry.name == "*"]
        shape = roles()[role].shape
        wanted = {ACTION, "msg"} if shape == ACTION else {shape or "msg"}
        modules = [module for module in starred if module.rsplit(".", 1)[-1] in wanted]
        module = self.folder.program.message_starred(name, modules)
        return TypeFound(self.types.full("::".join([*module.split("."), name]), role)) if module else UNKNOWN_TYPE


def _handed(held: Held) -> Held:
    """What a variable holds that somebody was handed: a class stays that class."""
    while held.how == "handed" and len(held.before) == 1:
        held = held.before[0]
    return held
