"""Packages and their files, as launch files, descriptions and Python name them.

Source: roslaunch and xacro (`$(find PKG)`), launch_ros (`$(find-pkg-share PKG)`, FindPackageShare), resource_retriever
(`package://PKG/...`), ament_index_python (get_package_share_directory), roslaunch `<node pkg= args=>`.
"""

from __future__ import annotations

import re
from typing import Final, Literal

import msgspec

from ecm_parsers.result import Parsed

Form = Literal["find", "uri", "call", "start", "load"]

_FORMS: Final = re.compile(
    rb"""\$\(find(?:-pkg-share|-pkg-prefix)?\s+(?P<find>\w+)\s*\)|package://(?P<uri>\w+)(?=/)"""
    rb"""|(?:FindPackageShare|get_package_share_directory|get_package_share_path)\(\s*['"](?P<call>\w+)['"]"""
    rb"""|\bpkg\s*=\s*"(?P<start>\w+)"|\bpackage\s*=\s*['"](?P<node>\w+)['"]"""
    rb"""|\bargs\s*=\s*"\s*(?:load|standalone)\s+(?P<load>\w+)/\w"""
)
_PATH: Final = re.compile(rb"/([\w./-]+)")
_COMMENT: Final = re.compile(rb"<!--.*?-->|^[ \t]*#[^\n]*", re.DOTALL | re.MULTILINE)
_NO_LINE_END: Final = re.compile(rb"[^\n]+")
_WORDS: Final[dict[str, Form]] = {"node": "start"}


class Reference(msgspec.Struct, frozen=True):
    """A package that a line names.

    Attributes:
        package: its name.
        path: what follows it below its share folder, as far as it is written out; empty for nothing.
        form: how it is named: `$(find ...)`, `package://`, a call, the package of a program, a nodelet that is loaded.
        line: 1-based.
    """

    package: str
    path: str
    form: Form
    line: int


def parse_references(data: bytes) -> Parsed[tuple[Reference, ...]]:
    """Return the packages that a file names outside of comments, in order."""
    data = _COMMENT.sub(lambda match: _NO_LINE_END.sub(b"", match[0]), data)
    found = []
    line, counted = 1, 0
    for match in _FORMS.finditer(data):
        line += data.count(b"\n", counted, match.start())
        counted = match.start()
        word = match.lastgroup or "find"
        after = _PATH.match(data, match.end()) if word in {"find", "uri"} else None
        path = after[1].decode() if after is not None else ""
        form: Form = _WORDS.get(word, word)  # type: ignore[arg-type]
        found.append(Reference(match[word].decode(), path, form, line))
    return Parsed(tuple(found))
