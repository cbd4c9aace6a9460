"""Nodes that can be started without a build: scripts of rospy, which their contracts name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ecm_checker.contract import Contract

from ecm_extract.check_inputs import subject

_ENDPOINTS = frozenset({"publisher", "subscriber", "service_server", "action_server", "action_client"})


@dataclass(frozen=True)
class Candidate:
    """A script and the contract that describes it."""

    tree: Path
    script: Path
    contract: Contract


def candidates(tree: Path) -> Iterator[Candidate]:
    """Yield the scripts of a tree, by module."""
    for module in sorted(subject(str(tree)).contracts, key=lambda each: each.ecm.module_id):
        if module.ecm.ros != 1 or module.ecm.kind not in {"node", "script"}:
            continue
        script = _script(tree, module)
        if script is not None and any(each.role in _ENDPOINTS for each in module.signature.interfaces):
            yield Candidate(tree, script, module)


def _script(tree: Path, module: Contract) -> Path | None:
    """The file that the contract was read from, when it is Python and makes a node by itself."""
    path = tree / module.ecm.source.path
    if not path.is_file() or path.suffix in {".cpp", ".cc", ".xml"}:
        return None
    text = path.read_bytes()
    return path if b"rospy" in text and b"init_node" in text else None
