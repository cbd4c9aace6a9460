"""Corrections of findings where they are sure: one word on one line, or a missing line of a package.xml."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from difflib import unified_diff

import msgspec
from ecm_checker.finding import Depend, Finding, Rename
from ecm_parsers.xml_tree import children, line_of, parse_xml

from ecm_extract.lint.workspace import Workspace

_HEAD = frozenset({"author", "license", "url", "version"})
_DEPENDENCIES = frozenset({"build_depend", "buildtool_depend", "depend", "exec_depend", "run_depend"})


class Fix(msgspec.Struct, frozen=True):
    """A line of a file that becomes another; with `insert` the new line comes after it."""

    path: str
    line: int
    before: str
    after: str
    insert: bool = False


def fixes_of(findings: Iterable[Finding], workspace: Workspace) -> list[Fix]:
    """Return the corrections that findings allow, each line at most once."""
    found: dict[tuple[str, int, str], Fix] = {}
    for finding in findings:
        fix = _fix(finding, workspace)
        if fix is not None:
            key = (fix.path, fix.line, fix.after if fix.insert else "")
            found.setdefault(key, fix)
    return list(found.values())


def _fix(finding: Finding, workspace: Workspace) -> Fix | None:
    match finding.edit:
        case Rename() as edit:
            return _renamed(edit, finding, workspace)
        case Depend() as edit:
            return _declared(edit, finding.subjects[0], workspace)
    return None


def _renamed(edit: Rename, finding: Finding, workspace: Workspace) -> Fix | None:
    """The line must hold the old name exactly once."""
    place = finding.evidence[0]
    line = _line(place.path, place.line, workspace)
    word = re.compile(rf"(?<![\w.]){re.escape(edit.old)}(?![\w.])")
    if line is None or len(word.findall(line)) != 1:
        return None
    return Fix(place.path, place.line, line, word.sub(lambda _: edit.new, line))


def _declared(edit: Depend, subject: str, workspace: Workspace) -> Fix | None:
    """A dependency goes behind the last one that the package.xml names."""
    package = workspace.by_name.get(subject)
    path = package.root.manifest if package is not None else None
    data = workspace.files.read(path) if path is not None else None
    if package is None or package.manifest is None or path is None or data is None:
        return None
    lines = data.decode("utf-8", "replace").splitlines()
    last = _last(data, lines, _DEPENDENCIES) or _last(data, lines, _HEAD)
    if last is None:
        return None
    tag = "run_depend" if package.manifest.format == 1 else "exec_depend" if edit.need == "run" else "depend"
    before = lines[last - 1]
    indent = before[: len(before) - len(before.lstrip())]
    return Fix(path, last, before, f"{indent}<{tag}>{edit.package}</{tag}>", insert=True)


def _last(data: bytes, lines: list[str], tags: frozenset[str]) -> int | None:
    """The line of the last element of some tags that ends on the line where it begins."""
    root = parse_xml(data).root
    found = [(line_of(element), tag) for tag, element in children(root) if tag in tags] if root is not None else []
    return max((line for line, tag in found if lines[line - 1].rstrip().endswith(f"</{tag}>")), default=None)


def _line(path: str, number: int, workspace: Workspace) -> str | None:
    data = workspace.files.read(path)
    lines = data.decode("utf-8", "replace").splitlines() if data is not None else []
    return lines[number - 1] if 0 < number <= len(lines) else None


def fixed_texts(fixes: Iterable[Fix], workspace: Workspace) -> Iterator[tuple[str, str, str]]:
    """Yield (path, text before, text after) of every file that fixes change."""
    by_path: dict[str, list[Fix]] = {}
    for fix in fixes:
        by_path.setdefault(fix.path, []).append(fix)
    for path, group in sorted(by_path.items()):
        before = (workspace.files.read(path) or b"").decode("utf-8", "surrogateescape")
        lines = before.splitlines(keepends=True)
        for fix in sorted(group, key=lambda entry: -entry.line):
            end = "\r\n" if lines[fix.line - 1].endswith("\r\n") else "\n"
            if fix.insert:
                lines.insert(fix.line, fix.after + end)
            else:
                lines[fix.line - 1] = lines[fix.line - 1].replace(fix.before, fix.after)
        yield path, before, "".join(lines)


def shown(path: str, before: str, after: str) -> str:
    """Return a change as a unified diff."""
    return "".join(
        unified_diff(before.splitlines(keepends=True), after.splitlines(keepends=True), f"a/{path}", f"b/{path}")
    )
