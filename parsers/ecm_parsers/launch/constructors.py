"""What the classes and functions that launch files call make, by the last part of their name."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ecm_parsers.launch.actions import ACTIONS
from ecm_parsers.launch.arguments import Constructor
from ecm_parsers.launch.substitutions import SUBSTITUTIONS

CONSTRUCTORS: Mapping[str, Constructor] = MappingProxyType({**SUBSTITUTIONS, **ACTIONS})
