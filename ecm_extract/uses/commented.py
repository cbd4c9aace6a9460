"""Lines of a consumer on which a person has said that the break is known."""

from __future__ import annotations

from typing import Final

from ecm_extract.answers.comments import Comment, comments_in
from ecm_extract.errors import TreeReadError
from ecm_extract.tree import Tree
from ecm_extract.uses.model import Use

_RULE: Final = "VER001"


class CommentedLines:
    """Comments `ecm: ignore[VER001]` of a tree; each reader of a change is answered by itself."""

    def __init__(self, tree: Tree) -> None:
        self._tree = tree
        self._found: dict[str, list[Comment]] = {}

    def answer(self, use: Use) -> bool:
        """Tell whether a comment on the line of a use, or on the one before, answers it."""
        if use.path not in self._found:
            self._found[use.path] = [each for each in comments_in((use.path,), self._read) if _RULE in each.rules]
        change = use.located.change
        names = f"{change.old} {change.new} {use.what}"
        return any(use.line - each.line in (0, 1) and each.word in names for each in self._found[use.path])

    def _read(self, path: str) -> bytes | None:
        try:
            return self._tree.read(path)
        except TreeReadError:
            return None
