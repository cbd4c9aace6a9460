"""Python that takes a result as it was when a function or method returned another number of values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op
from ecm_parsers.source.facts import Function, Statement

from ecm_extract.diff.model import Located
from ecm_extract.entities.model import PublicEntity
from ecm_extract.entities.side import Workspace
from ecm_extract.link.tuples import count_of
from ecm_extract.link.units import File
from ecm_extract.link.walk import dotted, expressions
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at


def unpacked_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines that unpack the old number of values, or keep several as if they were one.

    Functions are found by import, methods by their name in files that import from the same package, as the class of an
    object is mostly not known. Who follows already is quiet.
    """
    changes = {
        name: located
        for kind in ("function", "method")
        for located in index.of_kind(kind)
        for name in _changed(located)
    }
    if not changes:
        return
    for file in workspace.program.files:
        if file.language == "python":
            known = {name: located for name, located in changes.items() if _is_imported(located, file)}
            for function in file.facts.functions if known else ():
                for statement in function.body:
                    yield from _use(file, function, statement, known)


def _changed(located: Located) -> Iterator[str]:
    """The name of what returns another number of values now."""
    old, new = located.pair.old, located.pair.new
    if old is not None and new is not None and "" not in (before := _values(old), after := _values(new)):
        yield from [old.name] if before != after else []


def _values(entity: PublicEntity) -> str:
    return entity.forms[0].returns if entity.path.endswith(".py") and entity.forms else ""


def _is_imported(located: Located, file: File) -> bool:
    """Whether a file imports anything from where the function or the class of the method is."""
    old = located.pair.old
    package = (old.owner or old.name).partition(".")[0] if old is not None else ""
    return any(target.partition(".")[0] == package for target in file.imported.values())


def _use(file: File, function: Function, statement: Statement, changes: Mapping[str, Located]) -> Iterator[Use]:
    call = statement.value
    if statement.kind != "set" or not isinstance(call, Call):
        return
    written = dotted(call.callee) or ""
    head, _, rest = written.partition(".")
    full = f"{file.imported[head]}.{rest}".rstrip(".") if head in file.imported else ""
    last = call.callee.name if isinstance(call.callee, Member) else ""
    located = changes.get(full) or (changes.get(last) if not full else None)
    old = located.pair.old if located is not None else None
    if located is not None and old is not None and _values(old) == _taken(statement.target, function):
        place = Place(file.package, file.path, statement.line)
        what = f"takes {_values(old)} from {written or last}()"
        yield use_at(located, place, what, "proved" if full else "likely")


def _taken(target: Expr | None, function: Function) -> str:
    """How many values a line takes, as `Form.returns` has it; empty where that cannot be told."""
    count = count_of(target)
    if count is not None:
        return f"{count} values"
    return "1 value" if isinstance(target, Name) and not _is_taken_apart(target, function) else ""


def _is_taken_apart(name: Name, function: Function) -> bool:
    """Whether a function takes elements of a variable, or unpacks it."""
    for statement in function.body:
        if statement.value == name and count_of(statement.target) is not None:
            return True
        parts = (expr for expr, _ in expressions(statement))
        if any(isinstance(part, Op) and part.op == "[]" and part.operands[0] == name for part in parts):
            return True
    return False
