"""Programs that offer something by one line of code."""

from __future__ import annotations

import msgspec
import pytest
from ecm_checker.hub.provision import Provision

from ecm_extract.diff.pair import Pairing
from ecm_extract.diff.still_there import Evidence


def _topic(owner: str, path: str, *sharers: str) -> Provision:
    return Provision(
        kind="topic", package="arm", owner=owner, name="/done", facet="published", path=path, line=9, sharers=sharers
    )


@pytest.mark.parametrize(("sharers", "gone"), [(("right",), []), ((), ["right"])])
def test_what_a_program_has_by_the_line_of_another_one_is_not_gone(sharers: tuple[str, ...], gone: list[str]) -> None:
    """Each had the topic by a class of its own; both have it by that of one of them now, or only one has it."""
    old = [_topic("left", "src/a.py"), _topic("right", "src/b.py")]
    new = _topic("left", "src/a.py", *sharers)
    pairs = Pairing({each.key: each for each in old}, {new.key: new}, Evidence()).run()
    assert [pair.old.owner for pair in pairs if pair.old is not None and pair.new is None] == gone


@pytest.mark.parametrize(("kept", "how"), [(False, ["same"]), (True, ["moved"])])
def test_what_a_library_still_has_has_not_moved_to_it(kept: bool, how: list[str]) -> None:
    """The only program that it was told of is gone; one that is there and lost it is another thing."""
    old = msgspec.structs.replace(_topic("driver", "lib/src/a.cpp"), node="driver")
    new = msgspec.structs.replace(_topic("lib", "lib/src/a.cpp"), package="lib")
    program = Provision(kind="executable", package="arm", owner="", name="driver", path="arm/CMakeLists.txt", line=1)
    after = {each.key: each for each in (new, program) if kept or each is new}
    pairs = Pairing({old.key: old, program.key: program}, after, Evidence()).run()
    assert [pair.how for pair in pairs if pair.old is old and pair.new is new] == how
