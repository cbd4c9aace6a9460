"""Methods of texts: what is appended, joined, cut off or asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Text

from ecm_extract.infer.compute import method
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.folding.flat_lists import flat
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.own_names import node_namespace
from ecm_extract.link.running.values import PARENT_NAMESPACE, Value, joined, unknown
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_LAST_SLASH = frozenset({"rfind", "find_last_of"})
_CPP_METHODS = frozenset(
    {"substr", "size", "length", "empty", "find", "rfind", "find_last_of", "find_first_of", "compare", "back", "front"}
    | {"starts_with", "ends_with"}
)
_LIST_JOINS = shipped_names("link/code/library_values.toml", "list_joins")
_METHODS = frozenset(
    {"lower", "upper", "strip", "lstrip", "rstrip", "replace", "startswith", "endswith", "title", "capitalize", "count"}
    | {
        "removeprefix",
        "removesuffix",
        "zfill",
        "find",
        "rfind",
        "swapcase",
        "isdigit",
        "isalpha",
        "isidentifier",
        "index",
    }
)


class TextFolder:
    """Folds methods of texts."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def value(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """Methods of texts: what is appended, joined or cut off; None for other calls."""
        if call.path in _LIST_JOINS and len(call.args) == 2:
            return self._joined(self.folder.fold(call.args[1], env), call.args[0], env)
        if call.receiver is None:
            return None
        python = env.func.file.language == "python"
        if call.last == "append" and len(call.args) == 1 and not python:
            return joined([self.folder.fold(part, env) for part in (call.receiver, call.args[0])])
        if call.last == "join" and call.args:
            return self._joined(self.folder.fold(call.receiver, env), call.args[0], env)
        if _is_above(call):
            return self._above(call.receiver, env) or (unknown(call.last),)
        if call.last not in (_METHODS if python else _CPP_METHODS) or call.keywords:
            return None
        return self._method(call, env, python)

    def _method(self, call: Invocation, env: Env, python: bool) -> tuple[Value, ...] | None:
        """A method of a text; None where what it is called on is no text."""
        if call.last in {"size", "length", "empty", "back", "front", "at", "count", "index", "find"}:
            listed = self.folder.lists.items(call.receiver, env) is not None
            if listed or (call.receiver is not None and self.folder.tables.entries(call.receiver, env) is not None):
                return None
        subject = self.folder.fold(call.receiver, env)
        if any(value.data is not None for value in subject):
            return None
        options = [subject, *(self.folder.fold(arg, env) for arg in call.args)]
        found = self.folder.combined(options, lambda data: method(call.last, data[0], data[1:], python), call.last)
        owned = (
            all(value.confidence == "pattern" for value in found) and self.folder.objects.callee(call, env) is not None
        )
        return None if owned else found

    def _above(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        """The namespace above that of the node, or above a name that is known."""
        values = self.folder.fold(expr, env)
        if node_namespace().parts in {value.parts for value in values}:
            return (node_namespace(PARENT_NAMESPACE),)
        known = [value for value in values if value.confidence != "pattern"]
        return tuple([Value((value.text.rpartition("/")[0],), "folded") for value in known])

    def _joined(self, separator: tuple[Value, ...], expr: Expr, env: Env) -> tuple[Value, ...]:
        items = self.folder.lists.items(expr, env)
        if items is None:
            items = flat(expr, env)
            if len(items) == 1 and items[0].expr is expr:
                return (unknown("join"),)
        groups: list[tuple[Value, ...]] = []
        for bound in items:
            if groups:
                groups.append(separator)
            groups.append(self.folder.lists.fold(bound, env))
        return joined(groups)


def _is_above(call: Invocation) -> bool:
    """`text.substr(0, text.rfind("/"))`: what is above the last part of a name."""
    end = call.args[1] if call.last == "substr" and len(call.args) == 2 else None
    return (
        isinstance(end, Call)
        and getattr(end.callee, "name", "") in _LAST_SLASH
        and any(isinstance(arg, Text) and arg.value == "/" for arg in end.args)
    )
