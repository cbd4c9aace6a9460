"""Local clones of the repositories that cases name. Nothing is ever fetched from here."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from ecm_corpus.interface import Source, State, sources_of
from ecm_extract.errors import InputError, RefError, TreeError
from ecm_extract.tree import Tree, open_ref

URL: Final = "https://github.com/{repository}"

_LAYOUTS: Final = (
    "{owner}/{name}.git",
    "{owner}/{name}",
    "{owner}+{name}.git",
    "{owner}+{name}",
    "{name}.git",
    "{name}",
)


class MissingCloneError(InputError):
    """No local clone of a repository; the hint is the command that gets it."""


def clone_of(repository: str, folder: Path) -> Path:
    """The clone of `owner/name` below a folder: `owner/name`, `owner+name` or `name`, bare with `.git`.

    Raises:
        MissingCloneError: there is none.
    """
    owner, _, name = repository.partition("/")
    for layout in _LAYOUTS:
        place = folder / layout.format(owner=owner, name=name)
        if place.is_dir():
            return place
    url = URL.format(repository=repository)
    message = f"no clone of {url} in {folder}"
    raise MissingCloneError(message, f"git clone --bare {url} {folder / owner / name}.git")


def open_source(source: Source, folder: Path) -> Tree:
    """The tree of a repository at a ref.

    Raises:
        MissingCloneError: there is no clone; TreeError: the clone lacks the ref.
    """
    return open_ref(clone_of(source.repository, folder), source.ref)


def missing_from(states: dict[str, State], folder: Path) -> tuple[str, ...]:
    """URLs, with the ref where that is what lacks, that must be fetched before these states can be judged."""
    found = dict[str, None]()
    for state in states.values():
        for source in sources_of(state):
            url = URL.format(repository=source.repository)
            try:
                open_source(source, folder)
            except MissingCloneError:
                found[url] = None
            except (RefError, TreeError):
                found[f"{url} at {source.ref}"] = None
    return tuple(found)
