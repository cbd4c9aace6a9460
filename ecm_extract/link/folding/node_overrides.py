"""Parameters of nodes of rclpy that whoever makes the node gives other values than it declares.

Source: rclpy.node.Node, `parameter_overrides` and `cli_args`: what they have comes before a declared default.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Name
from ecm_parsers.source.python_literal import NULL

from ecm_extract.link.code.calls import Invocation, invocations
from ecm_extract.link.code.units import Cls, File
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_MAKERS: Final = frozenset({"__init__", "Node", "LifecycleNode", "create_node"})
_OVERRIDES: Final = "parameter_overrides"
_ARGUMENTS: Final = "cli_args"
_REMAPS: Final = ":="


class NodeOverrides:
    """Tells of which parameters that is so, by the class that makes itself a node, or the file that makes one."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def is_given(self, name: str, owners: Iterable[Cls | File]) -> bool:
        """Tell whether a parameter may have another value than its default from the beginning."""
        return any(self._gives(name, given) for owner in owners for given in self._given.get(owner, ()))

    @cached_property
    def _given(self) -> Mapping[Cls | File, Sequence[Bound]]:
        """Who makes nodes -> what they are given."""
        found: dict[Cls | File, list[Bound]] = defaultdict(list)
        program = self.folder.program
        for func in (
            each for file in program.files if file.language == "python" for each in program.functions_in(file)
        ):
            for call in invocations(func, _MAKERS):
                found[func.cls or func.file] += self._of(call)
        return found

    def _of(self, call: Invocation) -> Iterator[Bound]:
        whole, env = self.folder.spreading.out(call, Env(call.func, call.at))
        keywords = dict(whole.keywords)
        if not _is_left_out(keywords.get(_OVERRIDES, NULL), env):
            yield Bound(keywords[_OVERRIDES], env)
        if remaps(keywords.get(_ARGUMENTS), env, self.folder):
            yield Bound(keywords[_ARGUMENTS], env)

    def _gives(self, name: str, given: Bound) -> bool:
        """Whether a list has an object for a parameter, or may have one."""
        items = self.folder.lists.items(given.expr, given.env)
        named = [_named(item.expr) for item in items or ()]
        if items is None or None in named:
            return True
        values = [self.folder.fold(expr, item.env) for expr, item in zip(named, items, strict=True)]
        return any(len(found) != 1 or not is_proved(found[0]) or found[0].text == name for found in values)


def _is_left_out(given: Expr, env: Env) -> bool:
    """Tell whether overrides are none, or what only a maker gives that wants them: `overrides=None`."""
    return given == NULL or (isinstance(given, Name) and (given.id, NULL) in env.func.defaults)


def remaps(given: Expr | None, env: Env, folder: Folder) -> bool:
    """Tell whether arguments of a command line may give a node other names, or values of its parameters."""
    if given is None or all(value.text == "null" for value in folder.fold(given, env)):
        return False
    items = folder.lists.items(given, env)
    values = [value for item in items or () for value in folder.lists.fold(item, env)]
    return items is None or any(not is_proved(value) or _REMAPS in str(data_in(value)) for value in values)


def _named(made: Expr) -> Expr | None:
    """The name of `Parameter("name", ...)`."""
    if not isinstance(made, Call):
        return None
    return made.args[0] if made.args else dict(made.keywords).get("name")
