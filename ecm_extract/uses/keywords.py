"""Python calls that name an argument which the function, or the class that they make, no longer takes."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from ecm_parsers.source.expr import Call
from ecm_parsers.source.python import parse_python

from ecm_extract.diff.model import Located
from ecm_extract.entities.model import PublicEntity
from ecm_extract.entities.side import Side, Workspace
from ecm_extract.link.program import imported_names
from ecm_extract.link.units import File
from ecm_extract.link.walk import dotted, expressions
from ecm_extract.system.launch_files import is_launch_file
from ecm_extract.tree import Tree
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

Lost = tuple[str, frozenset[str], Located]
"""The dotted name that is called, the arguments that it lost, and the change."""
MAX_BYTES = 1_000_000
_MOST_LINES = 40


def keyword_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines that name such an argument.

    A package may offer a name above the module that has it (`from arm.actions import Node` of `arm.actions.node`), so
    the module that a consumer names has only to begin the module of the change.
    """
    lost = list(_lost(index))
    by_last: dict[str, list[Lost]] = defaultdict(list)
    for entry in lost:
        by_last[entry[0].rpartition(".")[2]].append(entry)
    for file in _files(workspace, frozenset(word for _, words, _ in lost for word in words)) if lost else ():
        yield from _of_file(file, by_last, workspace.tree)


def _files(workspace: Workspace, words: frozenset[str]) -> Iterator[File]:
    """Python sources, and launch files, which belong to no program; these only where they have such a word."""
    yield from (file for file in workspace.program.files if file.language == "python" and file.imported)
    sought = re.compile("|".join(rf"\b{re.escape(word)}\s*=" for word in sorted(words)).encode())
    for facts in workspace.packages:
        paths = sorted(
            entry.path
            for entry in facts.root.files
            if entry.path.endswith(".py") and entry.path not in facts.sources and is_launch_file(entry.path)
        )
        for path, data in workspace.tree.read_many(paths):
            if len(data) <= MAX_BYTES and sought.search(data):
                file = File(path, facts.name, facts.ros, parse_python(data).facts)
                file.imported = imported_names(file)
                yield file


def _lost(index: ChangeIndex) -> Iterator[Lost]:
    for kind in ("method", "function"):
        for located in index.of_kind(kind):
            old, new = located.pair.old, located.pair.new
            if located.change.change != "signature_changed" or old is None or new is None or not _is_python(old):
                continue
            gone = frozenset(_names(old) - _names(new))
            if gone and kind == "function":
                yield old.name, gone, located
            elif gone and old.name == "__init__":
                yield from ((cls, gone, located) for cls in (old.owner, *_heirs(old, index.old)))


def _is_python(entity: PublicEntity) -> bool:
    return entity.path.endswith(".py")


def _names(entity: PublicEntity) -> set[str]:
    return {name for form in entity.forms for name in form.names if not name.startswith("*")}


def _heirs(init: PublicEntity, old: Side) -> Iterator[str]:
    """Classes that hand what they do not know themselves (`**kwargs`) to the class of an `__init__`."""
    own = init.owner.rpartition(".")[2]
    for entity in old.entities.values():
        if entity.kind != "class" or not _is_python(entity) or entity.package != init.package:
            continue
        if any(base.rpartition(".")[2] == own for base in entity.bases):
            made = old.entities.get(("method", entity.package, entity.name, "__init__", ""))
            if made is not None and any(name.startswith("**") for form in made.forms for name in form.names):
                yield entity.name


def _of_file(file: File, by_last: Mapping[str, Sequence[Lost]], tree: Tree) -> Iterator[Use]:
    for function in file.facts.functions:
        for statement in function.body:
            for expr, line in expressions(statement):
                if not isinstance(expr, Call) or not expr.keywords:
                    continue
                for name, gone, located in _called(expr, file, by_last):
                    for keyword in (word for word, _ in expr.keywords if word in gone):
                        place = Place(file.package, file.path, _line_of(keyword, file, line, tree))
                        yield use_at(located, place, f"gives {keyword} to {name.rpartition('.')[2]}()")


def _called(call: Call, file: File, by_last: Mapping[str, Sequence[Lost]]) -> Iterator[Lost]:
    written = dotted(call.callee) or ""
    head, _, rest = written.partition(".")
    full = f"{file.imported[head]}.{rest}".rstrip(".") if head in file.imported else ""
    module, _, last = full.rpartition(".")
    found = [entry for entry in by_last.get(last, ()) if entry[0] == full or entry[0].startswith(f"{module}.")]
    if module and len({name for name, _, _ in found}) == 1:
        yield from found


def _line_of(keyword: str, file: File, line: int, tree: Tree) -> int:
    """The line of an argument; facts only tell that of the call, and calls of launch files are long."""
    lines = tree.read(file.path).decode("utf-8", "replace").splitlines()
    sought = re.compile(rf"\b{re.escape(keyword)}\s*=(?!=)")
    near = range(line, min(len(lines), line + _MOST_LINES) + 1)
    return next((number for number in near if sought.search(lines[number - 1])), line)
