"""What functions that are called leave the variables and members of their callers with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call

from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.held import Held, all_ways
from ecm_extract.infer.places import as_written, owners
from ecm_extract.link.folding.fields_left import field_left
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class BehindCalls:
    """Runs what is called, and asks what it held when it ended."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def left(self, held: Held, env: Env) -> tuple[tuple[Held, ...], Env] | None:
        """Return what a called method leaves a member with, and the place to evaluate it at."""
        if not isinstance(held.expr, Call):
            return None
        if self.folder.lasting.named(held.name, env.func) is not None:
            return self.folder.lasting_states.left(held, env)
        lent = self.folder.lent.left(held, env)
        if lent is not None:
            return lent
        inner = self.folder.methods.begun(invocation_of(held.expr, env), env)
        run = self.folder.flow.run(inner) if inner is not None else None
        if inner is None or run is None or run.end is None:
            return None
        ways = self.folder.flow.left(run, held.name)
        if ways:
            return ways, inner
        if any(self.folder.flow.left(run, whole) for whole in owners(held.name)):
            end = inner.within(run.end, len(inner.func.fact.body))
            return (Held("value", held.name, as_written(held.name), end),), inner
        if self._is_changed_unseen(held, inner):
            if self._is_changed_inside(held, inner):
                return (Held("handed", held.name, before=held.before),), env
            return (Held("lost", held.name),), inner
        return (held.before, env) if not run.end.called else ((Held("shared", held.name),), inner)

    def _is_changed_unseen(self, held: Held, env: Env) -> bool:
        """Whether a method may have changed a member in a way that its run does not hold.

        By another name, in a function within it, or by a method of the member. A text of Python is never changed so.
        """
        outline = self.folder.flow.outline(env.func)
        inside = held.name in outline.escaped
        unseen = outline.by_other_names | self.folder.methods.changed_through(env.func)
        if not inside and not any(name in unseen for name in (held.name, *owners(held.name))):
            return False
        fixed = all(each.how == "value" and is_plain(each.expr) for each in all_ways(held.before))
        return inside or not (fixed and held.before and env.func.file.language == "python" and "." not in held.name[1:])

    def _is_changed_inside(self, held: Held, env: Env) -> bool:
        """Whether a method of Python may only have changed what a member consists of: by a list that it stands in."""
        if env.func.file.language != "python" or "." in held.name[1:] or not held.before:
            return False
        outline = self.folder.flow.outline(env.func)
        return held.name not in outline.escaped and held.name not in self.folder.methods.changed_through(env.func)

    def out(self, held: Held, env: Env) -> tuple[tuple[Held, ...], Env] | None:
        """Return what a parameter of a called function holds when it returns, with the place to evaluate it at."""
        call = held.expr
        if not isinstance(call, Call):
            return None
        invocation = invocation_of(call, env)
        callee = self.folder.returns.meant(invocation, env)
        name = held.name.partition(".")[0]
        if callee is None or name in self.folder.flow.outline(callee).rebound:
            return None
        if all(entry.name != name for entry in callee.fact.params):
            return None  # of several functions of that name another one is meant here
        if callee.file.language == "python" and self.folder.methods.parameters.is_hidden(callee, name):
            return None
        inner = self.folder.returns.entered(callee, invocation, bind(callee, invocation, env), env)
        run = self.folder.flow.run(inner)
        if run is None or run.end is None:
            return None
        ways = self.folder.flow.left(run, held.name) or (Held("given", held.name),)
        if "." not in held.name:
            return ways, inner
        left = field_left(held, ways, run, env, self.folder.flow)
        return (left, inner) if left is not None else None
