"""What an endpoint is called that a library puts beside or below the name that it is given."""

from __future__ import annotations

from itertools import takewhile

from ecm_extract.link.running.values import Hole, Value, joined, literal, unknown

_NAME, _PARENT = "{name}", "{parent}"
PRIVATE = "~/{name}"
CAMERA_INFO = f"{_PARENT}/camera_info"
"""Beside an image: image_transport/camera_common.hpp, getCameraInfoTopic."""


def placed(value: Value, place: str) -> Value:
    """Return the name that a row makes of the name that is given.

    `{name}/get_parameters` is below it, `{parent}/camera_info` beside it; `~/{name}` is private unless the name
    says more.
    """
    if not place:
        return value
    if place == PRIVATE:
        return value if _head(value) else joined([(literal("~/"),), (value,)])[0]
    if place.startswith(_PARENT):
        leaf = place.removeprefix(_PARENT).removeprefix("/")
        return _beside(value, leaf)
    return joined([(value,), (literal(place.removeprefix(_NAME)),)])[0]


def _beside(value: Value, leaf: str) -> Value:
    """The name with another last part; not known where a part that is not known may hold a slash."""
    before, last = _last_text(value.parts)
    folder, slash, _ = last.rpartition("/")
    if slash:
        return Value((*before, f"{folder}/{leaf}"), value.confidence)
    head = _head(value)
    if not before:
        return Value((head + leaf,), value.confidence)
    return Value((head, *unknown(leaf).parts), "pattern") if head else unknown(leaf)


def _last_text(parts: tuple[str | Hole, ...]) -> tuple[tuple[str | Hole, ...], str]:
    """The parts up to the last one that is not known, and the text after it, of however many parts it is."""
    after = tuple(takewhile(lambda part: isinstance(part, str), reversed(parts)))
    return parts[: len(parts) - len(after)], "".join([str(part) for part in reversed(after)])


def _head(value: Value) -> str:
    """The mark that a name begins with, which says whose namespace it is in."""
    first = value.parts[0] if value.parts else ""
    return first[0] if isinstance(first, str) and first[:1] in {"/", "~"} else ""
