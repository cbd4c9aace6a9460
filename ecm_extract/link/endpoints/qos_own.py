"""Profile classes of the tree: what the run of a constructor leaves the base of its object with, and its fields."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.endpoints.qos_made import Policies, QosMade
from ecm_extract.link.endpoints.qos_presets import UNSEEN
from ecm_extract.link.endpoints.qos_variables import QosVariables
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.base_calls import makes_base
from ecm_extract.link.running.env import Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_PROFILE: Final = "QoSProfile"
"""The profile of rclpy (rclpy/qos.py)."""


class OwnProfiles:
    """Tells what an object of a profile class of the tree is made as."""

    def __init__(self, folder: Folder, variables: QosVariables, made: QosMade) -> None:
        self.folder = folder
        self.variables = variables
        self.made = made

    def of_call(self, expr: Call, env: Env, level: int) -> Policies | None:
        """Return the policies of what a call makes; None where that is no object of a class of the tree."""
        call = invocation_of(expr, env)
        cls = self.folder.program.class_named(call.path, env.func.file, env.scope)
        if cls is None or (cls.file.language == "python" and not self._is_profile(cls)):
            return None
        return self._of_class(cls, expr, call, env, level)

    def _is_profile(self, cls: Cls) -> bool:
        lineage = self.folder.program.ancestry(cls)
        return any(last_name(base).rpartition(".")[2] == _PROFILE for each in lineage for base in each.fact.bases)

    def _of_class(self, cls: Cls, expr: Call, call: Invocation, env: Env, level: int) -> Policies | None:
        """What the nearest constructor makes; without any in the tree it is that of the library."""
        python = cls.file.language == "python"
        maker = self.folder.objects.constructor(cls, call)
        if maker is None or maker.cls is None:
            return self.made.of_call(_PROFILE, expr, env, level + 1) if python else None
        place = Env(maker, 0, bind(maker, call, env), this=cls, depth=env.depth + 1)
        run = self.folder.flow.run(place)
        if run is None or run.end is None or run.end.called:
            return dict(UNSEEN)
        if not python:
            return self.variables.left_of_base(run.end, place, level)
        whole = self._made_by_library(place, level)
        return self.variables.with_fields(whole, run.end) if whole is not None else dict(UNSEEN)

    def _made_by_library(self, place: Env, level: int) -> Policies | None:
        """What a constructor of Python hands to the one of its base, once in each run; None where that is not known."""
        outline, body = self.folder.flow.outline(place.func), place.func.fact.body
        made = [(at, each.value) for at, each in enumerate(body) if makes_base(each.value)]
        if len(made) != 1 or made[0][0] not in outline.certain:
            return None if made else {}
        at, value = made[0]
        return self._of_super(value, place.within(None, at), level) if isinstance(value, Call) else None

    def _of_super(self, value: Call, env: Env, level: int) -> Policies | None:
        call = replace(value, args=value.args[1:]) if value.args[:1] == (THIS,) else value
        parent = next(iter(self.folder.program.bases(env.func.cls)), None) if env.func.cls is not None else None
        if parent is None:
            return self.made.of_call(_PROFILE, call, env, level + 1)
        return self._of_class(parent, call, invocation_of(call, env), env, level + 1)
