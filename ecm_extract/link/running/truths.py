"""Whether conditions hold, and values are the same: proved, or as long as nobody sets a parameter."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member, Op, Opaque, Text

from ecm_extract.infer.compute import UNKNOWN, operate, truth
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.routes import OPEN, Verdict
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import calls_in, children, names_in
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, data_in, is_known, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Truths:
    """Decides conditions by the values of what they ask for.

    Args:
        folder: gives values.
        outline: tells what is known of a function before it runs.
    """

    def __init__(self, folder: Folder, outline: Callable[[Func], Outline]) -> None:
        self.folder = folder
        self._outline = outline

    def verdict(self, test: Expr, env: Env) -> Verdict:
        """Tell whether a condition holds.

        A name that somebody else gives is taken for one that is likely not empty.
        """
        found = self._judged(test, env)
        return found if found.likely is not None else Verdict(found.holds, self._if_given(test, env))

    def holds(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""
        return self._judged(test, env).holds

    def _before(self, test: Expr, env: Env) -> bool | None:
        """What a condition was on the way, where it asks for nothing but parameters that stay what they are."""
        turns = env.state.path if env.state is not None else ()
        asked = next((turn for turn in turns if turn.test == test and turn.env is not None), None)
        if asked is None or asked.env is None or asked.env.func is not env.func or calls_in(test):
            return None
        given = {entry.name for entry in env.func.fact.params} - set(self._outline(env.func).changes)
        return asked.holds if set(names_in(test)) <= given else None

    def _if_given(self, test: Expr, env: Env) -> bool | None:
        if isinstance(test, Op) and test.op == "!":
            inner = self._if_given(test.operands[0], env)
            return None if inner is None else not inner
        if isinstance(test, Op) and test.op in {"==", "!="} and Text("") in test.operands:
            named = next((operand for operand in test.operands if operand != Text("")), None)
            return test.op == "!=" if named is not None and self._is_given(named, env) else None
        if isinstance(test, Call) and isinstance(test.callee, Member) and test.callee.name == "empty":
            return False if self._is_given(test.callee.base, env) else None
        return None

    def _is_given(self, expr: Expr, env: Env) -> bool:
        values = self.folder.fold(expr, env)
        return all(value.open("param") or value.open("made") or value.open("node") for value in values)

    def may_know(self, test: Expr, env: Env) -> bool:
        """Tell whether all that a condition asks for is followed, and anything tells what it is."""
        asks = not isinstance(test, Opaque) and not self._is_exposed(test, env.func)
        return asks and not self.folder.untold.has(test, env.func, env.at)

    def _judged(self, test: Expr, env: Env) -> Verdict:
        if isinstance(test, Opaque):
            return OPEN
        if isinstance(test, Op) and test.op == "!":
            inner = self._judged(test.operands[0], env)
            return Verdict(_negated(inner.holds), _negated(inner.likely))
        if isinstance(test, Op) and test.op in {"&&", "||"}:
            return self._all_of(test, env)
        if self._is_exposed(test, env.func):
            return OPEN
        before = self._before(test, env)
        if before is not None:
            return Verdict(before, before)
        python = env.func.file.language == "python"
        compared = self._compared(test, env) if python else None
        if compared is None and self.folder.untold.has(test, env.func, env.at):
            return OPEN
        full = compared if python else self.folder.optionals.holds(test, env)
        if full is not None:
            return Verdict(full, full)
        values = self.folder.fold(test, env)
        found = Verdict(_truth(values, is_proved, python), _truth(values, is_known, python))
        return self._of_object(test, env, found) if python and None in found else found

    def _compared(self, test: Expr, env: Env) -> bool | None:
        """What comes of comparing what is no text and no number, as far as it is known what that is."""
        found = self.folder.enums.compared(test, env)
        return found if found is not None else self.folder.data_classes.compared(test, env)

    def _of_object(self, test: Expr, env: Env, found: Verdict) -> Verdict:
        """A list of Python holds when it is not empty, an object of most classes always."""
        items = self.folder.lists.items(test, env)
        holds = bool(items) if items is not None else self.folder.surely_made.holds(test, env)
        return found if holds is None else Verdict(*[holds if each is None else each for each in found])

    def _is_exposed(self, test: Expr, func: Func) -> bool:
        """Whether a condition asks for a variable that somebody may write in a way that is not followed."""
        outline = self._outline(func)
        return bool(outline.exposed) and _names_any(test, outline)

    def _all_of(self, test: Op, env: Env) -> Verdict:
        """What stands behind an operand that decides is not asked."""
        ends = test.op == "||"
        found: list[Verdict] = []
        for operand in test.operands:
            found.append(self._judged(operand, env))
            if found[-1].holds is ends or found[-1] == OPEN:  # what stands behind an open one decides nothing
                break
        return Verdict(_met([each.holds for each in found], ends), _met([each.likely for each in found], ends))

    def text(self, expr: Expr, env: Env) -> str | None:
        """Return the text that an expression surely is; None where that is not known."""
        values = self.folder.fold(expr, env)
        data = data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else None
        return data if isinstance(data, str) else None

    def alike(self, one: Expr, other: Expr, env: Env, likely: bool = False) -> bool | None:
        """Tell whether two expressions (likely) have the same value; None when that is not decided."""
        python = env.func.file.language == "python"
        pairs = [(a, b) for a in self.folder.fold(one, env) for b in self.folder.fold(other, env)]
        counts = is_known if likely else is_proved
        found = {_same(a, b, python) if counts(a) and counts(b) else None for a, b in pairs}
        return found.pop() if len(found) == 1 else None


def _negated(holds: bool | None) -> bool | None:
    return None if holds is None else not holds


def _truth(values: Iterable[Value], counts: Callable[[Value], bool], python: bool) -> bool | None:
    """Whether all values are true, or all are false, as far as they count."""
    found = {truth(data_in(value), python) if counts(value) else None for value in values}
    return found.pop() if len(found) == 1 else None


def _met(operands: Sequence[bool | None], ends: bool) -> bool | None:
    """What operands make together, of which one that is `ends` decides, unless one before it is not known."""
    known = operands[: operands.index(None)] if None in operands else operands
    if ends in known:
        return ends
    return None if None in operands else not ends


def _same(one: Value, other: Value, python: bool) -> bool | None:
    found = operate("==", data_in(one), data_in(other), python)
    return None if found is UNKNOWN else bool(found)


def _names_any(test: Expr, outline: Outline) -> bool:
    if outline.effects.key(test) in outline.exposed:
        return True
    return any(_names_any(part, outline) for part in children(test))
