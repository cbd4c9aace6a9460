"""Generated headers that a target includes through any number of headers of its own package."""

from __future__ import annotations

from typing import Any

from lint_fixtures import lint

DEPTH = 450
CMAKE = """cmake_minimum_required(VERSION 3.0)
project(pkg)
find_package(catkin REQUIRED COMPONENTS roscpp message_generation)
add_message_files(FILES Speed.msg)
generate_messages()
catkin_package()
add_executable(driver src/driver.cpp)
"""


def test_the_way_to_a_generated_header_may_be_long(workspace: Any) -> None:
    """No header is left out without being told."""
    chain = {f"include/pkg/h{at}.h": f'#include "pkg/h{at + 1}.h"\n' for at in range(DEPTH)}
    last = {f"include/pkg/h{DEPTH}.h": "#include <pkg/Speed.h>\n"}
    source = {"src/driver.cpp": "#include <pkg/h0.h>\nint main() { return 0; }\n"}
    workspace.package({**chain, **last, **source, "msg/Speed.msg": "float64 x\n", "CMakeLists.txt": CMAKE}, ros=1)
    found = [each for each in lint(workspace.root) if each.rule == "LNT041"]
    assert [each.about.new for each in found if each.about is not None] == ["pkg"]
