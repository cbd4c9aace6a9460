"""Questions to the registry that go over one release."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_checker.hub.package import provisions
from ecm_checker.hub.provision import Provision
from ecm_checker.match.provisions import Provisions, last_part
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.releases import find_release, package_of_release
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.users import UsedName, used_names

Asked = tuple[str | None, str | None]
"""A name, or the last part of names, and a kind; None for any."""


def who_uses(session: Session, spec: str, asked: Asked, scope: Scope) -> list[UsedName]:
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
    wanted = list(_wanted(everything.values(), asked))
    if not wanted:
        message = f"{spec} provides nothing that is called {' '.join(filter(None, asked))}"
        raise InputError(message, f"`ecm-extract registry show {spec} --format json` tells what it provides")
    return used_names(session, Provisions(everything.values(), frozenset(package.bound)), wanted, scope)


def _wanted(all_names: Iterable[Provision], asked: Asked) -> Iterator[Provision]:
    name, kind = asked
    for each in all_names:
        if kind in (None, each.kind) and name in (None, each.name, last_part(each.name)):
            yield each
