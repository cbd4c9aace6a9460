"""Plugins in documents of older versions, which do not say which part of a name they are loaded under."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import msgspec
from ecm_checker.hub.local_name import LocalName, OpenPart
from ecm_checker.hub.running import Running, RunningEndpoint, RunningModule, as_local

from ecm_extract.link.naming.plugin_names import own_parts, with_own


def renewed(packages: Mapping[str, Running]) -> Mapping[str, Running]:
    """Return what runs, with the names of such plugins as a newer version writes them."""
    loaded = {entry.cls: entry.base for running in packages.values() for entry in running.plugins}
    own = _own(packages.values(), loaded)
    return {name: _renewed(running, loaded, own) for name, running in packages.items()} if own else packages


def _own(found: Iterable[Running], loaded: Mapping[str, str]) -> Mapping[str, frozenset[OpenPart]]:
    """By base what the parameters of its plugins are below."""
    own: dict[str, frozenset[OpenPart]] = defaultdict(frozenset)
    for module in (each for running in found for each in running.modules if _is_older(each)):
        parts = own_parts(_parameters(module))
        if parts:
            own[_base(module, loaded)] |= parts
    return own


def _base(module: RunningModule, loaded: Mapping[str, str]) -> str:
    """What a plugin is loaded as; one that is not declared by its name has a base of its own."""
    return loaded.get(module.cls, module.cls)


def _is_older(module: RunningModule) -> bool:
    """Tell whether no name of a class has its open parts apart; then an older version wrote it, or none is open."""
    return bool(module.cls) and all(isinstance(name, str) for entry in module.endpoints for name in entry.local)


def _parameters(module: RunningModule) -> Iterator[LocalName]:
    return (name for entry in module.endpoints if entry.row.value for name in _names(entry))


def _names(entry: RunningEndpoint) -> Iterator[LocalName]:
    return (as_local(name) for name in entry.local or (entry.name,))


def _renewed(running: Running, loaded: Mapping[str, str], own: Mapping[str, frozenset[OpenPart]]) -> Running:
    modules = tuple(_with_own(module, own.get(_base(module, loaded), frozenset())) for module in running.modules)
    return msgspec.structs.replace(running, modules=modules)


def _with_own(module: RunningModule, own: frozenset[OpenPart]) -> RunningModule:
    if not own or not _is_older(module):
        return module
    return msgspec.structs.replace(module, endpoints=tuple(_placed(entry, own) for entry in module.endpoints))


def _placed(entry: RunningEndpoint, own: frozenset[OpenPart]) -> RunningEndpoint:
    return msgspec.structs.replace(entry, local=tuple(with_own(name, own) for name in _names(entry)))
