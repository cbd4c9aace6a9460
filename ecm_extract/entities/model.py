"""The provisions of the contract model, under the name that this folder has for them."""

from __future__ import annotations

from typing import Final

from ecm_checker.hub.provision import Form, Key, Line
from ecm_checker.hub.provision import Provision as PublicEntity

__all__ = ["LAUNCHED", "Form", "Key", "Line", "PublicEntity"]

LAUNCHED: Final = "launched"
"""Facet of a name that a launch file gives."""
