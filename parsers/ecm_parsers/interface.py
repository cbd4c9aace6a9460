"""`.msg`, `.srv`, `.action` -> fields and constants by section.

Sources: genmsg (ROS 1, wiki.ros.org/msg) and rosidl (ROS 2, "Interface definition" of its manual). One reader
serves both: where they differ (string constants) both readings are kept.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from ecm_parsers.interface_facts import (
    PRIMITIVES,
    SECTIONS,
    ArrayKind,
    Constant,
    Definition,
    Field,
    Section,
    Shape,
)
from ecm_parsers.numbers import integer
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.text import decode
from ecm_parsers.units import unit_of

MAX_BYTES = 1_000_000
_STRINGS = ("string", "wstring")
_TYPE = r"(?P<type>[A-Za-z]\w*(?:/\w+){0,2}(?:<=\d{1,10})?(?:\[(?:(?:<=)?\d{1,10})?\])?)"
_HEAD = rf"\s*(?:@\w+\s+)*{_TYPE}\s+(?P<name>[A-Za-z_]\w*)"
_CONSTANT = re.compile(rf"{_HEAD}\s*=(?P<rest>.*)", re.ASCII)
_FIELD = re.compile(rf"{_HEAD}(?P<rest>$|[\s#].*)", re.ASCII)
_ANNOTATION = re.compile(r"\s*(?:@\w+\s*)+(?:#.*)?$", re.ASCII)
_SEPARATOR = re.compile(r"\s*---+\s*(?:#.*)?$")
_TYPE_PARTS = re.compile(r"([\w/]+)(?:<=(\d+))?(?:\[(<=)?(\d*)\])?", re.ASCII)
_QUOTED = re.compile(r"""\s*(?P<value>"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')\s*(?:#(?P<comment>.*))?$""")
_BEFORE_COMMENT = re.compile(r"""(?:[^#"']|"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')*+(?=#|$)""")


class _Line(NamedTuple):
    """A declaration with the comments that belong to it."""

    number: int
    text: str
    comment: str
    doc: str


def parse(data: bytes, shape: Shape) -> Parsed[Definition]:
    """Read one interface file.

    Args:
        data: its bytes, at most `MAX_BYTES`.
        shape: the file's suffix, which decides how many sections it has.

    Returns:
        The definition with every section of the shape, and diagnostics for the lines that could not be read.
    """
    if shape not in SECTIONS:
        message = f"`{shape}` is no interface shape. Pass msg, srv or action."
        empty = Definition("msg", (Section("message"),))
        return Parsed(empty, (Diagnostic("error", "interface-unknown-shape", 0, message),))
    if len(data) > MAX_BYTES:
        message = f"The file exceeds {MAX_BYTES} bytes and is skipped. Check that it is an interface."
        empty = Definition(shape, tuple(Section(name) for name in SECTIONS[shape]))
        return Parsed(empty, (Diagnostic("error", "interface-too-large", 0, message, cut=True),))
    text, found = decode(data)
    diagnostics = list(found)
    sections = _read_sections(text, shape, diagnostics)
    return Parsed(Definition(shape, sections), tuple(diagnostics))


def _read_sections(text: str, shape: Shape, diagnostics: list[Diagnostic]) -> tuple[Section, ...]:
    names = SECTIONS[shape]
    parts: list[list[tuple[int, str]]] = [[]]
    for number, line in enumerate(text.split("\n"), 1):
        if _SEPARATOR.match(line):
            parts.append([])
            _check_separator(len(parts), names, number, diagnostics)
        else:
            parts[-1].append((number, line))
    if len(parts) < len(names):
        message = f"A .{shape} needs {len(names) - 1} `---` lines, this has {len(parts) - 1}. Add the missing."
        diagnostics.append(Diagnostic("error", "interface-separators", 0, message))
        parts.extend([] for _ in range(len(names) - len(parts)))
    return tuple(_read_section(name, lines, diagnostics) for name, lines in zip(names, parts, strict=False))


def _check_separator(count: int, names: tuple[str, ...], line: int, diagnostics: list[Diagnostic]) -> None:
    if count == len(names) + 1:
        message = "There are more `---` lines than sections; the rest is not read. Remove the extra line."
        diagnostics.append(Diagnostic("error", "interface-separators", line, message))


