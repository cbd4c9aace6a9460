"""What rows imply about names: whole names, and private ones, which a handle that the call is given makes public."""

from __future__ import annotations

from ecm_extract.link.code.texts import is_text
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.placing import PRIVATE
from ecm_extract.link.naming.handle import Handle
from ecm_extract.link.naming.names import RosName, endpoint_name, parameter_name
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


def name_below(site: Site, value: Value, handle: Handle, node: str | None) -> RosName:
    """Return the name of what a call makes, below its handle."""
    if site.is_absolute:
        return RosName(value.text, value.text)
    make = parameter_name if site.form.row.value else endpoint_name
    return make(value, handle, node, site.root.file.ros)


def _is_given_handle(site: Site, folder: Folder) -> bool:
    """Tell whether a call is given a handle, or a text of which one is made."""
    given = next(positions(site.form.node, site.call), None)
    if given is None or is_text(given, site.call.func):
        return given is not None
    return any(word in folder.objects.type_of(given, site.env) for word in ("NodeHandle", "string"))
