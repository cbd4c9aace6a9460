"""Whether conditions hold, and values are the same: proved, or as long as nobody sets a parameter."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member, Op, Opaque, Text

from ecm_extract.infer.compute import UNKNOWN, operate, truth
from ecm_extract.infer.outline import Outline
from ecm_extract.link.env import Env
from ecm_extract.link.units import Func
from ecm_extract.link.values import Value, data_in, is_known, is_proved
from ecm_extract.link.walk import children

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder


class Truths:
    """Decides conditions by the values of what they ask for.

    Args:
        folder: gives values.
        outline: tells what is known of a function before it runs.
    """

    def __init__(self, folder: Folder, outline: Callable[[Func], Outline]) -> None:
        self.folder = folder
        self._outline = outline

    def holds(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""
        return self._holds(test, env, is_proved)

    def likely(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds as long as nobody sets a parameter; None when that is not known.

        A name that somebody else gives is taken for one that is not empty.
        """
        holds = self._holds(test, env, is_known)
        return self._if_given(test, env) if holds is None else holds

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

    def _holds(self, test: Expr, env: Env, counts: Callable[[Value], bool]) -> bool | None:
        if isinstance(test, Opaque):
            return None
        if isinstance(test, Op) and test.op == "!":
            inner = self._holds(test.operands[0], env, counts)
            return None if inner is None else not inner
        if isinstance(test, Op) and test.op in {"&&", "||"}:
            return self._all_of(test, env, counts)
        python = env.func.file.language == "python"
        if self._is_exposed(test, env.func):
            return None
        values = self.folder.fold(test, env)
        found = {truth(data_in(value), python) if counts(value) else None for value in values}
        if found == {None} and python:
            items = self.folder.lists.items(test, env)
            return None if items is None else bool(items)
        return found.pop() if len(found) == 1 else None

    def _is_exposed(self, test: Expr, func: Func) -> bool:
        """Whether a condition asks for a variable that somebody may write in a way that is not followed."""
        outline = self._outline(func)
        return bool(outline.exposed) and _names_any(test, outline)

    def _all_of(self, test: Op, env: Env, counts: Callable[[Value], bool]) -> bool | None:
        ends = test.op == "||"
        undecided = False
        for operand in test.operands:
            holds = self._holds(operand, env, counts)
            if holds is ends:
                return None if undecided else ends
            undecided = undecided or holds is None
        return None if undecided else not ends

    def alike(self, one: Expr, other: Expr, env: Env) -> bool | None:
        """Tell whether two expressions have the same value; None when that is not decided."""
        python = env.func.file.language == "python"
        pairs = [(a, b) for a in self.folder.fold(one, env) for b in self.folder.fold(other, env)]
        found = {_same(a, b, python) for a, b in pairs}
        return found.pop() if len(found) == 1 else None


def _same(one: Value, other: Value, python: bool) -> bool | None:
    if not (is_proved(one) and is_proved(other)):
        return None
    found = operate("==", data_in(one), data_in(other), python)
    return None if found is UNKNOWN else bool(found)


def _names_any(test: Expr, outline: Outline) -> bool:
    if outline.effects.key(test) in outline.exposed:
        return True
    return any(_names_any(part, outline) for part in children(test))
