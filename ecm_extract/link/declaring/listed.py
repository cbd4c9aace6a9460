"""Parameters that one call declares as a list: `declare_parameters("camera", [("rate", 30), ("topic", "image")])`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ecm_parsers.source.expr import Opaque

from ecm_extract.link.declaring.match import name_argument, positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.data import stated_type
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.values import Value, literal, weaker


class Listed(NamedTuple):
    """A parameter by its whole name, with its default where it has one."""

    name: Value
    default: Bound | None


def listed_parameters(site: Site, folder: Folder) -> Iterator[Listed]:
    """Yield the parameters that the call of a site lists; nothing where the list is not known."""
    prefixes = _prefixes(site, folder)
    for entry in folder.lists.items(next(positions(site.form.items, site.call), None), site.env) or ():
        name, *rest = folder.lists.items(entry.expr, entry.env) or [Bound(Opaque("parameters"), entry.env)]
        for value in folder.lists.fold(name, site.env):
            yield from (Listed(_below(prefix, value), rest[0] if rest else None) for prefix in prefixes)


def defaults_of(site: Site, names: Iterable[Value], folder: Folder) -> Iterable[Listed]:
    """Return the parameters of a site, by the names that it declares, with their defaults."""
    if site.form.items:
        return listed_parameters(site, folder)
    default = next(positions(site.form.default, site.call), None)
    if default is None or name_argument(site.form, site.call) is None:
        return ()
    return [Listed(name, Bound(default, site.env)) for name in names]


def bare_names(site: Site, names: Iterable[Value], folder: Folder) -> list[Value]:
    """Return the parameters that a site declares without a default, by a type or by nothing but their names.

    Source: rclpy.readthedocs.io, "Node" (`declare_parameter`, `declare_parameters`): what has no value is not set.
    """
    if site.form.ros != 2 or site.form.undeclared or site.chain:
        return []
    if site.form.items:
        return [each.name for each in listed_parameters(site, folder) if _is_bare(each.default)]
    default = next(positions(site.form.default, site.call), None)
    given = Bound(default, site.env) if default is not None else None
    return list(names) if _is_bare(given) and name_argument(site.form, site.call) is not None else []


def _is_bare(default: Bound | None) -> bool:
    return default is None or stated_type(default.expr) is not None


def _prefixes(site: Site, folder: Folder) -> tuple[Value, ...]:
    given = name_argument(site.form, site.call) if site.call.args or site.call.keywords else None
    return folder.fold(given, site.env) if given is not None else (literal(""),)


def _below(prefix: Value, name: Value) -> Value:
    if not prefix.text:
        return name
    return Value((*prefix.parts, ".", *name.parts), weaker(prefix.confidence, name.confidence))
