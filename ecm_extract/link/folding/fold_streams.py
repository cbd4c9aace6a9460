"""What is written to streams of C++ whose manipulators say how: `name << std::setw(2) << std::setfill('0') << 7`."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op, Text

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.infer.held import Held
from ecm_extract.infer.streaming import PLAIN, StreamFormat, written
from ecm_extract.link.code.numbers import CHARACTERS, type_of_number
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Func
from ecm_extract.link.folding.fold_changes import STREAMS
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, data_in, is_proved, joined, unknown
from ecm_extract.shipped import shipped, shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TABLE: Final = "infer/streams.toml"
_PACKAGE: Final = "std"
_WRITABLE: Final = STREAMS | {"ostream"}
_KEEPING: Final = frozenset({"str", "clear"})
"""Methods that change the text or the errors of a stream, and leave how it writes."""


class StreamFolder:
    """Writes to streams, and follows how they write."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._asked: set[Held] = set()

    def writes(self, expr: Op, env: Env) -> bool:
        """Tell whether operands that stand side by side are written to a stream that somebody tells how to write."""
        stream = expr.operands[0]
        if env.func.file.language != "cpp" or not isinstance(stream, Name | Member) or not self._is_used:
            return False
        return any(map(_is_manipulator, expr.operands[1:])) or _is_stream(stream, env)

    def overwrites(self, expr: Op, env: Env) -> bool:
        """Tell whether what is written to a stream takes the place of a text that it was given, from its beginning on.

        Source: en.cppreference.com, basic_ostringstream: without `std::ios::ate` the first output goes to the front.
        """
        stream = expr.operands[0]
        if env.func.file.language != "cpp" or not isinstance(stream, Name) or not _is_stream(stream, env):
            return False
        return any(_is_given_text(held) for ways in self.folder.flow.ways(stream, env) for held in ways)

    def written(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """Return what a stream holds after operands were written to it."""
        groups = [self.folder.fold(expr.operands[0], env)]
        how = self._left(expr.operands[0], env)
        for operand in expr.operands[1:]:
            if _is_manipulator(operand):
                how = self._told(operand, how, env)
                continue
            groups.append(self._piece(operand, how, env))
            how = replace(how, width=0) if how is not None else None
        return joined(groups)

    def values(self, operand: Expr, env: Env) -> tuple[Value, ...]:
        """Return what an operand is that is written; a byte is written as a character."""
        values = self.folder.fold(operand, env)
        if isinstance(operand, Name) and type_of_number(env.func.written_types.get(operand.id, "")) in CHARACTERS:
            return tuple([value if value.data is None else unknown("value") for value in values])
        return values

    def _piece(self, operand: Expr, how: StreamFormat | None, env: Env) -> tuple[Value, ...]:
        values = self.values(operand, env)
        if how is not None and not how.width and all(value.data is None for value in values):
            return values
        return self.folder.combined([values], lambda data: UNKNOWN if how is None else written(data[0], how), "value")

    # --- how a stream writes -----------------------------------------------------------------------------------

    def _told(self, manipulator: Expr, how: StreamFormat | None, env: Env) -> StreamFormat | None:
        """How a stream writes after a manipulator."""
        name, given = _named(manipulator), shipped(_TABLE)["given"]
        if how is None or (name not in given and name not in shipped(_TABLE)["plain"]):
            return None
        if not isinstance(manipulator, Call):
            return replace(how, **shipped(_TABLE)["plain"][name])
        data = self._only(manipulator.args[0], env) if len(manipulator.args) == 1 else UNKNOWN
        fits = isinstance(data, str if given[name] == "fill" else int)
        changed: dict[str, Any] = {given[name]: data}
        return replace(how, **changed) if fits else None

    def _only(self, expr: Expr, env: Env) -> Any:
        values = self.folder.fold(expr, env)
        return data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else UNKNOWN

    def _left(self, stream: Expr, env: Env) -> StreamFormat | None:
        """How a stream writes at a place; None where that is not known."""
        if not isinstance(stream, Name) or _is_told_by_methods(stream.id, env.func):
            return None
        ways = self.folder.flow.ways(stream, env)
        helds = {held for way in ways for held in way} or {Held("given", stream.id)}
        found = {self._of(held, env) for held in helds}
        return found.pop() if len(found) == 1 else None

    def _of(self, held: Held, env: Env) -> StreamFormat | None:
        if held in self._asked:
            return None
        self._asked.add(held)
        try:
            return self._by_how(held, env)
        finally:
            self._asked.discard(held)

    def _by_how(self, held: Held, env: Env) -> StreamFormat | None:
        inner = held.env if held.env is not None else env
        if held.how == "value":
            return self._after(held.expr, inner)
        if held.how == "given":
            bound = env.args.get(held.name)
            return self._left(bound.expr, bound.env) if bound is not None else None
        if held.how == "out":
            found = self.folder.behind_calls.out(held, inner)
            return self._all(found[0], found[1]) if found is not None else None
        if held.how == "changed" and _method(held.expr) in _KEEPING:
            return self._all(held.before, inner)
        return PLAIN if held.how == "made" else None

    def _all(self, helds: tuple[Held, ...], env: Env) -> StreamFormat | None:
        found = {self._of(held, env) for held in self.folder.flow.decisions.ways(helds)}
        return found.pop() if len(found) == 1 else None

    def _after(self, expr: Expr | None, env: Env) -> StreamFormat | None:
        """How a stream writes that was made, or that operands were written to."""
        if isinstance(expr, Text) or (isinstance(expr, Call) and _named(expr) in STREAMS):
            return PLAIN
        if not isinstance(expr, Op) or expr.op != "+":
            return None
        how = self._left(expr.operands[0], env)
        for operand in expr.operands[1:]:
            told = _is_manipulator(operand)
            how = self._told(operand, how, env) if told else replace(how, width=0) if how is not None else None
        return how

    @cached_property
    def _is_used(self) -> bool:
        """Whether any function of the tree tells a stream how to write."""
        functions = (func for group in self.folder.program.functions.values() for func in group)
        return any(_tells(func) for func in functions if func.file.language == "cpp")


def _tells(func: Func) -> bool:
    methods = shipped(_TABLE)["others"]["methods"]
    if any(_method(call) in methods for calls in func.calls for call in calls):
        return True
    values = (entry.value for entry in func.fact.body if isinstance(entry.value, Op) and entry.value.op == "+")
    return any(_is_manipulator(operand) for value in values for operand in value.operands[1:])


def _is_given_text(held: Held) -> bool:
    """Whether a stream holds a text that it was made with or that `str(text)` gave it, and nothing written since."""
    if held.how == "changed" and isinstance(held.expr, Call):
        return _method(held.expr) == "str" and held.expr.args not in {(), (Text(""),)}
    if held.how != "value" or held.expr is None or isinstance(held.expr, Op):
        return False
    return held.expr != Text("") and not (isinstance(held.expr, Call) and held.expr.args in {(), (Text(""),)})


def _is_told_by_methods(name: str, func: Func) -> bool:
    """Whether a function calls a method of a stream that changes how that writes."""
    methods = shipped(_TABLE)["others"]["methods"]
    on = (call for calls in func.calls for call in calls if _method(call) in methods)
    return any(isinstance(call.callee, Member) and call.callee.base == Name(name) for call in on)


def _is_stream(expr: Expr, env: Env) -> bool:
    written_as = env.func.written_types.get(expr.id, "") if isinstance(expr, Name) else ""
    return plain(written_as).rsplit("::", 1)[-1] in _WRITABLE


def _is_manipulator(expr: Expr) -> bool:
    """Whether an operand is a manipulator; one that is written without a package may be any variable."""
    table, name = shipped(_TABLE), _named(expr)
    if isinstance(expr, Call):
        return name in table["given"] or name in shipped_names(_TABLE, "others")
    return (
        isinstance(expr, Name)
        and expr.id == f"{_PACKAGE}::{name}"
        and (name in table["plain"] or name in shipped_names(_TABLE, "others"))
    )


def _named(expr: Expr | None) -> str:
    callee = expr.callee if isinstance(expr, Call) else expr
    return last_name(callee.id) if isinstance(callee, Name) else ""


def _method(expr: Expr | None) -> str:
    return expr.callee.name if isinstance(expr, Call) and isinstance(expr.callee, Member) else ""
