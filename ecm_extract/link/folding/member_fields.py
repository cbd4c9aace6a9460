"""Fields of members that a function finds as others left them: `params_.topic` in a callback."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Member

from ecm_extract.infer.held import Held
from ecm_extract.infer.places import as_written, owners
from ecm_extract.infer.run import Run
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.begun_fields import declared_field
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, alternatives, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ALONE: Final = frozenset({"given", "shared"})
"""Ways to hold what a method has not given anything."""
_MADE: Final = _ALONE | {"value", "made"}
"""Ways to hold an object that is as it was made."""


class MemberFields:
    """Evaluates fields at the end of the methods that change them, or the members that they lie in."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def beside(self, known: tuple[Value, ...], expr: Member, env: Env, as_made: bool) -> tuple[Value, ...]:
        """Return what a field is by all methods, or `known`, `as_made`: which is told of how its object is made.

        Where it is not seen what a method makes of the field, how its object is made is not all that is known of it.
        """
        key, cls = self.folder.flow.effects(env.func).key(expr), env.this or env.func.cls
        if cls is None or not owners(key) or self._is_left_to_others(key, env) or not self._is_changed(key, cls, env):
            return known
        left = self._left(key, cls, env)
        told = bool(left) and all(map(_is_told, left))
        begun = self._is_begun(key, cls, env)
        known = known if begun else self._declared(expr, env, known)
        if told:
            return left if begun else self._besides(known, left)
        asked = env.func.file.language == "python" or (as_made and self._is_lost(key, cls, env))
        more = asked and any(map(_is_told, known))
        return alternatives((*known, unknown(expr.name))) if more else known

    def _is_lost(self, key: str, cls: Cls, env: Env) -> bool:
        """Whether it is not seen what a method gives the field of an object that another one made."""
        left = self._left(key, cls, env, of_makers=False)
        return not all(map(_is_told, left))

    def _declared(self, expr: Member, env: Env, known: tuple[Value, ...]) -> tuple[Value, ...]:
        """What is known of a field, and what it is declared with: no method need have run that gives it something.

        Settings are read before they are used, so one that a parameter gives is that.
        """
        if any(value.confidence == "default" for value in known):
            return known
        declared = [value for value in declared_field(expr, env, self.folder) if value.text]
        return alternatives((*declared, *known)) if declared else known

    def _besides(self, known: tuple[Value, ...], left: tuple[Value, ...]) -> tuple[Value, ...]:
        """What a field may still be as its object was made, where no constructor gives it anything."""
        return alternatives((*known, *left)) if known and all(map(_is_told, known)) else known

    def _is_begun(self, key: str, cls: Cls, env: Env) -> bool:
        """Whether each constructor of a class gives the field something, so that no method finds it as it was made."""
        for entry in self.folder.program.ancestry(cls):
            makers = [each for each in entry.constructors if "declaration" not in each.fact.traits]
            if makers and all(self._gives(maker, key, cls, env) for maker in makers):
                return True
        return False

    def _gives(self, maker: Func, key: str, cls: Cls, env: Env) -> bool:
        run = self.folder.flow.run(self.folder.members.beginning(maker, cls, env))
        return run is not None and not _is_alone(self._helds(key, run))

    def _is_left_to_others(self, key: str, env: Env) -> bool:
        """Whether a method finds the member new, or others than its methods change the field."""
        new = self.folder.names.is_fresh(env) and self.folder.first_methods.finds_new(env.func, key.split(".")[1])
        return new or self.folder.given_fields.is_reached_into(key, env.func.file.language)

    def _left(self, key: str, cls: Cls, env: Env, of_makers: bool = True) -> tuple[Value, ...]:
        """What methods leave the field with; `of_makers`: those too that make its object."""
        asked = ("left", key, cls, env.made, env.func, of_makers)
        name = key.rpartition(".")[2]
        return self.folder.guarded(asked, name, lambda: alternatives(list(self._at_ends(key, cls, env, of_makers))))

    def _at_ends(self, key: str, cls: Cls, env: Env, of_makers: bool) -> Iterator[Value]:
        for run, place in self._ends(key, cls, env):
            if not of_makers and run is not None and self._makes(key, run):
                continue
            if run is None or run.end is None:
                yield unknown(key.rpartition(".")[2])
                continue
            left = self._helds(key, run)
            if not _is_alone(left):
                end = place.within(run.end, len(place.func.fact.body))
                yield from self.folder.fold(as_written(key), end)
            yield from self._meanwhile(key, left, run, place)

    def _makes(self, key: str, run: Run) -> bool:
        """Whether a method leaves the member, or a part of it, with an object that it made."""
        return any(held.how in _MADE - _ALONE and held.name != key for held in self._helds(key, run))

    def _meanwhile(self, key: str, left: Sequence[Held], run: Run, place: Env) -> Iterator[Value]:
        """What methods find that one calls which gives the field something else later, or leaves it to them."""
        for held in self._shown(key, run):
            if held in left or held.how in _ALONE:
                continue
            if held.how == "value" and held.name == key:
                yield from self.folder.held.values(held, place)
            else:
                yield unknown(key.rpartition(".")[2])

    def _is_changed(self, key: str, cls: Cls, env: Env) -> bool:
        """Whether a method gives the field something, or does something to its object other than to make it."""
        runs = [run for run, _ in self._ends(key, cls, env) if run is not None]
        return any(held.how not in _MADE or held.name == key for run in runs for held in self._shown(key, run))

    def _ends(self, key: str, cls: Cls, env: Env) -> Iterator[tuple[Run | None, Env]]:
        return self.folder.members.ends(key.split(".")[1], cls, env)

    def _helds(self, key: str, run: Run) -> list[Held]:
        """What a method leaves the field, and the members that it lies in, with."""
        return [held for each in (key, *owners(key)) for held in self.folder.flow.left(run, each)]

    def _shown(self, key: str, run: Run) -> list[Held]:
        """The same, and what other methods that one calls find them with."""
        return [held for each in (key, *owners(key)) for held in self.folder.flow.shown(run, each)]


def _is_alone(helds: Sequence[Held]) -> bool:
    """Tell whether a method leaves alone what it holds so."""
    return all(held.how in _ALONE for held in helds)


def _is_told(value: Value) -> bool:
    return value.confidence != "pattern"
