"""Read recordings message by message; what is broken in one costs nothing of the others."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from ecm_extract.errors import InputError
from ecm_extract.observe.bag.connections import recorded
from ecm_extract.observe.hearing.contents import DIAGNOSTICS, OLD_TRANSFORMS, TRANSFORMS
from ecm_extract.observe.hearing.heard import Heard
from ecm_extract.observe.model import Endpoint, Gap, Node, Observation, Sense

_BLOCK: Final = 1 << 20
_NS: Final = 1e-9
_HINT: Final = "name a .bag file, a folder with metadata.yaml, an .mcap or a .db3 file"


class _Recording:
    """What is collected over all files."""

    def __init__(self) -> None:
        self.heard = Heard()
        self.endpoints: list[Endpoint] = []
        self.gaps: list[Gap] = []
        self.rosses: set[int] = set()

    def add(self, path: Path) -> None:
        """Read one recording."""
        ros = 1 if path.suffix == ".bag" else 2
        with _opened(path, ros) as reader:
            self.rosses.add(ros)
            listeners = {}
            for connection in reader.connections:
                found = recorded(connection, ros)
                self.endpoints += found.endpoints
                listeners[connection.id] = self.heard.listener(found.channel)
            takers = {number: listener.message for number, listener in listeners.items()}
            for connection, time_ns, raw in reader.messages():
                takers[connection.id](raw, time_ns)
            self._count(path, reader.message_count, sum(each.arrivals.count for each in listeners.values()))

    def _count(self, path: Path, told: int, read: int) -> None:
        """A recording says how many messages it holds; fewer are a part of it."""
        if read < told:
            self.gaps.append(Gap(str(path), f"{read} of the {told} messages that it says it holds are there"))


def observe_bags(paths: Sequence[Path]) -> Observation:
    """Return what recordings hold.

    Raises:
        InputError: one is not there, or none of them can be read.
    """
    for path in paths:
        if not path.exists():
            message = f"there is no {path}"
            raise InputError(message, _HINT)
    recording = _Recording()
    for path in paths:
        try:
            recording.add(path)
        except Exception as error:  # the file is somebody else's, and its reader raises whatever it leads it to
            recording.gaps.append(Gap(str(path), f"{error or type(error).__name__}"))
    if not recording.rosses:
        gap = recording.gaps[0]
        message = f"{gap.what} cannot be read: {gap.why}"
        raise InputError(message, _HINT)
    return _observation(recording, paths)


def _opened(path: Path, ros: int) -> AbstractContextManager[Any]:
    if ros == 1:
        from rosbags.rosbag1 import Reader as Reader1

        reader1: AbstractContextManager[Any] = Reader1(path)
        return reader1
    from rosbags.rosbag2 import Reader as Reader2

    reader2: AbstractContextManager[Any] = Reader2(path)
    return reader2


def _observation(recording: _Recording, paths: Sequence[Path]) -> Observation:
    heard, endpoints = recording.heard, recording.endpoints
    first, last = heard.span_ns()
    return Observation(
        source="bag",
        target=" ".join(map(str, paths)),
        ros=None if len(recording.rosses) > 1 else min(recording.rosses),  # type: ignore[arg-type]
        begun=datetime.fromtimestamp(first * _NS, UTC).isoformat().replace("+00:00", "Z"),
        seconds=(last - first) * _NS,
        senses=tuple(_senses(endpoints)),
        nodes=tuple(Node(name) for name in sorted({end.node for end in endpoints if end.node})),
        endpoints=tuple(endpoints),
        streams=heard.streams(),
        transforms=tuple(heard.transforms().found()),
        statuses=tuple(heard.statuses().found()),
        states=heard.states(),
        gaps=(*recording.gaps, *heard.gaps()),
        digest=_digest(paths),
    )


def _senses(endpoints: Iterable[Endpoint]) -> Iterator[Sense]:
    """A topic that is not in a recording may not have been recorded, so publishers are not among them."""
    yield "rate"
    kinds = {end.type for end in endpoints}
    if any(end.qos is not None for end in endpoints):
        yield "qos"
    if not kinds.isdisjoint({TRANSFORMS, OLD_TRANSFORMS}):
        yield "transform"
    if DIAGNOSTICS in kinds:
        yield "diagnostic"


def _digest(paths: Sequence[Path]) -> str:
    """SHA-256 over the content of all files in the order of their names, each with its name."""
    digest = hashlib.sha256()
    for path in paths:
        files = [path] if path.is_file() else sorted(found for found in path.rglob("*") if found.is_file())
        for file in files:
            digest.update(f"{file.name}\0{file.stat().st_size}\0".encode())
            with file.open("rb") as stream:
                while block := stream.read(_BLOCK):
                    digest.update(block)
    return f"sha256:{digest.hexdigest()}"
