"""What a function template takes the place of: its parameters are whatever the arguments of old calls make them."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Final

import msgspec
from ecm_checker.hub.provision import Form

_PARAMETER: Final = re.compile(r"\$[A-J]\b")
"""How `signatures.template_names` writes a parameter of a function template."""
_ARGUMENT: Final = r"([\w:][\w:<>,* ]*?)"


def deduced(new: Form, old: Form) -> Form:
    """Return a form with the parameters of its template as the types of an old one make them, as far as they fit."""
    if new.virtual or not any(_PARAMETER.search(each) for each in new.types):
        return new
    found: dict[str, str] = {}
    for after, before in zip(new.types, old.types, strict=False):
        for name, argument in _arguments(after, before):
            if found.setdefault(name, argument) != argument:
                return new
    types = tuple(_filled(each, found) for each in new.types)
    return msgspec.structs.replace(new, types=types, returns=_filled(new.returns, found))


def _filled(written: str, arguments: dict[str, str]) -> str:
    return _PARAMETER.sub(lambda match: arguments.get(match[0], match[0]), written)


@lru_cache(maxsize=20_000)
def _arguments(after: str, before: str) -> tuple[tuple[str, str], ...]:
    """Pairs of a parameter of a template and what an argument makes of it; none where it does not fit."""
    parts = _PARAMETER.split(after)
    names = _PARAMETER.findall(after)
    match = re.fullmatch(_ARGUMENT.join(re.escape(part) for part in parts), before)
    if match is None or not all(_is_one(each) for each in match.groups()):
        return ()
    return tuple(zip(names, match.groups(), strict=True))


def _is_one(argument: str) -> bool:
    """Whether a text is one argument: all its brackets are closed, no comma stands outside of them."""
    depth = 0
    for letter in argument:
        depth += {"<": 1, ">": -1}.get(letter, 0)
        if depth < 0 or (letter == "," and depth == 0):
            return False
    return depth == 0
