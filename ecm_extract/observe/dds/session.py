"""One watch of a DDS domain: discover, listen, and let the middleware watch."""

from __future__ import annotations

import gc
import time
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Final

from cyclonedds.domain import DomainParticipant
from ecm_checker.hub.roles import roles

from ecm_extract.observe.actions import with_actions
from ecm_extract.observe.dds.graph import Graph
from ecm_extract.observe.dds.listening import Listening
from ecm_extract.observe.dds.watchdogs import Watchdogs
from ecm_extract.observe.hearing.heard import Heard
from ecm_extract.observe.model import Gap, Observation, Sense

_SETTLE_S: Final = 2.0
_QUIET_S: Final = 0.5
_STEP_S: Final = 0.02
_SHOW_S: Final = 1.0
_BY_DISCOVERY: Final[tuple[Sense, ...]] = (*(role for role, row in roles().items() if row.peer), "qos")
_BY_LISTENING: Final[tuple[Sense, ...]] = ("rate", "transform", "diagnostic")


class _Session:
    """What is known of a domain, from one start."""

    def __init__(self, domain: int, listens: bool) -> None:
        self.began = datetime.now(UTC)
        self.start = time.monotonic()
        self._domain = domain
        self._listens = listens
        self._participant = DomainParticipant(domain)
        self._heard = Heard()
        self._graph = Graph(self._participant)
        self._listening = Listening(self._participant, self._heard, self._graph.node_of)
        self._watchdogs = Watchdogs(self._participant)
        self._followed = 0

    def step(self) -> None:
        """Take what came since the last step."""
        self._graph.look()
        if not self._listens:
            return
        if self._followed != self.changes:
            self._followed = self.changes
            found = self._graph.found()
            self._listening.follow(found)
            self._watchdogs.follow(found)
        self._listening.take()

    @property
    def changes(self) -> int:
        """How often an endpoint came or went."""
        return self._graph.discovery.changes

    def observation(self) -> Observation:
        """What is known now."""
        heard, nodes = self._heard, self._graph.nodes()
        gaps = [Gap(what, why) for what, why in sorted(self._listening.refused.items())]
        return Observation(
            source="dds",
            target=f"domain {self._domain}",
            ros=2,
            begun=self.began.isoformat(timespec="milliseconds").replace("+00:00", "Z"),
            seconds=round(time.monotonic() - self.start, 3),
            senses=tuple(self._senses(named=bool(nodes))),
            nodes=nodes,
            endpoints=with_actions(self._graph.endpoints(), 2),
            streams=heard.streams(),
            transforms=tuple(heard.transforms().found()),
            statuses=tuple(heard.statuses().found()),
            states=heard.states(),
            incidents=(*self._watchdogs.incidents(), *self._listening.incidents()),
            gaps=(*gaps, *self._graph.gaps(), *heard.gaps()),
        )

    def _senses(self, named: bool) -> Iterator[Sense]:
        """Parameters are behind services, which are never called."""
        yield from _BY_DISCOVERY
        if named:
            yield "node"
        if self._listens:
            yield from _BY_LISTENING


def watch_dds(domain: int, seconds: float, *, once: bool = False) -> Iterator[Observation]:
    """Yield what is seen of a domain, each second anew; the last one is the whole.

    Args:
        domain: number of the domain.
        seconds: how long to listen.
        once: discover, at most for two seconds, and do not listen.
    """
    try:
        yield from _watch(domain, seconds, once)
    finally:
        # Built-in readers of cyclonedds refer to themselves by a condition, so only the collector frees them.
        gc.collect()


def _watch(domain: int, seconds: float, once: bool) -> Iterator[Observation]:
    session = _Session(domain, listens=not once)
    if once:
        _settle(session)
    else:
        yield from _listen(session, session.start + seconds)
    session.step()
    yield session.observation()


def _listen(session: _Session, end: float) -> Iterator[Observation]:
    show = session.start + _SHOW_S
    while time.monotonic() < end:
        session.step()
        if time.monotonic() > show:
            show = time.monotonic() + _SHOW_S
            yield session.observation()
        time.sleep(_STEP_S)


def _settle(session: _Session) -> None:
    """Peers tell what they have within two seconds; once they have begun, half a second of silence is the end."""
    quiet_since, known = session.start, 0
    while time.monotonic() < session.start + _SETTLE_S:
        session.step()
        if session.changes != known:
            quiet_since, known = time.monotonic(), session.changes
        if known and time.monotonic() - quiet_since > _QUIET_S:
            return
        time.sleep(_STEP_S)
