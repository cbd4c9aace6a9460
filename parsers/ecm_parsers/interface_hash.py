"""The fingerprints by which ROS 1 (MD5) and ROS 2 (RIHS01) tell whether two sides speak the same type.

Sources: genmsg `gentools`, REP 2016, rosidl_generator_type_description.
Full names are written `package/msg|srv|action/Name` for ROS 1 and ROS 2 alike.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from types import MappingProxyType

import msgspec

from ecm_parsers.interface_derived import ros1_messages, ros2_messages
from ecm_parsers.interface_facts import PRIMITIVES, ROS1_TIMES, Definition, Field, Section

Resolve = Callable[[str], Definition | None]
MAX_DEPTH = 60
MAX_TYPES = 5_000

# FieldType.msg of type_description_interfaces; rosidl turns `char` of a .msg into uint8.
_SCALARS = (
    ("int8", 2),
    ("uint8", 3),
    ("int16", 4),
    ("uint16", 5),
    ("int32", 6),
    ("uint32", 7),
    ("int64", 8),
    ("uint64", 9),
    ("float32", 10),
    ("float64", 11),
    ("char", 3),
    ("bool", 15),
    ("byte", 16),
    ("string", 17),
    ("wstring", 18),
)
_SCALAR_IDS: Mapping[str, int] = MappingProxyType(dict(_SCALARS))
_NESTED_ID = 1
_STRING_TO_BOUNDED = 4
_ARRAY_OFFSETS: Mapping[str, int] = MappingProxyType({"none": 0, "fixed": 48, "bounded": 96, "unbounded": 144})
_FILLER = Field("structure_needs_at_least_one_member", "uint8", "uint8", None, 0)


class Hashed(msgspec.Struct, frozen=True):
    """A fingerprint, or the full name of the first type that kept it from being computed."""

    value: str | None
    missing: str | None = None


class _MissingTypeError(Exception):
    """Names a type that cannot be resolved, holds itself or lies too deep."""


def md5(name: str, definition: Definition, resolve: Resolve) -> Hashed:
    """Compute the ROS 1 MD5 sum of a message or service, or of the `NameAction` message of an action.

    Args:
        name: full name of the definition.
        definition: what it declares.
        resolve: returns the definition of a full name, None when unknown.
    """
    own = ros1_messages(name, definition)
    texts = _Md5Texts(own, resolve)
    wholes = list(own) if definition.shape == "srv" else list(own)[:1]
    try:
        text = "".join(texts.of(whole) for whole in wholes)
    except _MissingTypeError as error:
        return Hashed(None, str(error))
    return Hashed(_hex(text))


def rihs01(name: str, definition: Definition, resolve: Resolve) -> Hashed:
    """Compute the ROS 2 type hash `RIHS01_...` of a message, service or action.

    Args:
        name: full name of the definition.
        definition: what it declares.
        resolve: returns the definition of a full name, None when unknown.
    """
    own = ros2_messages(name, definition)
    described: dict[str, dict[str, object]] = {}
    pending = [name]
    while pending:
        full = pending.pop()
        if full in described:
            continue
        section = own.get(full) or _message(full, resolve)
        if section is None or len(described) >= MAX_TYPES:
            return Hashed(None, full)
        fields = section.fields or (_FILLER,)
        package = full.partition("/")[0]
        described[full] = {"type_name": full, "fields": [_describe(field, package) for field in fields]}
        pending.extend(_full_name(field, package) for field in reversed(fields) if _is_nested(field))
    whole = {
        "type_description": described.pop(name),
        "referenced_type_descriptions": [described[full] for full in sorted(described)],
    }
    return Hashed(f"RIHS01_{hashlib.sha256(json.dumps(whole).encode()).hexdigest()}")


class _Md5Texts:
    """The texts that genmsg hashes, each computed once."""

    def __init__(self, own: Mapping[str, Section], resolve: Resolve) -> None:
        self._own = own
        self._resolve = resolve
        self._sums: dict[str, str] = {}
        self._open: list[str] = []

    def of(self, full: str) -> str:
        """Return constants and fields, a nested type replaced by its sum.

        Raises:
            _MissingTypeError: a type cannot be resolved.
        """
        section = self._own.get(full) or _message(full, self._resolve)
        if section is None or full in self._open or len(self._open) >= MAX_DEPTH:
            raise _MissingTypeError(full)
        self._open.append(full)
        package = full.partition("/")[0]
        lines = [f"{constant.type} {constant.name}={constant.text}" for constant in section.constants]
        lines += [f"{self._type(field, package)} {field.name}" for field in section.fields]
        self._open.pop()
        return "\n".join(lines).strip()

    def _type(self, field: Field, package: str) -> str:
        if field.package is None and field.base in PRIMITIVES | ROS1_TIMES:
            return field.type
        full = _full_name(field, field.package or package)
        if full not in self._sums:
            self._sums[full] = _hex(self.of(full))
        return self._sums[full]


def _message(full: str, resolve: Resolve) -> Section | None:
    definition = resolve(full)
    if definition is None or definition.shape != "msg":
        return None
    return definition.section("message")


def _full_name(field: Field, package: str) -> str:
    """Return `package/msg/Name`; a type written without a package is of the given one."""
    path = field.type.partition("[")[0].split("/")
    if len(path) == 1:
        return f"{package}/msg/{path[0]}"
    return "/".join(path) if len(path) == 3 else f"{path[0]}/msg/{path[1]}"


def _is_nested(field: Field) -> bool:
    return "/" in field.type or field.base not in PRIMITIVES


def _describe(field: Field, package: str) -> dict[str, object]:
    nested = _full_name(field, package) if _is_nested(field) else ""
    scalar = _NESTED_ID if nested else _SCALAR_IDS[field.base]
    if field.string_bound:
        scalar += _STRING_TO_BOUNDED
    kind = {
        "type_id": scalar + _ARRAY_OFFSETS[field.array],
        "capacity": field.bound or 0,
        "string_capacity": field.string_bound or 0,
        "nested_type_name": nested,
    }
    return {"name": field.name, "type": kind}


def _hex(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()
