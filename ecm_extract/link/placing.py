"""What an endpoint is called that a library puts beside or below the name that it is given."""

from __future__ import annotations

from ecm_extract.link.values import Value, joined, literal, unknown

_NAME, _PARENT = "{name}", "{parent}"


def placed(value: Value, place: str) -> Value:
    """Return the name that a row makes of the name that is given: `{name}/get_parameters`, `{parent}/camera_info`."""
    if not place:
        return value
    if place.startswith(_PARENT):
        leaf = place.removeprefix(_PARENT).removeprefix("/")
        return _beside(value, leaf)
    return joined([(value,), (literal(place.removeprefix(_NAME)),)])[0]


def _beside(value: Value, leaf: str) -> Value:
    """The name with another last part; not known where a part that is not known may hold a slash."""
    last = value.parts[-1] if value.parts else ""
    if not isinstance(last, str):
        return unknown(leaf)
    folder, slash, _ = last.rpartition("/")
    if not slash:
        return literal(leaf) if len(value.parts) <= 1 else unknown(leaf)
    return Value((*value.parts[:-1], f"{folder}/{leaf}"), value.confidence)
