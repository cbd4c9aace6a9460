"""Python modules over two releases: names that stay, values of enums, warnings, values that are set by name."""

from __future__ import annotations

import pytest

Files = dict[str, str | None]
BASE: Files = {
    "arm/setup.py": "from setuptools import setup\nsetup(name='arm', packages=['arm'])\n",
    "arm/arm/__init__.py": "",
}
_SCRIPT = (
    "from setuptools import setup\n"
    "setup(name='arm', packages=['arm'], entry_points={'console_scripts': ['qos = arm.qos:main']})\n"
)
_EMPTY = "import os\n"
OLD = "class QoSPolicy(IntEnum):\n    FIRST = 1\n    LAST = 2\n"


def _module(text: str) -> Files:
    return {**BASE, "arm/arm/qos.py": text}


def _named(what: str) -> Files:
    setup = f"from setuptools import find_packages, setup\nsetup(name='arm', {what})\n"
    return {"arm/setup.py": setup, "arm/arm/__init__.py": ""}


_BINDINGS = """#include <pybind11/pybind11.h>
PYBIND11_MODULE(qos, m) {
  py::class_<arm::Policy>(m, "QoSPolicy").def("first", &arm::Policy::first);
  m.def("stop", &arm::stop);
}
"""
_GRIPPER = "class Gripper(Tool):\n    def __init__(self, size):\n        pass\n    def grip(self):\n        pass\n"
_TOOL = "class Tool:\n    def grip(self):\n        pass\n"
_DATA = "@dataclass\nclass Tool:\n    size: int\n"

