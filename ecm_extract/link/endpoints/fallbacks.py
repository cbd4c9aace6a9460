"""What a variable holds when the parameter that was to be read into it is not set.

ROS 1 writes `if (!nh.getParam("rate", rate)) rate = 10.0;`, or gives the variable its value first.
"""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.infer.held import Held
from ecm_extract.link.declaring.handed_instead import handed_instead
from ecm_extract.link.declaring.instead import assigned_instead, goes_on, is_denied, returned_instead
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env


def fallback(site: Site, at: int, folder: Folder) -> Expr | None:
    """Return the default of a parameter whose call has none; `at` is the statement of the call."""
    out = next(positions(site.form.out, site.call), None)
    instead = returned_instead(site.call, out)
    if instead is not None or site.form.default or not isinstance(out, Name | Member):
        return instead
    if goes_on(site.call):
        return _held_before(out, site.env, folder)
    if is_denied(site.call):
        return assigned_instead(site.call, out, at) or handed_instead(site.call, out)
    plainly = isinstance(site.call.statement.value, Call) and site.call.statement.kind == "do"
    return _held_before(out, site.env, folder) if plainly else None


def _held_before(out: Name | Member, env: Env, folder: Folder) -> Expr | None:
    """What the variable was made with: a local in the same function, a member by its class or constructor."""
    if isinstance(out, Member) and out.base != Name("this"):
        return None
    if isinstance(out, Name) and folder.scope.locals_of(env.func).get(out.id):
        return out if folder.scope.is_certain(out.id, env) else None
    own = (
        held for held in folder.origins.of(out, env) if held.env is not None and not _is_stated(held, out, env, folder)
    )
    given = (held.env.func for held in own if held.env is not None)
    return out if all(func.is_constructor or func is env.func for func in given) else None


def _is_stated(held: Held, out: Expr, env: Env, folder: Folder) -> bool:
    """Tell whether it is what a variable of a namespace is declared with, which no function gives it."""
    stated = folder.objects.file_scope.meant(out.id, env.func) if isinstance(out, Name) and held.at < 0 else None
    return stated is not None and held.expr is stated.constant.value
