"""One round of a loop over what is known."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ecm_extract.infer.held import Turn

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Bound


class Round(NamedTuple):
    """A round of a loop.

    Attributes:
        item: the element that it has.
        path: the branches that nobody decides by which the element got there; empty where every run has it.
    """

    item: Bound
    path: tuple[Turn, ...] = ()
