"""Version: a field of a message is renamed, and only one side is built anew."""

from __future__ import annotations

import json
from collections.abc import Sequence

from path_a.predictions import diff, rules
from path_a.ros1 import PACKAGES, PROGRAMS, master, require
from path_a.row import FIXTURES, Case, Observed

MESSAGES = 60
_LEAST = 55  # the first messages may be sent before the connection stands


def measure(repetitions: int) -> Sequence[Case]:
    require(("rospy", "genpy.dynamic"), PACKAGES)
    old, new = (str(FIXTURES / name) for name in ("limits_1", "limits_2"))
    found = diff(old, new, "--consumer", str(FIXTURES / "limit_guard"))
    same = diff(old, old, "--consumer", str(FIXTURES / "limit_guard"))
    return [
        _case("field renamed, both sides the same version", "limits_1", rules(same), bool(same), repetitions),
        _case("field renamed, one side built anew", "limits_2", rules(found), bool(found), repetitions),
    ]


def _case(name: str, writer: str, told: str, broken: bool, repetitions: int) -> Case:
    expected = "none arrives" if broken else "messages arrive"
    return Case(name, f"{expected} ({told})", tuple(_repetition(writer, broken) for _ in range(repetitions)))


def _repetition(writer: str, broken: bool) -> Observed:
    with master() as core:
        program = PROGRAMS / "renamed_field.py"
        sender = core.start(program, "write", _definition(writer), "limits/Limit", str(MESSAGES), heard=True)
        got = int(core.output(program, "read", _definition("limits_1"), "limits/Limit", str(MESSAGES))["got"])
        text, _ = sender.communicate(timeout=60)
    said = str(json.loads(text.strip().splitlines()[-1])["said"])
    refused = "md5sum" in said
    as_predicted = (got == 0 and refused) if broken else (got >= _LEAST and not refused)
    words = f"rospy: {said.partition('{')[0]}" if said else "rospy says nothing"
    return Observed(f"{got} of {MESSAGES}; {words}", as_predicted)


def _definition(package: str) -> str:
    return str(FIXTURES / package / "msg" / "Limit.msg")
