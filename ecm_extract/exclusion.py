"""What a project leaves out: `[extract] exclude`, patterns as in a `.gitignore`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import cached_property

from pathspec import GitIgnoreSpec

from ecm_extract.tree import Entry, FileDiagnostic, Tree, Unread, can_declare, printable


class Exclusion:
    """Patterns of paths that are not read, relative to the root of the tree.

    Args:
        patterns: as lines of a `.gitignore`: `*` stays within a folder, `**` is any depth, `!` takes back.
    """

    def __init__(self, patterns: Sequence[str]) -> None:
        self._patterns = tuple(patterns)

    @cached_property
    def _spec(self) -> GitIgnoreSpec:
        return GitIgnoreSpec.from_lines(self._patterns)

    def leaves_out(self, path: str) -> bool:
        """Whether a file is not read."""
        return self._spec.match_file(path)

    def kept(self, tree: Tree) -> tuple[Entry, ...]:
        """Files that no pattern leaves out; each pattern is reported to the tree with what it left out."""
        if not self._patterns:
            return tree.files()
        out: dict[str, list[str]] = defaultdict(list)
        kept = []
        for entry in tree.files():
            found = self._spec.check_file(entry.path)
            if found.include and found.index is not None:
                out[self._patterns[found.index]].append(entry.path)
            else:
                kept.append(entry)
        for pattern in self._patterns:
            tree.report(_note(pattern, out[pattern]))
        return tuple(kept)


def _note(pattern: str, files: Sequence[str]) -> FileDiagnostic:
    """A pattern that leaves out nothing is told too: another ref may hold what it means."""
    shown = printable(pattern)
    message = f"[extract] exclude leaves out {len(files)} file(s). Remove the pattern to read them."
    unread = Unread(shown, "excluded", any(can_declare(path) for path in files))
    return FileDiagnostic("info", "excluded", shown, 0, message, unread)
