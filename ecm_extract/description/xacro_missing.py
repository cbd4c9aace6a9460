"""What is said of an include that finds no file, and of a call that leaves parameters out."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

from ecm_extract.description.model import ProblemKind
from ecm_extract.description.xacro_files import XacroFiles, shown_path

_COMPUTED = re.compile(r"\$\{[^}]*\}|\$\(arg [^)]*\)")
_SHOWN = 3


class MissingFile(NamedTuple):
    """What is said of an include, of which kind it is, and the file that it names."""

    message: str
    kind: ProblemKind
    about: str


def include_problem(
    written: str, name: str, beside: str, files: XacroFiles, value_of: Callable[[str], str]
) -> MissingFile:
    """Return what is said of an include whose file is not there.

    Args:
        written: the name as written.
        name: what it expands to.
        beside: the file that includes it.
        files: where it was looked for.
        value_of: expands a part of the name.
    """
    shown = shown_path(name)
    if any(not value_of(part) for part in _COMPUTED.findall(written)):
        # an empty default is there to be given
        return MissingFile(f"included file `{shown}` is known at launch only", "late", shown)
    if _COMPUTED.search(written) and files.has_choice(value_of(_COMPUTED.sub("{}", written)), beside):
        message = f"included file `{shown}`, which an argument chooses, is not in the tree"
        return MissingFile(message, "chosen_file", shown)
    return MissingFile(f"included file `{shown}` is not in the tree", "file", shown)


def call_problem(missing: Sequence[str], macro: str) -> str:
    """Return the message for the parameters that a call leaves out."""
    names = ", ".join(f"`{name}`" for name in missing[:_SHOWN])
    more = f" and {len(missing) - _SHOWN} more" if len(missing) > _SHOWN else ""
    return f"{names}{more} {'is' if len(missing) == 1 else 'are'} not given to macro `{macro}`"
