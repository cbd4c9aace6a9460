"""How many ways of aliases a lookup takes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from ecm_extract.resolve.cpp_scopes import Scopes


class Counting(dict[str, Any]):
    """Aliases that count how often they are asked for."""

    asked = 0

    def get(self, name: str, default: Any = None) -> Any:
        self.asked += 1
        return super().get(name, default)


class Everything:
    """A view that sees every file, and has no using-directives."""

    usings: dict[str, list[str]] = {}  # noqa: RUF012

    def __contains__(self, file: object) -> bool:
        return True


def test_aliases_that_lead_to_each_other_are_each_looked_through_once() -> None:
    """Several headers state them; a name at the end of many ways is found once, and not once for each of the ways."""
    entries = {
        name: [SimpleNamespace(alias=SimpleNamespace(target=other), file=at, scope="a::b") for at in range(4)]
        for name, other in (("x::Part", "y::Part"), ("y::Part", "z::Part"), ("z::Part", "x::Part"))
    }
    counting = Counting(entries)
    aliases: Any = SimpleNamespace(last_names={"Part"}, by_name=counting)
    view: Any = Everything()
    levels = Scopes(aliases, {}, lambda cls: ()).levels("x::Part::Inner", "a::b", view)
    found = [name for level in levels for name in level]
    assert {"x::Part::Inner", "y::Part::Inner", "z::Part::Inner"} <= set(found)
    assert counting.asked < 1000
