"""How much one evaluation of launch files may take in all, so that every input ends and what is left out is told."""

from __future__ import annotations

from ecm_extract.system.model import Place

MAX_STEPS = 1_000_000
"""Parts of texts that are evaluated, parameters and remaps that nodes are given."""
MAX_CHARACTERS = 8_000_000
"""Characters of all texts that are made."""
MAX_NODES = 5_000
FILE_STEPS = 500
"""What reading one launch file counts."""


class BudgetError(Exception):
    """An evaluation took more than it may."""

    def __init__(self, bound: int, unit: str) -> None:
        super().__init__(f"more than {bound:,} {unit}")


class Budget:
    """Shared by all launch files of one evaluation.

    Attributes:
        place: of the action that is being evaluated. cut: places of texts that are longer than is read.
    """

    def __init__(self) -> None:
        self.place = Place("", 0)
        self.cut: dict[Place, None] = {}
        self._steps = 0
        self._characters = 0
        self._nodes = 0

    def spend(self, steps: int, characters: int = 0) -> None:
        """Count work.

        Raises:
            BudgetError: it is too much.
        """
        self._steps += steps
        self._characters += characters
        if self._steps > MAX_STEPS:
            raise BudgetError(MAX_STEPS, "steps")
        if self._characters > MAX_CHARACTERS:
            raise BudgetError(MAX_CHARACTERS, "characters of text")

    def node(self) -> None:
        """Count a node that is started.

        Raises:
            BudgetError: there are too many.
        """
        self._nodes += 1
        if self._nodes > MAX_NODES:
            raise BudgetError(MAX_NODES, "nodes")

    def cut_here(self) -> None:
        """Take note that a text of the action is longer than is read."""
        self.cut.setdefault(self.place)
