"""What makes the object that a variable of a module or of a class of Python is, through other names for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_NAMES: Final = 6
"""Names of one object, each given by the next: `state = low.output.state`."""


class StatedObjects:
    """Follows what modules and classes state: variables that nobody gives anything later."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def made(self, expr: Expr, env: Env) -> Bound | None:
        """Return the call that makes an object, where it stands; None of what no module or class states."""
        bound: Bound | None = Bound(expr, env)
        for _ in range(MAX_NAMES):
            bound = self._stated(bound.expr, bound.env) if bound is not None else None
            if bound is None or isinstance(bound.expr, Call):
                return bound
        return None

    def _stated(self, expr: Expr, env: Env) -> Bound | None:
        if env.func.file.language != "python" or not isinstance(expr, Name | Member):
            return None
        if is_own_member(expr):
            return self._of_class(expr.name, env)
        root = dotted_name(expr)
        if not root or self._is_hidden(root.partition(".")[0], env):
            return None
        place, ways = self._left(root, env)
        held = ways[0][0] if len(ways) == 1 and len(ways[0]) == 1 else None
        while held is not None and held.how == "handed" and len(held.before) == 1:  # it stays that object
            held = held.before[0]
        if place is None or held is None or held.how != "value" or held.expr is None:
            return None
        return Bound(held.expr, held.env or place)

    def _left(self, root: str, env: Env) -> tuple[Env | None, list[tuple[Held, ...]]]:
        """What a module leaves a name with; in its own body that is what the run of that has there."""
        if not self.folder.flow.outline(env.func).is_module or "." in root:
            return self.folder.names.left_by_module(root, env)
        ways = self.folder.flow.ways(Name(root), env)
        changed = self.folder.names.variables.changers(root, env.func.file)
        return (env, ways) if ways and not changed else self.folder.names.left_by_module(root, env)

    def _is_hidden(self, name: str, env: Env) -> bool:
        """Whether a function, or one around it, has a variable of its own by a name."""
        outline = self.folder.flow.outline(env.func)
        own = not outline.is_module and (name in outline.effects.own or name in env.func.given)
        return own or self.folder.names.captured_at(name, env) is not None

    def _of_class(self, name: str, env: Env) -> Bound | None:
        """What the class of the object at hand states for a name that no method gives the object itself."""
        cls, program = env.this or env.func.cls, self.folder.program
        lineage = program.ancestry(cls) if cls is not None else ()
        owner = next((each for each in lineage if name in each.fields), None)
        default = owner.fields[name].default if owner is not None else None
        if cls is None or owner is None or default is None:
            return None
        methods = (
            each for entry in (*lineage, *program.derived(cls)) for each in self.folder.scope.changing(name, entry)
        )
        if any(self._gives(each, f".{name}") for each in methods):
            return None
        if self.folder.members.is_given(name, cls) or self.folder.redefined.is_hidden(name, cls, env):
            return None
        return Bound(default, self.folder.names.at_class(owner, cls, env))

    def _gives(self, method: Func, key: str) -> bool:
        """Whether a method gives a member of its object, or a part of that, something: to hand it on is no such."""
        return any(each == key or each.startswith(f"{key}.") for each in self.folder.flow.outline(method).given)
