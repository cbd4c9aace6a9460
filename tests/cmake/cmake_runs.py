"""Drawn up projects of CMake, run in memory."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ecm_parsers.cmake_facts import CmakeFile, Target

from ecm_extract.cmake import BuildFiles, evaluate, stated

TOP = "CMakeLists.txt"


def facts(text: str, listed: Iterable[str], others: Mapping[str, str], suffix: str) -> dict[str, CmakeFile]:
    """The facts of a project `p` with empty files; others are given by name, `__` for a slash, without their suffix."""
    files = {TOP: f"cmake_minimum_required(VERSION 3.14)\nproject(p VERSION 1.2.3)\n{text}".encode()}
    files |= {f"{name.replace('__', '/')}{suffix}": body.encode() for name, body in others.items()}
    files |= dict.fromkeys(listed, b"")
    return stated(evaluate(BuildFiles(files, files.get), TOP))


def targets_of(found: Mapping[str, CmakeFile]) -> dict[str, Target]:
    """All targets of a project by their names."""
    return {target.name: target for file in found.values() for target in file.targets}
