"""What was asked for and is not there: an error, never an empty result."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable
from pathlib import PurePosixPath
from typing import Final

from ecm_extract.discover import MANIFESTS, PackageRoot
from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Extraction
from ecm_extract.report.unread_text import unread_lines
from ecm_extract.tree import Tree, Unread, can_declare, unread_of
from ecm_extract.tree.unread import is_gap

_NEAREST: Final = 3


class NothingThereError(InputError):
    """A package that was named is in no tree, or a tree holds nothing that could be read."""


class NotWholeError(InputError):
    """What a decision needs could not be read."""


def refuse_unknown_packages(asked: Iterable[str], known: Collection[str], where: str) -> None:
    """Refuse names of packages that do not exist.

    Args:
        asked: as on the command line.
        known: names of packages that were read.
        where: the trees that were looked at.

    Raises:
        NothingThereError: a package is not there.
    """
    for name in asked:
        if name not in known:
            near = difflib.get_close_matches(name, sorted(known), _NEAREST) or sorted(known)[:_NEAREST]
            message = f"no package is called {name!r} in {where}"
            raise NothingThereError(message, f"nearest: {', '.join(near) or 'none, there is no package'}")


def refuse_empty(tree: Tree, roots: Iterable[PackageRoot]) -> None:
    """Refuse a tree without any package or file that could declare something.

    Raises:
        NothingThereError: there is nothing to read, or all packages were left out.
    """
    if any(root.manifest is not None for root in roots):
        return
    skipped = [each for each in unread_of(tree.diagnostics) if each.carries]
    if not skipped and any(_is_artefact(entry.path) for entry in tree.files()):
        return
    message = f"{tree.label} holds no ROS package: no {' or '.join(MANIFESTS)} and no source, message or launch file"
    left = f"not read: {'; '.join(unread_lines(skipped))}. " if skipped else ""
    raise NothingThereError(message, f"{left}name a folder in or above a package")


def refuse_nothing_read(extraction: Extraction) -> None:
    """Refuse an extraction of nothing: an empty folder, or one of which nothing could be read.

    Raises:
        NothingThereError: no file was read.
    """
    if extraction.packages and extraction.counts.files:
        return
    lines = unread_lines(each for each in extraction.unread if each.carries)
    if lines:
        message = f"nothing could be read of {extraction.path}"
        raise NothingThereError(message, f"not read: {'; '.join(lines)}")
    message = f"no ROS package in {extraction.path}"
    raise NothingThereError(message, "a package is a folder with a package.xml; name a folder in or above one")


def refuse_gaps(label: str, unread: Iterable[Unread]) -> None:
    """Refuse to decide on contracts that may lack what could not be read.

    Args:
        label: how the user named the tree or the documents.
        unread: of it.

    Raises:
        NotWholeError: something that can carry interfaces could not be read.
    """
    gaps = [each for each in unread if is_gap(each)]
    if gaps:
        message = f"{label} could not be read as a whole, so nothing can be decided about it"
        raise NotWholeError(message, "; ".join(unread_lines(gaps)))


def _is_artefact(path: str) -> bool:
    return bool(PurePosixPath(path).suffix) and can_declare(path)
