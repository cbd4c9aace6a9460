"""All uses of a workspace that the changes break."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

import msgspec

from ecm_extract.entities.side import Workspace
from ecm_extract.uses.cpp_names import cpp_name_uses
from ecm_extract.uses.endpoints import endpoint_uses
from ecm_extract.uses.fields import field_uses
from ecm_extract.uses.frames import frame_uses
from ecm_extract.uses.includes import include_uses
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.kept import kept_for
from ecm_extract.uses.keywords import keyword_uses
from ecm_extract.uses.launch import launch_uses
from ecm_extract.uses.layouts import layout_uses
from ecm_extract.uses.model import Use
from ecm_extract.uses.nodes import node_uses
from ecm_extract.uses.overrides import override_uses
from ecm_extract.uses.parameters import parameter_uses
from ecm_extract.uses.remaps import connections_of, is_kept_alive, remap_uses
from ecm_extract.uses.results import result_uses
from ecm_extract.uses.symbols import symbol_uses
from ecm_extract.uses.trees import tree_uses
from ecm_extract.uses.unpacked import unpacked_uses

_BUILT = (".cpp", ".cc", ".cxx", ".c", ".h", ".hh", ".hpp", ".hxx", ".ipp", ".tpp", ".cu", ".cuh")
_MATCHERS = (
    parameter_uses,
    node_uses,
    launch_uses,
    include_uses,
    frame_uses,
    tree_uses,
    symbol_uses,
    cpp_name_uses,
    override_uses,
    field_uses,
    result_uses,
    unpacked_uses,
    keyword_uses,
    layout_uses,
)


def uses_of(workspace: Workspace, index: ChangeIndex, own: bool = False) -> Iterator[Use]:
    """Yield the uses of a workspace, each with the commit it was read at.

    Args:
        workspace: the consumer.
        index: the changes.
        own: whether it is the new side itself, which builds: only names that are gone count there.
    """
    if index.is_empty():
        return
    connections = connections_of(workspace)
    paths = frozenset(entry.path for entry in workspace.tree.files())
    in_graph = (endpoint_uses(workspace, index, connections), remap_uses(connections, index))
    for use in chain(*in_graph, *(matcher(workspace, index) for matcher in _MATCHERS)):
        if own and not _is_forgotten(use):
            continue
        alive = is_kept_alive(use, connections)
        kept = kept_for(use.path, paths)
        yield msgspec.structs.replace(use, commit=workspace.tree.commit, remapped=alive, kept_for=kept)


def _is_forgotten(use: Use) -> bool:
    """Whether a line of the new side can be one that the release forgot.

    Its C++ was built with the change; a publisher that lost its listener in the same release is no accident.
    """
    entity = use.located.pair.old
    if use.located.change.kind == "launch_argument":
        return True
    if entity is None or use.located.change.change == "deprecated":
        return False
    if use.path.endswith(_BUILT):
        return entity.kind in {"topic", "service", "action"} and entity.facet != "subscribed"
    return use.located.change.change in GONE or entity.kind not in {"message_field", "constant"}
