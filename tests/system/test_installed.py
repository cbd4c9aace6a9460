"""Files of a share folder that install rules put there from elsewhere in the tree."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.extraction_model import Options
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import open_tree

HEAD = "cmake_minimum_required(VERSION 3.8)\nproject(pkg)\nfind_package(ament_cmake REQUIRED)\n"
RULES = """\
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/../../configs/ DESTINATION share/${PROJECT_NAME}/all)
install(DIRECTORY ../../maps DESTINATION share/${PROJECT_NAME})
install(FILES ../../configs/a.yaml DESTINATION share/${PROJECT_NAME} RENAME b.yaml)
install(FILES ../../configs/a.yaml DESTINATION share/other)
ament_package()
"""


@pytest.mark.parametrize(
    ("named", "found"),
    [
        ("all/a.yaml", "configs/a.yaml"),
        ("all/deep/c.yaml", "configs/deep/c.yaml"),
        ("maps/m.yaml", "maps/m.yaml"),
        ("b.yaml", "configs/a.yaml"),
        ("all/gone.yaml", None),
        ("a.yaml", None),
    ],
)
def test_a_file_is_found_where_it_is_copied_from(tmp_path: Path, named: str, found: str | None) -> None:
    """The content of a folder, a folder, a file under another name; what no rule puts there is not there."""
    files = {
        "src/pkg/package.xml": "<package format='3'><name>pkg</name><version>1.0.0</version></package>",
        "src/pkg/CMakeLists.txt": HEAD + RULES,
        **dict.fromkeys(("configs/a.yaml", "configs/deep/c.yaml", "maps/m.yaml"), "a: 1\n"),
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    assert Workspace(open_tree(tmp_path), Options(jobs=1)).files.find(f"tree:src/pkg/{named}") == found
