"""Where a name is written: the line in a chain of calls that says it, not those that hand it on.

A chain leads from a module to the call that makes an endpoint. A line that many names pass through is a wrapper, or
the call that sets a plugin up; the line that the fewest pass through says the name.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

import msgspec
from ecm_checker.hub.provision import Line, Provision


def at_their_names(entities: Sequence[Provision]) -> list[Provision]:
    """Return the entities, each at the line that says its name; one without a chain of calls stays where it is."""
    names: dict[Line, set[str]] = defaultdict(set)
    users: dict[Line, set[str]] = defaultdict(set)
    for entity in entities:
        for line in entity.chain:
            names[line].add(entity.name)
            users[line].add(f"{entity.package}/{entity.owner}")
    return [_placed(entity, names, users) for entity in entities]


def _placed(entity: Provision, names: Mapping[Line, set[str]], users: Mapping[Line, set[str]]) -> Provision:
    if len(entity.chain) < 2:
        return entity
    # of lines that say one name each, the one that more modules share is the library's
    path, line = min(entity.chain, key=lambda each: (len(names[each]), -len(users[each])))
    return msgspec.structs.replace(entity, path=path, line=line)
