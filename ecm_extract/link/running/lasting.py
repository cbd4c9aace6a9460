"""Variables of C++ that outlive a call: those of namespaces, and `static` ones of functions; who changes them is known.

Only those count that functions of one file with a `main` change, which nobody runs but by calling them where they
stand: what such a variable holds then follows from the order of these calls.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Name
from ecm_parsers.source.facts import Constant
from ecm_parsers.source.flow import Block, Branch, Loop, Switch, blocks

from ecm_extract.infer.held import Held
from ecm_extract.infer.inner import called_by_name
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import File, Func
from ecm_extract.link.code.walk import calls_in, names_in
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.runs_once import is_main
from ecm_extract.resolve.cpp_constants import Stated

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_MARK: Final = "#"
"""Begins the key of a variable in functions that do not write its name; no variable has such a name."""


@dataclass(frozen=True, slots=True, eq=False)
class Lasting:
    """One such variable.

    Attributes:
        key: what it is called in functions that do not write its name.
        first: what it holds before any function changes it.
        changing: the functions that change it, or call others that do.
        written: function -> its key there, of those that write its name.
    """

    key: str
    first: Held
    changing: Set[Func]
    written: Mapping[Func, str]

    def key_in(self, func: Func) -> str:
        """Return its key in a function."""
        return self.written.get(func, self.key)

    def changed_by(self, func: Func, at: int) -> list[Call]:
        """Return the calls in a statement of a function that may change it, inner ones first."""
        if func not in self.changing or at >= len(func.calls):
            return []
        names = {each.fact.name for each in self.changing}
        return [call for call in func.calls[at] if _called(call) in names]


class LastingVariables:
    """Finds them, once all calls are known."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._by_func: Mapping[Func, Sequence[Lasting]] = {}
        self._reading: Set[Func] = frozenset()

    def find(self) -> None:
        """Look through the program; to be asked for once, before values are."""
        mains = filter(is_main, self.folder.program.functions.get("main", ()))
        files = dict.fromkeys(func.file for func in mains)
        found = [each for file in files for each in (*self._kept(file), *self._stated(file))]
        changing: dict[Func, list[Lasting]] = defaultdict(list)
        for each in found:
            for func in {*each.changing, *each.written}:
                changing[func].append(each)
        self._reading = self._upward({func for each in found for func in each.written})
        self._by_func = changing

    def of(self, func: Func) -> Sequence[Lasting]:
        """Return those that a function names, or may change by what it calls."""
        return self._by_func.get(func, ())

    def named(self, key: str, func: Func) -> Lasting | None:
        """Return the one that has a key in a function."""
        known = self._by_func.get(func)  # most functions have none
        return next((each for each in known if each.key_in(func) == key), None) if known else None

    def is_concerned(self, func: Func) -> bool:
        """Tell whether what a function does depends on one of them, through what it calls as well."""
        return func in self._reading

    def changed_at(self, func: Func, at: int) -> Set[str]:
        """Return the keys of those that calls in a statement may change."""
        if func not in self._by_func:
            return frozenset()
        return {each.key_in(func) for each in self.of(func) if each.changed_by(func, at)}

    def differs(self, key: str, func: Func) -> bool:
        """Tell whether what a function calls may change the variable that has a key there."""
        found = self.named(key, func)
        return found is not None and func in found.changing

    # --- which ---------------------------------------------------------------------------------------------

    def _kept(self, file: File) -> Iterator[Lasting]:
        """The `static` variables of the functions of a file."""
        for func in self.folder.program.functions_in(file):
            for at, statement in enumerate(func.fact.body):
                target = statement.target
                if statement.kept and isinstance(target, Name) and self._is_simple(func, at, target.id):
                    first = Held("value", target.id, statement.value, Env(func, at), at)
                    key = f"{_MARK}{func.scope}::{target.id}:{func.fact.line}"
                    yield from self._followed(key, first, {func}, {func: target.id})

    def _is_simple(self, func: Func, at: int, key: str) -> bool:
        """Whether a function surely comes to a `static` variable, and keeps it and its beginning for itself."""
        outline, value = self.folder.flow.outline(func), func.fact.body[at].value
        begins = value is not None and not any(name in outline.effects.own for name in names_in(value))
        alone = outline.is_one(key) and key not in outline.escaped and key not in outline.exposed
        changed = outline.changes.get(key, 0) > 1
        return changed and begins and alone and at in outline.certain and "reference" not in func.fact.traits

    def _stated(self, file: File) -> Iterator[Lasting]:
        """The variables of namespaces of a file that functions change as a whole, and the fields of others."""
        for constant in file.facts.constants:
            written = self.folder.outside.written(Stated(file, constant))
            parts = self._parts(written) if written else set()
            if written and parts:
                place = self.folder.names.at_file(file, Env(next(iter(written))))
                for part in sorted(parts):
                    yield from self._one(constant, part, written, place)

    def _one(self, constant: Constant, part: str, written: Mapping[Func, str], place: Env) -> Iterator[Lasting]:
        """A variable, or a field of it: `part` is empty, or the name of the field behind a dot."""
        first = self._first(constant, part, place)
        keys = {func: f"{key}{part}" for func, key in written.items()}
        changing = {func for func, key in keys.items() if self._changes(func, key)}
        if first is not None:
            mark = f"{_MARK}{constant.scope}::{constant.name}::{part.removeprefix('.')}"
            yield from self._followed(mark, first, changing, keys)

    def _first(self, constant: Constant, part: str, place: Env) -> Held | None:
        """What a variable, or a field of one that is declared without a value, begins with."""
        if not part:
            return Held("value", constant.name, constant.value, place) if constant.value is not None else None
        cls = self.folder.objects.class_written(constant.type, place) if constant.value is None else None
        plain = cls is not None and not cls.fact.bases and not cls.methods
        field = cls.fields.get(part.removeprefix(".")) if cls is not None and plain else None
        return Held("value", part, field.default, place) if field is not None and field.default is not None else None

    def _changes(self, func: Func, key: str) -> bool:
        return key in self.folder.flow.outline(func).changes and not self.folder.runs_once.never(func)

    def _parts(self, written: Mapping[Func, str]) -> set[str]:
        """What functions change of a variable: its fields, or all of it; nothing where they do both."""
        found = {
            each.removeprefix(key)
            for func, key in written.items()
            for each in self.folder.flow.outline(func).changes
            if each == key or each.startswith(f"{key}.")
        }
        mixed = ("" in found and len(found) > 1) or any(part.count(".") > 1 for part in found)
        return set() if mixed else found

    # --- who -----------------------------------------------------------------------------------------------

    def _followed(self, key: str, first: Held, changing: set[Func], written: Mapping[Func, str]) -> Iterator[Lasting]:
        leading = self._leading(changing)
        if leading is not None:
            yield Lasting(key, first, leading, written)

    def _leading(self, changing: set[Func]) -> Set[Func] | None:
        """Functions with all that call them, directly or not; None where somebody may run one without such a call."""
        found, pending = set(changing), list(changing)
        while pending:
            func = pending.pop()
            calls = [call for call, _ in self.folder.states.callers.all(func)]
            if not self._is_straight(func) or any(call.statement.deferred for call in calls):
                return None
            more = {call.func for call in calls} - found
            found |= more
            pending += more
        names = {func.fact.name for func in found}
        return None if any(_asks(func, names) for func in found) else frozenset(found)

    def _is_straight(self, func: Func) -> bool:
        """Whether a function runs where the tree calls it by name, and nowhere else."""
        fact, once = func.fact, self.folder.runs_once
        if is_main(func):
            return True
        odd = fact.name.startswith(("operator", "~")) or fact.decorators or func.is_constructor
        if odd or not self._has_main(func.file) or any(_called(call) == fact.name for at in func.calls for call in at):
            return False
        if "lambda" in fact.traits:
            outer = self.folder.nesting.enclosing(func)
            return outer is not None and func in called_by_name(outer, self.folder.nesting.inner(outer))
        callers = self.folder.states.callers
        hosted = func.cls is not None and callers.may_be_called_outside(fact.name, func.cls)
        return not hosted and not callers.is_handed(func) and fact.name not in once.called_by_declarations

    def _has_main(self, file: File) -> bool:
        return any(map(is_main, self.folder.program.functions_in(file)))

    def _upward(self, funcs: Iterable[Func]) -> Set[Func]:
        """Functions with all that call them."""
        found = set(funcs)
        pending = list(found)
        while pending:
            more = {call.func for call, _ in self.folder.states.callers.all(pending.pop())} - found
            found |= more
            pending += more
        return frozenset(found)


def _called(call: Call) -> str:
    callee = call.callee
    return last_name(callee.id) if isinstance(callee, Name) else getattr(callee, "name", "")


def _asks(func: Func, names: Set[str]) -> bool:
    """Whether a function calls others where no statement says when: in a condition, or for the place of an element."""
    targets = (statement.target for statement in func.fact.body)
    asked = (*_tests(func.fact.flow or ()), *(target for target in targets if target is not None))
    return any(_called(call) in names for expr in asked for call in calls_in(expr))


def _tests(block: Block) -> Iterator[Expr]:
    for step in block:
        if isinstance(step, Branch | Loop) and step.test is not None:
            yield step.test
        if isinstance(step, Switch):
            yield step.subject
            yield from (test for case in step.cases for test in case.tests)
        for inner in () if isinstance(step, int) else blocks(step):
            yield from _tests(inner)
