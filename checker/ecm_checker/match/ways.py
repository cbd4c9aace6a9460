"""Ways to an object, followed on the side that declares them: `arm::Arm.joints_` -> `arm::Joint`.

A way begins with a class, or with a function (`arm::read()`), and goes on with members and methods. A type stands for
the first class of the side that its text names: lists and pointers of the language are none.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from ecm_checker.hub.provision import Form, Provision
from ecm_checker.match.generated import section_owners
from ecm_checker.match.hierarchy import Bases

_WORDS: Final = re.compile(r"[A-Za-z_]\w*")
_POINTER: Final = re.compile(r"(?:Const)?(?:Shared|Unique|Weak)?(?:Const)?Ptr$")
CALL: Final = "()"


class Ways:
    """The classes at the ends of ways.

    Args:
        bases: class hierarchy of the side.
        functions: its functions by qualified name.
        fields: types of the fields of its messages, see `field_types`.
    """

    def __init__(
        self, bases: Bases, functions: Mapping[str, Provision], fields: Mapping[str, Mapping[str, str]]
    ) -> None:
        self._bases, self._functions, self._fields = bases, functions, fields
        self._known: dict[tuple[str, str], str] = {}

    def end(self, way: str, scope: str) -> str:
        """Return the class at the end of a way as written in a scope; empty where the side does not tell."""
        key = way, scope
        if key not in self._known:
            self._known[key] = self._follow(way, scope)
        return self._known[key]

    def _follow(self, way: str, scope: str) -> str:
        first, *steps = way.split(".")
        cls = self._result(first, scope) if first.endswith(CALL) else self._bases.meant(first, scope) or first
        for step in steps:
            cls = self._held(cls, step)
        return cls

    def _result(self, written: str, scope: str) -> str:
        name = written.removesuffix(CALL)
        function = self._functions.get(name)
        if function is not None:
            return self._of_forms(function.forms, name)
        head, _, last = name.rpartition("::")
        owner = self._bases.resolve(head, scope) if head else None
        return self._held(owner, f"{last}{CALL}") if owner is not None else ""

    def _held(self, cls: str, step: str) -> str:
        message = self._fields.get(cls.replace("::", "."))
        if message is not None:
            return message.get(step, "")
        name, called = step.removesuffix(CALL), step.endswith(CALL)
        for owner in self._bases.ancestry(cls) if cls else ():
            found = self._bases.member(owner, called, name)
            if found is not None:
                return self._of_forms(found.forms, owner) if found.forms else self._named(found.type or "", owner)
        return ""

    def _of_forms(self, forms: tuple[Form, ...], scope: str) -> str:
        classes = {self._named(form.returns, scope) for form in forms if form.returns}
        return classes.pop() if len(classes) == 1 else ""

    def _named(self, text: str, scope: str) -> str:
        """The first class of the side that a type names; written without its namespace, it must be the only one."""
        for word in _bare(text):
            found = self._bases.meant(word, f"{scope}::{word}")
            if found is not None:
                return found
        return ""


def field_types(entities: Iterable[Provision]) -> Mapping[str, Mapping[str, str]]:
    """Return the types of fields by the types that have them, written with dots: `arm_msgs.Grip` -> `arm_msgs::Finger`.

    A list stands for what is in it, as it does in ways.
    """
    found: dict[str, dict[str, str]] = defaultdict(dict)
    for entity in entities:
        if entity.row.layout and entity.type is not None:
            for owner in section_owners(entity.owner, entity.facet):
                found[owner][entity.own_name] = entity.type.partition("[")[0].replace("/", "::")
    return found


def _bare(text: str) -> Iterator[str]:
    """The words of a type, each also without the mark of a pointer: `JointSharedPtr` -> `Joint`."""
    for word in _WORDS.findall(text):
        yield word
        if _POINTER.sub("", word) not in {"", word}:
            yield _POINTER.sub("", word)
