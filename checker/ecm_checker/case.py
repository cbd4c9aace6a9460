"""What rules look at: the modules of one question, matched by name, with the profiles they are asked about.

Matching goes through indexes by name and claim, never over all pairs. Everything derived is made when a rule first
asks for it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import pairwise

import msgspec

from ecm_checker import frames
from ecm_checker.contract import Interface
from ecm_checker.hub.roles import Role, RoleKind, roles
from ecm_checker.match.packages import Packages
from ecm_checker.profiles import NO_PROFILES, Call, Profiles
from ecm_checker.view import View


class Wire(msgspec.Struct, frozen=True):
    """A name that one module offers and another one uses.

    Several endpoints of one module under one name are alternatives that it chooses from when it runs. `role` is that of
    the module that offers.
    """

    role: Role
    name: str
    giver: View
    offered: tuple[Interface, ...]
    taker: View
    wanted: tuple[Interface, ...]


class Case:
    """One question to the rules.

    Attributes:
        modules: those that are asked about.
        ordered: whether each hands over to the next one.
        together: whether they are known to run together; else errors between modules are only likely.
        profiles: of robot, governance and installation.
        previous: the older version of the module in an upgrade.
        dependents: modules that use the older version; None when not known.
        call: what the caller of an invocation brings.
        packages: documents of the packages in question; None where only contracts of modules are known.
        replaced: documents of the packages that these replace. users: of those that use the replaced ones.
        started: nodes that launch files start together, and whom they name; None where nothing is started.
        libraries: modules that run inside of others only.
    """

    def __init__(
        self,
        modules: Sequence[View],
        profiles: Profiles = NO_PROFILES,
        *,
        ordered: bool = False,
        together: bool = True,
        previous: View | None = None,
        dependents: tuple[View, ...] | None = None,
        call: Call | None = None,
        packages: Packages | None = None,
        replaced: Packages | None = None,
        users: Packages | None = None,
        started: Packages | None = None,
        libraries: Sequence[View] = (),
    ) -> None:
        self.modules = tuple(modules)
        self.profiles = profiles
        self.ordered = ordered
        self.together = together
        self.previous = previous
        self.dependents = dependents
        self.call = call
        self.packages = packages
        self.replaced = replaced
        self.users = users
        self.started = started
        self.libraries = tuple(libraries)

    @cached_property
    def adjacent(self) -> tuple[tuple[View, View], ...]:
        """Pairs of modules of which the first hands over to the second."""
        return tuple(pairwise(self.modules)) if self.ordered else ()

    @cached_property
    def wires(self) -> tuple[Wire, ...]:
        """Both sides of each name that two modules share, in the order of the roles."""
        return tuple(wire for role, row in roles().items() if row.gives and row.peer for wire in self._wires(role, row))

    @cached_property
    def topics(self) -> tuple[Wire, ...]:
        """Publisher and subscriber of one topic."""
        return tuple(wire for wire in self.wires if roles()[wire.role].writes)

    @cached_property
    def claims(self) -> dict[str, tuple[View, ...]]:
        """Exclusive resource -> modules that claim it."""
        found: defaultdict[str, list[View]] = defaultdict(list)
        for module in self.modules:
            for lock in module.locks or ():
                found[lock].append(module)
        return {lock: tuple(holders) for lock, holders in found.items()}

    @cached_property
    def frame_groups(self) -> dict[str, str]:
        """Frame -> the transform tree that it is in, see `frames.groups`."""
        robot = self.profiles.embodiment
        found = list(robot.transforms) if robot is not None else []
        for module in self.modules:
            for entry in module.contract.signature.interfaces:
                ends = frames.ends(entry.frame) if entry.row.tells_transforms else None
                if ends is not None:
                    found.append(ends)
        return frames.groups(found)

    def connected(self, one: str, two: str) -> bool:
        """Whether two canonical frames are the same or a registered transform connects them."""
        if one == two:
            return True
        tree = self.frame_groups.get(one)
        return tree is not None and tree == self.frame_groups.get(two)

    def by_name(self, role: Role) -> dict[str, tuple[View, ...]]:
        """Name -> modules that have an endpoint of a role under it."""
        found: defaultdict[str, list[View]] = defaultdict(list)
        for module in self.modules:
            for name in module.endpoints(role):
                found[name].append(module)
        return {name: tuple(owners) for name, owners in found.items()}

    def _wires(self, role: Role, row: RoleKind) -> Iterator[Wire]:
        givers = [(module, module.by_role[role]) for module in self.modules if role in module.by_role]
        takers = [(module, module.by_role[row.peer]) for module in self.modules if row.peer in module.by_role]
        if not givers or not takers:
            return
        offers: defaultdict[str, list[tuple[View, tuple[Interface, ...]]]] = defaultdict(list)
        for giver, named in givers:
            for name, offered in named.items():
                offers[name].append((giver, offered))
        for taker, named in takers:
            for name in named.keys() & offers.keys():
                for giver, offered in offers[name]:
                    if _same_ros(giver, taker):
                        yield Wire(role, name, giver, offered, taker, named[name])


def _same_ros(one: View, two: View) -> bool:
    """ROS 1 and ROS 2 do not meet; None is not known."""
    versions = {one.contract.ecm.ros, two.contract.ecm.ros}
    return not versions >= {1, 2}
