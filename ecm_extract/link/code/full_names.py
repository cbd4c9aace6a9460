"""Names of Python by the imports of their file: `np.array` behind `import numpy as np` is `numpy.array`."""

from __future__ import annotations

from collections.abc import Mapping


def full_name(written: str, imported: Mapping[str, str]) -> str:
    """Return the dotted name that a written one means by an import; empty for what no import binds."""
    head, _, rest = written.partition(".")
    return f"{imported[head]}.{rest}".rstrip(".") if head in imported else ""
