"""What the body of a Python module makes is of the programs that import it, and so run it."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """#!/usr/bin/env python
import rospy
{imports}

if __name__ == "__main__":
    rospy.init_node("demo")
"""
PART = """import rospy
from std_msgs.msg import String


class Part(object):
    def __init__(self):
        rospy.Publisher("part", String, queue_size=1)
"""
MAKES = f"{PART}\n\nPart()\n"
OF_A_CLASS = f"{PART}\n\nclass Machine(object):\n    parts = []\n    parts.append(Part())\n"
GUARDED = f"{PART}\n\nif __name__ == '__main__':\n    Part()\n"
CYCLE = {"scripts/one.py": "import two\n", "scripts/two.py": f"import one\n{MAKES}"}
ROWS = [
    ("a module", "import part", {"scripts/part.py": MAKES}, {"/part"}),
    ("the body of a class", "from part import Machine", {"scripts/part.py": OF_A_CLASS}, {"/part"}),
    ("a script", "import part", {"scripts/part.py": f"#!/usr/bin/env python\n{MAKES}"}, {"/part"}),
    ("through another module", "import other", {"scripts/part.py": MAKES, "scripts/other.py": "import part\n"},
     {"/part"}),
    ("modules that import each other", "import one", CYCLE, {"/part"}),
    ("a package", "import parts.own",
     {"scripts/parts/__init__.py": MAKES, "scripts/parts/own.py": "A = 1\n"}, {"/part"}),
    ("a module of a package", "from parts import own",
     {"scripts/parts/__init__.py": "", "scripts/parts/own.py": MAKES}, {"/part"}),
    ("what only the module as a program does", "import part", {"scripts/part.py": GUARDED}, set()),
    ("a module that nobody makes use of", "import part", {"scripts/part.py": PART}, set()),
    ("a module that is not imported", "", {"scripts/part.py": MAKES}, set()),
]  # fmt: skip


@pytest.mark.parametrize(("imports", "files", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_program_has_what_modules_make_that_it_imports(
    workspace: Any, imports: str, files: dict[str, str], expected: set[str]
) -> None:
    """It was told of the library, or of the module as a program."""
    written = {
        "scripts/demo.py": NODE.format(imports=imports),
        "CMakeLists.txt": "project(pkg)\ncatkin_install_python(PROGRAMS scripts/demo.py DESTINATION bin)\n",
        **files,
    }
    own = workspace.package(written, ros=1).modules().get("ecm.pkg.demo")
    found = own.signature.interfaces if own is not None else ()
    assert {entry.name for entry in found if entry.role == "publisher"} == expected
