"""Whether somebody still tells where a frame is: another program, a description, a name that is computed now."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from ecm_checker.hub.provision import LAUNCHED, SENT, Key, Provision

_STATIC: Final = "static_transform_publisher"
"""Of tf and tf2_ros: it sends the frames that its arguments name (wiki.ros.org/tf2_ros)."""


class SentFrames:
    """Knows the frames of the new side, and who may send others that no source names."""

    def __init__(self, old: Mapping[Key, Provision], new: Mapping[Key, Provision]) -> None:
        came = [entity for key, entity in new.items() if key not in old]
        sent = [entity for entity in new.values() if entity.facet == SENT]
        self._named = {(entity.kind, entity.name) for entity in new.values()}
        self._open = {entity.package for entity in sent if entity.is_computed}
        self._came_open = any(_may_send_any(entity) for entity in came)

    def may_be_there(self, frame: Provision) -> bool:
        """Whether a frame that its program no longer sends is there all the same, as far as anybody can tell."""
        known = (frame.kind, frame.name) in self._named
        return known or frame.is_computed or frame.package in self._open or self._came_open


def _may_send_any(entity: Provision) -> bool:
    return (entity.facet == SENT and entity.is_computed) or (entity.facet == LAUNCHED and _STATIC in entity.bases)
