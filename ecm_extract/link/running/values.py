"""Folded values: text with holes where no artefact shows what stands there."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from ecm_checker.contract import Confidence
from ecm_parsers.source.facts import Constant

from ecm_extract.infer.compute import NULL, UNKNOWN

MAX_ALTERNATIVES = 12
MAX_LENGTH = 16_384
"""Characters of a value that is put together."""
NAMESPACE = "node namespace"
PARENT_NAMESPACE = "parent namespace"
"""Labels with a space: no variable of a source is called so."""
_NO_BRACES = str.maketrans("{", "_", "}")
_RANK: dict[Confidence, int] = {"literal": 0, "folded": 1, "default": 2, "one_of": 3, "pattern": 4}


class Hole(NamedTuple):
    """An unknown part of a value; `default` is what it is when nobody says otherwise.

    `param`: a parameter of the function at hand, which its callers know; `made`: a parameter of the constructor,
    which whoever makes the object knows; `node`: the name of the node at hand; `space`: its namespace, or the one above
    that; `circle`: what is asked for itself; `setting`: the value of a parameter that somebody
    sets; `outside`: a constant of a library, by its own name; `unknown`: nobody does. `part` is what is taken of it: an
    element or a field; empty where it is the whole.
    """

    label: str
    kind: Literal["param", "made", "node", "space", "circle", "setting", "outside", "unknown"] = "unknown"
    default: str | None = None
    part: str = ""

    @property
    def shown(self) -> str:
        """What people call it: what a partial keeps has a name of its own, `make*0`, which stands in no source.

        A parameter is called by the last part of its name, which may have holes itself.
        """
        label = (self.part or self.label).strip("*").partition("*")[0]
        return label.rpartition("/")[2].translate(_NO_BRACES).strip("_" * ("{" in label)) or "value"

    def of(self, part: str) -> Hole:
        """Return an element or a field of the same."""
        return self._replace(default=None, part=part)


class OfParameter(NamedTuple):
    """A part of a value that a ROS parameter gives: its name, and what it is as long as no launch sets it."""

    parameter: str
    default: tuple[str | Hole, ...]


TOO_LONG = Hole("too long a text")
"""Stands for a text that is put together beyond `MAX_LENGTH`."""


@dataclass(frozen=True, slots=True)
class Enumerator:
    """A value of an enumeration that has no number of its own, by its declaration."""

    constant: Constant


class Value(NamedTuple):
    """One possible value: its parts in order and how surely it is known.

    `template` has the same parts with those apart that a ROS parameter gives, and is empty where none does.
    `data` is what is no text: a number, a truth value, null; None for texts and for what is not known.
    `beside` is how surely all but the name or namespace of the node is known, None where neither stands in it.
    """

    parts: tuple[str | Hole, ...]
    confidence: Confidence = "literal"
    template: tuple[str | Hole | OfParameter, ...] = ()
    data: Any = None
    beside: Confidence | None = None

    @property
    def text(self) -> str:
        """The value with holes as `{label}`."""
        if len(self.parts) == 1 and isinstance(self.parts[0], str):
            return self.parts[0]
        return "".join([part if isinstance(part, str) else f"{{{part.shown}}}" for part in self.parts])

    @property
    def parameter(self) -> str:
        """The ROS parameter whose value this is and nothing else, empty for none."""
        whole = self.template[0] if len(self.template) == 1 else ""
        return whole.parameter if isinstance(whole, OfParameter) else ""

    def open(self, kind: str) -> frozenset[str]:
        """Return the labels of the holes of a kind."""
        return frozenset(part.label for part in self.parts if isinstance(part, Hole) and part.kind == kind)


TOO_MANY = Value((Hole("one of many"),), "pattern")
"""Stands for values beyond `MAX_ALTERNATIVES`."""
TOO_DEEP = Value((Hole("too deep a value"),), "pattern")
"""Stands for what lies behind more functions, branches or objects than are followed."""


def literal(text: str) -> Value:
    """A value read as it stands."""
    return Value((text,))


def constant(data: Any) -> Value:
    """A number, truth value or null read as it stands; its text is what it is written as."""
    text = "" if data is NULL else str(data).lower() if isinstance(data, bool) else str(data)
    return Value((text,), "literal", (), data)


def computed(data: Any) -> Value | None:
    """What a computation gives, None for what is not known."""
    if data is UNKNOWN or data is None:
        return None
    return Value((data,), "folded") if isinstance(data, str) else constant(data)._replace(confidence="folded")


def data_in(value: Value) -> Any:
    """Return the data that a value is: a number, truth value or null, else its text; UNKNOWN with holes."""
    if value.data is not None:
        return value.data
    return value.text if all(isinstance(part, str) for part in value.parts) else UNKNOWN


def is_proved(value: Value) -> bool:
    """Tell whether a value is surely this one, or one of several of which each is known."""
    return value.confidence in {"literal", "folded", "one_of"} and not value.template


def is_known(value: Value) -> bool:
    """Tell whether a value is this one, or is as long as nobody sets a parameter."""
    return value.confidence != "pattern"


def alternatives(values: Iterable[Value]) -> tuple[Value, ...]:
    """Values of which one is true: several are each `one of`, a pattern stays beside them.

    What somebody may set through a parameter makes what stands beside it a default.
    """
    listed = unique(values)
    fixed = tuple([value for value in listed if not is_setting(value)])
    if len(fixed) < len(listed) and any(value.text and is_known(value) for value in fixed):
        listed = lowered(fixed, "default")
    return listed if len(listed) <= 1 else lowered(map(_set, listed), "one_of")


def _set(value: Value) -> Value:
    """The same value where it stands beside others: sources ask first whether a parameter is empty."""
    if not any(isinstance(part, Hole) and part.kind == "setting" and part.default is not None for part in value.parts):
        return value
    parts = [
        part._replace(default=None) if isinstance(part, Hole) and part.kind == "setting" else part
        for part in value.parts
    ]
    return value._replace(parts=tuple(parts))


def unknown(label: str) -> Value:
    """A value that nothing shows; the label tells what it is called in source."""
    return Value((Hole(_label(label)),), "pattern")


def outside(label: str) -> Value:
    """A constant of a library, of which only the name is known."""
    return Value((Hole(_label(label), "outside"),), "pattern")


def setting(label: str, default: str | None = None) -> Value:
    """The value of a parameter, or of a port of a behaviour tree, of which no default is known but an empty one."""
    return Value((Hole(_label(label), "setting", default),), "pattern")


def setting_of(name: str, default: str | None = None) -> Value:
    """The same of a parameter by its full name."""
    return setting(name.rsplit("/", 1)[-1].rsplit(".", 1)[-1].strip("~{}"), default)


def is_setting(value: Value) -> bool:
    """Tell whether a value is no more than what somebody sets."""
    return len(value.parts) == 1 and isinstance(value.parts[0], Hole) and value.parts[0].kind == "setting"


def given_holes(value: Value) -> tuple[Hole, ...]:
    """Return the parts of a value that callers, or the makers of the object, know."""
    return tuple([part for part in value.parts if isinstance(part, Hole) and part.kind in {"param", "made"}])


def circular(label: str) -> Value:
    """What a value is that is made from itself."""
    return Value((Hole(_label(label), "circle"),), "pattern")


def is_circle(value: Value) -> bool:
    """Tell whether a value is no more than what is asked for itself."""
    return len(value.parts) == 1 and isinstance(value.parts[0], Hole) and value.parts[0].kind == "circle"


def parameter(label: str, made: bool = False, default: str | None = None) -> Value:
    """A value that the callers of the function at hand know, or the makers of the object."""
    return Value((Hole(label, "made" if made else "param", default),), "pattern")


def settled(value: Value) -> Value:
    """Fill holes that have a default: nobody in the tree says otherwise. What a parameter has to give stays open."""
    if is_setting(value) or not any(isinstance(part, Hole) and part.default is not None for part in value.parts):
        return value
    parts = _with_defaults(value.parts)
    rest = any(isinstance(part, Hole) for part in parts)
    beside: Confidence | None = "default" if value.beside is not None else None
    return Value(parts, "pattern" if rest else "default", _template_with_defaults(value), beside=beside)


def _with_defaults(parts: Iterable[str | Hole]) -> tuple[str | Hole, ...]:
    return tuple([part.default if isinstance(part, Hole) and part.default is not None else part for part in parts])


def _template_with_defaults(value: Value) -> tuple[str | Hole | OfParameter, ...]:
    return tuple(
        [
            part._replace(default=_with_defaults(part.default))
            if isinstance(part, OfParameter)
            else _with_defaults((part,))[0]
            for part in value.template
        ]
    )


def without_defaults(value: Value, kinds: Collection[str] = ("made",)) -> Value:
    """The same value where it is not known what the makers of its object say, or who else knows holes of some kinds."""
    parts = [
        part._replace(default=None) if isinstance(part, Hole) and part.kind in kinds else part for part in value.parts
    ]
    return value if tuple(parts) == value.parts else value._replace(parts=tuple(parts))


def weaker(first: Confidence, second: Confidence) -> Confidence:
    """The less certain of two."""
    return first if _RANK[first] >= _RANK[second] else second


def surer(first: Confidence, second: Confidence) -> Confidence:
    """The more certain of two."""
    return first if _RANK[first] <= _RANK[second] else second


def lowered(values: Iterable[Value], to: Confidence) -> tuple[Value, ...]:
    """The same values, at most as certain as `to`."""
    return tuple(
        [
            value._replace(
                confidence=weaker(value.confidence, to),
                beside=weaker(value.beside, to) if value.beside is not None else None,
            )
            for value in values
        ]
    )


def demoted(values: Iterable[Value]) -> tuple[Value, ...]:
    """The same values read through a name: folded, not literal."""
    return lowered(values, "folded")


def joined(groups: Iterable[tuple[Value, ...]]) -> tuple[Value, ...]:
    """Concatenate: every combination of one alternative of each group, bounded in number and length."""
    results: list[Value] = [Value((), "folded")]
    for group in groups:
        if len(results) * len(group) > MAX_ALTERNATIVES:
            results = [TOO_MANY] if len(results) > len(group) else results
            group = (TOO_MANY,) if len(results) * len(group) > MAX_ALTERNATIVES else group
        results = [_beside(left, right) for left in results for right in group]
    return tuple(results)


def _beside(left: Value, right: Value) -> Value:
    """One value after another; what is longer than any name is told as such and goes no further."""
    if TOO_LONG in left.parts or TOO_LONG in right.parts or _length(left) + _length(right) > MAX_LENGTH:
        return Value((TOO_LONG,), "pattern")
    beside = None
    if left.beside is not None or right.beside is not None:
        beside = weaker(left.beside or left.confidence, right.beside or right.confidence)
    confidence = weaker(left.confidence, right.confidence)
    return Value(left.parts + right.parts, confidence, _template(left, right), beside=beside)


def _length(value: Value) -> int:
    """Parts and characters of a value and of its template."""
    return max(_size(value.parts), _size(value.template))


def _size(parts: Iterable[str | Hole | OfParameter]) -> int:
    return sum([1 + (len(part) if isinstance(part, str) else _size_of_open(part)) for part in parts])


def _size_of_open(part: Hole | OfParameter) -> int:
    return len(part.label) if isinstance(part, Hole) else len(part.parameter) + _size(part.default)


def _template(left: Value, right: Value) -> tuple[str | Hole | OfParameter, ...]:
    if not left.template and not right.template:
        return ()
    return tuple([part for side in (left, right) for part in side.template or side.parts if part])


def set_by(name: str, values: Iterable[Value]) -> tuple[Value, ...]:
    """The same values as those of a ROS parameter that a launch may set."""
    return tuple([value._replace(template=(OfParameter(name, _unset(value)),)) for value in values])


def _unset(value: Value) -> tuple[str | Hole, ...]:
    """What a value is made of as long as nobody sets it."""
    return _with_defaults(value.parts) if is_setting(value) else value.parts


def unique(values: Iterable[Value]) -> tuple[Value, ...]:
    """Drop repetitions by text, keeping order; more than a bound of them are one that nobody knows."""
    seen: dict[str, Value] = {}
    for value in values:
        known = seen.setdefault(value.text, value)
        if known is not value:
            seen[value.text] = _either(known, value)
    listed = tuple(seen.values())
    if len(listed) <= MAX_ALTERNATIVES:
        return listed
    return (*listed[: MAX_ALTERNATIVES - 1], TOO_MANY)


def _either(one: Value, other: Value) -> Value:
    """One text that is known in two ways: as surely as the weaker of them."""
    data = one.data if one.data == other.data else None
    beside = weaker(one.beside, other.beside) if one.beside is not None and other.beside is not None else None
    confidence = weaker(one.confidence, other.confidence)
    return Value(one.parts, confidence, one.template or other.template, data, beside)


def _label(text: str) -> str:
    return text.strip("_").rsplit("::", 1)[-1].removeprefix("m_").partition("@")[0] or "value"
