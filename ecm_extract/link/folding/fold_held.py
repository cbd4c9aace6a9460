"""What variables hold, as values: by the statements that made it so, in the order in which they ran."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.compute import with_character
from ecm_extract.infer.held import Held, How
from ecm_extract.infer.places import as_written
from ecm_extract.link.code.containers import begins_empty
from ecm_extract.link.code.named_alike import is_name_of_node
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls
from ecm_extract.link.folding.begun_fields import begun_field
from ecm_extract.link.folding.declared_numbers import as_declared
from ecm_extract.link.folding.fold_changes import STREAMS, ChangeFolder
from ecm_extract.link.folding.named_containers import container_of_variable
from ecm_extract.link.folding.reached_elements import reached
from ecm_extract.link.folding.same_objects import is_as_made
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, Instance
from ecm_extract.link.running.own_names import node_name
from ecm_extract.link.running.values import (
    Value,
    alternatives,
    demoted,
    given_holes,
    is_setting,
    literal,
    lowered,
    unknown,
)

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TEXTS = STREAMS | {"string", "QString"}


class HeldFolder:
    """Evaluates what variables hold."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._changes = ChangeFolder(folder)
        self._asked: set[Held] = set()
        self._work: Mapping[How, Callable[[Held, Env], tuple[Value, ...]]] = {
            "each": self._element,
            "part": self._part,
            "read": self._read,
            "made": self._made,
            "changed": self._changed,
            "stored": self._stored,
            "out": self._written,
            "after": self._after,
            "caught": lambda held, env: self.folder.messages.of(held, env),
            "entered": lambda held, env: self.of([held.before], env),
        }

    def of(self, ways: Iterable[tuple[Held, ...]], env: Env) -> tuple[Value, ...]:
        """Return the values of a variable: `ways` has what it may hold in each state of the place."""
        states = self._states(ways, env)
        found: list[Value] = []
        for helds in states:
            if len(helds) > 1:
                found += alternatives(value for held in helds for value in self._one_of(held, env))
            else:
                found += self.values(helds[0], env) if helds else ()
        return alternatives(found) if len(states) > 1 else tuple(found)

    def _one_of(self, held: Held, env: Env) -> tuple[Value, ...]:
        """What a variable holds that may hold something else: only where it was given this, which a test decided."""
        return self.folder.asked.by_asked(self.values(held, env), held.env)

    def _states(self, ways: Iterable[tuple[Held, ...]], env: Env) -> list[tuple[Held, ...]]:
        """What a variable holds in states of which it holds something different, where reading it does not raise."""
        taken = [self.folder.flow.decisions.ways(helds) for helds in ways]
        return list(dict.fromkeys(self.folder.unset.without(taken, env.func)))

    def values(self, held: Held, env: Env) -> tuple[Value, ...]:
        """Return the values of one thing that a variable may hold; `env` is who asks."""
        known = held.settled.get("values")
        if isinstance(known, tuple):
            return known
        folder = self.folder
        marks = folder.marks
        values = folder.guarded(("held", held), _label(held.name), lambda: self._values(held, env))
        if marks == folder.marks:
            held.settled["values"] = values
        return values

    def _values(self, held: Held, env: Env) -> tuple[Value, ...]:
        inner = held.env.deeper(env.depth + 1) if held.env is not None else env.deeper(env.depth + 1)
        work = self._work.get(held.how)
        if work is not None:
            return work(held, inner)
        if held.how == "shared" and held.before:
            return self.folder.names.variables.given(held.name, env.func.file, self.of([held.before], env))
        if held.how in {"given", "shared"}:
            place = env if held.env is None else inner
            entered = self._entered(held, place)
            return self.values(entered, place) if entered else self.given(held.name, place, first=held.how == "given")
        if held.how == "looped":
            return self.of([held.before], env)
        if held.how in {"handed", "reached"}:
            return self._handed(held, env, inner.func.file.language == "python")
        return self._assigned(held, env, inner) if held.how == "value" else (unknown(_label(held.name)),)

    def _entered(self, held: Held, env: Env) -> Held | None:
        """What a variable held where the function was called that did not give it anything yet."""
        if held.how != "given":
            return None
        lasting = self.folder.lasting_states.entered(held.name, env)
        if lasting is not None:
            return Held("entered", held.name, env=env, before=lasting)
        return self.folder.states.entered(held.name, env)

    def _assigned(self, held: Held, env: Env, inner: Env) -> tuple[Value, ...]:
        statement = _statement(held)
        if statement is not None and is_name_of_node(inner.func, statement):
            return (node_name(),)
        values = as_declared(demoted(self.folder.fold(held.expr, inner)), statement, inner.func)
        return self._by_default(held, env) or values if all(map(is_setting, values)) else values

    def _element(self, held: Held, env: Env) -> tuple[Value, ...]:
        return self.folder.lists.elements(held.expr, env)

    def _part(self, held: Held, env: Env) -> tuple[Value, ...]:
        """A part of an element of a list of which not all is known: who knows the list knows it."""
        values = self.folder.lists.open.part(held.expr, held.more, env)
        is_known = any(given_holes(value) or value.parameter for value in values)
        return values if is_known else (unknown(_label(held.name)),)

    def _by_default(self, held: Held, env: Env) -> tuple[Value, ...]:
        """What a member holds that somebody sets through a parameter, as long as nobody does."""
        if not held.name.startswith(".") or held.name.count(".") > 1:
            return ()
        return tuple([value for value in self.given(held.name, env, first=False) if value.confidence != "pattern"])

    def given(self, key: str, env: Env, first: bool = True) -> tuple[Value, ...]:
        """Return what a variable is that the function did not give anything, `first`: yet."""
        around = self.folder.lent.around(key, env) if key.startswith("^") else None
        if around is not None:
            return self.folder.fold(around[0], around[1].deeper(env.depth + 1))
        entry = env.entry()
        name = key.rpartition(".")[2]
        if "." not in key:
            values = self.folder.names.around(name, entry) or (unknown(name),)
            shifted = not first and self.folder.objects.file_scope.type_of(name, env)
            return alternatives((*values, unknown(name))) if shifted else values
        owner = entry.this or entry.func.cls
        if (
            first
            and entry.func.is_constructor
            and key.startswith(".")
            and key.count(".") == 1
            and entry.func.cls is not None
        ):
            return self.at_first(name, entry) or (unknown(name),)
        if key.startswith(".") and key.count(".") == 1 and owner is not None:
            found = self.folder.members.member_value(name, owner, entry)
            return found or self.folder.names.around(name, entry) or (unknown(name),)
        is_python = entry.func.file.language == "python" and not key.startswith(".")
        found = self.folder.names.imported(key, entry) if is_python else ()
        return found or self._as_begun(as_written(key), env) or (unknown(name),)

    def _as_begun(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        """What a field is that the function has not given anything yet: what its object is made from says it.

        Of Python that is an object that the function made, and only its own statements and methods have changed.
        """
        if not isinstance(expr, Member):
            return ()
        if env.func.file.language == "python" and not is_as_made(expr.base, env, self.folder):
            return ()
        return self.folder.structures.field(expr, env) or begun_field(expr, env, self.folder)

    def at_first(self, name: str, env: Env) -> tuple[Value, ...]:
        """Return what a member holds of a new object (`FirstMethods`): what its bases made of it, or its default."""
        cls = env.func.cls
        if cls is None or not self.folder.first_methods.finds_new(env.func, name):
            return ()
        for base in self.folder.program.bases(cls):
            if self._is_of(name, base):
                made = self.folder.objects.part(env.made or Instance(cls, {}, {}), base)
                return self.folder.members.member_value(
                    name, base, Env(env.func, env.at, this=env.this, made=made, depth=env.depth)
                )
        values = self.folder.members.initial(name, env.this or cls, env)
        last = plain(self.folder.scope.member_type(name, cls)).rsplit("::", 1)[-1]
        begun = last in _TEXTS and not self._is_static(name, cls)
        return values or ((literal("")._replace(confidence="folded"),) if begun else ())

    def _is_static(self, name: str, cls: Cls) -> bool:
        """Tell whether a member is defined elsewhere, and was there before any object: no object begins it."""
        owner = self.folder.scope.declaring(name, cls)
        return owner is not None and "static" in owner.fields[name].traits

    def _is_of(self, name: str, base: Cls) -> bool:
        """Tell whether a base has a member, or gives it a value."""
        lineage = self.folder.program.ancestry(base)
        changing = self.folder.scope.changing
        return bool(self.folder.scope.member_type(name, base)) or any(changing(name, entry) for entry in lineage)

    def _after(self, held: Held, env: Env) -> tuple[Value, ...]:
        """A member after a method that may have changed it."""
        found = self.folder.behind_calls.left(held, env)
        return (unknown(_label(held.name)),) if found is None else self.of([found[0]], found[1].deeper(env.depth + 1))

    def _before(self, held: Held, env: Env) -> tuple[Value, ...]:
        return self.of([held.before or (Held("given", held.name),)], env)

    def _read(self, held: Held, env: Env) -> tuple[Value, ...]:
        """A parameter that is read into a variable: where it is not set, the variable keeps what it held."""
        if held.expr is None:
            return (unknown(_label(held.name)),)
        values = self.folder.parameters.parameter_value(held.expr, self._instead(held, env), env)
        kept = self._before(held, env) if held.before and held.more is None else ()
        kept = tuple([value for value in kept if value.text and value.confidence != "pattern"])
        lasts = env.func.file.ros == 1  # there a default of another read is known to nobody but that one
        if kept and (lasts or any(value.confidence == "pattern" for value in values)):
            return self.folder.parameters.kept_value(held.expr, kept, env)
        return values

    def _instead(self, held: Held, env: Env) -> Expr | None:
        """What a call has instead of a parameter: in ROS 2 that is asked for only where nobody declares it."""
        if held.more is None or held.expr is None or env.func.file.ros != 2:
            return held.more
        parameters = self.folder.parameters
        return None if parameters.is_declared(self.folder.fold(held.expr, env), env) else held.more

    def _made(self, held: Held, _: Env) -> tuple[Value, ...]:
        """A variable that is declared without a value."""
        statement = _statement(held)
        last = plain(statement.type).rsplit("::", 1)[-1] if statement is not None else ""
        return (literal("")._replace(confidence="folded"),) if last in _TEXTS else (unknown(_label(held.name)),)

    def _changed(self, held: Held, env: Env) -> tuple[Value, ...]:
        """A text of C++ after a method that changes it; texts of Python never change."""
        call = held.expr
        if not isinstance(call, Call) or not isinstance(call.callee, Member) or env.func.file.language == "python":
            return (unknown(_label(held.name)),)
        return self._changes.of(call, lambda: self._before(held, env), env, _label(held.name))

    def _stored(self, held: Held, env: Env) -> tuple[Value, ...]:
        """`text[0] = 'x'` in C++."""
        if env.func.file.language == "python" or held.expr is None:
            return (unknown(_label(held.name)),)
        options = [self._before(held, env), self.folder.fold(held.expr, env), self.folder.fold(held.more, env)]
        return self.folder.combined(options, with_character, _label(held.name))

    def _handed(self, held: Held, env: Env, python: bool) -> tuple[Value, ...]:
        """Whoever gets a text in Python cannot change it; in C++ somebody outside may, or fill an empty one."""
        values = self._before(held, env)
        if python:
            return values
        filled = any(not value.text for value in values)
        return (unknown(_label(held.name)),) if filled else lowered(values, "one_of")

    def _written(self, held: Held, env: Env) -> tuple[Value, ...]:
        if env.func.file.language == "python" and "." not in held.name:  # whose functions give variables no other texts
            return self._before(held, env)
        found = self.folder.behind_calls.out(held, env)
        if found is None:
            return (unknown(_label(held.name)),)
        ways, inner = found
        return self.of([ways], inner.deeper(env.depth + 1))

    # --- lists -------------------------------------------------------------------------------------------------

    def items(self, held: Held, env: Env) -> list[Bound] | None:
        """Return the elements of a list that a variable may hold; None when they are not all known."""
        asked, marks = "elements" if self.folder.lists.any_order else "items", self.folder.marks
        if asked in held.settled:
            return held.settled[asked]  # type: ignore[return-value]
        if env.depth > MAX_DEPTH or held in self._asked:
            self.folder.cuts += 1
            return None
        self._asked.add(held)
        found = self._items(held, env.deeper(env.depth + 1))
        self._asked.discard(held)
        if marks == self.folder.marks:
            held.settled[asked] = found
        return found

    def _items(self, held: Held, env: Env) -> list[Bound] | None:
        inner = held.env.deeper(env.depth + 1) if held.env is not None else env.deeper(env.depth + 1)
        if held.how == "value":
            return self.folder.lists.items(held.expr, inner)
        if held.how == "made":
            statement = _statement(held)
            written = statement.type if statement is not None else ""
            return [] if begins_empty(container_of_variable(written, inner.func, self.folder.program)) else None
        if held.how in {"given", "shared"}:
            return self._items_at_first(held, env) if not held.before else None
        if held.how == "out":
            found = self.folder.behind_calls.out(held, inner)
            return self.items_of([found[0]], found[1].deeper(env.depth + 1)) if found is not None else None
        if held.how == "after":
            found = self.folder.behind_calls.left(held, inner)
            return self.items_of([found[0]], found[1].deeper(env.depth + 1)) if found is not None else None
        if held.how == "entered":
            return self.items_of([held.before], inner)
        before = self.items_of([held.before], env) if held.before else None
        if before is None:
            return None
        if held.how == "reached":
            return [reached(item) for item in before]
        if held.how == "changed" and isinstance(held.expr, Call):
            return self.folder.list_changes.changed(before, held.expr, inner)
        return self.folder.list_changes.stored(before, held, inner) if held.how == "stored" else None

    def _items_at_first(self, held: Held, env: Env) -> list[Bound] | None:
        """The elements of a list that the function did not change."""
        entered = self._entered(held, env)
        if entered is not None:
            return self.items(entered, env)
        around = self.folder.lent.around(held.name, env)
        if around is not None:
            return self.folder.lists.items(around[0], around[1].deeper(env.depth + 1))
        return self.folder.lists.given(held.name, env, held.how == "given")

    def items_of(self, ways: Iterable[tuple[Held, ...]], env: Env) -> list[Bound] | None:
        """Return the elements of a list that a variable surely holds; None for one of several lists."""
        states = self._states(ways, env)
        if len(states) != 1 or len(states[0]) != 1:
            return None
        return self.items(states[0][0], env)

    def any_items(self, ways: Iterable[tuple[Held, ...]], env: Env) -> tuple[list[Bound], bool]:
        """Return the elements of all lists that a variable may hold, and whether that is all of them."""
        found: list[Bound] = []
        known = True
        for held in dict.fromkeys(held for helds in self._states(ways, env) for held in helds):
            items = self.items(held, env)
            known = known and items is not None
            found += items or []
        return found, known


def _label(key: str) -> str:
    return key.rpartition(".")[2].lstrip("^#") or "value"


def _statement(held: Held) -> Statement | None:
    body = held.env.func.fact.body if held.env is not None else ()
    return body[held.at] if 0 <= held.at < len(body) else None
