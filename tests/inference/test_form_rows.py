"""Every row of the table of forms that real code uses: what is true of it, and which of them are not told yet."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

import pytest
from ecm_checker.contract import Contract, Interface
from ecm_checker.hub.condition import text_of
from form_rows import Row, rows

_HOLE = re.compile(r"\{[^}]*\}")


def _cases() -> Iterator[Any]:
    for row in rows():
        for language, files in row.variants():
            why = row.wrong.get(language, "")
            marks = [pytest.mark.xfail(strict=True, reason=f"{row.id.split()[0]}: {why}")] if why else []
            yield pytest.param(row, files, id=f"{row.id} [{language}]", marks=marks)


@pytest.mark.parametrize(("row", "files"), list(_cases()))
def test_what_is_told_is_true(workspace: Any, row: Row, files: Mapping[str, str]) -> None:
    """The contracts of a small package say of a form what happens when it runs: no more and no less."""
    own = {path: text for path, text in files.items() if not path.startswith("../")}
    for name in sorted({path.split("/")[1] for path in files if path not in own}):
        inside = f"../{name}/"
        other = {path.removeprefix(inside): text for path, text in files.items() if path.startswith(inside)}
        workspace.package(other, ros=row.ros, name=name)
    workspace.package(own, ros=row.ros)
    for path in own:
        if path.startswith("scripts/"):
            (workspace.root / "pkg" / path).chmod(0o755)
    told = sorted(line for module in workspace.modules().values() for line in _lines(module, row))
    assert told == sorted(row.truth)


def _lines(module: Contract, row: Row) -> Iterator[str]:
    name = module.ecm.module_id.removeprefix("ecm.").removeprefix("pkg.")
    for entry in module.signature.interfaces:
        if not row.roles or entry.role in row.roles:
            parts = [entry.role, _HOLE.sub("{}", entry.name), *(_said(entry, each) for each in row.say)]
            yield f"{name}: " + " ".join(parts)
    conditions = module.behavior.preconditions
    if "precondition" in row.roles:
        yield from (f"{name}: precondition {each}" for each in (conditions.value if conditions is not None else ()))


def _said(entry: Interface, what: str) -> str:
    if what == "qos":
        qos = entry.qos
        return "unknown" if qos is None else f"{qos.reliability} {qos.durability} {qos.depth}"
    if what == "condition":
        return text_of(entry.when) or "always"
    return str(getattr(entry, what, None))
