"""Parameters that launch files of ROS 1 put on the server for nobody in particular, which any node may read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from ecm_checker.hub.provision import Provision
from ecm_parsers.launch.model import Action, Group, LaunchFile, ParameterValue, PushNamespace
from ecm_parsers.launch.templates import written

from ecm_extract.entities.launch_values import is_judged
from ecm_extract.entities.parameter_settings import plain
from ecm_extract.entities.paths import inside
from ecm_extract.entities.setting import SETTING
from ecm_extract.read.facts import PackageFacts

_SERVER: Final = 1
"""The ROS whose parameters lie on a server; those of the other one are a node's own."""


def launch_parameters(facts: PackageFacts, launches: Sequence[tuple[str, LaunchFile]]) -> Iterator[Provision]:
    """Yield each once for a file, by its first line; its owner is the file, as it lies in the package."""
    for path, file in launches:
        if file.ros != _SERVER or not is_judged(path):
            continue
        found: dict[str, ParameterValue] = {}
        for name, parameter in _named(file.actions, ""):
            found.setdefault(name, parameter)
        owner = inside(path, facts.root.path)
        for name, parameter in found.items():
            yield Provision(
                kind=SETTING,
                package=facts.name,
                owner=owner,
                name=name,
                default=_text(parameter.value),
                ros=file.ros,
                path=path,
                line=parameter.line,
            )


def _named(actions: Iterable[Action], space: str) -> Iterator[tuple[str, ParameterValue]]:
    for action in actions:
        if isinstance(action, PushNamespace):
            space = _below(space, written(action.namespace))
        elif isinstance(action, Group):
            yield from _named(action.actions, space)
        elif isinstance(action, ParameterValue) and action.name:
            yield _below(space, written(action.name)), action


def _below(space: str, name: str) -> str:
    """A name in a namespace; one that begins at the root, or at a node of its own, is in none."""
    return name if not space or name.startswith(("/", "~")) else f"{space.rstrip('/')}/{name}"


def _text(value: object) -> object:
    """A value as it is written; a list is text."""
    if isinstance(value, tuple):
        return written(value)
    return str([_text(each) for each in value]) if isinstance(value, list) else plain(value)
