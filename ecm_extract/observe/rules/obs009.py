"""Several nodes write to one actuator at once."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.hub.roles import roles

from ecm_extract.observe.actuation import moves
from ecm_extract.observe.model import Endpoint
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS009",
    name="several_actuator_writers",
    dimension="resources",
    severity="error",
    who="safety",
    consequence="the robot follows whichever message came last and jerks between them",
    resolution="give each its own topic and put a multiplexer before the base, or stop all but one",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Actuation topics with several publishing nodes and somebody who listens."""
    for (role, name), ends in watch.by_name.items():
        commands = [end for end in ends if moves(end.name, end.type)]
        writers = sorted({end.node for end in commands if end.node is not None})
        if roles()[role].writes and len(writers) > 1:
            yield _finding(watch, name, writers, watch.by_name.get((roles()[role].peer, name), ()))


def _finding(watch: Watch, name: str, writers: list[str], readers: tuple[Endpoint, ...]) -> Finding:
    """Proved when two of them were seen to send: a publisher that is silent harms nobody yet."""
    sent = {stream.node for stream in watch.seen.streams if stream.topic == name and stream.count > 0}
    active = [node for node in writers if node in sent]
    who = f", read by {', '.join(sorted({end.node or 'a node' for end in readers}))}" if readers else ""
    told = f"; messages of {', '.join(active)} were seen" if len(active) > 1 else ""
    text = f"{name} is published by {', '.join(writers)}{who}{told}"
    certainty: Certainty = "proved" if len(active) > 1 else "likely"
    return RULE.seen(text, Entity("topic", name), writers, certainty=certainty)
