"""Types of fields of messages that other packages define, of which a tree has no source."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Expr, Member

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped

_FIELDS: Final = shipped("link/endpoints/message_fields.toml")


def written_type(expr: Expr, env: Env, folder: Folder) -> str:
    """Return the type of a variable, or of a field of a message that it is, as written; empty when nothing shows it."""
    written = folder.objects.type_of(expr, env)
    if written or not isinstance(expr, Member):
        return written
    message = plain(pointee(written_type(expr.base, env, folder)))
    meant = plain(folder.program.alias(message, env.func.file, env.scope) or message)
    found: str = _FIELDS.get(meant.replace("::msg::", "::"), {}).get(expr.name, "")
    return found
