"""What a person requests: packages with ranges of their versions."""

from __future__ import annotations

from typing import Final

import msgspec
from packaging.specifiers import InvalidSpecifier, SpecifierSet

from ecm_extract.errors import InputError

_COMPARES: Final = "<>=!~"


class Wish(msgspec.Struct, frozen=True):
    """A requested package and the range of its versions; `*` for any."""

    package: str
    wanted: str = "*"


def wish_of(text: str) -> Wish:
    """Read `package`, `package@1.2.0`, or `package>=1.2,<2`.

    Raises:
        InputError: the range cannot be read.
    """
    at = next((place for place, char in enumerate(text) if char in f"@{_COMPARES}"), len(text))
    package, rest = text[:at].strip(), text[at:]
    wanted = f"=={rest[1:]}" if rest.startswith("@") else rest or "*"
    try:
        SpecifierSet("" if wanted == "*" else wanted)
    except InvalidSpecifier as error:
        message = f"{text}: {wanted} is no range of versions"
        raise InputError(message, "write PACKAGE, PACKAGE@1.2.0, or 'PACKAGE>=1.2,<2'") from error
    return Wish(package, wanted)
