"""What people wrote about the changes: commit messages and changelog entries between two refs."""

from __future__ import annotations

import re
from functools import cached_property
from pathlib import Path

from ecm_extract.diff.similarity import last_part
from ecm_extract.entities.notes import MAX_BYTES, is_note, sentences
from ecm_extract.entities.side import Side
from ecm_extract.errors import EcmError
from ecm_extract.tree.git_repo import find_repo

_WORD = re.compile(r"[A-Za-z_]\w{3,}")
_MAX_FILES = 200


class History:
    """Sentences about the changes, looked up by name."""

    def __init__(self, old: Side, new: Side, repo_folder: Path | None) -> None:
        self._old, self._new, self._folder = old, new, repo_folder

    @cached_property
    def _lines(self) -> list[str]:
        return [*self._messages(), *self._changelogs()]

    @cached_property
    def _index(self) -> dict[str, set[int]]:
        found: dict[str, set[int]] = {}
        for number, line in enumerate(self._lines):
            for word in _WORD.findall(line):
                found.setdefault(word, set()).add(number)
        return found

    def mentions(self, *names: str) -> str | None:
        """Return a sentence that names all of these, None when nobody wrote one."""
        words = [_WORD.findall(last_part(name)) for name in names]
        if not all(words) or len({last_part(name) for name in names}) < len(names):
            return None
        hits = [self._index.get(word, set()) for group in words for word in group]
        common = set.intersection(*hits) if hits else set()
        return self._lines[min(common)] if common else None

    def _messages(self) -> list[str]:
        repo = find_repo(self._folder) if self._folder is not None else None
        if repo is None or not self._old.commit or not self._new.commit:
            return []
        between = (self._new.commit, f"^{self._old.commit}")
        try:
            _, out = repo.run("rev-list", "--max-count=3000", "--format=%B", "--no-commit-header", *between)
        except EcmError:
            return []
        return sentences(out[:MAX_BYTES])

    def _changelogs(self) -> list[str]:
        paths = [path for path in self._new.blobs if is_note(path)]
        changed = [path for path in paths if self._new.blobs[path] != self._old.blobs.get(path)][:_MAX_FILES]
        before = self._old.notes([path for path in changed if path in self._old.blobs])
        found = []
        for path, lines in self._new.notes(changed).items():
            known = set(before.get(path, ()))
            found += [line for line in lines if line not in known]
        return found
