"""Names with open parts in one text: as tables write them, and as documents of older versions hold them.

`${parameter=default}` is given by a parameter; `{node}`, `{node namespace}` and `{parent namespace}` are of the node,
other words in braces told by nobody. `{in arm}out` is `out` of a node that its code puts in `arm`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Final

from ecm_checker.hub.local_name import LocalName, OpenPart, Teller, joined

_SPACE: Final = re.compile(r"\{in ([^{}]+)\}")
_OPEN: Final = re.compile(r"\$\{(?P<name>[^={}]+)=(?P<default>(?:[^{}]|\{[^{}]*\})*)\}|\{(?P<label>[^{}]*)\}")
_TELLERS: Final[Mapping[str, Teller]] = {
    "node": "node",
    "node namespace": "namespace",
    "parent namespace": "above",
}


def read_name(text: str) -> LocalName:
    """Return the name that a text stands for."""
    if "{" not in text:
        return LocalName((text,))
    space = _SPACE.match(text)
    if space is None:
        return LocalName(joined(_parts(text)))
    return LocalName(joined(_parts(text[space.end() :])), space[1])


def _parts(text: str) -> Iterator[str | OpenPart]:
    end = 0
    for found in _OPEN.finditer(text):
        yield text[end : found.start()]
        yield _open(found)
        end = found.end()
    yield text[end:]


def _open(found: re.Match[str]) -> OpenPart:
    if found["name"] is not None:
        return OpenPart("parameter", found["name"], joined(_parts(found["default"])))
    of = _TELLERS.get(found["label"], "nobody")
    return OpenPart(of, found["label"] if of == "nobody" else "")
