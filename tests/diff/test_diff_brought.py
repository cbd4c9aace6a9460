"""A header that another package has now, under the same name: who depends on that package loses nothing."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from diff_repos import package, release, write

from ecm_extract.cli.run import run

HEADER = "#pragma once\nnamespace arm { struct Grip { int width; }; }\n"
BUILD = "project({0})\ninstall(DIRECTORY include/ DESTINATION include)\nament_package()\n"
DEPENDS: dict[str, tuple[str, bool]] = {
    "on the old package": ("arm_old", True),
    "on the new package": ("arm_new", False),
    "on what depends on the new package": ("arm_tools", False),
}


def of(name: str, depends: str = "rclcpp") -> dict[str, str | None]:
    """Files of a package that installs headers."""
    manifest = package(name).replace("rclcpp", depends)
    return {f"{name}/package.xml": manifest, f"{name}/CMakeLists.txt": BUILD.format(name)}


@pytest.mark.parametrize(("depends", "breaks"), DEPENDS.values(), ids=DEPENDS)
def test_an_include_that_a_dependency_answers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], depends: str, breaks: bool
) -> None:
    """The line is told only where nothing that the consumer depends on has the header."""
    packages = {**of("arm_old"), **of("arm_new"), **of("arm_tools", "arm_new")}
    release(tmp_path / "arm", {**packages, "arm_old/include/arm/grip.hpp": HEADER}, "1.0.0")
    moved: dict[str, str | None] = {"arm_old/include/arm/grip.hpp": None, "arm_new/include/arm/grip.hpp": HEADER}
    release(tmp_path / "arm", moved, "2.0.0")
    user = tmp_path / "user"
    source = {
        "src/user.cpp": "#include <arm/grip.hpp>\n",
        "CMakeLists.txt": "project(user)\nadd_library(u src/user.cpp)\n",
    }
    write(user, {"package.xml": package("user").replace("rclcpp", depends), **source})
    line = ["diff", "1.0.0", "2.0.0", "--repo", str(tmp_path / "arm"), "--consumer", str(user), "--format", "json"]
    run(line)
    found = [at["path"] for each in json.loads(capsys.readouterr().out)["findings"] for at in each["evidence"]]
    assert ("src/user.cpp" in found) is breaks
