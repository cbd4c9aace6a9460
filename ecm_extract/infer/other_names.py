"""Members that a function changes by another name: `auto & p = p_; p.x = 1;`, `for (auto & c : all_) c.x = 1;`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Set
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Expr, Items, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.places import target_of
from ecm_extract.infer.pointing import is_address, refers
from ecm_extract.link.code.spelling import by_value

if TYPE_CHECKING:
    from ecm_extract.infer.outline import Outline

_BINDING: Final = frozenset({"let", "each"})
_BINDING_OF_PYTHON: Final = _BINDING | {"set"}


class _Named(NamedTuple):
    """What a variable is another name of: another variable, or a part of it that has no name."""

    key: str
    is_element: bool


def changed_by_other_names(outline: Outline) -> Set[str]:
    """Return the members, or fields of them, that a body may change by variables that it has them in.

    What it changes of an element counts as a change of the whole.
    """
    named = _names(outline, lambda key: key[:1] == ".")
    return frozenset(_changed(outline, named)) if named else frozenset()


def changed_around(outline: Outline) -> Set[str]:
    """Return the variables around a function of C++ that it may change by references and pointers to them."""
    named = _names(outline, lambda key: key.partition(".")[0] not in outline.effects.own, refers)
    return frozenset(_changed(outline, named)) if named else frozenset()


def changed_as_others(outline: Outline, parameter: str) -> Set[str]:
    """Return the parameter of a body, or fields of it, that the body may change by variables that it has them in."""
    named = _names(outline, lambda key: key.partition(".")[0] == parameter)
    found = set(_changed(outline, named)) if named else set()
    return frozenset(parameter for key in found if key.partition(".")[0] == parameter)


def _changed(outline: Outline, named: Mapping[str, Set[_Named]]) -> Iterator[str]:
    for at, entry in enumerate(outline.func.fact.body):
        bound = set(outline.bound_keys(target_of(entry))) & named.keys() if _binds(entry, outline.python) else set()
        for key in outline.changed_by(at) - bound:
            first, dot, rest = key.partition(".")
            for name in named.get(first, ()):
                yield name.key if name.is_element else f"{name.key}{dot}{rest}"


def _names(
    outline: Outline, is_wanted: Callable[[str], bool], binds: Callable[[Statement], bool] = lambda entry: True
) -> Mapping[str, Set[_Named]]:
    """Variable -> what it may be another name of, by any of the statements that bind it."""
    kinds = _BINDING_OF_PYTHON if outline.python else _BINDING
    entries = (entry for entry in outline.func.fact.body if entry.kind in kinds and binds(entry))
    bindings = [entry for entry in entries if not _is_copy(entry, outline)]
    found: dict[str, set[_Named]] = defaultdict(set)
    while any(_note(entry, outline, found, is_wanted) for entry in bindings):
        pass
    return found


def _note(entry: Statement, outline: Outline, found: dict[str, set[_Named]], is_wanted: Callable[[str], bool]) -> bool:
    """Note what the variables of a statement are names of; tells whether any of that is new."""
    named = set(_named_by(entry, outline))
    named |= {_Named(each.key, one.is_element or each.is_element) for one in named for each in found.get(one.key, ())}
    members = {one for one in named if is_wanted(one.key)}
    names = [key for key in outline.bound_keys(entry.target) if "." not in key]
    new = [name for name in names if members - found.get(name, set())]
    for name in new:
        found[name] |= members
    return bool(new)


def _named_by(entry: Statement, outline: Outline) -> Iterator[_Named]:
    """What a statement gives its variables: other variables as they are, and what they consist of."""
    value, effects = entry.value, outline.effects
    whole = value.items if isinstance(value, Items) else (value,) if entry.kind != "each" else ()
    same = {effects.key(each.operands[0] if isinstance(each, Op) and is_address(each) else each) for each in whole}
    shared = shared_names(value, outline.func.fact.body) if outline.python else _sides(value)
    held = {effects.root(value), *map(effects.key, shared)}
    yield from (_Named(key, key not in same) for key in same | held if key)


def _sides(value: Expr | None) -> tuple[Expr, ...]:
    """What `test ? a : b` is one of."""
    return value.operands[1:] if isinstance(value, Op) and value.op == "?:" else ()


def _binds(entry: Statement, python: bool) -> bool:
    """Whether a statement makes its variable mean something else; `x += y` may change what it means."""
    return entry.kind in _BINDING or (python and entry.kind != "do" and not entry.type.endswith("="))


def _is_copy(entry: Statement, outline: Outline) -> bool:
    """Whether a variable of C++ is a copy of a member of the class, which no pointer is."""
    if outline.python or entry.kind != "let" or entry.type.endswith(("&", "*")):
        return False
    key, cls = outline.effects.key(entry.value), outline.func.cls
    field = cls.fields.get(key.removeprefix(".")) if cls is not None and key[:1] == "." else None
    return field is not None and by_value(field.type)
