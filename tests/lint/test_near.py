"""Names that somebody may have meant, and which of them are sure enough to be written."""

from __future__ import annotations

import pytest
from ecm_checker.finding import Rename

from ecm_extract.lint.near import slip


@pytest.mark.parametrize(
    ("name", "near", "sure"),
    [
        ("arm_drvier", "arm_driver", True),
        ("arm_drivers", "arm_driver", True),
        ("ArmDriver", "armdriver", True),
        ("joint_jump_detector_node", "force_jump_detector_node", False),
        ("camera_1", "camera_2", False),
        ("left_arm", "right_arm", False),
        ("arm", "arm", False),
        ("arm", "", False),
    ],
)
def test_only_a_slip_is_mended(name: str, near: str, sure: bool) -> None:
    """A like name may be another program: `--fix` writes what differs by two letters at most, and not by a number."""
    assert slip(name, near) == (Rename(name, near) if sure else None)
