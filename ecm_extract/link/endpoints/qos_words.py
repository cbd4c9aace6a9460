"""The policies of QoS that an expression can be: names of enumerations, and whatever holds, has or gives one."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Expr, Member, Name, Op

from ecm_extract.link.endpoints.qos_picked import PickedProfiles
from ecm_extract.link.endpoints.qos_values import policy_asked, policy_called
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.values import Enumerator, Hole, Value

_UNKNOWN: Final = "unknown"


class QosWords:
    """Tells which policies a value can be, as long as nobody sets a parameter."""

    def __init__(self, folder: Folder, picked: PickedProfiles) -> None:
        self.folder = folder
        self.picked = picked

    def of(self, value: Expr, env: Env) -> set[str]:
        """Return the policies that a value can be, `unknown` among them for what the tree does not show."""
        asked = policy_asked(value)
        if asked is not None:
            return {policy_called(each.text) or _UNKNOWN for each in self.folder.fold(asked, env)}
        likely = self._likely(value, env) if env.depth <= MAX_DEPTH else []
        if likely:
            return {word for each in likely for word in self.of(each.expr, each.env.deeper(env.depth + 1))}
        return {_named(each) or _UNKNOWN for each in self.folder.fold(value, env)}

    def _likely(self, value: Expr, env: Env) -> list[Bound]:
        """What it is by the defaults of parameters; nothing where that makes no difference, or is not known."""
        if isinstance(value, Op) and value.op == "?:":
            return [Bound(side, env) for side in self.picked.likely_side(value, env)]
        if isinstance(value, Name | Member):
            bound = self._handed(value, env) if isinstance(value, Name) else None
            if bound is not None:
                return [bound]
            helds = [held for ways in self.folder.flow.ways(value, env, likely=True) for held in ways]
            given = [Bound(held.expr, held.env) for held in helds if held.how == "value" and held.expr and held.env]
            return given if len(given) == len(helds) else []
        element = self.picked.element(value, env)
        return [element] if element is not None else []

    def _handed(self, value: Name, env: Env) -> Bound | None:
        """The argument of a parameter that the function leaves alone."""
        is_left = value.id not in self.folder.flow.outline(env.func).changes
        return self.folder.names.argument(value.id, env) if is_left else None


def _named(value: Value) -> str:
    """The policy that a constant of a client library is."""
    if isinstance(value.data, Enumerator):
        return policy_called(value.data.constant.name)
    only = value.parts[0] if len(value.parts) == 1 else ""
    return policy_called(only.label) if isinstance(only, Hole) and only.kind == "outside" else ""
