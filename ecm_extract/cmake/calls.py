"""A command of CMake that runs: with which arguments, from where, under which conditions."""

from __future__ import annotations

import posixpath
from typing import Final

import msgspec

from ecm_extract.cmake.files import absolute, tree_path
from ecm_extract.cmake.values import BINARY, PREFIX, SOURCE, is_known, written

_BUILD: Final = "${CMAKE_BINARY_DIR}"


class Call(msgspec.Struct, frozen=True):
    """A command that runs.

    Attributes:
        name: lower case.
        texts: evaluated arguments, as a build without settings of its own has them if `sure`.
        others: the arguments that other builds have.
        path: file that says so: for the body of a function or macro the one that calls it. line: 1-based.
        folder: CMAKE_CURRENT_SOURCE_DIR as a path of the tree.
        conditions: that are not decided, as written.
        by_default: whether a build without settings of its own runs it; None where that is not known.
        is_test: whether it runs only when tests are built.
        is_relative_here: whether sources that it adds are found from its folder, not from that of the target (CMP0076).
        makes_shared: whether libraries are shared here that do not say it (BUILD_SHARED_LIBS); None is not known.
    """

    name: str
    texts: tuple[str, ...]
    path: str
    line: int
    folder: str
    others: tuple[tuple[str, ...], ...] = ()
    sure: bool = True
    conditions: tuple[str, ...] = ()
    by_default: bool | None = True
    is_test: bool = False
    is_relative_here: bool = False
    makes_shared: bool | None = None

    @property
    def args(self) -> tuple[str, ...]:
        """The arguments as people write them; what is not known is a reference `${NAME}`."""
        return tuple(self.word(text) for text in self.texts)

    def word(self, text: str) -> str:
        """Return an argument as people write it, a path of the tree from the folder of the file."""
        place = tree_path(text)
        if place is not None and is_known(text):
            return f"./{relative(place, posixpath.dirname(self.path))}" if place else self._up()
        return written(_named(text.replace(SOURCE, ".")))

    def _up(self) -> str:
        return posixpath.relpath(".", posixpath.dirname(self.path) or ".")

    def file(self, text: str) -> str:
        """Return a path that an argument names, from the folder of the file; references stay as they are."""
        if not text or not is_known(text) or text.startswith("$<"):
            return written(_named(text)).replace(SOURCE, ".") if text else text
        slash = "/" if text.endswith("/") else ""
        place = tree_path(absolute(text, self.folder))
        if place is None:
            return written(_named(text))
        return relative(place, posixpath.dirname(self.path)) + slash


def is_of_build(path: str) -> bool:
    """Tell whether a path as people write it is that of a file which the build makes."""
    return path.startswith(_BUILD) and "$" not in path.removeprefix(_BUILD)


def _named(text: str) -> str:
    return text.replace(BINARY, _BUILD).replace(PREFIX, "${CMAKE_INSTALL_PREFIX}")


def relative(path: str, folder: str) -> str:
    """Return a path of the tree from a folder of the tree."""
    if not folder:
        return path or "."
    if path.startswith(f"{folder}/"):
        return path[len(folder) + 1 :]
    return posixpath.relpath(f"/{path}", f"/{folder}")
