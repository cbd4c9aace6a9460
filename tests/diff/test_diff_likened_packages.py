"""A package of files that a tool wrote for one robot, and the one that it wrote for the next."""

from __future__ import annotations

import pytest
from diff_repos import package

LAUNCH = "<launch>\n" + "".join(f'  <arg name="{name}" default="0"/>\n' for name in "abcdef") + "%s\n</launch>\n"
START = '<node pkg="{0}_driver" exec="{0}" name="{0}_driver_of_{0}"/>'
NAMES = ("demo", "move", "plan", "show")
ALONE = ("table", "world", "light", "floor")


def _launches(robot: str, names: tuple[str, ...]) -> dict[str, str]:
    return {f"{robot}/launch/{name}.launch.xml": LAUNCH % START.format(robot) for name in names}


def _manifest(robot: str, about: str) -> str:
    return package(robot).replace("</package>", f"<description>{about}</description></package>")


@pytest.mark.parametrize(
    ("about", "others", "successor"),
    [("Another robot. " * 40, ALONE, None), ("", ALONE, "leg"), ("Another robot. " * 40, (), "leg")],
)
def test_a_package_of_another_robot_is_no_new_name(
    told, about: str, others: tuple[str, ...], successor: str | None
) -> None:  # type: ignore[no-untyped-def]
    """One that has half of its files, and a manifest of its own, is another one: what it has is not what is gone."""
    alone = {f"arm/launch/{name}.launch.xml": f"<launch><!-- {name * 30} --></launch>" for name in others}
    old = {"arm/package.xml": _manifest("arm", ""), **_launches("arm", NAMES), **alone}
    new = {"leg/package.xml": _manifest("leg", about), **_launches("leg", NAMES)}
    found = told(old, {**new, **dict.fromkeys(old)})
    assert ("package", "removed" if successor is None else "renamed", "arm", successor) in found
    assert any(change == "moved" for _, change, _, _ in found) == (successor is not None)
