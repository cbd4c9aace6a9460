"""Forms of CMake that projects are drawn of, and how a form is filled in."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Final


def read_forms(*names: str) -> Mapping[str, list[str]]:
    """Forms of several files; those of one kind follow each other."""
    found: dict[str, list[str]] = {}
    for name in names:
        for kind, forms in tomllib.loads(Path(__file__).with_name(name).read_text("utf-8")).items():
            found.setdefault(kind, []).extend(forms)
    return found


FORMS: Final = read_forms("cmake_forms.toml", "cmake_statements.toml", "cmake_ros.toml", "cmake_packages.toml")
PLACES: Final = {
    1: {
        "share": "${CATKIN_PACKAGE_SHARE_DESTINATION}",
        "programs": "${CATKIN_PACKAGE_BIN_DESTINATION}",
        "ros_package": "catkin",
    },
    2: {"share": "share/${PROJECT_NAME}", "programs": "lib/${PROJECT_NAME}", "ros_package": "ament_cmake"},
}
"""Where things are installed, and the package that builds, by ROS."""


def written(form: str, given: Mapping[str, str]) -> list[str]:
    """The lines of a form, with what is given in the place of `<words>`."""
    for word, text in given.items():
        form = form.replace(f"<{word}>", text)
    return form.rstrip("\n").split("\n")
