"""Fields of objects of C++ that are declared without a value, or in braces: what they begin with, till they change."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Constant, Expr, Items, Member, Name, Number, Text

from ecm_extract.link.code.units import Cls
from ecm_extract.link.folding.constructions import named_parts
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

NOTHING: Final = Items(())


def begun_field(expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return what a field of `Config config;` is there; empty of other objects, and of what nothing begins."""
    begun = begun_with(expr, env, folder)
    return demoted(folder.fold(begun.expr, begun.env)) if begun is not None and begun.expr != NOTHING else ()


def begun_with(expr: Member, env: Env, folder: Folder) -> Bound | None:
    """Return what a field of such an object is given where that is declared, `NOTHING` for nothing; None of others."""
    if env.func.file.language != "cpp":
        return None
    key = folder.flow.effects(env.func).key(expr.base)
    begun = _of_new(key[1:], env, folder) if key.startswith(".") else _of_local(expr.base, env, folder)
    return _given(expr, begun, env, folder) if begun is not None else None


def declared_field(expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return what a field of a member of the object at hand is declared with, whatever methods give it later."""
    key, cls = folder.flow.effects(env.func).key(expr.base), env.this or env.func.cls
    if cls is None or cls.file.language != "cpp" or not key.startswith(".") or key.count(".") > 1:
        return ()
    begun = _declared(key[1:], cls, folder)
    given = _given(expr, begun, env, folder) if begun is not None else None
    return demoted(folder.fold(given.expr, given.env)) if given is not None and given.expr != NOTHING else ()


def _given(expr: Member, begun: Sequence[Expr], env: Env, folder: Folder) -> Bound | None:
    """What a field is given by an object that begins with some values, `NOTHING` for nothing."""
    cls = folder.objects.class_of(expr.base, env)
    owner = folder.scope.declaring(expr.name, cls) if cls is not None else None
    if cls is None or owner is None or (begun and cls.fact.bases) or _may_give(cls, owner, folder):
        return None
    place = Env(env.func, depth=env.depth + 1, this=cls)
    parts = [Bound(each, place) for each in begun]
    given = dict(named_parts(parts)) or dict(zip(cls.filled, parts, strict=False))
    default = given[expr.name].expr if expr.name in given else owner.fields[expr.name].default
    return Bound(default if default is not None else NOTHING, place)


def _may_give(cls: Cls, owner: Cls, folder: Folder) -> bool:
    """Tell whether a constructor of an object of a class may give something to a member that it has by another one."""
    lineage = folder.program.ancestry
    return any(each.constructors for each in lineage(cls) if owner in lineage(each))


def _of_local(base: Expr, env: Env, folder: Folder) -> Sequence[Expr] | None:
    """Nothing, of a variable that is as it was declared without braces; None of others."""
    helds = {held for way in folder.flow.ways(base, env) for held in way} if isinstance(base, Name) else set()
    return () if helds and all(held.how == "made" for held in helds) else None


def _of_new(name: str, env: Env, folder: Folder) -> Sequence[Expr] | None:
    """What a member is declared with in braces; None where a method does not find it as it was declared."""
    cls = env.this or env.func.cls
    if cls is None or not folder.names.is_fresh(env) or not folder.first_methods.finds_new(env.func, name):
        return None
    helds = {held for way in folder.flow.ways(Member(THIS, name), env) for held in way}
    if env.func.is_constructor and folder.scope.declaring(name, cls) is not env.func.cls:  # that of the base came first
        return None
    return _declared(name, cls, folder) if all(held.how == "given" for held in helds) else None


def _declared(name: str, cls: Cls, folder: Folder) -> Sequence[Expr] | None:
    """What a member is declared with in braces, or nothing; None where it is declared with something else."""
    owner = folder.scope.declaring(name, cls)
    field = owner.fields[name] if owner is not None else None
    if field is None or field.default is None:
        return None if field is None else ()
    if isinstance(field.default, Text | Number | Constant):  # the parser takes the braces of one literal away
        return (field.default,)
    return field.default.items if isinstance(field.default, Items) else None
