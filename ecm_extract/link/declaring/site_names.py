"""Names that sites are given, folded once; one that nobody tells, as its states are told, costs no word."""

from __future__ import annotations

from typing import Final

from ecm_extract.link.declaring.match import name_argument
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.steps import is_left_out, is_too_deep
from ecm_extract.link.running.values import Value, alternatives, unknown, without_defaults

_HANDED: Final = frozenset({"param", "made"})
"""Kinds of holes of which the callers of a function know."""


class SiteNames:
    """Folds the names of sites.

    Args:
        folder: what values are.
    """

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Site, tuple[Value, ...]] = {}

    def of(self, site: Site) -> tuple[Value, ...]:
        """Return the possible names that a site is given."""
        known = self._known.get(site)
        if known is None:
            name = name_argument(site.form, site.call)
            with self.folder.steps.without_a_word():
                values = self.folder.fold(name, site.env) if name is not None else ()
            if self.folder.replaced.may_be(site.call, site.env):
                values = alternatives((*values, unknown(site.call.last)))
            known = self._known[site] = values
        return known

    def told(self, site: Site, is_open: bool) -> tuple[Value, ...]:
        """Return the names of a site that is told, and note it where a bound left some out.

        Args:
            site: the site.
            is_open: whether somebody may hand its outermost function something else than the defaults that this has.
        """
        values = self.of(site)
        if any(map(is_left_out, values)):
            self.folder.steps.leave_out(site.env)
        if any(map(is_too_deep, values)):
            self.folder.steps.give_up(site.env)
        others = (without_defaults(value, _HANDED) for value in values) if is_open else ()
        return tuple(dict.fromkeys((*values, *others)))