CASES = {
    "a module is compiled now, with what its bindings name": (
        _module("class QoSPolicy:\n    def first(self):\n        pass\ndef stop():\n    pass\ndef halt():\n    pass\n"),
        {
            "arm/arm/qos.py": None,
            "arm/CMakeLists.txt": "project(arm)\npybind11_add_module(qos src/qos.cpp)\n",
            "arm/src/qos.cpp": _BINDINGS,
        },
        {("function", "removed", "arm.qos.halt", None)},
        True,
    ),
    "a method is in a base of another module now": (
        {**_module(f"from .tool import Tool\n{_GRIPPER}"), "arm/arm/tool.py": "class Tool:\n    pass\n"},
        {**_module(f"from arm import Tool\n{_GRIPPER[: _GRIPPER.index('    def grip')]}"), "arm/arm/tool.py": _TOOL}
        | {"arm/arm/__init__.py": "from .tool import Tool\n"},
        set(),
        False,
    ),
    "what writes a constructor is not known": (
        _module(f"from dataclasses import dataclass\n{_DATA}"),
        {**_module(f"from .compatible import dataclass\n{_DATA}"), "arm/arm/compatible.py": "def dataclass(c): ..."},
        set(),
        False,
    ),
    "nothing writes a constructor": (
        _module(f"from dataclasses import dataclass\n{_DATA}"),
        _module("class Tool:\n    size: int\n"),
        {("method", "removed", "__init__", None)},
        True,
    ),
    "a constant of a class that is gone, and one of a new class": (
        _module("class Tool:\n    MIN_SIZE = 2\n"),
        _module("class Wheel:\n    MIN_SIZE = 2\n"),
        {("class", "removed", "arm.qos.Tool", None)},
        True,
    ),
    "the old name stands for the new class": (
        _module(OLD),
        _module(OLD.replace("QoSPolicy", "Policy") + "\nQoSPolicy = Policy\n"),
        {("class", "renamed", "arm.qos.QoSPolicy", "arm.qos.Policy")},
        False,
    ),
    "a class is compiled now": (_module(OLD), _module("from . import impl\nQoSPolicy = impl.QoSPolicy\n"), None, False),
    "a value of an enum is gone": (
        _module(OLD),
        _module("class QoSPolicy(IntEnum):\n    FIRST = 1\n"),
        {("constant", "removed", "LAST", None)},
        True,
    ),
    "a value is set by its name": (
        _module(OLD),
        _module("@aliases((('LAST', 'FIRST'),))\nclass QoSPolicy(IntEnum):\n    FIRST = 1\n"),
        set(),
        False,
    ),
    "a function warns of its end": (
        _module("def stop(now):\n    pass\ndef halt(now):\n    pass\n"),
        _module(
            "import warnings\n"
            "def stop(now):\n    warnings.warn('stop() is deprecated. Use arm.qos.halt() instead')\n"
            "def halt(now):\n    if now is None:\n        warnings.warn('now is deprecated')\n"
        ),
        {("function", "deprecated", "arm.qos.stop", "arm.qos.halt")},
        False,
    ),
    "only the folder of the package moved": (
        _module(OLD),
        {
            "arm/setup.py": None,
            "arm/arm/__init__.py": None,
            "arm/arm/qos.py": None,
            "arm/CMakeLists.txt": "project(arm)\nament_python_install_package(arm PACKAGE_DIR python/arm)\n",
            "arm/python/arm/__init__.py": "",
            "arm/python/arm/qos.py": OLD,
        },
        set(),
        False,
    ),
    "a module becomes a program": (
        _module("class Tool:\n    def run(self):\n        pass\n\ndef main():\n    Tool().run()\n"),
        {"arm/setup.py": _SCRIPT},
        set(),
        False,
    ),
    "a program loses a class that others may have imported": (
        {**_module("class Tool:\n    def run(self):\n        pass\n\ndef main():\n    Tool().run()\n")},
        {"arm/setup.py": _SCRIPT, "arm/arm/qos.py": "def main():\n    pass\n"},
        {("class", "removed", "arm.qos.Tool", None)},
        True,
    ),
    "a folder that is not installed as a package": (
        {**BASE, "arm/tools/qos.py": _EMPTY, "arm/stop.py": _EMPTY},
        {"arm/tools/qos.py": None, "arm/stop.py": None},
        set(),
        False,
    ),
    "a folder and a module that are": (
        {**_named("packages=['arm', 'tools'], py_modules=['stop']"), "arm/tools/qos.py": _EMPTY, "arm/stop.py": _EMPTY},
        {"arm/tools/qos.py": None, "arm/stop.py": None},
        {("file", "removed", "tools.qos", None), ("file", "removed", "stop", None)},
        True,
    ),
    "a folder that a search finds, and one that it does not": (
        {
            **_named("packages=find_packages()"),
            "arm/tools/qos.py": _EMPTY,
            "arm/more/qos.py": _EMPTY,
            "arm/more/__init__.py": "",
        },
        {"arm/tools/qos.py": None, "arm/more/qos.py": None},
        {("file", "removed", "more.qos", None)},
        True,
    ),
    "an argument among those that are given by name": (
        _module("class Arm:\n    def __init__(self, size, *args, grip=1, speed=2):\n        pass\n"),
        _module("class Arm:\n    def __init__(self, size, *args, log=False, speed=2, grip=1):\n        pass\n"),
        set(),
        False,
    ),
    "an argument that was given by name is gone": (
        _module("class Arm:\n    def __init__(self, size, *, grip=1, speed=2):\n        pass\n"),
        _module("class Arm:\n    def __init__(self, size, *, speed=2, force=1):\n        pass\n"),
        {("method", "signature_changed", "__init__", "__init__")},
        True,
    ),
    "any arguments are no longer taken": (
        _module("class Arm:\n    def __init__(self, size, *args, grip=1):\n        pass\n"),
        _module("class Arm:\n    def __init__(self, size, *, grip=1):\n        pass\n"),
        {("method", "signature_changed", "__init__", "__init__")},
        True,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_modules(changes, case: str) -> None:  # type: ignore[no-untyped-def]
    """What importers notice is told, and breaks them or not."""
    old, new, expected, breaks = CASES[case]
    found = changes(old, new)
    told = {(each["kind"], each["change"], each["old"], each["new"]) for each in found}
    assert any(each["breaking"] for each in found) == breaks
    if expected is not None:
        assert {entry for entry in told if entry[1] != "added"} == expected
