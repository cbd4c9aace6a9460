"""Names for any namespace and node: text, and parts that are known only where the node is started."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, TypeAlias

import msgspec

Teller: TypeAlias = Literal["parameter", "node", "namespace", "above", "plugin", "caller", "nobody"]
"""Who tells a part of a name.

`parameter`: a ROS parameter. `node`: the name of the node. `namespace`: that of the node; `above`: the one above that.
`plugin`: the name under which the class is loaded. `caller`: who calls the function at hand, or makes its object.
"""


class OpenPart(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """A part of a name that the source leaves open.

    Attributes:
        of: who tells it.
        label: the name of the parameter; of `plugin`, `caller` and `nobody` what the source calls the part.
        default: what a parameter gives as long as nobody sets it.
    """

    of: Teller
    label: str = ""
    default: tuple[str | OpenPart, ...] = ()

    @property
    def shown(self) -> str:
        """The part where nobody tells it: the default of a parameter, else a word in braces."""
        return shown(self.default) if self.of == "parameter" else f"{{{self.label or self.of}}}"


Parts: TypeAlias = tuple[str | OpenPart, ...]


class LocalName(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """A name for any namespace and node: `/absolute`, `~/private` or relative.

    Attributes:
        parts: in order.
        space: the namespace that code gives the node, in whose place comes the one that a launch gives it; `out` in
            `arm` is `/arm/out` of a node that is launched without a namespace, and `/left/out` below `left`.
            Source: design.ros2.org "Remapping names", `__ns` replaces the namespace of the node.
    """

    parts: Parts
    space: str = ""


def shown(parts: Iterable[str | OpenPart]) -> str:
    """Return the text of parts as long as nobody tells what is open."""
    return "".join([part if isinstance(part, str) else part.shown for part in parts])


def joined(parts: Iterable[str | OpenPart]) -> Parts:
    """Return parts with texts that stand side by side as one, and without empty ones."""
    return tuple(_joined(parts))


def _joined(parts: Iterable[str | OpenPart]) -> Iterator[str | OpenPart]:
    text = ""
    for part in parts:
        if isinstance(part, str):
            text += part
            continue
        if text:
            yield text
        text = ""
        yield part
    if text:
        yield text
