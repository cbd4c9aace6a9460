"""Requirements on whose line a person has said that a break of them is known: `ecm: ignore[VER001]`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Requirement

from ecm_extract.answers.comments import Comment, comments_in
from ecm_extract.tree import Tree

_RULE: Final = "VER001"
_MARK: Final = b"ecm:"
Comments = Mapping[str, Sequence[Comment]]


def comments_of(tree: Tree, paths: Iterable[str]) -> Comments:
    """Return the comments of some files that answer breaks, by path."""
    texts = {path: data for path, data in tree.read_many(sorted(set(paths))) if _MARK in data}
    found: dict[str, list[Comment]] = defaultdict(list)
    for comment in comments_in(texts, texts.get):
        if _RULE in comment.rules:
            found[comment.path].append(comment)
    return found


def with_answers(entry: Requirement, comments: Comments) -> Iterator[Requirement]:
    """Yield a requirement, its answered lines apart from the others."""
    if not any(at.path in comments for at in entry.evidence):
        yield entry
        return
    words = {at: _words(at, comments) for at in entry.evidence}
    answered = [at for at in entry.evidence if words[at]]
    if not answered:
        yield entry
        return
    left = tuple(at for at in entry.evidence if not words[at])
    if left:
        yield msgspec.structs.replace(entry, evidence=left)
    for at in answered:
        yield msgspec.structs.replace(entry, evidence=(at,), ignored=words[at])


def _words(at: Evidence, comments: Comments) -> tuple[str, ...]:
    """What must stand in a break for a comment on the line, or the one before, to answer it; empty for anything."""
    return tuple(each.word for each in comments.get(at.path, ()) if at.line - each.line in (0, 1))
