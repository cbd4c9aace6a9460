"""Parameters that decide whether a function gets to a site, or which name that has, where all callers are known."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_parsers.source.expr import Expr, Op
from ecm_parsers.source.flow import Branch, Loop, Switch, steps

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions, names_in
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.values import Value, is_proved


def deciding(site: Site, names: Sequence[Value], folder: Folder) -> frozenset[str]:
    """Return the parameters of the outermost function that decide; none where a caller leaves one of them open."""
    func = site.root
    if not func.given or func.is_constructor:
        return frozenset()
    streams = site.form.row.streams
    tests = _within(func) if len(names) > 1 or streams else _on_the_way(site, folder)
    given = _handed(site.call) if streams and site.call.func is func else ()  # whether it is latched, how much it keeps
    asked = func.given & {name for each in (*tests, *given) for name in names_in(each)}
    return asked if asked and _is_inner(func, folder) and _are_settled(func, asked, folder) else frozenset()


def _handed(call: Invocation) -> tuple[Expr, ...]:
    return (*call.args, *(value for _, value in call.keywords))


def _on_the_way(site: Site, folder: Folder) -> Iterator[Expr]:
    """What is asked on the way to a site and not decided yet."""
    for state in folder.flow.reached(site.places[0] if site.places else site.env):
        for turn in folder.flow.decisions.turns(state.path):
            if turn.test is not None:
                yield turn.test


def _within(func: Func) -> Iterator[Expr]:
    """What a function asks anywhere."""
    for step in steps(func.fact.flow):
        if isinstance(step, Branch | Loop) and step.test is not None:
            yield step.test
        elif isinstance(step, Switch):
            yield step.subject
            yield from (test for case in step.cases for test in case.tests)
    for statement in func.fact.body:
        yield from (expr.operands[0] for expr, _ in expressions(statement) if isinstance(expr, Op) and expr.op == "?:")


def _is_inner(func: Func, folder: Folder) -> bool:
    """Whether no other package calls a method: it is private, or no file but its own sees the class."""
    cls, program = func.cls, folder.program
    if cls is None:
        return False
    traits = {trait for each in cls.methods if each.fact.name == func.fact.name for trait in each.fact.traits}
    if traits & {"private", "protected"}:
        return True
    return not any(program.sees(file, cls.file) for file in program.files if file not in {cls.file, func.file})


def _are_settled(func: Func, asked: frozenset[str], folder: Folder) -> bool:
    """Whether all callers of a function are known, with what they hand it for the parameters that decide."""
    callers = folder.states.callers.of(func)
    for call, place in callers or ():
        args = bind(func, call, place)
        for name in asked:
            if name not in args or not _is_settled(args[name], folder):
                return False
    return callers is not None


def _is_settled(given: Bound, folder: Folder) -> bool:
    """Whether an argument is one value, or one member of an enumeration, whatever that holds."""
    values = folder.fold(given.expr, given.env)
    return (len(values) == 1 and is_proved(values[0])) or folder.enums.member(given.expr, given.env) is not None
