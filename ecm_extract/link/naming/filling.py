"""Names with `${parameter=default}` once the parameters are known."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

MAX_ITEMS = 60
_PARAMETER = re.compile(r"\$\{([^={}]+)=((?:[^{}]|\{[^{}]*\})*)\}")


def filled(local: str, parameter: Callable[[str], Any]) -> list[str]:
    """Return a name with each `${parameter=default}` replaced by its value, once for each item of a list.

    Args:
        local: the name.
        parameter: gives the value of a parameter, None when it is not set.
    """
    match = _PARAMETER.search(local)
    if match is None:
        return [local]
    given = parameter(match[1])
    values = given[:MAX_ITEMS] if isinstance(given, list) else [match[2] if given is None else given]
    texts = [str(value) for value in values if not isinstance(value, list | dict)] or [match[2]]
    names = [local[: match.start()] + text + local[match.end() :] for text in texts]
    return [entry for name in names[:MAX_ITEMS] for entry in filled(name, parameter)][:MAX_ITEMS]