def _read_section(name: str, lines: list[tuple[int, str]], diagnostics: list[Diagnostic]) -> Section:
    fields: dict[str, Field] = {}
    constants: dict[str, Constant] = {}
    for line in _with_comments(lines):
        item = _read_constant(line) or _read_field(line)
        if item is None:
            message = f"`{_shorten(line.text)}` is neither a field nor a constant. Write `type name`."
            diagnostics.append(Diagnostic("error", "interface-bad-line", line.number, message))
        elif item.name in fields or item.name in constants:
            message = f"`{item.name}` is declared twice in this section; the first stays. Rename one."
            diagnostics.append(Diagnostic("error", "interface-duplicate", line.number, message))
        elif isinstance(item, Field):
            fields[item.name] = item
        else:
            constants[item.name] = item
    return Section(name, tuple(fields.values()), tuple(constants.values()))


def _with_comments(lines: list[tuple[int, str]]) -> Iterator[_Line]:
    """Give each declaration its comments: the block above, what trails it, what continues that below."""
    above: list[str] = []
    current: _Line | None = None
    for number, text in lines:
        bare = text.strip()
        if bare.startswith("#"):
            comment = bare.lstrip("#").strip()
            if current is not None and current.comment and text[0] in " \t":
                current = current._replace(comment=f"{current.comment}\n{comment}")
            else:
                above.append(comment)
            continue
        if current is not None and (bare or not above):
            yield current
            current = None
        if not bare:
            above = []
        elif not _ANNOTATION.match(text):
            current = _Line(number, text, _trailing_comment(text), "\n".join(above).strip())
            above = []
    if current is not None:
        yield current


def _trailing_comment(text: str) -> str:
    """Return the comment of a declaration; a ROS 1 string constant has none."""
    constant = _CONSTANT.match(text)
    if constant and constant["type"].startswith(_STRINGS):
        quoted = _QUOTED.match(constant["rest"])
        return (quoted["comment"] or "").strip() if quoted else ""
    return _split_comment(text)[1]


def _split_comment(text: str) -> tuple[str, str]:
    """Cut at the first `#` outside quotes; an unclosed quote is no quote."""
    before = _BEFORE_COMMENT.match(text)
    cut = before.end() if before else text.find("#")
    return (text, "") if cut < 0 else (text[:cut].strip(), text[cut:].lstrip("#").strip())


def _read_constant(line: _Line) -> Constant | None:
    match = _CONSTANT.match(line.text)
    if match is None or not _is_primitive(match["type"]):
        return None
    text = match["rest"].strip()
    if match["type"].startswith(_STRINGS):
        quoted = _QUOTED.match(match["rest"])
        value = quoted["value"][1:-1] if quoted else text
    else:
        value = text = _split_comment(match["rest"])[0]
        if not value:
            return None
    unit = None if match["type"].startswith(_STRINGS) else _unit(line)
    return Constant(match["name"], match["type"], value, text, line.number, line.comment, line.doc, unit)


def _read_field(line: _Line) -> Field | None:
    match = _FIELD.match(line.text)
    if match is None:
        return None
    parts = _TYPE_PARTS.fullmatch(match["type"])
    if parts is None:
        return None
    path, string_bound, bounded, bound = parts.groups()
    *packages, base = path.split("/")
    if string_bound and base not in _STRINGS:
        return None
    default = _split_comment(match["rest"])[0]
    length, most = (integer(text) if text else None for text in (bound, string_bound))
    if (bound and length is None) or (string_bound and most is None):
        return None
    return Field(
        name=match["name"],
        type=match["type"],
        base=base,
        package=packages[0] if packages else _implied_package(match["type"]),
        line=line.number,
        array=_array_kind(bounded, bound),
        bound=length,
        string_bound=most,
        default=default or None,
        comment=line.comment,
        doc=line.doc,
        unit=None if base in ("bool", *_STRINGS) else _unit(line),
    )


def _implied_package(written: str) -> str | None:
    return "std_msgs" if written == "Header" else None


def _array_kind(bounded: str | None, bound: str | None) -> ArrayKind:
    if bound is None:
        return "none"
    if not bound:
        return "unbounded"
    return "bounded" if bounded else "fixed"


def _is_primitive(written: str) -> bool:
    return written.partition("<=")[0] in PRIMITIVES and not written.endswith("]")


def _unit(line: _Line) -> str | None:
    return unit_of(line.comment) or unit_of(line.doc)


def _shorten(text: str) -> str:
    return text.strip()[:60]
