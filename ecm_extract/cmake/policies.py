"""Policies: which of two ways of CMake holds, by the version that files ask for and by `cmake_policy`.

They are kept among the variables, under names that no variable can have, so that scopes end them.
Source: cmake-policies(7), cmake-commands(7) "cmake_policy", "include", "block".
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from ecm_extract.cmake.change import Change
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.state import State
from ecm_extract.cmake.values import Value

PREFIX: Final = "\x06POLICY\x06"
VERSION: Final = f"{PREFIX}VERSION"
_DEPTH: Final = f"{PREFIX}DEPTH"
_SINCE: Final = {"CMP0076": (3, 13), "CMP0077": (3, 13), "CMP0126": (3, 21)}
"""The versions that brought the policies which are asked for here."""
_NAMES: Final = (VERSION, *(f"{PREFIX}{policy}" for policy in _SINCE))
_KNOWN_TO_ALL: Final = "CMP0071"
"""The last policy of CMake 3.10, the oldest one of a distribution that is still built."""


def held(scope: Mapping[str, Value]) -> Mapping[str, Value]:
    """Return the policies that hold, to be put back where what is run now ends."""
    return {name: scope[name] for name in _NAMES if name in scope}


def put_back(state: State, before: Mapping[str, Value]) -> None:
    """Let the policies hold again that held before."""
    if held(state.variables) == before:
        return
    scope = state.own()
    for name in _NAMES:
        scope.pop(name, None)
    scope.update(before)


def changed(before: Mapping[str, Value], scope: Mapping[str, Value]) -> Mapping[str, Value]:
    """Return the policies that were set since; what a macro does to them its caller sees."""
    return {name: value for name, value in held(scope).items() if before.get(name) != value}


def is_known_to_all(policy: str) -> bool:
    """Tell whether every CMake that may run a build knows a policy (`if(POLICY name)`)."""
    return len(policy) == len(_KNOWN_TO_ALL) and policy.startswith("CMP") and policy <= _KNOWN_TO_ALL


def is_new(look: Look, policy: str) -> bool:
    """Tell whether the new way of a policy holds."""
    told = _held(look, f"{PREFIX}{policy}")
    if told is None and _SINCE[policy] > _parts(_held(look, VERSION) or ""):
        told = _held(look, f"CMAKE_POLICY_DEFAULT_{policy}") or "OLD"
    return told != "OLD"


def of_version(version: str) -> Sequence[Change]:
    """Return what `VERSION min[...max]` changes: the policies of that version hold, whatever was set before."""
    return [*(Change(name, None) for name in _NAMES), Change(VERSION, version.rpartition("...")[2])]


def cmake_policy(args: list[str], look: Look) -> Sequence[Change]:
    """`cmake_policy(SET policy NEW | OLD)`, `(VERSION min[...max])`, `(PUSH)`, `(POP)`."""
    kind = "".join(args[:1])
    if kind == "SET" and len(args) == 3:
        return [Change(f"{PREFIX}{args[1]}", args[2])]
    if kind == "VERSION" and len(args) > 1:
        return of_version(args[1])
    depth = _depth(look)
    if kind == "PUSH":
        return [*_copied(look, "", f"{PREFIX}{depth}"), Change(_DEPTH, str(depth + 1))]
    if kind == "POP" and depth > 0:
        return [*_copied(look, f"{PREFIX}{depth - 1}", ""), Change(_DEPTH, str(depth - 1))]
    return []


def _depth(look: Look) -> int:
    text = _held(look, _DEPTH) or ""
    return int(text) if text.isdigit() else 0


def _copied(look: Look, source: str, target: str) -> Sequence[Change]:
    """Copy the policies from one place of the stack to another."""
    return [Change(f"{target}{name}", _held(look, f"{source}{name}")) for name in _NAMES]


def _held(look: Look, name: str) -> str | None:
    return look.get(name) if look.has(name) else None


def _parts(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split(".") if part.isdigit())
