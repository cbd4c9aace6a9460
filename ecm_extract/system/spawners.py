"""Which controllers a launch loads: spawners of both ROS versions and `ros2 control` command lines.

Sources: control.ros.org "controller_manager helper scripts"; wiki.ros.org/controller_manager.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ecm_extract.system.model import Instance, join
from ecm_extract.system.programs import programs


class Spawned(NamedTuple):
    """One controller that is loaded: its name, whether it is activated, and what the command line says of it.

    `namespace` is that of its manager.
    """

    name: str
    active: bool
    kind: str
    files: tuple[str, ...]
    instance: Instance
    namespace: str


def spawned(instances: Sequence[Instance]) -> Iterator[Spawned]:
    """Yield the controllers that instances load."""
    for instance in instances:
        words = [word.text for word in instance.arguments]
        if instance.executable in programs().spawner.executables:
            yield from _of_words(words, instance)
        elif instance.kind == "process" and "control" in words and "load_controller" in words:
            yield from _of_words(words[words.index("load_controller") + 1 :], instance)


def _of_words(words: Sequence[str], instance: Instance) -> Iterator[Spawned]:
    names: list[str] = []
    values: dict[str, list[str]] = {}
    at = 0
    while at < len(words):
        word = words[at]
        if word in programs().spawner.with_value:
            values.setdefault(word, []).append(words[at + 1] if at + 1 < len(words) else "")
            at += 2
            continue
        if not word.startswith("-") and ":=" not in word and word not in programs().spawner.verbs:
            names.append(word)
        at += 1
    is_loaded = bool(words) and words[0] == "load" and instance.executable == "controller_manager"
    active = not is_loaded and not programs().spawner.inactive & set(words)
    active = active and values.get("--set-state", ["active"]) != ["inactive"]
    kind = next(iter(values.get("-t", values.get("--controller-type", []))), "")
    files = (*values.get("-p", ()), *values.get("--param-file", ()))
    manager = next(iter(values.get("-c", values.get("--controller-manager", []))), "")
    for name in names:
        yield Spawned(name, active, kind, tuple(files), instance, _namespace(manager, instance))


def _namespace(manager: str, instance: Instance) -> str:
    """The namespace of a manager by its name, which counts from that of the spawner unless it is absolute."""
    if not manager or "{" in manager:
        return instance.namespace
    return join(instance.namespace, manager).rpartition("/")[0] or "/"
