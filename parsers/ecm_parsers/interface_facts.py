"""What `.msg`, `.srv` and `.action` files declare; one vocabulary for ROS 1 and ROS 2."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal

import msgspec

Shape = Literal["msg", "srv", "action"]
ArrayKind = Literal["none", "fixed", "bounded", "unbounded"]

SECTIONS: Mapping[Shape, tuple[str, ...]] = MappingProxyType(
    {
        "msg": ("message",),
        "srv": ("request", "response"),
        "action": ("goal", "result", "feedback"),
    }
)
_NUMBERS = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64")
PRIMITIVES = frozenset({"bool", "byte", "char", "string", "wstring", *_NUMBERS})
ROS1_TIMES = frozenset({"time", "duration"})


class Field(msgspec.Struct, frozen=True):
    """A field of a section.

    Attributes:
        name: as written.
        type: as written, e.g. `geometry_msgs/Pose[<=3]`.
        base: own name of the element type, e.g. `Pose`, `float64`.
        package: package of the element type; None for a primitive and for a type of the own package.
            `Header` alone is `std_msgs`, as ROS 1 has it.
        line: 1-based.
        array: kind of array.
        bound: element count of a fixed array, upper bound of a bounded one.
        string_bound: of `string<=10`.
        default: text of the default value as written (ROS 2).
        comment: trailing comment, its indented continuation lines included.
        doc: comment block directly above.
        unit: short unit that the comments name, e.g. `m/s`; None when they name none or several.
    """

    name: str
    type: str
    base: str
    package: str | None
    line: int
    array: ArrayKind = "none"
    bound: int | None = None
    string_bound: int | None = None
    default: str | None = None
    comment: str = ""
    doc: str = ""
    unit: str | None = None


class Constant(msgspec.Struct, frozen=True):
    """A constant of a section.

    Attributes:
        name: as written.
        type: as written.
        value: without the quotes of a ROS 2 string.
        text: everything that ROS 1 takes as the value; for strings this holds quotes and `#` too.
        line: 1-based.
        comment: trailing comment; a ROS 1 string constant has none.
        doc: comment block directly above.
        unit: as for a field.
    """

    name: str
    type: str
    value: str
    text: str
    line: int
    comment: str = ""
    doc: str = ""
    unit: str | None = None


class Section(msgspec.Struct, frozen=True):
    """`message`, `request`, `response`, `goal`, `result` or `feedback`."""

    name: str
    fields: tuple[Field, ...] = ()
    constants: tuple[Constant, ...] = ()


class Definition(msgspec.Struct, frozen=True):
    """One interface file: its sections, always as many as the shape has."""

    shape: Shape
    sections: tuple[Section, ...]

    def section(self, name: str) -> Section:
        """Return the section of that name.

        Raises:
            KeyError: the shape has no such section.
        """
        for section in self.sections:
            if section.name == name:
                return section
        raise KeyError(name)
