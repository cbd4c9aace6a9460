"""Members of Python objects that hold what can be called: `self.make = partial(self.create_publisher, String)`."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping

from ecm_parsers.source.expr import THIS, Call, Expr, Member
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.callables import callable_of
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import children


class _Given:
    """What classes give the members of their objects, and which members others give something."""

    def __init__(self) -> None:
        self.counts: dict[Cls, Counter[str]] = defaultdict(Counter)
        self.held: dict[Cls, dict[str, Expr]] = defaultdict(dict)
        self.outside: set[str] = set()

    def read(self, func: Func) -> None:
        """Add the statements of a function."""
        for step in func.fact.body:
            for member in _members(step.target):
                if func.cls is None or member.base != THIS:
                    self.outside.add(member.name)
                else:
                    self.counts[func.cls][member.name] += 1
            held = _held(step, func.file.imported)
            if held is not None and func.cls is not None:
                self.held[func.cls][held[0]] = held[1]

    def is_settled(self, name: str, held: Expr, related: Iterable[Cls]) -> bool:
        """Tell whether a member holds nothing else, of an object of any of some classes."""
        classes = list(related)
        methods = {method.fact.name for cls in classes for method in cls.methods} | {
            field for cls in classes for field in cls.fields
        }
        once = sum(self.counts[cls][name] for cls in classes if cls in self.counts) == 1
        own = held.name if isinstance(held, Member) and held.base == THIS else ""
        changed = own in self.outside or any(self.counts[cls][own] for cls in classes if cls in self.counts)
        return once and name not in self.outside and name not in methods and not changed


def settle_callables(funcs: Iterable[Func], related: Callable[[Cls], Iterable[Cls]]) -> None:
    """Tell classes what their members hold that can be called; `related` gives a class with its bases and heirs."""
    given = _Given()
    for func in funcs:
        if func.file.language == "python":
            given.read(func)
    for cls, held in given.held.items():
        classes = list(related(cls)) if held else ()
        for name, expr in held.items():
            if given.is_settled(name, expr, classes):
                for each in classes:
                    each.callables[name] = expr


def _held(step: Statement, imported: Mapping[str, str]) -> tuple[str, Expr] | None:
    target = step.target
    if step.kind != "set" or not isinstance(target, Member) or target.base != THIS:
        return None
    value = callable_of(step.value, imported)
    method = isinstance(value, Call) or (isinstance(value, Member) and value.base == THIS)
    return (target.name, value) if value is not None and method else None


def _members(target: Expr | None) -> Iterator[Member]:
    if isinstance(target, Member):
        yield target
    elif target is not None:
        for each in children(target):
            yield from _members(each)
