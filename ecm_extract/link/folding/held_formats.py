"""Formats that a variable holds: `TOPIC = "{}/cmd"`, then `TOPIC.format(x)`, `TOPIC % x`, `fmt::format(topic, x)`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr, Member, Name, Text
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.folding.formats import BRACED, FORMATTING
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_HELD: Final = (Name, Member)


def with_text(expr: Expr, env: Env, folder: Folder) -> Expr:
    """Return the text that a variable surely holds, of which nothing is open; any other expression as it is."""
    values = folder.fold(expr, env) if isinstance(expr, _HELD) else ()
    text = data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else None
    return Text(text) if isinstance(text, str) else expr


def with_format(call: Invocation, env: Env, folder: Folder) -> Invocation:
    """Return a formatting call with its format in place of the variable that holds it; any other call as it is."""
    if call.last in BRACED and call.receiver is not None:
        return replace(call, receiver=with_text(call.receiver, env, folder))
    if call.path in FORMATTING and call.args:
        return replace(call, args=(with_text(call.args[0], env, folder), *call.args[1:]))
    return call
