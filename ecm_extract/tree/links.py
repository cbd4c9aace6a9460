"""Where symbolic links lead, decided from the listing alone: the file system is never asked to follow one."""

from collections.abc import Collection, Mapping
from typing import Literal

import msgspec

MAX_HOPS = 16
"""Links passed through on the way to one file; Linux gives up after 40."""

LinkProblem = Literal["symlink-outside", "symlink-loop", "symlink-directory", "symlink-broken"]


class Link(msgspec.Struct, frozen=True):
    """The end of a link: a path in the tree, or why there is none."""

    target: str | None
    problem: LinkProblem | None = None


def resolve(path: str, links: Mapping[str, str], files: Collection[str], folders: Collection[str]) -> Link:
    """Follow the link at `path` through `links` (path -> text of the link), part by part as POSIX does."""
    done = path.split("/")[:-1]
    todo = _parts(links[path])
    hops = 1
    if links[path].startswith("/"):
        return Link(None, "symlink-outside")
    while todo:
        part = todo.pop()
        if part == ".." and not done:
            return Link(None, "symlink-outside")
        here = _step(done, part)
        if here not in links:
            continue
        hops += 1
        if hops > MAX_HOPS:
            return Link(None, "symlink-loop")
        if links[here].startswith("/"):
            return Link(None, "symlink-outside")
        done.pop()
        todo += _parts(links[here])
    return _end("/".join(done), files, folders)


def _parts(text: str) -> list[str]:
    """Parts of a link in reverse, so that the next one is popped off the end."""
    return [part for part in reversed(text.split("/")) if part not in ("", ".")]


def _step(done: list[str], part: str) -> str:
    if part == "..":
        done.pop()
        return ""
    done.append(part)
    return "/".join(done)


def _end(target: str, files: Collection[str], folders: Collection[str]) -> Link:
    if target in files:
        return Link(target)
    if not target or target in folders:
        return Link(None, "symlink-directory")
    return Link(None, "symlink-broken")
