"""Messages come more seldom than the contract of their publisher says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.view import View

from ecm_extract.observe.expected import Expected
from ecm_extract.observe.model import Stream
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS007",
    name="rate_below_contract",
    dimension="behavior",
    severity="error",
    who="safety",
    consequence="controllers and filters work with data that is older than they were tuned for",
    resolution="find what slows it down, or lower the rate in the contract",
)
_TOLERANCE = 0.9
_LEAST_MESSAGES = 5


def check(watch: Watch) -> Iterator[Finding]:
    """Rates that a contract gives a topic, and the only rate of a module that publishes one topic only."""
    streams = {(stream.topic, stream.node): stream for stream in watch.seen.streams}
    for pair in watch.pairs:
        if not pair.seen.row.writes:
            continue
        stream = streams.get((pair.seen.name, pair.seen.node)) or streams.get((pair.seen.name, None))
        wanted = _promised(pair.expected)
        if stream is not None and wanted is not None:
            yield from _slow(pair.expected, stream, *wanted)


def _slow(expected: Expected, stream: Stream, hertz: float, certainty: Certainty) -> Iterator[Finding]:
    if stream.hz is None or stream.count < _LEAST_MESSAGES or stream.hz >= hertz * _TOLERANCE:
        return
    module = expected.module
    text = f"{stream.topic} comes at {stream.hz:.3g} Hz, the contract of {module.id} says {hertz:g} Hz"
    evidence = module.evidence("behavior.rates")[:1]
    subjects = (module.id, stream.node or stream.topic)
    yield RULE.seen(text, Entity("rate", stream.topic), subjects, evidence, certainty=certainty)


def _promised(expected: Expected) -> tuple[float, Certainty] | None:
    rates = expected.module.rates
    interface = expected.interface
    for key in (interface.name, interface.raw_name, f"publisher {interface.name}"):
        if key in rates:
            return rates[key], "proved"
    return _only_rate(expected.module, rates)


def _only_rate(module: View, rates: Mapping[str, float]) -> tuple[float, Certainty] | None:
    """A module with one rate and one topic has most likely that rate on that topic."""
    different = set(rates.values())
    published = {each.name for each in module.written}
    if len(different) == 1 and len(published) == 1:
        return different.pop(), "likely"
    return None
