"""Values of which one call asks for several: `get_parameters(["a", "b"])` gives what `get_parameter` does of each.

Source: rclpy/node.py.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Member, Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.other_nodes import asks_another_node
from ecm_extract.link.running.values import data_in, is_proved
from ecm_extract.shipped import shipped

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold_lists import ListFolder


@cache
def asking() -> dict[str, str]:
    """Return the methods that ask for several values, each with the one that asks for one of them."""
    rows = shipped("link/code/library_values.toml")["asked_together"]
    return {str(row["all"]): str(row["each"]) for row in rows["methods"]}


def asked_together(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    """Return the calls that ask for each of the values; None where not all of their names are known."""
    objects = lists.folder.objects
    if call.receiver is None or len(call.args) != 1 or call.keywords or asks_another_node(call, env, objects):
        return None
    names = lists.items(call.args[0], env) if objects.callee(call, env) is None else None
    values = [lists.fold(name, env) for name in names or ()]
    texts = [data_in(each[0]) for each in values if len(each) == 1 and is_proved(each[0])]
    known = [text for text in texts if isinstance(text, str)]
    if names is None or len(known) != len(names):
        return None
    each = Member(call.receiver, asking()[call.last])
    return [Bound(Call(each, (Text(name),), (), (), call.line), env) for name in known]
