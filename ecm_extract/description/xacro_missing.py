"""What is said of an include that finds no file, and of a call that leaves parameters out."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from ecm_extract.description.xacro_files import XacroFiles, shown_path

_COMPUTED = re.compile(r"\$\{[^}]*\}|\$\(arg [^)]*\)")
_SHOWN = 3


def include_problem(written: str, name: str, beside: str, files: XacroFiles, value_of: Callable[[str], str]) -> str:
    """Return the message for an include whose file is not there.

    Args:
        written: the name as written.
        name: what it expands to.
        beside: the file that includes it.
        files: where it was looked for.
        value_of: expands a part of the name.
    """
    shown = shown_path(name)
    if any(not value_of(part) for part in _COMPUTED.findall(written)):
        return f"included file `{shown}` is known at launch only"  # an empty default is there to be given
    if _COMPUTED.search(written) and files.has_choice(value_of(_COMPUTED.sub("{}", written)), beside):
        return f"included file `{shown}`, which an argument chooses, is not in the tree"
    return f"included file `{shown}` is not in the tree"


def call_problem(missing: Sequence[str], macro: str) -> str:
    """Return the message for the parameters that a call leaves out."""
    names = ", ".join(f"`{name}`" for name in missing[:_SHOWN])
    more = f" and {len(missing) - _SHOWN} more" if len(missing) > _SHOWN else ""
    return f"{names}{more} {'is' if len(missing) == 1 else 'are'} not given to macro `{macro}`"
