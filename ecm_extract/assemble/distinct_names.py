"""Modules that share an id: all but one are told apart by the file that declares them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Set
from itertools import count
from pathlib import PurePosixPath

import msgspec
from ecm_checker.contract import Contract

_RUNS_NOT = frozenset({"interface", "launch", "library"})


def distinct(contracts: Iterable[Contract]) -> list[Contract]:
    """Return contracts with ids of their own, so that none is lost.

    Of those that share one, a module that runs keeps it before a library, then the first by its path. The others
    take the name of their file to it: `talker` of `src/second.cpp` becomes `talker_second`.
    """
    entries = sorted(contracts, key=_rank)
    taken = {entry.ecm.module_id for entry in entries}
    seen: set[str] = set()
    result = []
    for contract in entries:
        name = contract.ecm.module_id
        if name in seen:
            name = _free(contract, taken | seen)
            contract = msgspec.structs.replace(contract, ecm=msgspec.structs.replace(contract.ecm, module_id=name))
        seen.add(name)
        result.append(contract)
    return result


def _rank(contract: Contract) -> tuple[str, bool, str]:
    return contract.ecm.module_id, contract.ecm.kind in _RUNS_NOT, contract.ecm.source.path


def _free(contract: Contract, taken: Set[str]) -> str:
    return next(name for name in _candidates(contract) if name not in taken)


def _candidates(contract: Contract) -> Iterator[str]:
    """The id with the file's name, then with folders before it from the inside, at last a number."""
    own = contract.ecm.module_id
    path = PurePosixPath(contract.ecm.source.path)
    parts = (*path.parts[:-1], path.stem) if path.name else ()
    if parts and parts[-1] != own.rsplit(".", 1)[-1]:
        yield f"{own}_{parts[-1]}"
    for folders in range(2, len(parts) + 1):
        yield f"{own}_{'_'.join(parts[-folders:])}"
    yield from (f"{own}_{number}" for number in count(2))
