"""Policies: which of two ways of CMake holds, by the version that files ask for and by `cmake_policy`.

They are kept among the variables, under names that no variable can have, so that scopes end them.
Source: cmake-policies(7), cmake-commands(7) "cmake_policy"; `PUSH` and `POP` are not followed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ecm_extract.cmake.change import Change
from ecm_extract.cmake.look import Look

PREFIX: Final = "\x06POLICY\x06"
VERSION: Final = f"{PREFIX}VERSION"
_SINCE: Final = {"CMP0076": (3, 13), "CMP0077": (3, 13), "CMP0126": (3, 21)}
"""The versions that brought the policies which are asked for here."""


def is_new(look: Look, policy: str) -> bool:
    """Tell whether the new way of a policy holds."""
    told = _held(look, f"{PREFIX}{policy}")
    if told is None and _SINCE[policy] > _parts(_held(look, VERSION) or ""):
        told = _held(look, f"CMAKE_POLICY_DEFAULT_{policy}") or "OLD"
    return told != "OLD"


def upper(version: str) -> str:
    """Return the version whose policies `VERSION min...max` takes."""
    return version.rpartition("...")[2]


def cmake_policy(args: list[str], look: Look) -> Sequence[Change]:
    """`cmake_policy(SET policy NEW | OLD)`, `cmake_policy(VERSION min[...max])`."""
    del look
    if args[:1] == ["SET"] and len(args) == 3:
        return [Change(f"{PREFIX}{args[1]}", args[2])]
    return [Change(VERSION, upper(args[1]))] if args[:1] == ["VERSION"] and len(args) > 1 else []


def _held(look: Look, name: str) -> str | None:
    return look.get(name) if look.has(name) else None


def _parts(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split(".") if part.isdigit())
