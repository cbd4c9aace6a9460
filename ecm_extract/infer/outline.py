"""What is known of a function before it runs: which variables its statements change, and which of them surely run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Items, Name, Op
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Block, Later, Leave, Step, blocks, steps

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import Effects
from ecm_extract.infer.inner import function_named, only_called
from ecm_extract.infer.left_alone import is_left_alone
from ecm_extract.infer.other_names import changed_around, changed_by_other_names
from ecm_extract.infer.places import caught_names, own_names, target_of
from ecm_extract.infer.raising import may_raise
from ecm_extract.infer.raising_calls import unpacks
from ecm_extract.infer.read_into import Reads
from ecm_extract.infer.targets import Targets
from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.walk import children, comprehensions

if TYPE_CHECKING:
    from ecm_extract.infer.giving import WaysGiven
    from ecm_extract.link.code.units import Func


class Outline:
    """The variables of one function, by key (see `places`).

    Args:
        func: the function.
        reads: what it reads of parameters.
        inner: the functions that are declared in it.
        targets: who resolves calls.
    """

    def __init__(self, func: Func, reads: Reads, inner: Sequence[Func], targets: Targets) -> None:
        self.func = func
        self.reads = reads
        self.inner = inner
        self.python = func.file.language == "python"
        self.is_module = self.python and func.fact.name == "<module>"
        self.effects = Effects(func, own_names(func.fact, self.python), targets)
        self.ways_given: dict[int, WaysGiven] = {}

    @cached_property
    def block(self) -> Block:
        """Its steps."""
        return self.func.fact.flow or tuple(range(len(self.func.fact.body)))

    @cached_property
    def changes(self) -> Mapping[str, int]:
        """Variable -> how many times the body changes it."""
        changed = Counter(key for keys in self._changed for key in keys) + Counter(self.escaped)
        changed += Counter(self.by_other_names) + Counter(self._by_defaults)
        return changed + Counter(caught_names(self.block)) if self.python else changed

    @property
    def _by_defaults(self) -> Iterator[str]:
        """The variables around a function of Python that are defaults of parameters which it changes in place."""
        altered = self.altered if self.python else ()
        given = (each.default for each in self.func.fact.params if each.default is not None and each.name in altered)
        return (key for each in given if (key := self.effects.key(each)))

    @cached_property
    def by_other_names(self) -> Set[str]:
        """The members that the body may change by a variable that it has them in (`other_names`)."""
        return changed_by_other_names(self)

    @cached_property
    def given(self) -> Set[str]:
        """The variables that the body gives something else, by a statement, a method or a function of the tree."""
        found = {key for statement in self.func.fact.body for key in self._assigned(statement)}
        if self.python:  # where calls may change what a variable consists of, and give it nothing else
            return frozenset(found | self.escaped)
        effects = (effect for at in range(len(self.func.fact.body)) for effect in self.effects.of(at))
        return frozenset(found | {effect.key for effect in effects if effect.kind != "handed"} | self.escaped)

    def _assigned(self, statement: Statement) -> Iterator[str]:
        return self.bound_keys(target_of(statement)) if statement.kind != "do" else iter(())

    def is_one(self, key: str) -> bool:
        """Tell whether a name of C++ means one local variable throughout the body: no block hides it by another."""
        return self._declared[key] == 1

    @cached_property
    def _declared(self) -> Counter[str]:
        """Variable -> how many declarations of that name the function has, parameters included."""
        lets = (entry for entry in self.func.fact.body if entry.kind in {"let", "each"})
        declared = Counter(key for entry in lets for key in self.bound_keys(entry.target))
        return declared + Counter(parameter.name for parameter in self.func.fact.params)

    @cached_property
    def written_through(self) -> Set[str]:
        """The variables of C++ by which the body changes what they point to or consist of."""
        targets = [entry.target for entry in self.func.fact.body if entry.kind == "set"]
        found = {self.effects.root(each) for each in targets if not self.effects.key(each)}
        effects = (effect for at in range(len(self.func.fact.body)) for effect in self.effects.of(at))
        return frozenset(found | {effect.key for effect in effects if effect.kind != "handed"})

    @cached_property
    def rebound(self) -> Set[str]:
        """The variables of Python that come to mean another object; `x += y` may change the one that they mean."""
        if not self.python:
            return frozenset()
        binding = (entry for entry in self.func.fact.body if not entry.type.endswith("="))
        return frozenset(key for entry in binding for key in self._assigned(entry))

    def may_change(self, key: str) -> bool:
        """Tell whether the body may give a variable, or a part of it, something else, and does not only read it."""
        changed = self.given | self.altered
        return not self.python or any(f"{each}.".startswith(f"{key}.") for each in changed)

    @cached_property
    def altered(self) -> Set[str]:
        """The variables of Python that the body may change in place, or a part of them, by whatever name it has it."""
        body = self.func.fact.body if self.python else ()
        found = {effect.key for at in range(len(body)) for effect in self.effects.of(at)} | self.escaped
        found |= {self.effects.root(each.target) for each in body if self._is_within(each)}
        bound = (each for each in body if not self._is_within(each))  # what is put into a list stays as it is
        named = [(set(self._assigned(each)), self._shared(each.value)) for each in bound]
        while more := {key for keys, shared in named if keys & found for key in shared} - found:
            found |= more
        return frozenset(found - {""})

    def _is_within(self, statement: Statement) -> bool:
        """Whether a statement gives a part of something a value, or adds to what a variable means."""
        bare = isinstance(statement.target, Items) or bool(self.effects.key(statement.target))
        return statement.type.endswith("=") or (statement.kind == "set" and not bare)

    def _shared(self, expr: Expr | None) -> Set[str]:
        return frozenset(map(self.effects.key, shared_names(expr, self.func.fact.body)))

    @cached_property
    def escaped(self) -> Set[str]:
        """The variables that functions which are declared within it change, or objects that end: any time."""
        handed = (func for func in self.inner if func not in self.captured)
        return self.unfollowed | {key for func in handed for key in self._changed_inside(func)}

    @cached_property
    def unfollowed(self) -> Set[str]:
        """The variables that objects change when they end; with jumps (`goto`) all that are not only declared."""
        ended = self.effects.targets.changed_by_ending(self.func)
        if not any(isinstance(step, Leave) and step.how == "goto" for step in steps(self.func.fact.flow)):
            return ended
        changed = Counter(key for keys in self._changed for key in keys)
        begun = self._declared.keys() - self.func.given
        return ended | {key for key, count in changed.items() if count > 1 or key not in begun}

    @cached_property
    def waiting(self) -> Set[int]:
        """The statements with a call that may let callbacks of the program run."""
        waits = self.effects.calls.waits
        return frozenset(at for at, calls in enumerate(self.func.calls) if any(waits(call) for call in calls))

    @cached_property
    def bound_inside(self) -> Set[str]:
        """The variables of a function of Python that functions within it give something else (`nonlocal x`)."""
        found = {key for func in self.inner for key in self._changed_inside(func, bound=True)}
        return frozenset(found)

    @cached_property
    def captured(self) -> Mapping[Func, Set[str]]:
        """The functions within it that it does nothing with but call, with the variables that they change."""
        if self.func.fact.name == "<module>":  # whose functions anybody can call
            return {}
        called = only_called(self.func, self.inner, self._lends)
        found = {func: frozenset(self._changed_inside(func)) for func in called}
        return {func: keys for func, keys in found.items() if self._are_followed(func, keys)}

    def _lends(self, call: Call, index: int) -> bool:
        """Whether an argument is a function that is declared here, which the function that gets it only calls."""
        own = any(function_named(call.args[index]) == func.fact.name for func in self.inner)
        return own and self.effects.targets.lent.is_lent(call, self.func, index)

    def _are_followed(self, func: Func, keys: Set[str]) -> bool:
        """Whether what a function within it changes are variables that nobody else has a reference to."""
        if "reference" in func.fact.traits:
            return False
        calls = [call for group in self.func.calls for call in group]
        named = [call for call in calls if call.callee == Name(func.fact.name)] if not self.python else []
        named += [call for call in calls if _is_given(call, func)]
        handed = {self.effects.root(arg) for call in named for arg in call.args}
        shared = (keys & handed) | ((keys | handed) & self._references)
        return not shared and not any(key.startswith(".") for key in keys)

    @cached_property
    def _references(self) -> Set[str]:
        """The variables of C++ that are declared as references, and so may mean what others mean."""
        lets = (entry for entry in self.func.fact.body if entry.kind in {"let", "each"} and entry.type.endswith("&"))
        return frozenset(key for entry in lets for key in self.bound_keys(entry.target))

    @cached_property
    def exposed(self) -> Set[str]:
        """The variables of C++ that are given away, by address or to somebody unknown, and so decide no branch."""
        if self.python:
            return frozenset()
        effects = (effect for at in range(len(self.func.fact.body)) for effect in self.effects.of(at))
        found = {effect.key for effect in effects if effect.kind in {"handed", "lost"}}
        for statement in self.func.fact.body:
            for start in (statement.target, statement.value):
                found |= {self.effects.key(name) for name in _given_away(start, self.effects.targets.keeps)}
        return frozenset((found | self.escaped) & self.effects.own)

    @cached_property
    def certain(self) -> Set[int]:
        """The statements that every run of the function takes, once each."""
        found: set[int] = set()
        for step in self.block:
            if isinstance(step, int):
                found.update(() if self._repeats(step) else (step,))
                if step in self.risks and self.effects.targets.exceptions.is_provable(self.func, step, False):
                    break
            elif self._may_end(step):
                break
        return found

    @cached_property
    def risks(self) -> Set[int]:
        """The statements of which anything may raise."""
        found = (at for at, entry in enumerate(self.func.fact.body) if self._may_raise(entry))
        return frozenset(found)

    def _may_raise(self, statement: Statement) -> bool:
        language = self.func.file.language
        parts = (statement.value, statement.target)
        return any(may_raise(each, language) for each in parts) or unpacks(statement)

    def _repeats(self, at: int) -> bool:
        """Whether a statement calls something for each element that a comprehension runs over."""
        found = self.func.calls[at] if self._has_rounds else ()
        return bool(found) and any(comprehensions(self.func.fact.body[at].value))

    @cached_property
    def _has_rounds(self) -> bool:
        return any(statement.kind == "each" for statement in self.func.fact.body)

    def _may_end(self, step: Step) -> bool:
        """Whether the function may be left within a step."""
        if isinstance(step, int):
            return self.func.fact.body[step].kind == "return"
        if isinstance(step, Leave):
            return step.how in {"return", "throw", "goto"}
        inner = () if isinstance(step, Later) else blocks(step)
        return any(self._may_end(entry) for block in inner for entry in block)

    def changed_by(self, at: int) -> Set[str]:
        """Return the variables that a statement changes."""
        return self._changed[at]

    @cached_property
    def _changed(self) -> Sequence[Set[str]]:
        return tuple([self._changed_at(at) for at in range(len(self.func.fact.body))])

    def _changed_at(self, at: int) -> Set[str]:
        statement = self.func.fact.body[at]
        found = {effect.key for effect in self.effects.of(at)}
        found |= {self.effects.key(read.out) or self.effects.root(read.out) for read in self.reads.get(at, ())}
        found |= {key for call in self.func.calls[at] for key in self.changed_by_inner(call)}
        if statement.kind != "do":
            found |= set(self.bound_keys(target_of(statement)))
        return frozenset(found - {""})

    def changed_by_inner(self, call: Call) -> Set[str]:
        """Return the variables that a call changes of a function which is declared here, or of who is lent one."""
        found = (
            keys for func, keys in self.captured.items() if call.callee == Name(func.fact.name) or _is_given(call, func)
        )
        return frozenset().union(*found)

    def run_by(self, call: Call) -> Iterator[Func]:
        """Yield the functions declared here that a call runs, or that it hands to a function of the tree."""
        for func in self.inner:
            given = _is_given(call, func) and self.effects.targets.target(call, self.func, len(self.func.fact.body))
            if call.callee == Name(func.fact.name) or given:
                yield func

    def changed_inside(self, func: Func) -> Set[str]:
        """Return the variables of this function, and members, that one declared in it changes."""
        return frozenset(self._changed_inside(func))

    def bound_keys(self, target: Expr | None) -> Iterator[str]:
        """Yield the variables that an assignment to a target changes."""
        if isinstance(target, Items):
            for item in target.items:
                yield from self.bound_keys(unstarred(item))
        else:
            yield self.effects.key(target) or self.effects.root(target)

    def _changed_inside(self, func: Func, bound: bool = False) -> Iterator[str]:
        outline = Outline(func, {}, (), self.effects.targets)
        inner = outline.effects
        keys: list[str] = [] if self.python else [*changed_around(outline), *outline.escaped]
        for at, statement in enumerate(func.fact.body):
            targets = [statement.target] if statement.kind in {"set", "each"} else []
            keys += [inner.key(target) or inner.root(target) for target in targets]
            keys += [effect.key for effect in inner.of(at) if not bound and not is_left_alone(effect, self.effects)]
            shown = statement.kind == "return" and not bound and "reference" in func.fact.traits
            keys += [inner.root(statement.value)] if shown else []  # who calls it may change what it shows
        for key in keys:
            root = key.partition(".")[0]
            if root not in inner.own:
                is_own = not root or root in self.effects.own
                yield key if is_own or not self.effects.is_member(root) else f".{key}"


def _is_given(call: Call, func: Func) -> bool:
    """Whether a function is an argument of a call."""
    return any(function_named(arg) == func.fact.name for arg in call.args)


def _given_away(expr: Expr | None, keeps: Callable[[str], bool]) -> Iterator[Expr]:
    """Yield the names in braces, the names whose address is taken, and the arguments of what makes an object.

    `keeps` tells which classes of libraries copy what they are made of.
    """
    if expr is None:
        return
    if isinstance(expr, Items):
        yield from (item for item in expr.items if isinstance(item, Name))
    elif isinstance(expr, Op) and expr.op == "&" and len(expr.operands) == 1:
        yield expr.operands[0]
    elif isinstance(expr, Call) and isinstance(expr.callee, Name) and _makes_or_ties(expr.callee.id):
        yield from (arg for arg in expr.args if isinstance(arg, Name) and not keeps(expr.callee.id))
    prints = isinstance(expr, Op) and expr.op == "%"  # what a format is filled with stands in a list of its own
    for part in children(expr):
        for inner in children(part) if prints and isinstance(part, Items) else (part,):
            yield from _given_away(inner, keeps)


def _makes_or_ties(name: str) -> bool:
    """Whether a call makes an object, by the way that classes are written, or refers to what it gets."""
    last = name.rpartition("::")[2]
    return last[:1].isupper() or last in {"tie", "ref"}
