"""Names that begin with a parameter of a template: `Derived::topic` in `template <class Derived> class Base`."""

from __future__ import annotations

from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects


def spelled(name: str, env: Env, objects: Objects) -> str:
    """Return a name with the class that the object at hand has for the parameter; empty where nobody knows it."""
    head, found, rest = name.partition("::")
    if not found or env.func.cls is None or head not in env.func.cls.fact.template:
        return name
    given = objects.class_types(env).get(head, head)
    return f"{given}::{rest}" if given != head else ""
