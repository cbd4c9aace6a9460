"""Blocks of CMake: conditions, loops, definitions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import zip_longest
from typing import Final

import msgspec
from ecm_parsers.cmake_blocks import Block, Branch
from ecm_parsers.cmake_tokens import Argument

from ecm_extract.cmake import policies
from ecm_extract.cmake.answers import Answers
from ecm_extract.cmake.conditions import Judged, holds, judged
from ecm_extract.cmake.functions import Function
from ecm_extract.cmake.keywords import split
from ecm_extract.cmake.known import known
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.look import Look, Outcomes
from ecm_extract.cmake.patterns import MATCH
from ecm_extract.cmake.run import Arm, Place, Run
from ecm_extract.cmake.state import both, opposite
from ecm_extract.cmake.text import all_values
from ecm_extract.cmake.values import Value, is_known, unknown

MAX_TURNS: Final = 2_000
MAX_WHILE: Final = 500
MAX_SHOWN: Final = 120


def run_block(run: Run, block: Block, place: Place) -> bool:
    """Run one block; tells whether its end is reached."""
    branch, inside = block.branches[0], place.deeper()
    if block.kind == "if":
        return _condition(run, block, inside)
    if block.kind == "foreach":
        return run.bounded(frozenset({"break"}), lambda: _foreach(run, branch, inside, block.line))
    if block.kind == "while":
        return run.bounded(frozenset({"break"}), lambda: _while(run, branch, inside))
    if block.kind in {"function", "macro"}:
        _define(run, block)
        return True
    return _scoped(run, branch, inside)


def _define(run: Run, block: Block) -> None:
    branch = block.branches[0]
    name = branch.header[0].text.lower() if branch.header else ""
    # Of two definitions that exclude each other, that of a build without settings counts.
    if name and (run.state.path.by_default is not False or name not in run.functions):
        params = tuple(argument.text for argument in branch.header[1:])
        run.functions[name] = Function(block.kind == "macro", params, branch.body, policies.held(run.state.variables))


def _scoped(run: Run, branch: Branch, place: Place) -> bool:
    """`block([SCOPE_FOR [POLICIES] [VARIABLES]] [PROPAGATE names...])`: variables and policies that go when it ends."""
    words = run.worlds(lambda look: tuple(all_values(branch.header, look))).first
    groups = split(words, frozenset({"SCOPE_FOR", "PROPAGATE"}))
    kinds = groups.get("SCOPE_FOR") or ["POLICIES", "VARIABLES"]
    if "VARIABLES" not in kinds:
        before = policies.held(run.state.variables)
        goes_on = run.steps(branch.body, place)
        policies.put_back(run.state, before)
        return goes_on
    run.state.enter({})
    goes_on = run.steps(branch.body, place)
    inner = run.state.end()
    for name in groups.get("PROPAGATE", []):
        run.state.assign(name, inner.get(name, Value((None,))))
    if "POLICIES" not in kinds:
        policies.put_back(run.state, policies.held(inner))
    return goes_on


# -- conditions


class _Verdict(msgspec.Struct, frozen=True):
    """Whether a condition holds: as a build without settings has it, in others, and whether only with tests."""

    first: bool | None
    others: tuple[bool | None, ...]
    sure: bool
    is_test: bool

    @property
    def never(self) -> bool:
        return self.first is False and all(each is False for each in self.others)

    @property
    def always(self) -> bool:
        return self.first is True and all(each is True for each in self.others)

    @property
    def default(self) -> bool | None:
        return self.first if self.sure else None


def _condition(run: Run, block: Block, place: Place) -> bool:
    arms = list(_arms(run, block, place))
    if len(arms) == 1 and not arms[0].condition:
        return arms[0].run()
    return run.branches(arms)


def _arms(run: Run, block: Block, place: Place) -> Iterator[Arm]:
    """Yield the arms that can be taken, and an empty one where it may be that none is."""
    before: bool | None = True
    refused: list[str] = []
    for at, branch in enumerate(block.branches):
        is_else = at > 0 and not branch.header
        verdict = _Verdict(True, (), True, False) if is_else else _verdict(run, branch.header)
        if verdict.never:
            continue
        text = " AND ".join([*refused, *([] if verdict.always else [shown(branch.header)])])
        yield Arm(text, both(before, verdict.default), partial(run.steps, branch.body, place), verdict.is_test)
        if verdict.always:
            return
        refused.append(f"NOT ({shown(branch.header)})")
        before = both(before, opposite(verdict.default))
    yield Arm(" AND ".join(refused), before, lambda: True)


def _verdict(run: Run, header: tuple[Argument, ...]) -> _Verdict:
    answers = Answers(run)
    outcomes = run.worlds(lambda look: judged(header, look, answers))
    _remember(run, {outcomes.first.matched, *(each.matched for each in outcomes.others)})
    others = tuple(each.verdict for each in outcomes.others)
    return _Verdict(outcomes.first.verdict, others, outcomes.sure, _asks_for_tests(run, header, outcomes))


def _remember(run: Run, matches: set[tuple[tuple[str, str], ...] | None]) -> None:
    """Keep what MATCHES leaves in variables; where that may be several things it is not known."""
    (found,) = matches if len(matches) == 1 else (None,)
    for name, text in found or ():
        run.set(name, text)
    stale = [name for name in run.state.variables if name.startswith(MATCH)] if found is None else []
    for name in stale:
        run.set(name, unknown(name))


def _asks_for_tests(run: Run, header: tuple[Argument, ...], outcomes: Outcomes[Judged]) -> bool:
    """Tell whether a condition cannot hold in a build without tests."""
    switches = known().tests.names & outcomes.reads
    if not switches or outcomes.first.verdict is False:
        return False
    off = Look(run.state.variables, dict.fromkeys(switches, "OFF"), run.outside)
    return holds(header, off, Answers(run)) is False


def shown(header: Sequence[Argument]) -> str:
    """Return a condition as it is written."""
    return " ".join(argument.text for argument in header)[:MAX_SHOWN]


# -- loops


class _Turn(msgspec.Struct, frozen=True):
    """What the variables of a loop hold in one turn; a turn that is not known stands for any number."""

    names: tuple[str, ...]
    texts: tuple[str | None, ...]
    is_known: bool = True


def _foreach(run: Run, branch: Branch, place: Place, line: int) -> bool:
    if not branch.header:
        return True
    outcomes = run.worlds(lambda look: tuple(_turns_of(branch.header, look)))
    kinds = list(dict.fromkeys((outcomes.first, *outcomes.others)))
    if len(kinds) == 1:
        return _turns(run, branch, kinds[0], place)
    text = shown(branch.header)
    del line
    return run.branches(
        [
            Arm(text, (at == 0) if outcomes.sure else None, partial(_turns, run, branch, turns, place))
            for at, turns in enumerate(kinds)
        ]
    )


def _turns(run: Run, branch: Branch, turns: Sequence[_Turn], place: Place) -> bool:
    outer = {name: run.state.variables.get(name) for turn in turns for name in turn.names}
    goes_on, line = True, branch.header[0].line
    for turn in turns[:MAX_TURNS]:
        if not goes_on or run.is_exhausted(line, place):
            break
        goes_on = _turn(run, branch, turn, place)
    for name, value in outer.items():
        if value is None:
            run.state.own().pop(name, None)
        else:
            run.state.assign(name, value)
    return goes_on


def _turn(run: Run, branch: Branch, turn: _Turn, place: Place) -> bool:
    def body() -> bool:
        for name, text in zip(turn.names, turn.texts, strict=False):
            run.state.assign(name, Value((text,)))
        return run.bounded(frozenset({"continue"}), lambda: run.steps(branch.body, place))

    if turn.is_known:
        return body()
    return run.branches([Arm(f"foreach {shown(branch.header)}", None, body), Arm("", None, lambda: True)])


def _turns_of(header: tuple[Argument, ...], look: Look) -> Iterator[_Turn]:
    words = all_values(header, look)
    names, rest = words[:1], words[1:]
    keyword = next((at for at, word in enumerate(words) if word == "IN" and at > 0), None)
    if keyword is not None and all(is_known(word) for word in words[:keyword]):
        names, rest = words[:keyword], words[keyword + 1 :]
        yield from _of_keywords(tuple(names), rest, look)
    elif rest[:1] == ["RANGE"]:
        yield from _of_range(tuple(names), rest[1:])
    else:
        yield from (_one(tuple(names), text) for text in rest)


def _of_keywords(names: tuple[str, ...], words: list[str], look: Look) -> Iterator[_Turn]:
    """`IN [LISTS lists...] [ITEMS items...]` or `IN ZIP_LISTS lists...`."""
    if words[:1] == ["ZIP_LISTS"]:
        lists = [items(look.get(word) or "") for word in words[1:]]
        targets = names if len(names) > 1 else tuple(f"{names[0]}_{at}" for at in range(len(lists)))
        yield from (_Turn(targets, texts) for texts in zip_longest(*lists) if len(texts) == len(targets))
        return
    mode = ""
    for word in words:
        if word in {"LISTS", "ITEMS"} and mode != "ITEMS":
            mode = word
        elif mode == "LISTS":
            yield from (_one(names, text) for text in items(look.get(word) or ""))
        else:
            yield _one(names, word)


def _one(names: tuple[str, ...], text: str) -> _Turn:
    """A turn with one text; what is not known at all may be many."""
    is_whole = text.startswith("\x01") and text.endswith("\x02")
    return _Turn(names, (unknown(names[0]),), False) if is_whole else _Turn(names, (text,))


def _of_range(names: tuple[str, ...], words: list[str]) -> Iterator[_Turn]:
    """`RANGE stop` or `RANGE start stop [step]`, both ends included."""
    if not words or not all(word.lstrip("-").isdigit() for word in words):
        yield _Turn(names, (unknown(names[0]),), False)
        return
    numbers = [int(word) for word in words]
    start, stop = (0, numbers[0]) if len(numbers) == 1 else numbers[:2]
    step = numbers[2] if len(numbers) > 2 else 1 if start <= stop else -1
    last = stop + (1 if step > 0 else -1)
    places = range(start, last, step) if step else range(0)
    yield from (_Turn(names, (str(number),)) for number in places[:MAX_TURNS])


def _while(run: Run, branch: Branch, place: Place) -> bool:
    def body() -> bool:
        return run.bounded(frozenset({"continue"}), lambda: run.steps(branch.body, place))

    line = branch.header[0].line if branch.header else 0
    for _ in range(MAX_WHILE):
        verdict = _verdict(run, branch.header)
        if verdict.never or run.is_exhausted(line, place):
            return True
        if not verdict.always:
            run.open(place, line, f"while {shown(branch.header)}")
            return run.branches([Arm(shown(branch.header), None, body), Arm("", None, lambda: True)])
        if not body():
            return False
    run.open(place, line, f"while {shown(branch.header)} does not end")
    return True
