"""One watch of a ROS 1 graph: ask, listen to every publisher, look again each second."""

from __future__ import annotations

import time
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Final

from ecm_checker.hub.roles import roles

from ecm_extract.errors import InputError
from ecm_extract.observe.actions import with_actions
from ecm_extract.observe.hearing.heard import Channel, Heard
from ecm_extract.observe.hearing.layouts import begins_with_header
from ecm_extract.observe.model import Gap, Node, Observation, Sense
from ecm_extract.observe.ros1.asking import Answers, Publication, full_type
from ecm_extract.observe.ros1.listening import MOST_CONNECTIONS, Listening
from ecm_extract.observe.ros1.master import Master
from ecm_extract.observe.ros1.peer import PeerError

_LOOK_AGAIN_S: Final = 1.0
_UNTOLD: Final = "service_client"
"""The master knows who serves, not who calls."""
_BY_ASKING: Final[tuple[Sense, ...]] = (
    "node",
    *(role for role, row in roles().items() if not row.transform and role != _UNTOLD),
)
_BY_LISTENING: Final[tuple[Sense, ...]] = ("rate", "transform", "diagnostic")


class _Session:
    """Answers and what is heard, from one start."""

    def __init__(self, uri: str, listens: bool) -> None:
        self.began = datetime.now(UTC)
        self.start = time.monotonic()
        self.answers = Answers(Master(uri))
        self.heard = Heard()
        self.listening = Listening(self.heard)
        self._listens = listens

    def look(self) -> None:
        """Ask, and listen to publishers that are new."""
        for each in self.answers.look():
            if not self._listens:
                each.connection.close()
            elif self.listening.count >= MOST_CONNECTIONS:
                each.connection.close()
                self.answers.gaps["rates"] = f"there are more than {MOST_CONNECTIONS} publishers"
            else:
                self.listening.add(each.connection, _channel(each))

    def observation(self) -> Observation:
        """What is known now."""
        answers, heard = self.answers, self.heard
        gaps = [Gap(what, why) for what, why in sorted(answers.gaps.items())]
        return Observation(
            source="ros1",
            target=answers.master.uri,
            ros=1,
            begun=self.began.isoformat(timespec="milliseconds").replace("+00:00", "Z"),
            seconds=round(time.monotonic() - self.start, 3),
            senses=(*_BY_ASKING, *(_BY_LISTENING if self._listens else ())),
            nodes=tuple(Node(name, answers.addresses.get(name, "")) for name in answers.graph.nodes),
            endpoints=with_actions(answers.endpoints(), 1),
            parameters=answers.parameters,
            streams=heard.streams(),
            transforms=tuple(heard.transforms().found()),
            statuses=tuple(heard.statuses().found()),
            gaps=(*gaps, *heard.gaps()),
        )


def watch_ros1(uri: str, seconds: float, *, once: bool = False) -> Iterator[Observation]:
    """Yield what is seen of a graph, each second anew; the last one is the whole.

    Args:
        uri: of the master.
        seconds: how long to listen.
        once: look once and do not listen.

    Raises:
        InputError: there is no master.
    """
    session = _Session(uri, listens=not once)
    try:
        _first_look(session)
        end = session.start + seconds
        while not once and (left := end - time.monotonic()) > 0:
            session.listening.run(time.monotonic() + min(left, _LOOK_AGAIN_S))
            if end - time.monotonic() > _LOOK_AGAIN_S:
                yield session.observation()
                session.answers.attempt("the master", session.look)
        yield session.observation()
    finally:
        session.listening.close()


def _first_look(session: _Session) -> None:
    try:
        session.look()
    except PeerError as error:
        message = f"there is no ROS 1 master at {session.answers.master.uri}: {error}"
        raise InputError(message, "start roscore, or name its address: --ros1 http://host:11311") from None


def _channel(found: Publication) -> Channel:
    header = found.header
    kind = full_type(header.get("type"), "msg")
    headed = kind is not None and begins_with_header(kind, header.get("message_definition"))
    return Channel(found.end.name, found.end.node, kind, "ros1", headed, header.get("latching") == "1")
