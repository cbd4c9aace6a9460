"""What a member of a class template is for who has the class by template arguments."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final

import msgspec

from ecm_checker.hub.provision import Provision

_PLACE: Final = re.compile(r"\$(\d+)\b")
"""How types write the parameter of a class template at a place."""


def for_arguments(member: Provision, given: Sequence[str]) -> Provision:
    """Return a member with the types that the arguments of its class make of its own."""
    if not given:
        return member
    forms = tuple(
        msgspec.structs.replace(
            form, types=tuple(written_for(each, given) for each in form.types), returns=written_for(form.returns, given)
        )
        for form in member.forms
    )
    kind = written_for(member.type, given) if member.type is not None else None
    return msgspec.structs.replace(member, forms=forms, type=kind)


def written_for(written: str, given: Sequence[str]) -> str:
    """Return a type with arguments in the place of parameters; one that is not given keeps its place."""
    return _PLACE.sub(lambda match: dict(enumerate(given, 1)).get(int(match[1]), match[0]), written)
