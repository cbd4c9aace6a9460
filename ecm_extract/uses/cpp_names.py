"""C++ that names a class or function, with its namespace, which is gone or going, or gives it too many arguments.

Names are searched in the text: facts hold no types of every expression, and a name with its namespace is one thing.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from ecm_extract.diff.model import Located
from ecm_extract.entities.model import PublicEntity
from ecm_extract.entities.side import Side, Workspace
from ecm_extract.link.units import File
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:[^\"\\\n]|\\.)*\"", re.DOTALL)
_QUALIFIED = re.compile(r"(?<!\w)[A-Za-z_]\w*(?:::[A-Za-z_]\w*)+")
_MARKS = re.compile("::")
_OPEN, _CLOSE = "([{", ")]}"
MAX_BYTES = 1_000_000
MAX_ARGUMENTS = 4_000
"""Characters of a call that are looked at."""


def cpp_name_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield such lines in files that include a header of the package, unless they name the successor too."""
    by_package: dict[str, list[Located]] = defaultdict(list)
    for kind in ("class", "function"):
        for located in index.of_kind(kind):
            old = located.pair.old
            if old is not None and "::" in old.name and not old.path.endswith(".py") and _counts(located):
                by_package[old.package].append(located)
    if not by_package:
        return
    folders = _folders(index.old)
    files = {
        file.path: (file, wanted)
        for file in workspace.program.files
        if file.language == "cpp" and (wanted := _wanted(file, by_package, folders))
    }
    for path, data in workspace.tree.read_many(sorted(files)):
        if len(data) <= MAX_BYTES:
            text = _COMMENT.sub(_blank, data.decode("utf-8", "replace"))
            yield from _in_text(text, *files[path])


def _counts(located: Located) -> bool:
    change, new = located.change, located.pair.new
    if change.change == "signature_changed":
        return change.kind == "function" and new is not None
    return change.change == "deprecated" or (change.change in GONE and (new is None or new.name != change.old))


def _folders(old: Side) -> Mapping[str, set[str]]:
    """What stands first in the includes of each package's headers."""
    found: dict[str, set[str]] = defaultdict(set)
    for entity in old.entities.values():
        if entity.kind == "file" and "/" in entity.name:
            found[entity.name.partition("/")[0]].add(entity.package)
    return found


def _wanted(file: File, by_package: Mapping[str, list[Located]], folders: Mapping[str, set[str]]) -> list[Located]:
    included = {package for entry in file.facts.imports for package in folders.get(entry.module.partition("/")[0], ())}
    return [located for package in sorted(included - {file.package}) for located in by_package.get(package, ())]


def _blank(match: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", match.group())


def _in_text(text: str, file: File, wanted: Sequence[Located]) -> Iterator[Use]:
    places = _places(text)
    for located in wanted:
        old, new = located.pair.old, located.change.new
        if old is None or (new is not None and new != old.name and new in places):
            continue
        for start, end in places.get(old.name, ()):
            if located.change.change == "signature_changed" and not _too_many(text, end, located.pair.new):
                continue
            line = text.count("\n", 0, start) + 1
            yield use_at(located, Place(file.package, file.path, line), f"names {old.name}")


def _places(text: str) -> dict[str, list[tuple[int, int]]]:
    """Where each name with a namespace stands, and each name that one begins with: `a::B` of `a::B::c`."""
    found: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for match in _QUALIFIED.finditer(text):
        name = match.group()
        for end in [*(mark.start() for mark in _MARKS.finditer(name)), len(name)]:
            found[name[:end]].append((match.start(), match.start() + end))
    return found


def _too_many(text: str, start: int, new: PublicEntity | None) -> bool:
    """Whether a call gives another number of arguments than any form takes."""
    count = _argument_count(text, start)
    forms = new.forms if new is not None else ()
    return count is not None and not any(form.required <= count <= len(form.types) for form in forms)


def _argument_count(text: str, start: int) -> int | None:
    """How many arguments follow a name; None where it is not called, or template arguments may hide commas."""
    rest = text[start : start + MAX_ARGUMENTS].lstrip()
    if not rest.startswith("("):
        return None
    depth, count, given = 0, 1, False
    for character in rest:
        if character in _OPEN:
            depth += 1
        elif character in _CLOSE:
            depth -= 1
            if depth == 0:
                return count if given else 0
        elif character == "," and depth == 1:
            count += 1
        elif character == "<":
            return None
        given = given or (depth > 0 and not character.isspace() and character != "(")
    return None
