"""Fields of messages in messages, and names behind an alias of a namespace: the lines that a release breaks."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from diff_repos import package, release, write

from ecm_extract.cli.run import run

MESSAGES = "project(arm_msgs)\nrosidl_generate_interfaces(arm_msgs msg/Hand.msg msg/Finger.msg)\n"
HAND = "Finger[] fingers\nFinger thumb\n"
MAKE = "project(user)\nadd_library(user src/user.cpp)\n"
HEADER = "#pragma once\n#include <arm_msgs/msg/hand.hpp>\nnamespace user {{\n{alias}\n}}\n"
USER = """#include <user/user.hpp>
namespace user {{
void fill(const Other & other) {{
  {hand} hand;
  {line}
}}
}}
"""
PLAIN = "arm_msgs::msg::Hand"
CHOSEN = "#ifdef NEW\nnamespace m = arm_msgs::msg;\n#else\nnamespace m = arm_msgs;\n#endif"
LINES: dict[str, tuple[str, str, str, bool]] = {
    "field of an element": ("", PLAIN, "hand.fingers[0].angle = 1;", True),
    "field of a field": ("", PLAIN, "use(hand.thumb.angle);", True),
    "another field of it": ("", PLAIN, "use(hand.thumb.force);", False),
    "a field of that name of something else": ("", PLAIN, "use(other.thumb.angle);", False),
    "alias of the namespace": ("namespace m = arm_msgs::msg;", "m::Hand", "use(hand.thumb.angle);", True),
    "alias that two ROS versions choose": (CHOSEN, "m::Hand", "use(hand.thumb.angle);", True),
    "alias of another namespace": ("namespace m = leg_msgs::msg;", "m::Hand", "use(hand.thumb.angle);", False),
    "alias of one of two": ("namespace m = arm_msgs; namespace m = leg_msgs;", "m::Hand", "hand.thumb.angle;", False),
}


def named(capsys: pytest.CaptureFixture[str], repo: Path, user: Path) -> set[str]:
    """Return path and line of what breaks in the consumer."""
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--consumer", str(user), "--format", "json"])
    found = json.loads(capsys.readouterr().out)["findings"]
    return {f"{at['path']}:{at['line']}" for each in found if each["rule"] == "VER001" for at in each["evidence"]}


@pytest.mark.parametrize(("alias", "hand", "line", "breaks"), LINES.values(), ids=LINES)
def test_a_field_is_reached_through_messages(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], alias: str, hand: str, line: str, breaks: bool
) -> None:
    """A field that went away is told where it is used, however the message that holds it is written."""
    for tag, field in (("1.0.0", "angle"), ("2.0.0", "bend")):
        files = {"package.xml": package("arm_msgs", tag), "CMakeLists.txt": MESSAGES, "msg/Hand.msg": HAND}
        release(tmp_path / "arm_msgs", {**files, "msg/Finger.msg": f"float64 {field}\nfloat64 force\n"}, tag)
    user = tmp_path / "user"
    sources = {
        "include/user/user.hpp": HEADER.format(alias=alias),
        "src/user.cpp": USER.format(hand=hand, line=line),
    }
    write(user, {"package.xml": package("user"), "CMakeLists.txt": MAKE, **sources})
    assert ("src/user.cpp:5" in named(capsys, tmp_path / "arm_msgs", user)) is breaks


def test_a_message_is_named_behind_an_alias(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A message that went away is told where only the alias of its namespace stands before it."""
    files = {"package.xml": package("arm_msgs"), "CMakeLists.txt": MESSAGES, "msg/Finger.msg": "float64 angle\n"}
    release(tmp_path / "arm_msgs", {**files, "msg/Hand.msg": HAND}, "1.0.0")
    release(tmp_path / "arm_msgs", {"msg/Hand.msg": None}, "2.0.0")
    user = tmp_path / "user"
    header = HEADER.format(alias="namespace m = arm_msgs::msg;")
    source = USER.format(hand="m::Hand", line="use(hand);")
    sources = {"include/user/user.hpp": header, "src/user.cpp": source}
    write(user, {"package.xml": package("user"), "CMakeLists.txt": MAKE, **sources})
    assert "src/user.cpp:4" in named(capsys, tmp_path / "arm_msgs", user)
