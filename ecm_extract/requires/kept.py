"""Files that a project keeps for one distribution beside those for the others, and picks when it is launched."""

from __future__ import annotations

from collections.abc import Container
from typing import Final

DISTRIBUTIONS: Final = frozenset(
    {
        *("groovy", "hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic"),
        *("ardent", "bouncy", "crystal", "dashing", "eloquent", "foxy", "galactic", "humble", "iron", "jazzy"),
        *("kilted", "lyrical", "rolling"),
    }
)
"""Names of ROS distributions (REP 3, REP 2000)."""


def kept_for(path: str, paths: Container[str]) -> str:
    """The distribution in whose folder a file lies, when the file of that name beside the folder is there too.

    Args:
        path: of the file.
        paths: of all files of the tree.
    """
    parts = path.split("/")
    for at, part in enumerate(parts[:-1]):
        if part.lower() in DISTRIBUTIONS and "/".join((*parts[:at], *parts[at + 1 :])) in paths:
            return part.lower()
    return ""
