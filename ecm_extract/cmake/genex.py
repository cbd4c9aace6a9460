"""Generator expressions: `$<...>` (cmake-generator-expressions(7)), as far as CMake files alone decide them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Final

from ecm_extract.cmake.comparisons import COMPARISONS
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.values import is_known

MAX_NESTING: Final = 20
_OPEN: Final = "$<?>"
"""What stands for an expression that only a build decides."""
_OBJECTS: Final = "$<TARGET_OBJECTS:"
_FALSE: Final = frozenset({"", "0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND"})


def stripped(text: str) -> str:
    """Return a text without its generator expressions, nested ones included."""
    return "".join("" if is_inside else part for part, is_inside in _parts(text))


def has_genex(text: str) -> bool:
    """Tell whether a text holds a generator expression."""
    return "$<" in text


def decided(texts: list[str]) -> list[str]:
    """Return the items of arguments with their expressions evaluated; one that is not decided stays as `$<?>`.

    Items are put together first: an expression over a list comes as several arguments.
    """
    if not any(map(has_genex, texts)):
        return texts
    text = ";".join(texts)
    return [item for item in items(_evaluated(text, _OPEN) or "") if item]


def decided_text(text: str) -> str:
    """Return one argument with its expressions evaluated; as it is where one is not decided."""
    found = _evaluated(text, None) if has_genex(text) else text
    return text if found is None else found


def objects_used(texts: Sequence[str]) -> list[str]:
    """Return the libraries whose objects are named: `$<TARGET_OBJECTS:name>`."""
    return [text.removeprefix(_OBJECTS)[:-1] for text in texts if _is_objects(text)]


def without_objects(texts: Sequence[str]) -> list[str]:
    """Return the texts that name no objects of a library."""
    return [text for text in texts if not _is_objects(text)]


def _is_objects(text: str) -> bool:
    return text.startswith(_OBJECTS) and text.endswith(">")


def _parts(text: str) -> Iterator[tuple[str, bool]]:
    """Yield the outer parts of a text: what stands between, and the inside of each expression."""
    at = 0
    while at < len(text):
        start = text.find("$<", at)
        if start < 0:
            yield text[at:], False
            return
        yield text[at:start], False
        end = _end(text, start + 2)
        yield text[start + 2 : end], True
        at = end + 1


def _end(text: str, at: int) -> int:
    """Position of the `>` that closes the expression that is open at a place; the end of the text if none does."""
    depth = 1
    while at < len(text):
        if text.startswith("$<", at):
            depth, at = depth + 1, at + 1
        elif text[at] == ">":
            depth -= 1
            if depth == 0:
                return at
        at += 1
    return at


def _evaluated(text: str, instead: str | None, depth: int = 0) -> str | None:
    """Return a text with its expressions evaluated, `instead` in the place of one that is not decided."""
    found = []
    for part, is_inside in _parts(text):
        value = _value(part, depth + 1) if is_inside else part
        value = instead if value is None else value
        if value is None:
            return None
        found.append(value)
    return "".join(found)


def _value(inside: str, depth: int) -> str | None:
    """The value of what stands between `$<` and `>`."""
    if depth > MAX_NESTING:
        return None
    head, rest = _cut(inside, ":")
    name = _evaluated(head, None, depth)
    if name is None or not is_known(name):
        return None
    if name == "0":
        return ""
    if name == "IF":
        return _chosen(_split(rest), depth)
    if name in {"1", "BUILD_INTERFACE"}:
        return _evaluated(rest, None, depth)
    form = _FORMS.get(name)
    values = [_evaluated(each, None, depth) for each in _split(rest)]
    return form(values) if form is not None else None


def _cut(text: str, mark: str) -> tuple[str, str]:
    """Cut a text at the first mark that is in no expression."""
    at = 0
    while at < len(text):
        if text.startswith("$<", at):
            at = _end(text, at + 2)
        elif text[at] == mark:
            return text[:at], text[at + 1 :]
        at += 1
    return text, ""


def _split(text: str) -> list[str]:
    found = []
    while True:
        head, rest = _cut(text, ",")
        found.append(head)
        if len(head) == len(text):
            return found
        text = rest


def _chosen(params: list[str], depth: int) -> str | None:
    """`$<IF:condition,one,other>`; only the one that is taken is evaluated."""
    condition = _evaluated(params[0], None, depth)
    if len(params) != 3 or condition not in {"0", "1"}:
        return None
    return _evaluated(params[1 if condition == "1" else 2], None, depth)


# -- expressions over values that are known or None

_Values = list[str | None]


def _bool(values: _Values) -> str | None:
    text = ",".join(value or "" for value in values)
    if None in values or not is_known(text):
        return None
    return "0" if text.upper() in _FALSE or text.upper().endswith("-NOTFOUND") else "1"


def _and(values: _Values) -> str | None:
    return "0" if "0" in values else None if None in values else "1"


def _or(values: _Values) -> str | None:
    return "1" if "1" in values else None if None in values else "0"


def _not(values: _Values) -> str | None:
    return {"0": "1", "1": "0"}.get(values[0] or "")


def _known(values: _Values) -> list[str] | None:
    kept = [value for value in values if value is not None and is_known(value)]
    return kept if len(kept) == len(values) else None


def _compared(name: str) -> Callable[[_Values], str | None]:
    def run(values: _Values) -> str | None:
        known = _known(values)
        holds = COMPARISONS[name](*known) if known is not None and len(known) == 2 else None
        return None if holds is None else str(int(holds))

    return run


def _is_in_list(values: _Values) -> str | None:
    known = _known(values)
    return str(int(known[0] in items(known[1]))) if known is not None and len(known) == 2 else None


def _platform(values: _Values) -> str | None:
    """Packages of ROS are read as a Linux builds them."""
    known = _known(values)
    return None if known is None else "Linux" if known == [""] else str(int("Linux" in known))


def _changed(change: Callable[[str], str]) -> Callable[[_Values], str | None]:
    def run(values: _Values) -> str | None:
        known = _known(values)
        return change(",".join(known)) if known is not None else None

    return run


def _join(values: _Values) -> str | None:
    return values[1].join(items(values[0])) if len(values) == 2 and values[0] is not None and values[1] else None


_FORMS: Final[dict[str, Callable[[_Values], str | None]]] = {
    "BOOL": _bool,
    "AND": _and,
    "OR": _or,
    "NOT": _not,
    "IN_LIST": _is_in_list,
    "PLATFORM_ID": _platform,
    "LOWER_CASE": _changed(str.lower),
    "UPPER_CASE": _changed(str.upper),
    "JOIN": _join,
    "INSTALL_INTERFACE": lambda values: "",
    "COMMA": lambda values: ",",
    "SEMICOLON": lambda values: ";",
    "ANGLE-R": lambda values: ">",
    **{
        name: _compared(name)
        for name in (
            *("STREQUAL", "EQUAL", "VERSION_LESS", "VERSION_GREATER", "VERSION_EQUAL"),
            *("VERSION_LESS_EQUAL", "VERSION_GREATER_EQUAL"),
        )
    },
}
