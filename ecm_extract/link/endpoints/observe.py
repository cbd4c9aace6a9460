"""When modules act and what they wait for, read off calls by the table `observations.toml`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from types import MappingProxyType
from typing import Literal, NamedTuple

import msgspec
from ecm_checker.contract import Evidence
from ecm_parsers.source.expr import Expr, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.folding.durations import seconds_of
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.owning.activation import Activation
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped

Kind = Literal["timer", "rate", "wait_service", "wait_action", "wait_message", "wait_transform"]
MAX_RATE = 1e5


class ObservationForm(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One row: the callee, what it shows, and the positions of a time in seconds (or hertz) and of names."""

    callee: str
    kind: Kind
    time: str = ""
    name: str = ""
    other: str = ""

    @property
    def last(self) -> str:
        """Last part of the callee's name."""
        return self.callee.rsplit(".", 1)[-1]


class Observation(NamedTuple):
    """Something that a module does.

    Attributes:
        kind: what. name: the awaited service, topic or `target <- source` of frames; empty when not known.
        value: seconds between two timer calls or of the longest wait, hertz of a rate; None when not known.
        evidence: the line. beginning: it happens while the module is brought to work, not in a callback.
    """

    kind: Kind
    name: str
    value: float | None
    evidence: Evidence
    beginning: bool


@cache
def observation_forms() -> Mapping[str, Sequence[ObservationForm]]:
    """Return the rows by the last part of their callee."""
    rows = msgspec.convert(shipped("link/endpoints/observations.toml")["observation"], list[ObservationForm])
    return MappingProxyType({row.last: [each for each in rows if each.last == row.last] for row in rows})


def observations(sites: Sites, activation: Activation) -> Iterator[tuple[Cls | Func, Observation]]:
    """Yield what the units of a program do, each with the class or function that does it."""
    for last, rows in observation_forms().items():
        for call in sites.calls.get(last, ()):
            row = next((row for row in rows if _is(row, call)), None)
            if row is not None and not _hands_on(row, call):
                env = sites.root_env(call.func, call.at)
                seen = _observed(row, call, env, sites.folder, activation.runs(call))
                yield call.func.holder or call.func, seen


def _is(row: ObservationForm, call: Invocation) -> bool:
    if "." in row.callee:
        return call.path == row.callee
    if row.kind == "rate" and row.callee != "create_rate":
        return call.receiver is None and bool(call.args or call.keywords)
    return row.callee not in call.path.split("::")[:-1]


def _hands_on(row: ObservationForm, call: Invocation) -> bool:
    """A function that passes its own parameter on is a wrapper: it does not know the time itself."""
    own = {entry.name for entry in call.func.fact.params}
    return any(isinstance(expr, Name) and expr.id in own for expr in positions(row.time, call))


def _observed(row: ObservationForm, call: Invocation, env: Env, folder: Folder, beginning: bool) -> Observation:
    evidence = Evidence(call.func.file.path, call.line)
    return Observation(row.kind, _name(row, call, env, folder), _time(row, call, env, folder), evidence, beginning)


def _time(row: ObservationForm, call: Invocation, env: Env, folder: Folder) -> float | None:
    for expr in positions(row.time, call):
        found = seconds_of(expr, env, folder)
        if found is not None and 0 < found < MAX_RATE:
            return found
    return None


def _name(row: ObservationForm, call: Invocation, env: Env, folder: Folder) -> str:
    names = [_text(expr, env, folder) for expr in _first(row.name, call) + _first(row.other, call)]
    return " <- ".join(names) if all(names) else ""


def _first(position: str, call: Invocation) -> list[Expr]:
    found = next(positions(position, call), None)
    return [] if found is None else [found]


def _text(expr: Expr, env: Env, folder: Folder) -> str:
    value = folder.fold(expr, env)[0]
    return "" if value.confidence == "pattern" else value.text
