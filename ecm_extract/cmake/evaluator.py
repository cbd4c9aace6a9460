"""Runs CMake files as CMake does: scopes, functions, macros, loops, includes and subfolders, within bounds.

Where a condition is not decided, each arm is run from the same state, and what they leave is joined.
"""

from __future__ import annotations

import posixpath

from ecm_parsers.cmake_blocks import Block
from ecm_parsers.cmake_tokens import Command

from ecm_extract.cmake.blocks import run_block
from ecm_extract.cmake.command import run_command
from ecm_extract.cmake.files import BuildFiles, placed
from ecm_extract.cmake.known import at_start
from ecm_extract.cmake.run import Evaluation, Place, Run
from ecm_extract.cmake.setters import setters
from ecm_extract.cmake.special import run_file
from ecm_extract.cmake.state import State
from ecm_extract.cmake.values import BINARY


class _Handlers:
    """Blocks and commands as CMake runs them."""

    def block(self, run: Run, block: Block, place: Place) -> bool:
        return run_block(run, block, place)

    def command(self, run: Run, command: Command, place: Place) -> bool:
        return run_command(run, command, place)


def evaluate(files: BuildFiles, top: str) -> Evaluation:
    """Run a CMakeLists.txt and what it includes; never raises on content.

    Args:
        files: of the tree.
        top: path of the file of the package.
    """
    run = Run(files, _Handlers(), setters(files), State(at_start()), Evaluation(files))
    for name in ("CMAKE_SOURCE_DIR", "CMAKE_CURRENT_SOURCE_DIR", "PROJECT_SOURCE_DIR"):
        run.set(name, placed(posixpath.dirname(top)))
    for name in ("CMAKE_BINARY_DIR", "CMAKE_CURRENT_BINARY_DIR", "PROJECT_BINARY_DIR"):
        run.set(name, BINARY)
    run_file(run, top, Place(top))
    return run.found
