"""Nodelets that a program loads into itself by literal name: `loader.load(ros::this_node::getName(), "pkg/grid")`.

Only those that get the program's own name are told here: others have private names of their own.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Final

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.sites import Sites

LOAD: Final = "load"
_LOADER: Final = "Loader"


def loaded_nodelets(sites: Sites, named: Mapping[str, Cls]) -> Mapping[Func, Sequence[Cls]]:
    """Return function -> the classes of the nodelets that it loads.

    Args:
        sites: knows all calls.
        named: the class of each plugin of the tree by its name.
    """
    found: dict[Func, list[Cls]] = defaultdict(list)
    for call in sites.calls.get(LOAD, ()):
        cls = _loaded(call, sites, named)
        if cls is not None:
            found[call.func].append(cls)
    return found


def _loaded(call: Invocation, sites: Sites, named: Mapping[str, Cls]) -> Cls | None:
    if call.receiver is None or len(call.args) < 2:
        return None
    env = sites.root_env(call.func, call.at)
    written = sites.folder.objects.type_of(call.receiver, env)
    if last_name(plain(pointee(written))) != _LOADER:
        return None
    node, plugin = (sites.folder.fold(arg, env) for arg in call.args[:2])
    own = len(node) == 1 and bool(node[0].open("node")) and len(node[0].parts) == 1
    return named.get(plugin[0].text) if own and len(plugin) == 1 and plugin[0].confidence != "pattern" else None
