"""Which output of a module is supplied to which input of the next one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_checker.case import Case
from ecm_checker.profiles import Call
from ecm_checker.terms import Field, fields
from ecm_checker.view import View


def supplied(outputs: Sequence[Field], inputs: Sequence[Field]) -> Iterator[tuple[Field, Field]]:
    """Pairs of output and input: of one name, else the only output of the input's type."""
    by_name = {output.name: output for output in outputs}
    for wanted in inputs:
        found = by_name.get(wanted.name) or _only_of_type(outputs, wanted)
        if found is not None:
            yield found, wanted


def handovers(case: Case) -> Iterator[tuple[tuple[View, ...], Field, Field]]:
    """Modules concerned, what is given and what is taken: between adjacent modules, and by a caller."""
    for first, second in case.adjacent:
        for output, wanted in supplied(first.outputs or (), second.inputs or ()):
            yield (first, second), output, wanted
    for module in case.modules if case.call is not None else ():
        for output, wanted in supplied(called_with(case.call), module.inputs or ()):
            yield (module,), output, wanted


def called_with(call: Call | None) -> tuple[Field, ...]:
    """Inputs that a caller brings."""
    return fields(call.inputs) if call is not None else ()


def _only_of_type(outputs: Sequence[Field], wanted: Field) -> Field | None:
    same = [output for output in outputs if output.type is not None and output.type == wanted.type]
    return same[0] if len(same) == 1 else None
