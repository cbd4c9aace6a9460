"""Names below the namespace that code gives a node, in whose place comes the one that a launch gives it.

`{in arm}out` is `/arm/out` of a node that is launched without a namespace, and `/left/out` below `left`.
Source: design.ros2.org "Remapping names": `__ns` replaces the namespace of the node.
"""

from __future__ import annotations

import re
from typing import NamedTuple

_MARK = re.compile(r"^\{in ([^{}]+)\}")


class Placed(NamedTuple):
    """A name for any namespace and node, and the namespace that the code gives the node; empty for none."""

    space: str
    name: str


def marked(space: str, name: str) -> str:
    """Return a name with the namespace of its node before it; below one that is not wholly known as it stands."""
    if not space or name.startswith("/"):
        return name
    if "{" in space:
        return name if name.startswith("~") else f"{space}/{name}"
    return f"{{in {space}}}{name}"


def unmarked(local: str) -> Placed:
    """Return what `marked` was given."""
    found = _MARK.match(local)
    return Placed(found[1], local[found.end() :]) if found else Placed("", local)
