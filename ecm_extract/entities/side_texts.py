"""What entities are read from beside facts: launch files, descriptions, YAML files, sources that speak of an end.

All of it is read in one go: of a git ref, a process for each package would cost more than reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from ecm_parsers.cmake_tokens import Command, parse_commands
from ecm_parsers.launch.model import LaunchFile
from ecm_parsers.result import Facts, Parsed

from ecm_extract.read.cuts import report_cuts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import is_included
from ecm_extract.system.launch_files import is_launch_file
from ecm_extract.tree import Tree

DESCRIPTIONS: Final = (".urdf", ".xacro")
PARAMETERS: Final = (".yaml", ".yml")
_BUILDS: Final = ("CMakeLists.txt", ".cmake", ".sdf")
"""What requirements are read from as well: build files, and descriptions of worlds."""
_ENDS: Final = re.compile(rb"[Dd]eprecat|DEPRECAT|[Oo]bsolete")


class SideTexts:
    """Contents of the files of one side.

    Attributes:
        speaking: contents of sources, headers and interface files that call something deprecated or obsolete, by path.
        launches: the launch files that were parsed so far, with their paths, by the folder of the package.
    """

    def __init__(self, tree: Tree, packages: Sequence[PackageFacts]) -> None:
        self._tree = tree
        self._whole: dict[str, bytes] = {}
        self.speaking: dict[str, bytes] = {}
        self.launches: dict[str, Sequence[tuple[str, LaunchFile]]] = {}
        listed = [entry.path for facts in packages for entry in facts.root.files]
        whole = {
            path for path in listed if path.endswith((*DESCRIPTIONS, *PARAMETERS, *_BUILDS)) or is_launch_file(path)
        }
        searched = {path for facts in packages for path in (*facts.sources, *facts.interfaces)}
        searched |= {path for path in listed if is_included(path)}
        for path, data in tree.read_many(sorted(whole | searched)):
            if path in whole:
                self._whole[path] = data
            if path in searched and _ENDS.search(data):
                self.speaking[path] = data

    def told(self, path: str, parsed: Parsed[Facts]) -> Facts:
        """Return the facts of a file; what of it was not read is told to the tree."""
        report_cuts(self._tree, path, parsed.diagnostics)
        return parsed.facts

    def commands(self, path: str) -> Sequence[Command]:
        """Return the commands of a CMake file as they are written; none of one that cannot be read."""
        return [command for _, data in self.read_many([path]) for command in parse_commands(data).facts]

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Yield path and content in the order asked for; what is not kept is read anew."""
        for path in paths:
            if path in self._whole:
                yield path, self._whole[path]
            else:
                yield from self._tree.read_many([path])
