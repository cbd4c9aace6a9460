"""What the line that declares a name says beside the name, so that it is known again under another one."""

from __future__ import annotations

import hashlib
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.hub.provision import HOLE, Provision

from ecm_extract.tree import Tree

_MAX_LINES: Final = 4
"""A call may go over several lines; its name stands in one of the first."""
_QUOTED: Final = r"(?<=[\"'/~]){}(?=[\"'])"
_PARTS: Final = re.compile(r"[/.:~]+")
_TELLING: Final = re.compile(r"[\w\]>)]\s*=[^=]|[&:]\w+::\w+|self\.\w+|\bbind\b|\[[&=\w, ]*\]\s*\(|\bthis->\w+")
"""What a line assigns, or hands on, tells it from its like; a bare call does not."""

_PLAIN: Final = re.compile(r"=\s*([\"'])(?:[Tt]rue|[Ff]alse|[-+.\d]*|<\*>)\1")
"""A number or truth value that an attribute or argument has, as many do, or the name itself."""


def with_lines(tree: Tree, entities: Sequence[Provision]) -> Iterator[Provision]:
    """Yield the entities, those that a telling line declares by a literal name with the hash of that line."""
    wanted: dict[str, list[Provision]] = defaultdict(list)
    for entity in entities:
        if entity.row.by_line and HOLE not in entity.name:
            wanted[entity.path].append(entity)
        else:
            yield entity
    for path, data in _contents(tree, wanted):
        lines = [" ".join(text.split()) for text in data.decode("utf-8", "replace").splitlines()]
        for entity in wanted[path]:
            yield msgspec.structs.replace(entity, written=_written(entity, lines))


def _contents(tree: Tree, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
    """Each path once, with nothing where the file cannot be read."""
    missing = dict.fromkeys(sorted(paths))
    for path, data in tree.read_many(list(missing)):
        missing.pop(path, None)
        yield path, data
    yield from ((path, b"") for path in missing)


def _written(entity: Provision, lines: Sequence[str]) -> str:
    name = re.compile(_QUOTED.format(re.escape(_PARTS.split(entity.name)[-1])))
    start = max(0, entity.line - 1)
    text = ""
    for line in lines[start : start + _MAX_LINES]:
        text = f"{text} {line}" if text else line
        holed = name.sub(HOLE, text)
        if holed != text:
            is_telling = _TELLING.search(_PLAIN.sub("", holed))
            return hashlib.sha256(holed.encode()).hexdigest()[:16] if is_telling else ""
    return ""
