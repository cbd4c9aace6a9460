"""Which controllers the arguments of a spawner load, and where."""

from __future__ import annotations

import pytest

from ecm_extract.system.model import Instance, Place, Text
from ecm_extract.system.spawners import spawned


@pytest.mark.parametrize(
    ("words", "namespace"),
    [
        (("base",), "/driver"),
        (("base", "--controller-manager", "/controller_manager"), "/"),
        (("base", "-c", "/arm/controller_manager"), "/arm"),
        (("base", "-c", "controller_manager"), "/driver"),
        (("base", "-c", "arm/controller_manager"), "/driver/arm"),
        (("base", "-c", "{prefix}/controller_manager"), "/driver"),
    ],
)
def test_a_controller_is_in_the_namespace_of_its_manager(words: tuple[str, ...], namespace: str) -> None:
    """Not in that of the spawner, which may call a manager by its absolute name."""
    given = tuple(Text(word) for word in words)
    place = Place("a.launch.py", 1)
    spawner = Instance("node", "controller_manager", "spawner", "", "s", "/driver", 2, place, arguments=given)
    found = list(spawned([spawner]))
    assert [(each.name, each.namespace) for each in found] == [("base", namespace)]
