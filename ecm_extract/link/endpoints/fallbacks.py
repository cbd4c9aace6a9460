"""What a variable holds when the parameter that was to be read into it is not set.

ROS 1 writes `if (!nh.getParam("rate", rate)) rate = 10.0;`, or gives the variable its value first.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.infer.held import Held, all_ways
from ecm_extract.link.code.own import own_name
from ecm_extract.link.declaring.handed_instead import handed_instead
from ecm_extract.link.declaring.instead import (
    assigned_instead,
    assigned_otherwise,
    goes_on,
    is_denied,
    is_made_over,
    returned_instead,
)
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value

_AS_FOUND: Final = frozenset({"given", "shared", "made", "entered"})
"""How a function has what it gave nothing itself (see `held`)."""


def default_of(site: Site, names: Sequence[Value], folder: Folder) -> Expr | None:
    """Return the default of a parameter: of its call unless its node declares it, else what stands in its place."""
    stated = next(positions(site.form.default, site.call), None)
    if site.form.fallback and folder.parameters.is_declared(names, site.env):
        return None
    return stated or _fallback(site, site.call.at, folder)


def _fallback(site: Site, at: int, folder: Folder) -> Expr | None:
    """The default of a parameter whose call has none; `at` is the statement of the call."""
    out = next(positions(site.form.out, site.call), None)
    instead = returned_instead(site.call, out)
    if instead is not None or site.form.default or not isinstance(out, Name | Member):
        return instead
    if is_made_over(site.call, out):
        return None
    otherwise = assigned_otherwise(site.call, out) if not is_denied(site.call) else None
    if otherwise is not None:
        return otherwise
    keeps = goes_on(site.call)
    if is_denied(site.call) and not keeps:
        return assigned_instead(site.call, out, at) or handed_instead(site.call, out)
    keeps = keeps or (isinstance(site.call.statement.value, Call) and site.call.statement.kind == "do")
    return _held_before(out, site.env, folder) if keeps and not _is_of_another(out, site, folder) else None


def _is_of_another(out: Name | Member, site: Site, folder: Folder) -> bool:
    """Tell whether the variable has what another parameter was, or the default that belongs to that."""
    before = (held for helds in folder.flow.ways(out, site.env) for held in all_ways(helds))
    return any(held.how == "read" and held.expr != site.call.args[0] for held in before)


def _held_before(out: Name | Member, env: Env, folder: Folder) -> Expr | None:
    """What the variable was made with: by the function itself, of a member by its class, constructor or callers."""
    if isinstance(out, Member) and out.base != THIS:
        return None
    ways = [held for helds in folder.flow.ways(out, env) for held in helds]
    if ways and all(held.how not in _AS_FOUND for held in ways):
        return out
    key = folder.flow.effects(env.func).key(out)
    if isinstance(out, Name) and not key.startswith(".") and folder.scope.locals_of(env.func).get(out.id):
        return None
    if all(held.how in {"given", "entered"} for held in ways) and _is_left_by_callers(key, env, folder):
        return out
    own = (
        held for held in folder.origins.of(out, env) if held.env is not None and not _is_stated(held, out, env, folder)
    )
    begun = _is_begun(out, env, folder)
    return out if all(_is_first(held, env, begun=begun) for held in own) else None


def _is_begun(out: Name | Member, env: Env, folder: Folder) -> bool:
    """Tell whether the class of the object at hand states what a member begins with."""
    cls = env.this or env.func.cls
    lineage = folder.program.ancestry(cls) if cls is not None else ()
    fields = (each.fields.get(own_name(out)) for each in lineage)
    return any(field is not None and field.default is not None for field in fields)


def _is_first(held: Held, env: Env, *, begun: bool) -> bool:
    """Tell whether a variable was given something by a constructor, or by no more than reads of the function at hand.

    What the function gives it otherwise is not before the read, or not on every way. Of a constructor that reads itself
    it is behind the read, so nothing that counts where the class states what the variable begins with; nor do its
    later reads then, which are all that there is of a member that nobody gives anything.
    """
    func = held.env.func if held.env is not None else None
    if func is None or func is not env.func:
        return func is not None and func.is_constructor
    if begun and func.is_constructor:
        return True
    return held.how == "read" and not (func.is_constructor and held.at > env.at)


def _is_left_by_callers(key: str, env: Env, folder: Folder) -> bool:
    """Tell whether all callers of a method are known, and each gave a member something on every way before."""
    entered = folder.states.entered(key, env)
    pending = [(entered, env)] if entered is not None else []
    asked = {env.func}
    while pending:
        held, place = pending.pop()
        place = held.env or place
        if held.how == "given":
            before = folder.states.entered(key, place) if place.func not in asked else None
            asked.add(place.func)
            if before is None:
                return False
            pending.append((before, place))
        elif held.how == "entered":
            pending += [(each, place) for each in held.before]
        elif held.how in _AS_FOUND:
            return False
    return entered is not None


def _is_stated(held: Held, out: Expr, env: Env, folder: Folder) -> bool:
    """Tell whether it is what a variable of a namespace is declared with, which no function gives it."""
    stated = folder.objects.file_scope.meant(out.id, env.func) if isinstance(out, Name) and held.at < 0 else None
    return stated is not None and held.expr is stated.constant.value
