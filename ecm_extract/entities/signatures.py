"""C++ and Python parameter lists in one comparable writing."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import Final

from ecm_checker.hub.provision import Form
from ecm_parsers.source.facts import Function, Parameter

_VIRTUAL: Final = frozenset({"virtual", "override", "pure"})
_FINAL: Final = "final"
_NOTHING: Final[Mapping[str, str]] = MappingProxyType({})
_NAME = re.compile(r"\b[A-Za-z_]\w*\b")
_QUALIFIER = re.compile(r"(?<![\w:])(?:\w+::)+")
_SPACE = re.compile(r"\s*([<>,&*()\[\]])\s*")
_IGNORED = re.compile(r"\b(?:typename|struct|class|inline|static|virtual|explicit|constexpr|friend)\s+")
_ATTRIBUTE = re.compile(r"\[\[.*?\]\]|\b[A-Z][A-Z0-9_]*_(?:PUBLIC|EXPORT|API|LOCAL|DEPRECATED)\b")
_SHARED = re.compile(r"(?<=\w)(Const)?SharedPtr\b")
_TRAILING_CONST = re.compile(r"^([\w<>,]*[\w>])(?:(?<=>)| )const(?=[&*]|$)")
_POINTERS = (
    (re.compile(r"(?:shared_ptr|std_shared_ptr)<const (\w+)>"), r"\1ConstSharedPtr"),
    (re.compile(r"shared_ptr<(\w+)>"), r"\1SharedPtr"),
    (re.compile(r"unique_ptr<(\w+)>"), r"\1UniquePtr"),
)
_NESTED = re.compile(r"\b(\w+)::(Const)?(SharedPtr|ConstPtr|UniquePtr|WeakPtr|Ptr)\b")


@lru_cache(maxsize=20_000)
def normal_type(written: str) -> str:
    """Return a type without namespaces, attributes, by-value `const` and white space that means nothing.

    `const std::vector<int> &` and `std::vector<int> const&` give the same text; so do `T::SharedPtr` and
    `std::shared_ptr<T>`, which are one type.
    """
    text = _IGNORED.sub("", _ATTRIBUTE.sub("", written))
    text = _NESTED.sub(r"\1\2\3", text)
    text = _QUALIFIER.sub("", text)
    text = _SPACE.sub(r"\1", " ".join(text.split()))
    text = _TRAILING_CONST.sub(r"const \1", text)
    for pattern, short in _POINTERS:
        text = pattern.sub(short, text)
    text = _SHARED.sub(r"\1Ptr", text)
    if text.startswith("const ") and not text.endswith(("&", "*")):
        text = text.removeprefix("const ")
    return text.strip()


def template_names(of_class: Sequence[str], own: Sequence[str] = ()) -> Mapping[str, str]:
    """Return what stands for template parameters, whose names bind nobody.

    Those of a class are fixed for its users (`$1`), those of a function take whatever comes (`$A`); no name begins so.
    """
    given = {name: f"${number}" for number, name in enumerate(of_class, 1)}
    deduced = {name: f"${letter}" for name, letter in zip(own, "ABCDEFGHIJ", strict=False)}
    return {**given, **deduced}


def written_type(written: str, templates: Mapping[str, str]) -> str:
    """Return a type as `normal_type` does, with template parameters by their place."""
    if templates:
        written = _NAME.sub(lambda match: templates.get(match[0], match[0]), written)
    return normal_type(written)


def _takes_any(entry: Parameter) -> bool:
    """Whether a parameter stands for any number: `*args`, `T... rest`, `...`."""
    return entry.name.startswith("*") or entry.type.endswith("...")


def _undeduced(function: Function) -> Mapping[str, str]:
    """Defaults of the template parameters that no argument of a call tells."""
    told = {name for entry in function.params for name in _NAME.findall(entry.type)}
    return {name: default for name, default in function.defaults if name not in told}


def form_of(function: Function, virtual: bool = False, templates: Mapping[str, str] = _NOTHING) -> Form:
    """Return the comparable form of a function; a call that gives no template arguments has its defaults."""
    templates = {**templates, **_undeduced(function)}
    params = [entry for entry in function.params if entry.name != "/" and entry.type != "void"]
    required = sum(entry.default is None and not _takes_any(entry) for entry in params)
    return Form(
        types=tuple(written_type(entry.type, templates) for entry in params),
        required=required,
        returns=written_type(function.returns, templates),
        names=tuple(entry.name for entry in params),
        virtual=_FINAL not in function.traits and (virtual or not _VIRTUAL.isdisjoint(function.traits)),
        pure="pure" in function.traits,
        override="override" in function.traits or (_FINAL in function.traits and "virtual" not in function.traits),
        deprecated="deprecated" in function.traits or any("eprecat" in text for text in function.decorators),
        line=function.line,
    )
