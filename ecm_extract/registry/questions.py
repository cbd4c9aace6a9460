"""Questions to the registry that go over one release."""

from __future__ import annotations

import msgspec
from ecm_checker.hub.package import provisions
from ecm_checker.hub.provision import Provision
from ecm_checker.match.provisions import Provisions, last_part
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.doubts import Doubt, doubts_of
from ecm_extract.registry.releases import find_release, package_of_release
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.users import UsedName, used_names


class Asked(msgspec.Struct, frozen=True):
    """Names that are asked about: by their text or the last part of it, and by their kind; None for any."""

    name: str | None = None
    kind: str | None = None

    def means(self, provision: Provision) -> bool:
        """Whether a provision is one of them."""
        same_kind = self.kind in (None, provision.kind)
        return same_kind and self.name in (None, provision.name, last_part(provision.name))


class Users(msgspec.Struct, frozen=True):
    """Who uses names, and what may use them without anybody knowing."""

    names: tuple[UsedName, ...]
    doubts: tuple[Doubt, ...]


def who_uses(session: Session, spec: str, asked: Asked, scope: Scope) -> Users:
    """Return who uses the names of a release.

    Args:
        session: one that reads.
        spec: `package@version`, or `package` for its newest release.
        asked: which of its names.
        scope: the releases that are asked.

    Raises:
        InputError: there is no such release, or it has no such name.
    """
    package = package_of_release(session, find_release(session, spec))
    everything = provisions(package.name, package)
    wanted = [each for each in everything.values() if asked.means(each)]
    if not wanted:
        message = f"{spec} provides nothing that is called {' '.join(filter(None, (asked.kind, asked.name)))}"
        raise InputError(message, f"`ecm-extract registry show {spec} --format json` tells what it provides")
    whole = Provisions(everything.values(), frozenset(package.bound))
    doubts = doubts_of(session, wanted, scope, {package.name})
    return Users(tuple(used_names(session, whole, wanted, scope)), doubts)
