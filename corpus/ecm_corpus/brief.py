"""Briefs: what two sides declare, for a person or another tool to judge, without the story.

The states of a case stand beside unrelated pairs, in an order and under names that tell nothing. What was found is not
in a brief, only what the contracts say. Source: paper section "Are the Conflicts Interface-Derivable?".
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.contract import Contract, Interface
from ecm_checker.delta import gained, lost
from ecm_checker.view import view

from ecm_corpus.again import sides_of
from ecm_corpus.documents import stored, unpacked
from ecm_corpus.results import CaseResult, Results, StateResult
from ecm_corpus.verdict import CONSUMER, NEW, OLD, contracts

UNRELATED: Final = 2
"""Unrelated pairs beside the states of a case."""

MAX_ENDPOINTS: Final = 400

_QUESTION: Final = {
    "composition": "May these modules run together as they are?",
    "upgrade": "May the new side take the place of the old one under these consumers, if there are any?",
}


class Brief(msgspec.Struct, frozen=True):
    """One question: its id, its text, and where it comes from, which only the key says."""

    id: str
    text: str
    origin: str


def briefs(case: CaseResult, results: Results, store: Path) -> list[Brief]:
    """Briefs of every state of a case, and of unrelated pairs, in an order that tells nothing.

    Args:
        case: whose states are asked about.
        results: all of them, to take unrelated modules from.
        store: folder of the documents.

    Raises:
        InputError: documents that the results name are not in the store.
    """
    found = [_of_state(case.case, name, state, store) for name, state in case.states.items()]
    found += _unrelated(case, results, store)
    return sorted(found, key=lambda brief: brief.id)


def _of_state(case: str, name: str, state: StateResult, store: Path) -> Brief:
    sides = _sides(state, store)
    origin = f"{case}:{name}"
    lines = [_QUESTION[state.question], ""]
    if OLD in sides:
        lines += _changes(sides[OLD], sides[NEW])
        lines += _side("the consumers declare", sides.get(CONSUMER, []))
    else:
        for side in sorted(sides):
            lines += _side("the modules declare", sides[side])
    return _brief(origin, lines)


def _unrelated(case: CaseResult, results: Results, store: Path) -> Iterator[Brief]:
    """Pairs of one package of this case with one of another case, chosen by hash so that a rerun has the same."""
    own = _some_package(case)
    others = [other for other in results.cases if other.case != case.case and _some_package(other) is not None]
    for other in sorted(others, key=lambda other: _mark(f"{case.case}+{other.case}"))[:UNRELATED]:
        theirs = _some_package(other)
        if own is None or theirs is None:
            continue
        modules = contracts([*unpacked(stored(own, store)), *unpacked(stored(theirs, store))])
        lines = [_QUESTION["composition"], "", *_side("the modules declare", modules)]
        yield _brief(f"unrelated:{case.case}+{other.case}", lines)


def _some_package(case: CaseResult) -> str | None:
    names = sorted({mark for state in case.states.values() for mark in state.documents.values()})
    return names[0] if names else None


def _sides(state: StateResult, store: Path) -> dict[str, list[Contract]]:
    return {side: contracts(packages) for side, packages in sides_of(state, store).items()}


def _brief(origin: str, lines: Iterable[str]) -> Brief:
    mark = _mark(origin)
    text = "\n".join((f"# Brief {mark}", "", *lines, "", *_FORM))
    return Brief(mark, text.replace("<id>", mark) + "\n", origin)


_FORM: Final = (
    "## Answer",
    "",
    "<id>: {outcome: compatible | incompatible | cannot tell, dimension: signature | behavior | resources |",
    "       permissions | recovery | versioning}",
)


def _mark(origin: str) -> str:
    return hashlib.sha256(f"brief {origin}".encode()).hexdigest()[:8]


def _side(title: str, contracts: Sequence[Contract]) -> list[str]:
    lines = [f"## What {title}", ""]
    left = MAX_ENDPOINTS
    for contract in contracts:
        lines += [f"- {contract.ecm.module_id} ({contract.ecm.kind}, version {contract.ecm.version or 'unknown'})"]
        shown = contract.signature.interfaces[: max(0, left)]
        left -= len(shown)
        lines += [f"  - {_endpoint(entry)}" for entry in shown]
        locks = contract.resources.exclusive_locks
        if locks is not None:
            lines.append(f"  - claims {', '.join(map(str, locks.value)) or 'nothing'}")
    if left < 0:
        lines.append(f"- and {-left} more endpoints")
    return lines if contracts else []


def _endpoint(entry: Interface) -> str:
    parts = [entry.role.replace("_", " "), entry.name, entry.type or "of a type that is not known"]
    if entry.row.value and entry.default is not None:
        parts.append(f"default {entry.default}")
    if entry.frame is not None:
        parts.append(f"frame {entry.frame}")
    if entry.qos is not None:
        parts += [text for text in (entry.qos.reliability, entry.qos.durability) if text]
    return ", ".join(parts)


def _changes(old: Sequence[Contract], new: Sequence[Contract]) -> list[str]:
    """What the new side no longer has, or has more, by module."""
    before: Mapping[str, Contract] = {contract.ecm.module_id: contract for contract in old}
    after: Mapping[str, Contract] = {contract.ecm.module_id: contract for contract in new}
    lines = ["## What changed", ""]
    for name in sorted({*before, *after}):
        if name not in after or name not in before:
            lines.append(f"- {name} is {'gone' if name in before else 'new'}")
            continue
        one, two = view(before[name]), view(after[name])
        steps = f"{before[name].ecm.version} to {after[name].ecm.version}"
        told = [each.text for each in lost(one, two)] + [f"{kind} {what} is new" for kind, what in gained(one, two)]
        lines += [f"- {name}, {steps}"] * bool(told) + [f"  - {text}" for text in told]
    return [*lines, ""]
