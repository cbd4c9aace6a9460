"""One command: it leaves a body, calls a function of the tree, sets variables, or is a call that states something."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

from ecm_parsers.cmake_tokens import Command

from ecm_extract.cmake import policies
from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.change import Change
from ecm_extract.cmake.functions import Function, bound, substituted
from ecm_extract.cmake.known import commands, is_true, known
from ecm_extract.cmake.look import Outcomes
from ecm_extract.cmake.run import Arm, Place, Run
from ecm_extract.cmake.setters import ALSO_CALLS
from ecm_extract.cmake.special import SPECIAL
from ecm_extract.cmake.state import Leave
from ecm_extract.cmake.text import all_values
from ecm_extract.cmake.values import Value, is_known, one_of, unknown

_LIBRARIES: Final = frozenset({"add_library", "cuda_add_library", "ament_auto_add_library"})
_LEAVES: Final[dict[str, Leave]] = {"return": "return", "break": "break", "continue": "continue"}


def run_command(run: Run, command: Command, place: Place) -> bool:
    """Run one command; tells whether the run goes on behind it."""
    if command.name in _LEAVES:
        run.state.leave(_LEAVES[command.name])
        return False
    if command.name in run.functions:
        return _invoke_each(run, command, run.functions[command.name], place)
    if command.name in run.setters:
        _set_variables(run, command)
        if command.name not in ALSO_CALLS:
            return True
    outcomes = run.worlds(lambda look: tuple(all_values(command.args, look)))
    _record(run, command, outcomes, place)
    special = SPECIAL.get(command.name)
    if special is not None:
        return special(
            run, Command(command.name, command.args, place.caller_line or command.line), outcomes.first, place
        )
    if command.name not in commands():
        run.brought.run(command.name, outcomes.first)
    if command.name not in commands() or command.name in known().openers.names:
        _touch(run, outcomes.first)
    return True


def _record(run: Run, command: Command, outcomes: Outcomes[tuple[str, ...]], place: Place) -> None:
    path = run.state.path
    others = tuple(dict.fromkeys(each for each in outcomes.others if each != outcomes.first))
    call = Call(
        name=command.name,
        texts=outcomes.first,
        path=place.path,
        line=place.caller_line or command.line,
        folder=run.folder(),
        others=others,
        sure=outcomes.sure or not others,
        conditions=path.conditions,
        by_default=path.by_default,
        is_test=path.is_test,
        is_relative_here=policies.is_new(run.look(), "CMP0076"),
        makes_shared=_makes_shared(run) if command.name in _LIBRARIES else None,
    )
    run.found.calls.append(call)


def _makes_shared(run: Run) -> bool | None:
    look = run.look()
    text = look.get("BUILD_SHARED_LIBS") if look.has("BUILD_SHARED_LIBS") else None
    return is_true(text) if text is not None and is_known(text) else None


# -- variables


def _set_variables(run: Run, command: Command) -> None:
    setter = run.setters[command.name]
    if command.name == "set":
        _begin(run, command)
    outcomes = run.worlds(lambda look: tuple(setter(all_values(command.args, look), look)))
    _apply(run, outcomes)
    if _is_switch(command):
        for change in outcomes.first:
            other = "OFF" if is_true(change.text or "") else "ON"
            run.state.assign(change.name, Value((change.text, other), outcomes.sure), change.where)


def _begin(run: Run, command: Command) -> None:
    """`set(X ${X} more)`: a variable that nothing set before is empty, unless others set it."""
    (name, *_) = (*all_values(command.args[:1], run.look()), "")
    if name and is_known(name) and name not in run.state.variables and not run.outside.may_set(name):
        run.state.assign(name, Value((None,)))


def _is_switch(command: Command) -> bool:
    """Tell whether a command makes a switch that may be turned from the command line."""
    words = [argument.text for argument in command.args]
    is_cached = command.name == "set" and "CACHE" in words[:-1] and words[words.index("CACHE") + 1] == "BOOL"
    return command.name in {"option", "cmake_dependent_option"} or is_cached


def _apply(run: Run, outcomes: Outcomes[tuple[Change, ...]]) -> None:
    results = [{(each.name, each.where): each.text for each in one} for one in (outcomes.first, *outcomes.others)]
    for name, where in dict.fromkeys(key for result in results for key in result):
        value = run.state.variables.get(name)
        held = value.first if value is not None else None
        texts = [result.get((name, where), held) for result in results]
        run.state.assign(name, one_of(texts, outcomes.sure), where)


def _touch(run: Run, words: Sequence[str]) -> None:
    """A command from elsewhere may set the variables whose names it is given."""
    for word in words:
        value = run.state.variables.get(word)
        if value is None and run.outside.leaves_empty(word):
            value = Value((None,))
        if value is not None:
            run.state.assign(word, one_of((*value.texts, unknown(word)), False))


# -- functions and macros


def _invoke_each(run: Run, command: Command, function: Function, place: Place) -> bool:
    """Run a function with its arguments; where these may be several, with each of them."""
    outcomes = run.worlds(lambda look: tuple(all_values(command.args, look)))
    kinds = list(dict.fromkeys((outcomes.first, *outcomes.others)))
    inside = Place(place.path, place.caller_line or command.line, place.depth + 1)
    if len(kinds) == 1:
        return _invoke(run, function, kinds[0], inside)
    return run.branches(
        [
            Arm(command.name, (at == 0) if outcomes.sure else None, partial(_invoke, run, function, args, inside))
            for at, args in enumerate(kinds)
        ]
    )


def _invoke(run: Run, function: Function, args: tuple[str, ...], place: Place) -> bool:
    run.work += len(args) // 8 + (0 if function.is_macro else len(run.state.variables) // 20)
    before = policies.held(run.state.variables)
    policies.put_back(run.state, function.policies)
    goes_on = _run_body(run, function, args, place)
    own = policies.changed(function.policies, run.state.variables)
    policies.put_back(run.state, {**before, **own})
    return goes_on


def _run_body(run: Run, function: Function, args: tuple[str, ...], place: Place) -> bool:
    if function.is_macro:
        return run.steps(substituted(function, args), place)
    run.state.enter(bound(function, args))
    goes_on = run.bounded(frozenset({"return"}), lambda: run.steps(function.body, place))
    run.state.end()
    return goes_on
