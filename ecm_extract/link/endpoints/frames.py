"""The frames of a transform that code asks for or sends: as texts of a call, or in the message that it sends."""

from __future__ import annotations

from ecm_parsers.source.expr import Expr, Member

from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, unknown


def frame_of(site: Site, folder: Folder) -> str | None:
    """Return `parent <- child` as far as it is known; None for a message of which no frame is."""
    exprs = list(positions(site.form.frame, site.call))
    if "field:" not in site.form.frame:
        return " <- ".join(folder.fold(expr, site.env)[0].text for expr in exprs) or None
    values = [_written(expr, site.env, folder) for expr in exprs]
    known = any(value.confidence != "pattern" for value in values)
    return " <- ".join(value.text for value in values) if known else None


def _written(expr: Expr, env: Env, folder: Folder) -> Value:
    """What a field of a message holds; one of several is not told for the one."""
    values = folder.fold(expr, env)
    return values[0] if len(values) == 1 else unknown(expr.name if isinstance(expr, Member) else "frame")
