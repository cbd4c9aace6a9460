"""Which lines stand in one branch of several."""

import pytest

from ecm_extract.lint.alternatives import has_alternative

GUARDED = "#ifndef A_H\n#define A_H\n#include <old.h>\n#endif\n"
CHOSEN = "#ifdef OLD\n#include <old.h>\n#else\n#include <new.hpp>\n#endif\n#include <more.h>\n"
INNER = "#ifdef OLD\n#if DEEP\n#include <old.h>\n#endif\n#elif NEW\n#include <new.hpp>\n#endif\n"
CMAKE = "if(OLD)\n  old(a)\nelse()\n  new(a)\nendif()\nold(b)\n"
TRIED = "try:\n    from a import (b,\n        c)\nexcept ImportError:\n    b = None\nfrom a import d\n"
CAUGHT = "try:\n    from a import b\nexcept ImportError:\n    from c import b\n"
VERSIONS = "import sys\nif sys.version_info[0] < 3:\n    from a import b\nelse:\n    from c import b\n"
VARIABLE = "import os\nif os.environ['ROS_DISTRO'] == 'humble':\n    from a import b\n"
SAID = "def f(x):\n    # try:\n    if x == 'a ROS_DISTRO':\n        from a import b\n"
QUOTED = 'x = R"(\n#if OLD\n)";\n#include <old.h>\ny = R"(\n#else\n#endif\n)";\n'
NOTED = "# if(\nold(a)\n# else(\n# endif(\n"
METHOD = "def f():\n    from a import b\n"


@pytest.mark.parametrize(
    ("path", "text", "line", "expected"),
    [
        ("a.h", GUARDED, 3, False),
        ("a.cpp", CHOSEN, 2, True),
        ("a.cpp", CHOSEN, 4, True),
        ("a.cpp", CHOSEN, 6, False),
        ("a.cpp", INNER, 3, True),
        ("a.cpp", "#else\n#endif\n", 1, False),
        ("a.cpp", "", 4, False),
        ("CMakeLists.txt", CMAKE, 2, True),
        ("CMakeLists.txt", CMAKE, 6, False),
        ("a.py", TRIED, 2, True),
        ("a.py", TRIED, 3, True),
        ("a.py", TRIED, 6, False),
        ("a.py", METHOD, 2, False),
        ("a.py", CAUGHT, 4, True),
        ("a.py", VERSIONS, 3, True),
        ("a.py", VERSIONS, 5, True),
        ("a.py", VARIABLE, 3, True),
        ("a.py", SAID, 4, False),
        ("a.cpp", QUOTED, 4, False),
        ("CMakeLists.txt", NOTED, 2, False),
        ("a.py", "", 3, False),
    ],
)
def test_a_line_in_one_branch_of_several(path: str, text: str, line: int, expected: bool) -> None:
    """A condition without a second branch, such as an include guard, offers no other way."""
    assert has_alternative(path, text.encode(), line) is expected
