"""Names whose declaring line stands there with another name in it."""

from __future__ import annotations

import pytest
from diff_repos import package

Files = dict[str, str | None]
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")


def _launch(*arguments: str, name: str = "arm") -> Files:
    lines = "\n".join(f"<arg {each}/>" for each in arguments)
    return {f"arm/launch/{name}.launch": f"<launch>\n{lines}\n</launch>\n"}


@pytest.mark.parametrize(
    ("default", "word"),
    [("$(find arm)/config/arm.yaml", "renamed"), ("false", "removed"), ("0.5", "removed"), ("", "removed")],
)
def test_an_argument_of_the_same_default(changes, default: str, word: str) -> None:  # type: ignore[no-untyped-def]
    """A default that many have tells no argument from the next."""
    old, new = (_launch(f'name="{name}" default="{default}"') for name in ("settings", "where"))
    found = changes({"arm/package.xml": ROS1, **old}, new)
    assert [each["change"] for each in found if each["breaking"]] == [word]


def test_white_space_tells_no_line_from_another(changes) -> None:  # type: ignore[no-untyped-def]
    """Columns that are kept in line do not make one of two arguments the new one."""
    default = 'default="$(find arm)/config/arm.yaml"'
    old = _launch(f'name="settings"  {default}', f'name="file"      {default}')
    found = changes({"arm/package.xml": ROS1, **old}, _launch(f'name="whereall"  {default}'))
    assert sorted(each["change"] for each in found if each["breaking"]) == ["removed", "removed"]


def test_arguments_of_a_file_that_is_gone(told) -> None:  # type: ignore[no-untyped-def]
    """They go with it, although a file that git takes for its successor has such lines."""
    lines = [f'name="part_{number}" default="$(find arm)/config/{number}.yaml"' for number in range(6)]
    new = {**dict.fromkeys(_launch(name="arm")), **_launch(*lines, name="left_hand")}
    found = told({"arm/package.xml": ROS1, **_launch(*lines), **_launch(name="leg")}, new)
    assert not [each for each in found if each[0] == "launch_argument" and each[2] == each[3]]
