"""Nodes that code makes on the spot: the name, and the namespace, that they are given there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

from ecm_parsers.source.expr import Call, Expr
from ecm_parsers.source.python_literal import NULL

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.naming.handle import Handle, under
from ecm_extract.link.naming.node_settings import NodeSettings
from ecm_extract.link.running.env import Env, Instance, invocation_of
from ecm_extract.link.running.own_names import node_namespace
from ecm_extract.link.running.values import Value, is_known, literal, unknown

NODE_NAME: Final = "arg:0|kw:node_name"
NODE_SPACE: Final = "kw:namespace"
"""Where a node of rclpy is given its name and its namespace."""
_OF_NODES = frozenset({"get_fully_qualified_name", "get_namespace", "get_effective_namespace", "get_name"})
"""Methods of nodes that give a text."""
_TEXTS: Final = ("string", "char")


def _no_name(_made: Instance) -> None:
    """Before anybody knows what nodes are called."""


class NewNodes:
    """Tells what handle a node is that a call makes; `names` gives what an object of a class of the tree is called."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.settings = NodeSettings(folder)
        self.names: Callable[[Instance], str | None] = _no_name

    def of_cpp(self, args: Sequence[Expr], env: Env) -> Handle:
        """Return the node that is made of a name, and perhaps a namespace and options."""
        settings = self.settings.of(args[1:], (), env)
        name = settings.name or self.folder.fold(args[0], env)[0]
        named = len(args) > 1 and self._is_namespace(args[1], env)
        space = settings.space or (self.folder.fold(args[1], env)[0] if named else None)
        if space is None:
            return Handle(literal(""), name)
        own = space.parts == node_namespace().parts  # that of the node which makes it
        return Handle(literal(""), name if own else under(space, name))

    def of_python(self, call: Invocation, env: Env) -> Handle | None:
        """Return a node of rclpy, whose namespace is a keyword; None of one without a name, as a class has its own."""
        name, space = next(positions(NODE_NAME, call), None), next(positions(NODE_SPACE, call), None)
        if name is None:
            return None
        settings = self.settings.of((), call.keywords, env)
        named = settings.name or self.folder.fold(name, env)[0]
        found: tuple[Value, ...] = (settings.space,) if settings.space is not None else ()
        if not found and (space is None or space == NULL):
            return Handle(literal(""), named)
        found = found or self.folder.fold(space, env)
        return Handle(literal(""), under(found[0] if len(found) == 1 else unknown("namespace"), named))

    def made(self, expr: Call, env: Env) -> Instance | None:
        """Return the object of a class of the tree that a call of C++ makes; None of one that makes none."""
        begun = self.folder.states.constructor(expr, env) if env.func.file.language == "cpp" else None
        return self.folder.objects.delegated(begun.made) if begun is not None and begun.made is not None else None

    def of_object(self, made: Instance) -> Handle | None:
        """Return the node that an object is; None where that is not known."""
        name = self.names(made)
        return Handle(literal(""), literal(name)) if name is not None else None

    def _is_namespace(self, expr: Expr, env: Env) -> bool:
        """Tell whether the second argument of a node is text; its options are an object."""
        if isinstance(expr, Call) and invocation_of(expr, env).last in _OF_NODES:
            return True
        written = self.folder.objects.type_of(expr, env)
        return any(word in written for word in _TEXTS) or is_known(self.folder.fold(expr, env)[0])
