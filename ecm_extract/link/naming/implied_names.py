"""What rows imply about names: whole names, and private ones, which a handle that the call is given makes public."""

from __future__ import annotations

from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.placing import PRIVATE
from ecm_extract.link.running.values import Value, literal


def place_at(site: Site, folder: Folder) -> str:
    """Return the place that a row says; a handle that the call is given leaves nothing private."""
    place = site.form.place
    return "" if place == PRIVATE and _is_given_handle(site, folder) else place


def fixed_name(site: Site, folder: Folder) -> Value:
    """The name that a row implies: a private one is below the handle that the call is given, if it is given one."""
    text = site.form.fixed
    of_handle = text.startswith("~") and _is_given_handle(site, folder)
    return literal(text.removeprefix("~").lstrip("/") if of_handle else text)


def _is_given_handle(site: Site, folder: Folder) -> bool:
    given = next(positions(site.form.node, site.call), None)
    return given is not None and "NodeHandle" in folder.objects.type_of(given, site.env)
