"""Finds ROS API call sites by plain regular expressions: an oracle that shares no code with our parsers.

It knows no syntax tree, no types and no linking. What it leaves out is decided by the few named rules of
`EXCLUSIONS`, each counted.
"""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
from cpp_calls import call_end, count_arguments, is_definition, open_paren, receiver_start
from source_files import Source
from source_mask import mask_cpp, mask_python

EXCLUSIONS = {
    "comment_or_string": "the name stands in a comment or a string",
    "definition": "the function or class itself is declared or defined there",
    "no_call": "no argument list follows (a macro name, a function pointer, `using`)",
    "too_few_arguments": "somebody else's method of that name, such as `sub.subscribe()`",
    "not_a_method": "a free function of that name, such as a local `param(`",
    "type_mention": "the class is named but not constructed",
}


class Row(msgspec.Struct, frozen=True):
    """One row of site_forms.toml; the file says what each field means."""

    form: str
    lang: str
    ros: list[int]
    roles: list[str]
    names: list[str]
    kind: str = "call"
    family: str = "api"
    args: int = 0
    method: bool = False
    bare: bool = False
    typed: bool = True


class Site(msgspec.Struct, frozen=True):
    """One call site: 1-based lines of its first and last character."""

    row: Row
    path: str
    line: int
    end_line: int
    text: str


Verdict = tuple[str | None, int]
"""Why a match is excluded (None: it is a site) and where its call ends."""


def load_rows(path: Path | None = None) -> list[Row]:
    """Read the table of forms."""
    table = tomllib.loads((path or Path(__file__).with_name("site_forms.toml")).read_text("utf-8"))
    return msgspec.convert(table["row"], list[Row])


def scan(source: Source, rows: list[Row], excluded: Counter[str]) -> Iterator[Site]:
    """Yield the sites of one file in the order of the table; count in `excluded` what is left out."""
    text = source.text
    masked = mask_cpp(text) if source.lang == "cpp" else mask_python(text)
    for row in rows:
        if row.lang == source.lang and source.ros & set(row.ros):
            yield from _scan_row(source, row, masked, excluded)


def _scan_row(source: Source, row: Row, masked: str, excluded: Counter[str]) -> Iterator[Site]:
    pattern = re.compile(rf"(?<!\w)(?:{'|'.join(row.names)})(?!\w)")
    judge = _JUDGES[row.lang, row.kind]
    for match in pattern.finditer(source.text):
        if masked[match.start()] != source.text[match.start()]:
            excluded["comment_or_string"] += 1
            continue
        reason, end = judge(row, masked, match)
        if reason:
            excluded[reason] += 1
        else:
            yield _site(source, row, receiver_start(masked, match.start()), match.start(), end)


def _site(source: Source, row: Row, start: int, name: int, end: int) -> Site:
    text = source.text
    line = text.count("\n", 0, start) + 1
    shown = text[text.rfind("\n", 0, name) + 1 : (text.find("\n", name) + 1 or len(text) + 1) - 1].strip()
    return Site(row=row, path=source.path, line=line, end_line=line + text.count("\n", start, end), text=shown)


def _judge_call(row: Row, masked: str, match: re.Match[str]) -> Verdict:
    paren = open_paren(masked, match.end())
    if paren is None:
        return "no_call", match.end()
    if is_definition(masked, match.start()):
        return "definition", match.end()
    return _judge_arguments(row, masked, match, paren)


def _judge_python(row: Row, masked: str, match: re.Match[str]) -> Verdict:
    before = masked[max(0, match.start() - 200) : match.start()]
    if re.search(r"\b(?:def|class)\s+$", before):
        return "definition", match.end()
    paren = re.compile(r"\s*\(").match(masked, match.end())
    if paren is None:
        return "no_call", match.end()
    return _judge_arguments(row, masked, match, paren.end() - 1)


def _judge_arguments(row: Row, masked: str, match: re.Match[str], paren: int) -> Verdict:
    end = call_end(masked, paren)
    if row.method and not _is_method(masked, match):
        return "not_a_method", end
    if count_arguments(masked, paren, end) < row.args:
        return "too_few_arguments", end
    return None, end


def _is_method(masked: str, match: re.Match[str]) -> bool:
    before = masked[max(0, match.start() - 60) : match.start()]
    return match.group().startswith("ros::") or bool(re.search(r"(?:\.|->|::)\s*(?:template\s+)?$", before))


def _judge_object(row: Row, masked: str, match: re.Match[str]) -> Verdict:
    """A class is constructed by make_shared<C>(, new C(, `C name(`, `= C(` and, if bare, `C name;`."""
    before = re.sub(r"(?:\w+\s*::\s*)+$", "", masked[max(0, match.start() - 200) : match.start()])
    after = _skip_template(masked, match.end())
    made = re.search(r"make_(?:shared|unique)\s*<\s*$", before)
    fresh = re.search(r"(?:\bnew|\breturn|(?<![=!<>])=)\s*$", before)
    if made or fresh:
        opened = re.compile(r"\s*>\s*[({]" if made else r"\s*[({]").match(masked, after)
        bare_new = fresh and re.compile(r"\s*[;)]").match(masked, after)
        if not opened:
            return (None, after) if bare_new else ("type_mention", after)
        return None, call_end(masked, opened.end() - 1)
    named = re.compile(r"\s+\w+\s*([;({])" if row.bare else r"\s+\w+\s*([({])").match(masked, after)
    if named is None or re.search(r"\b(?:class|struct|typedef|friend)\s+(?:\w+\s+)*$", before):
        return "type_mention", after
    return None, after if named.group(1) == ";" else call_end(masked, named.end() - 1)


def _skip_template(masked: str, position: int) -> int:
    opened = re.compile(r"\s*<").match(masked, position)
    return call_end(masked, opened.end() - 1, "<", ">") if opened else position


_JUDGES: dict[tuple[str, str], Callable[[Row, str, re.Match[str]], Verdict]] = {
    ("cpp", "call"): _judge_call,
    ("cpp", "object"): _judge_object,
    ("python", "call"): _judge_python,
}
