"""Numbers as the declared type of a variable holds them."""

from __future__ import annotations

from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.numbers import NUMBERS, as_number
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.running.values import Value, constant


def as_declared(values: tuple[Value, ...], statement: Statement | None) -> tuple[Value, ...]:
    """Return values as a declaration with a number type holds them: `double x = 1` is 1.0."""
    name = plain(statement.type).rsplit("::", 1)[-1] if statement is not None and statement.kind == "let" else ""
    if name not in NUMBERS:
        return values
    return tuple([_cast(value, name) for value in values])


def _cast(value: Value, name: str) -> Value:
    data = as_number(value.data, name)
    return (
        value if data is value.data else constant(data)._replace(confidence=value.confidence, template=value.template)
    )
