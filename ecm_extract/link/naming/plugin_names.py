"""Which part of the names of a plugin is the name that it is loaded under: the one that its parameters are below.

One method of a base gives each of its plugins that name, so what it is for one of them it is for all: a plugin without
parameters of its own has it too. Source: docs.nav2.org "Plugin Tutorials"; wiki.ros.org/nav_core, `initialize`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from typing import Final, TypeAlias

from ecm_checker.hub.local_name import LocalName, OpenPart, Parts
from ecm_checker.hub.roles import roles

from ecm_extract.link.code.units import Cls
from ecm_extract.link.owning.modules import Module, Registry
from ecm_extract.read.facts import PackageFacts

Names: TypeAlias = dict[tuple[str, str, str | None], list[LocalName]]
"""By role, name and type of an endpoint its names for any namespace and node."""
_BEFORE: Final = frozenset({"~", "~/", "/"})
_BELOW: Final = (".", "/")


def with_own_names(
    names: Mapping[Module, Names], packages: Iterable[PackageFacts], registry: Registry
) -> dict[Module, Names]:
    """Return the names of all modules, those of plugins with the name that they are loaded under as such."""
    bases = _bases(packages, registry)
    plugins = {module: bases.get(module.cls, (module.cls,)) for module in names if _is_plugin(module.cls, registry)}
    own: dict[str | Cls | None, frozenset[OpenPart]] = defaultdict(frozenset)
    for module, loaded_as in plugins.items():
        found = own_parts(_parameters(names[module]))
        own.update({base: own[base] | found for base in loaded_as})
    return {
        module: _marked(each, frozenset().union(*(own[base] for base in plugins.get(module, ()))))
        for module, each in names.items()
    }


def _is_plugin(cls: Cls | None, registry: Registry) -> bool:
    return cls is not None and registry.classes.get(cls) == "plugin"


def _bases(packages: Iterable[PackageFacts], registry: Registry) -> Mapping[Cls | None, Sequence[str]]:
    """The bases as which plugin descriptions declare a class."""
    found: dict[Cls | None, list[str]] = defaultdict(list)
    for entry in (each for package in packages for classes in package.plugins.values() for each in classes):
        cls = registry.lookups.get(entry.lookup_name)
        if cls is not None:
            found[cls].append(entry.base_class_type)
    return found


def _parameters(names: Names) -> Iterator[LocalName]:
    return (name for (role, _, _), found in names.items() if roles()[role].value for name in found)


def own_parts(parameters: Iterable[LocalName]) -> frozenset[OpenPart]:
    """Return what the names of parameters are below: what a caller gives, or else what nobody tells."""
    heads = frozenset(_heads(parameters))
    given = frozenset(head for head in heads if head.of == "caller")
    return given or frozenset(head for head in heads if head.of == "nobody")


def _heads(names: Iterable[LocalName]) -> Iterator[OpenPart]:
    """The open parts that names begin with, where more is below them."""
    for name in names:
        parts = name.parts[1:] if name.parts[:1] and name.parts[0] in _BEFORE else name.parts
        head, below = (*parts, "", "")[:2]
        if not isinstance(head, str) and isinstance(below, str) and below.startswith(_BELOW):
            yield head


def _marked(names: Names, own: frozenset[OpenPart]) -> Names:
    return {key: [with_own(name, own) for name in found] for key, found in names.items()} if own else names


def with_own(name: LocalName, own: Container[OpenPart]) -> LocalName:
    """Return a name with the parts that are the plugin's own name as such."""
    parts: Parts = tuple(
        OpenPart("plugin", part.label) if isinstance(part, OpenPart) and part in own else part for part in name.parts
    )
    return LocalName(parts, name.space)
