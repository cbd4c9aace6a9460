"""What an endpoint is called that a library puts beside or below the name that it is given."""

from __future__ import annotations

from ecm_extract.link.running.values import Value, joined, literal, unknown

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
    last = value.parts[-1] if value.parts else ""
    folder, slash, _ = last.rpartition("/") if isinstance(last, str) else ("", "", "")
    if slash:
        return Value((*value.parts[:-1], f"{folder}/{leaf}"), value.confidence)
    head = _head(value)
    if len(value.parts) <= 1 and isinstance(last, str):
        return Value((head + leaf,), value.confidence)
    return Value((head, *unknown(leaf).parts), "pattern") if head else unknown(leaf)


def _head(value: Value) -> str:
    """The mark that a name begins with, which says whose namespace it is in."""
    first = value.parts[0] if value.parts else ""
    return first[0] if isinstance(first, str) and first[:1] in {"/", "~"} else ""
