"""Messages that are decoded: transforms, diagnostics, transitions of life cycles. Types come from the ROS itself."""

from __future__ import annotations

from functools import cache
from typing import Any, Final, Literal, TypeAlias

Encoding: TypeAlias = Literal["ros1", "cdr"]

TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"
OLD_TRANSFORMS: Final = "tf/msg/tfMessage"
DIAGNOSTICS: Final = "diagnostic_msgs/msg/DiagnosticArray"
TRANSITION: Final = "lifecycle_msgs/msg/TransitionEvent"
DECODED: Final = frozenset({TRANSFORMS, OLD_TRANSFORMS, DIAGNOSTICS, TRANSITION})


def decoded(raw: bytes, kind: str, encoding: Encoding) -> Any | None:
    """A message of one of `DECODED` as an object with its fields; None when the bytes are none."""
    store = _store(encoding)
    name = TRANSFORMS if kind == OLD_TRANSFORMS else kind
    read = store.deserialize_ros1 if encoding == "ros1" else store.deserialize_cdr
    try:
        return read(raw, name)
    except Exception:  # the bytes are somebody else's, and the decoder raises whatever they lead it to
        return None


@cache
def _store(encoding: Encoding) -> Any:
    from rosbags.typesys import Stores, get_typestore

    latest = get_typestore(Stores.LATEST)
    if encoding == "cdr":
        return latest
    noetic = get_typestore(Stores.ROS1_NOETIC)
    noetic.register({TRANSFORMS: latest.fielddefs[TRANSFORMS]})
    return noetic
