"""Functions of a tree that declare or read the parameter which they are asked for, and give its value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr

from ecm_extract.link.declaring.instead import given_instead
from ecm_extract.link.declaring.match import name_argument, positions
from ecm_extract.link.declaring.parameters import Parameters
from ecm_extract.link.declaring.site import Site

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def remember_wrapper(site: Site, folder: Folder, parameters: Parameters) -> None:
    """Note that a function which declares the parameter it is asked for also gives its value."""
    name = _parameter_of(name_argument(site.form, site.call), site, folder)
    stated = next(positions(site.form.default, site.call), None)
    out = next(positions(site.form.out, site.call), None)
    default = _parameter_of(stated or given_instead(site.call, out), site, folder)
    if name:
        parameters.add_wrapper(site.root, name, default)


def _parameter_of(expr: Expr | None, site: Site, folder: Folder) -> str:
    """Return the parameter of the outermost function that an argument comes from, empty for none."""
    labels = folder.fold(expr, site.env)[0].open("param") if expr is not None else frozenset()
    return next((entry.name for entry in reversed(site.root.fact.params) if entry.name in labels), "")
