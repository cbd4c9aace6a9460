"""Ends that a declaration announces where it stands: in the comment above it, its description, its header.

Attributes and decorators are facts of the source file already; comments are not, so public headers that speak of
deprecation are searched as they stand.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import takewhile

import msgspec
from ecm_checker.hub.provision import Line, Provision

from ecm_extract.entities.cpp import MARKED
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import is_included

_MARK = re.compile(r"deprecat|obsolete", re.IGNORECASE)
_DIRECTIVE = re.compile(
    rb"^[ \t]*#[ \t]*(?:warning|pragma[ \t]+message)\b((?:[^\\\n]|\\\r?\n|\\.){0,600})$", re.MULTILINE
)
_JOIN = re.compile(r"\\\s|[\"()]+\s*[\"()]+")
_COMMENT = re.compile(r"^\s*(?://|/\*|\*)")
_TEMPLATE = re.compile(r"^\s*template\s*<.*>\s*$")
_ENDED = re.compile(r"(?i)^#+\s*(?:(?:it|this|the)\b.{0,60}\b(?:is|has been|was)\s+)?(?:deprecated|obsolete)\b")
_ATTRIBUTE = re.compile(r"\bdeprecated\s*\(((?:\s*\"(?:[^\"\\]|\\.)*\")+)")
_PIECE = re.compile(r"\"((?:[^\"\\]|\\.)*)\"")
MAX_ATTRIBUTE = 6
MAX_COMMENT = 40


def announced(side: SideTexts, packages: Iterable[PackageFacts], entities: Sequence[Provision]) -> list[Provision]:
    """Return the entities, with what their declarations say about their end."""
    texts = _descriptions(packages)
    lines: dict[str, list[str]] = defaultdict(list)
    headers = {entity.path for entity in entities if entity.row.included and is_included(entity.path)}
    texts |= _interface_heads(side, {entity.path for entity in entities if entity.row.generated})
    for path, data in side.speaking.items():
        if path in headers:
            lines[path] = data.decode("utf-8", "replace").splitlines()
            text = _directive(data)
            if text:
                texts[path, 0] = text
    return [_told(entity, texts, lines) for entity in entities]


def _interface_heads(side: SideTexts, paths: set[str]) -> dict[Line, str]:
    """What interface files say about their end above their first field."""
    found: dict[Line, str] = {}
    for path, data in side.speaking.items():
        if path in paths:
            lines = [line.strip() for line in data.decode("utf-8", "replace").splitlines()[:MAX_COMMENT]]
            head = takewhile(lambda line: not line or line.startswith("#"), lines)
            text = next((line.strip("# ") for line in head if _ENDED.search(line)), None)
            if text:
                found[path, 0] = text
    return found


def _directive(data: bytes) -> str:
    """What a `#warning` or `#pragma message` of a header says about its end, which may go over several lines."""
    for found in _DIRECTIVE.findall(data):
        text = " ".join(_JOIN.sub(" ", found.decode("utf-8", "replace")).split())
        if _MARK.search(text):
            return text.partition("//")[0].strip('()" ')
    return ""


def _descriptions(packages: Iterable[PackageFacts]) -> dict[Line, str]:
    """Texts of generated parameters and plugin descriptions that speak of the end of what they describe."""
    found: dict[Line, str] = {}
    for facts in packages:
        for path, namespaces in facts.parameters.items():
            for namespace in namespaces:
                for entry in namespace.parameters:
                    if _MARK.search(entry.description):
                        found[path, entry.line] = " ".join(entry.description.split())
        for path, classes in facts.plugins.items():
            for described in classes:
                if _MARK.search(described.description):
                    found[path, described.line] = described.description
    return found


def _told(entity: Provision, texts: dict[Line, str], lines: dict[str, list[str]]) -> Provision:
    """The entity with its announcement; of several overloads each has its own."""
    if entity.deprecated:
        text = _attribute(lines.get(entity.path, []), entity.line) if entity.deprecated == MARKED else None
        return msgspec.structs.replace(entity, deprecated=text) if text else entity
    told_at = entity.row.announced
    if told_at == "line":
        text = texts.get((entity.path, entity.line))
    elif told_at == "head":
        text = texts.get((entity.path, 0))
    elif told_at == "comment" and entity.path in lines:
        if len(entity.forms) > 1:
            return _overloads_told(entity, lines[entity.path])
        text = _comment_above(lines[entity.path], entity.line) or _named(entity, texts.get((entity.path, 0)))
    else:
        text = None
    return msgspec.structs.replace(entity, deprecated=text) if text else entity


def _attribute(lines: list[str], line: int) -> str | None:
    """The text of the `deprecated` attribute that stands at a declaration, or right above it."""
    first = max(0, line - MAX_ATTRIBUTE)
    end = sum(len(text) + 1 for text in lines[first:line])
    found = _ATTRIBUTE.finditer("\n".join(lines[first : line + MAX_ATTRIBUTE]))
    near = [match for match in found if match.start() < end]
    return " ".join("".join(_PIECE.findall(near[-1][1])).split()) if near else None


def _named(entity: Provision, directive: str | None) -> str | None:
    """The directive of a header that quotes a class of it: `'Box' is deprecated`."""
    own = re.escape(entity.name.rpartition("::")[2])
    return directive if directive and re.match(rf"['`\"]?{own}['`\"]? (?:is|has been) deprecated", directive) else None


def _overloads_told(entity: Provision, lines: list[str]) -> Provision:
    forms = tuple(
        msgspec.structs.replace(form, deprecated=form.deprecated or bool(_comment_above(lines, form.line)))
        for form in entity.forms
    )
    return msgspec.structs.replace(entity, forms=forms)


def _comment_above(lines: list[str], line: int) -> str | None:
    """The sentence on the end of a declaration in the comment right above it; None when there is none."""
    start = line - 2
    while 0 <= start < len(lines) and _TEMPLATE.match(lines[start]):
        start -= 1
    for above in range(start, max(-1, start - MAX_COMMENT), -1):
        if above >= len(lines) or not _COMMENT.match(lines[above]):
            return None
        text = lines[above].strip(" \t/*!<")
        if re.search(r"(?i)(?:^|[@\\\[\s])deprecated", text):
            return text
    return None
