"""Profile classes of the tree: what their constructors hand to their bases, then what they set on themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol

from ecm_parsers.source.expr import THIS, Call, Expr, Member
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Block, Branch, Leave, blocks, steps
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.endpoints.qos_made import Evaluating, Policies, QosMade
from ecm_extract.link.endpoints.qos_presets import UNSEEN, agreed
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_PROFILE: Final = "QoSProfile"
"""The profile of rclpy (rclpy/qos.py)."""
_MAKER: Final = "__init__"


class Setting(Evaluating, Protocol):
    """Evaluates profiles, and calls that set something of them."""

    def set_by(self, expr: Call, env: Env) -> Policies:
        """Return what one setter sets."""

    def chain(self, expr: Call, env: Env) -> Policies:
        """Return what a chain of setters sets."""


class OwnProfiles:
    """Tells what an object of a profile class of the tree is made as."""

    def __init__(self, folder: Folder, profiles: Setting, made: QosMade) -> None:
        self.folder = folder
        self.profiles = profiles
        self.made = made

    def of_call(self, expr: Call, env: Env, level: int) -> Policies | None:
        """Return the policies of what a call makes; None where that is no object of a class of the tree."""
        call = invocation_of(expr, env)
        cls = self.folder.program.class_named(call.path, env.func.file, env.scope)
        if cls is not None and cls.file.language == "python":
            return self._of_python(cls, expr, call, env, level) if self._is_profile(cls) else None
        maker = self.folder.objects.constructor(cls, len(call.args)) if cls is not None else None
        if cls is None or maker is None:
            return None
        place = Env(maker, 0, bind(maker, call, env), this=cls, depth=env.depth + 1)
        return self._of_maker(place, level)

    def _of_maker(self, place: Env, level: int) -> Policies:
        """What a constructor makes; of one that may end early, or has its methods set something, nobody knows it."""
        block = self.folder.flow.outline(place.func).block
        return self._of_block(block, place, {}, level) if self._shows_all(place.func) else dict(UNSEEN)

    def _shows_all(self, maker: Func) -> bool:
        """Whether all that a constructor sets stands in its own steps, of which each run takes every one."""
        left = any(isinstance(step, Leave) and step.how == "return" for step in steps(maker.fact.flow))
        if left or any(entry.kind == "return" for entry in maker.fact.body):
            return False
        calls = ((call, at) for at, group in enumerate(maker.calls) for call in group)
        found = (self.folder.flow.target(call, maker, at) for call, at in calls)
        return all(method is None or method.is_constructor or method.cls is None for method in found)

    def _is_profile(self, cls: Cls) -> bool:
        lineage = self.folder.program.ancestry(cls)
        return any(last_name(base).rpartition(".")[2] == _PROFILE for each in lineage for base in each.fact.bases)

    def _of_python(self, cls: Cls, expr: Call, call: Invocation, env: Env, level: int) -> Policies:
        """What the nearest constructor makes; without any in the tree it is that of the library."""
        maker = self.folder.objects.constructor(cls, len(call.args))
        if maker is None or maker.cls is None:
            return self.made.of_call(_PROFILE, expr, env, level + 1)
        return self._of_maker(Env(maker, 0, bind(maker, call, env), this=cls, depth=env.depth + 1), level)

    def _of_block(self, block: Block, place: Env, policies: Policies, level: int) -> Policies:
        """What steps make of a profile; of a branch the side that its condition is known to take, else what both do."""
        for step in block:
            if isinstance(step, int):
                found = self._of_statement(place.func.fact.body[step], place.within(None, step), level)
                policies = policies | found
            elif isinstance(step, Branch):
                holds = self.folder.flow.truth(step.test, place)
                sides = (step.then, step.other) if holds is None else (step.then if holds else step.other,)
                policies = agreed([self._of_block(side, place, policies, level) for side in sides])
            elif not isinstance(step, Leave):
                ways = [self._of_block(each, place, policies, level) for each in blocks(step)]
                policies = agreed([policies, *ways])
        return policies

    def _of_statement(self, statement: Statement, env: Env, level: int) -> Policies:
        value = statement.value
        if env.func.file.language == "python":
            return self._of_python_statement(statement, env, level)
        if statement.kind == "init" and value is not None:
            return self.profiles.policies(value, env, level + 1)
        if statement.kind == "do" and isinstance(value, Call):
            return self.profiles.chain(value, env) or self.profiles.set_by(value, env)
        return {}

    def _of_python_statement(self, statement: Statement, env: Env, level: int) -> Policies:
        value, target, cls = statement.value, statement.target, env.func.cls
        if isinstance(target, Member) and target.base == THIS and value is not None:
            return self.profiles.assigned(target.name, value, env)
        if not isinstance(value, Call) or not isinstance(value.callee, Member) or value.callee.name != _MAKER:
            return {}
        call = replace(value, args=_without_object(value.args))
        parent = next(iter(self.folder.program.bases(cls)), None) if cls is not None else None
        if parent is None:
            return self.made.of_call(_PROFILE, call, env, level + 1)
        return self._of_python(parent, call, invocation_of(call, env), env, level + 1)


def _without_object(args: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """What a constructor is given beside its object: `Base.__init__(self, depth=1)`."""
    return args[1:] if args[:1] == (THIS,) else args
