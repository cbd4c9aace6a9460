"""What a name means where it stands: `Derived::topic` of a template, `to_string` behind `using namespace std`."""

from __future__ import annotations

from typing import Final

from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects
from ecm_extract.shipped import shipped_names

_STD: Final = "std"
_CONVERSIONS: Final = shipped_names("link/code/library_values.toml", "conversions")
_BROUGHT: Final = {name.removeprefix("std::") for name in _CONVERSIONS if name.startswith("std::")}
"""Functions that a file may call without the namespace which it uses."""


def spelled(name: str, env: Env, objects: Objects) -> str:
    """Return a name with the class that the object at hand has for the parameter; empty where nobody knows it."""
    head, found, rest = name.partition("::")
    if not found or env.func.cls is None or head not in env.func.cls.fact.template:
        return name
    given = objects.class_types(env).get(head, head)
    return f"{given}::{rest}" if given != head else ""


def called(name: str, env: Env, objects: Objects) -> str:
    """Return what a function is called whose name stands in a call, as `spelled` does of other names."""
    return f"{_STD}::{name}" if name in _BROUGHT and _is_brought(name, env, objects) else spelled(name, env, objects)


def _is_brought(name: str, env: Env, objects: Objects) -> bool:
    """Tell whether a name of the standard library means that here: no function that the file sees is called so."""
    program, file = objects.program, env.func.file
    if file.language == "python":
        return False
    seen = {file, *program.included(file)}
    if any(func.cls is None and func.file in seen for func in program.functions.get(name, ())):
        return False
    usings = (using for each in seen for using in each.facts.usings)
    return any(using.namespace == _STD and using.holds_in(env.scope) for using in usings)
