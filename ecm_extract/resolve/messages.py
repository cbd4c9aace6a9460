"""Which message a C++ name means that leaves out the namespace of its package, as code inside of it may.

`msg::Temperature` inside `namespace robot` is `robot::msg::Temperature`, where `robot` has such a message: the tree
has its definition, or the file sees the header that is generated from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Final

from ecm_checker.match.generated import snake

from ecm_extract.link.code.units import File
from ecm_extract.resolve.cpp_scopes import enclosing_scopes
from ecm_extract.resolve.layout import PackageLayout
from ecm_extract.shipped import shipped

KINDS: Final = frozenset({"msg", "srv", "action"})
_PARTS: Final = ("ActionGoal", "ActionResult", "ActionFeedback", "Action", "Goal", "Result", "Feedback")
"""Ends of the messages that ROS 1 generates of an action, the longest first."""


class Messages:
    """Looks up messages.

    Args:
        layouts: of packages, with the messages that they define.
        included: gives the headers that a file sees.
    """

    def __init__(self, layouts: Mapping[str, PackageLayout], included: Callable[[File], Iterable[File]]) -> None:
        self._layouts = layouts
        self._included = included

    def find(self, name: str, file: File, scope: str) -> str | None:
        """Return the whole name of `msg::Name` in a scope of a file; None where no enclosing namespace has it."""
        kind, _, last = name.partition("::")
        if kind not in KINDS or not last or "::" in last:
            return None
        for package in (*enclosing_scopes(scope.removeprefix("::")), *self._used(file, scope)):
            if package and self._has(package, kind, last, file):
                return f"{package}::{name}"
        return None

    def starred(self, name: str, modules: Sequence[str]) -> str | None:
        """Return which of the modules of messages that are taken whole, one after the other, brings a name last.

        What packages of the tree and of the table define is known; of several others each can bring the name, and
        then it is None.
        """
        unknown: list[str] = []
        for module in dict.fromkeys(reversed(modules)):
            package, _, kind = module.rpartition(".")
            defined = self._defined(package)
            if not defined:
                unknown.append(module)
            elif _defines(defined, kind, name):
                return None if unknown else module
        return unknown[0] if len(unknown) == 1 else None

    def _defined(self, package: str) -> frozenset[str]:
        """What a package defines, as `msg/Name`, as the tree has it, else as the table does; nothing of others."""
        layout = self._layouts.get(package)
        if layout is not None and layout.messages:
            return layout.messages
        rows = shipped("resolve/message_packages.toml").get(package, {}) if layout is None else {}
        return frozenset(f"{kind}/{name}" for kind, names in rows.items() for name in names)

    def constant(self, name: str, file: File, scope: str) -> str | float | None:
        """Return the constant of a message that a name means, aliases put in; None of other names.

        Args:
            name: `pkg.msg.Name.CONSTANT` in Python, in C++ without what the namespaces around it or those used have.
            file: in which it stands.
            scope: in which it stands.
        """
        bare = name.removeprefix("::")
        scopes = (*enclosing_scopes(scope.removeprefix("::")), *self._used(file, scope))
        around = scopes if file.language == "cpp" else ()
        whole = (f"{outer}::{bare}" for outer in around if outer)
        return next((found for each in (*whole, bare) if (found := self._stated(each)) is not None), None)

    def _stated(self, name: str) -> str | float | None:
        package, *rest = name.replace("::", ".").split(".")
        layout = self._layouts.get(package)
        inner = rest[1:] if rest[:1] and rest[0] in KINDS else rest
        return layout.constants.get(".".join(inner)) if layout is not None else None

    def _used(self, file: File, scope: str) -> Iterator[str]:
        for each in (file, *self._included(file)):
            yield from (using.namespace for using in each.facts.usings if using.holds_in(scope.removeprefix("::")))

    def _has(self, package: str, kind: str, name: str, file: File) -> bool:
        layout = self._layouts.get(package)
        if layout is not None and f"{kind}/{name}" in layout.messages:
            return True
        header = f"{package}/{kind}/{snake(name)}."
        files = (file, *self._included(file))
        return any(entry.module.startswith(header) for each in files for entry in each.facts.imports)


def _defines(defined: frozenset[str], kind: str, name: str) -> bool:
    """Whether a package has a message, or an action of which ROS 1 generates that message."""
    actions = {each.partition("/")[2] for each in defined if each.startswith("action/")}
    part = next((name.removesuffix(end) for end in _PARTS if name.endswith(end)), "") if kind == "msg" else ""
    return f"{kind}/{name}" in defined or part in actions
