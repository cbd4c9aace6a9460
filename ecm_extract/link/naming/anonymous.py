"""Nodes of ROS 1 that get a number behind their name when they start, so that nobody knows what they are called."""

from __future__ import annotations

from types import MappingProxyType
from typing import Final

from ecm_parsers.source.expr import Expr, Name, Op

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import data_in

_ASKED: Final = MappingProxyType({"ros::init": "arg:3", "rospy.init_node": "kw:anonymous|arg:2"})
"""Where calls ask for one: ros/init.h, rospy/client.py."""
_FLAGS: Final = MappingProxyType({"NoSigintHandler": 1, "AnonymousName": 2, "NoRosout": 4})
"""ros::init_options, of which any are joined by `|`: ros/init.h."""


def is_anonymous(named: str, call: Invocation, env: Env, folder: Folder) -> bool:
    """Tell whether a call that begins a node may ask for a name of its own; what nobody knows may."""
    flag = next(positions(_ASKED[named], call), None) if named in _ASKED else None
    if flag is None:
        return False
    asked = _flags(flag, env, folder)
    return asked is None or bool(asked & (1 if env.func.file.language == "python" else _FLAGS["AnonymousName"]))


def _flags(expr: Expr, env: Env, folder: Folder) -> int | None:
    if isinstance(expr, Op) and expr.op == "|":
        parts = [_flags(each, env, folder) for each in expr.operands]
        return parts[0] | parts[1] if parts[0] is not None and parts[1] is not None else None
    if isinstance(expr, Name) and last_name(expr.id) in _FLAGS:
        return _FLAGS[last_name(expr.id)]
    values = folder.fold(expr, env)
    data = data_in(values[0]) if len(values) == 1 else None
    return int(data) if isinstance(data, int) else None
