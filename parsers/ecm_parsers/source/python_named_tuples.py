"""Classes that a call makes: `Row = namedtuple("Row", ["name", "topic"])`, as the class statement that does the same.

Source: docs.python.org, "collections" and "typing": the fields are texts, pairs of a text and a type, or one text.
"""

from __future__ import annotations

from collections.abc import Sequence

from ecm_parsers.source.expr import Call, Expr, Items, Text
from ecm_parsers.source.facts import Class, Field
from ecm_parsers.source.python_dataclasses import Imported, generated_init, spelled, tuple_makers
from ecm_parsers.source.python_scan import Scan

_BASE = "typing.NamedTuple"
_ANY = "typing.Any"


def made_class(scan: Scan, name: str, value: Expr | None, line: int) -> None:
    """Note the class that an assignment of a module gives a name, if it gives it one."""
    imported = Imported.of(scan.imports) if isinstance(value, Call) and len(value.args) == 2 else None
    if imported is None or not isinstance(value, Call) or imported.full(spelled(value)) not in tuple_makers():
        return
    named, said = _names(value.args[1]), dict(value.keywords)
    if not named or said.keys() - {"defaults"}:
        return
    given = said.get("defaults", Items(()))
    defaults = given.items if isinstance(given, Items) else None
    if defaults is None:
        return
    last: list[Expr | None] = [*[None] * (len(named) - len(defaults)), *defaults]
    fields = tuple([Field(each, _ANY, line, default) for each, default in zip(named, last, strict=False)])
    made = Class(name=name, scope=scan.frame.scope, bases=(_BASE,), line=line, end_line=line, fields=fields)
    scan.classes.append(made)
    inside = f"{scan.frame.scope}::{name}".removeprefix("::")
    init = generated_init(made, inside, (), imported)
    scan.functions += [init] if init is not None else []


def _names(fields: Expr) -> Sequence[str]:
    """The names of all fields; none where one of them is not known."""
    if isinstance(fields, Text):
        return fields.value.replace(",", " ").split()
    items = fields.items if isinstance(fields, Items) else ()
    names = [each.items[0] if isinstance(each, Items) and each.items else each for each in items]
    known = [each.value for each in names if isinstance(each, Text)]
    return known if len(known) == len(names) else ()
