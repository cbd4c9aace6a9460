"""Definitions in other files of what a C++ file declares."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import pytest

from ecm_extract.resolve.cpp_functions import CppFunctions


@dataclass(frozen=True, eq=False)
class SourceFile:
    """A file of a target."""

    targets: frozenset[str]
    package: str = "pkg"


class Seen(frozenset[Any]):
    """Files that are seen together, all of whose directives hold everywhere."""

    @property
    def surely(self) -> Seen:
        return self


@dataclass(frozen=True, eq=False)
class Function:
    """A function with so many parameters."""

    file: SourceFile
    count: int
    traits: frozenset[str] = field(default=frozenset())

    @property
    def fact(self) -> Any:
        params = [SimpleNamespace(type="int")] * self.count
        return SimpleNamespace(name="start", scope="", params=params, traits=self.traits)


ONE, TWO = SourceFile(frozenset({"one"})), SourceFile(frozenset({"two"}))
DECLARED = frozenset({"declaration"})
CASES = {
    "defined here": ([Function(ONE, 1)], Function(TWO, 2), False),
    "declared and defined here": ([Function(ONE, 1, DECLARED), Function(ONE, 1)], Function(TWO, 1), False),
    "declared here": ([Function(ONE, 1, DECLARED)], Function(TWO, 1), True),
    "declared with other parameters": ([Function(ONE, 1, DECLARED)], Function(TWO, 2), False),
    "an overload is only declared": ([Function(ONE, 1), Function(ONE, 2, DECLARED)], Function(TWO, 2), True),
}


@pytest.mark.parametrize(("here", "other", "is_meant"), CASES.values(), ids=CASES)
def test_another_file_defines_only_what_is_declared(here: list[Function], other: Function, is_meant: bool) -> None:
    """A function of that name in another program is another function, whatever its parameters."""
    scopes: Any = SimpleNamespace(levels=lambda name, scope, view: [[name]])
    views: Any = SimpleNamespace(of=lambda file: Seen({file}), wide=lambda file: Seen({file}))
    functions = CppFunctions(scopes, views, SimpleNamespace(by_name={}))  # type: ignore[arg-type]
    for each in (*here, other):
        functions.add(each)  # type: ignore[arg-type]
    assert (other in functions.find("start", ONE, "")) is is_meant  # type: ignore[arg-type,comparison-overlap]
