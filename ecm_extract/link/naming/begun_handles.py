"""Handles that a class of C++ declares its members with: `ros::NodeHandle pnh_{"~"};`, `nh_ = ros::NodeHandle("~")`.

What a constructor gives such a member in its list stands in the place of that; without one the member begins so
([class.base.init] of the C++ standard).
"""

from __future__ import annotations

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name

from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.spelling import by_value, plain
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.env import Env


def begun_handle(expr: Name | Member, env: Env, program: Program) -> Expr | None:
    """Return what makes the handle that a member of the object at hand is declared with; None for all others."""
    cls = env.this or env.func.cls
    name = own_name(expr)
    if cls is None or not name or env.func.file.language != "cpp":
        return None
    lineage = program.ancestry(cls)
    field = next((entry.fields[name] for entry in lineage if name in entry.fields), None)
    if field is None or field.default is None:
        return None
    if not by_value(field.type) or isinstance(field.default, Call):
        return _of_object(field.default, lineage)
    given = field.default.items if isinstance(field.default, Items) else (field.default,)  # one literal has no braces
    if not given:
        return None
    return Call(Name(plain(field.type)), tuple(_of_object(each, lineage) for each in given))


def _of_object(expr: Expr, lineage: tuple[Cls, ...]) -> Expr:
    """A name of a member as one, which no variable of the function at hand hides."""
    if isinstance(expr, Name) and any(expr.id in entry.fields for entry in lineage):
        return Member(THIS, expr.id)
    if isinstance(expr, Call):
        return Call(expr.callee, tuple(_of_object(each, lineage) for each in expr.args), expr.keywords, expr.types)
    return expr
