"""Names that a build makes of an interface file: headers, modules and classes of its parts.

Source: rosidl_generator_cpp and _py, genmsg and actionlib_msgs of ROS 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

PARTS: Final = ("Request", "Response", "Goal", "Result", "Feedback")
_MADE: Final = ("", *PARTS, "Action", "ActionGoal", "ActionResult", "ActionFeedback", *(f"_{part}" for part in PARTS))
_SHAPES: Final = frozenset({"msg", "srv", "action"})


def snake(name: str) -> str:
    """`ControllerServer` -> `controller_server`."""
    out = []
    for index, char in enumerate(name):
        previous = name[index - 1] if index else ""
        following = name[index + 1] if index + 1 < len(name) else ""
        if (
            char.isupper()
            and previous
            and previous != "_"
            and (previous.islower() or previous.isdigit() or following.islower())
        ):
            out.append("_")
        out.append(char.lower())
    return "".join(out)


def headers(interface: str) -> Iterator[str]:
    """Yield the headers that are generated of `package/msg|srv|action/Name`."""
    package, shape, name = interface.split("/")
    yield f"{package}/{name}.h"
    yield f"{package}/{shape}/{snake(name)}.hpp"


def python_names(interface: str) -> Iterator[str]:
    """Yield the dotted names that Python imports an interface and its parts by."""
    package, shape, name = interface.split("/")
    for part in _MADE:
        yield f"{package}.{shape}.{name}{part}"
        if shape == "action":
            yield f"{package}.msg.{name}{part}"


def section_owners(interface: str, section: str) -> Iterator[str]:
    """Yield how C++ and Python write the type that has the fields of a section, with dots for either.

    Args:
        interface: `package/msg|srv|action/Name`.
        section: `request`, `goal`, ...; empty for a message.
    """
    package, shape, name = interface.split("/")
    part = section.capitalize()
    for head in (f"{package}.{shape}.{name}", f"{package}.{name}"):
        yield f"{head}.{part}" if part else head
        if part:
            yield f"{head}{part}"
    if part and shape == "action":
        yield f"{package}.msg.{name}{part}"


def interface_package(name: str) -> str | None:
    """Return the package that alone can generate a name, as it is imported or included; None for any other name.

    Modules and headers that a build makes for itself (`_Grip`, `detail/`, `grip__struct.hpp`) tell nothing.
    """
    is_header = name.endswith(".hpp")
    parts = name.removesuffix(".hpp").split("/") if is_header else name.split(".")
    if len(parts) != 3 or parts[1] not in _SHAPES:
        return None
    made = parts[2].isidentifier() and not parts[2].startswith("_") and "__" not in parts[2]
    return parts[0] if made else None
