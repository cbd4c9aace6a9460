"""Frames: a target in the frame of the base, taken for one in the frame of the camera, by the real tf2."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

from ecm_checker.contract import Contract

from path_a.predictions import check, contract, manifest, rules
from path_a.ros1 import PACKAGES, PROGRAMS, master, require
from path_a.row import Case, Observed

# The paper's camera: 0.5 m and 0.2 m from the base, turned by 90 degrees; the target lies 1 m before the base.
_CAMERA = ("0.5", "0.2", str(pi / 2))
_TARGET_X = "1.0"
_THERE = (-0.2, -0.5, 0.0)
_OFF_M = 1.3
_EXACT = 1e-3


def measure(repetitions: int) -> Sequence[Case]:
    require(("rospy", "tf2_py", "tf2_geometry_msgs"), (*PACKAGES, "python3-tf2-ros", "python3-tf2-geometry-msgs"))
    detector, grasper = (manifest("frame_handover", name) for name in ("detector", "grasper"))
    found = tuple(each for each in check("chain", detector, grasper) if each.rule == "SIG006")
    given, taken = (_frame(contract("frame_handover", name)) for name in ("detector", "grasper"))
    observed = tuple(_repetition(given, taken) for _ in range(repetitions))
    expected = f"a target in {given} is taken in {taken}, at the wrong place" if found else "no mismatch"
    return [Case("frame of a target", f"{expected} ({rules(found)})", observed)]


def _frame(module: Contract) -> str:
    value = module.signature.coordinate_frame
    assert value is not None
    return str(value.value)


def _repetition(given: str, taken: str) -> Observed:
    with master() as core:
        found = core.output(PROGRAMS / "frame_error.py", given, taken, *_CAMERA, _TARGET_X)
    there = tuple(float(found[axis]) for axis in ("x", "y", "z"))
    off = float(found["off"])
    exact = all(abs(one - two) < _EXACT for one, two in zip(there, _THERE, strict=True))
    text = f"it lies at ({there[0]:.3f}, {there[1]:.3f}, {there[2]:.3f}) in {taken}: {off:.2f} m from its raw numbers"
    return Observed(text, exact and abs(off - _OFF_M) < _EXACT)
