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


CASES = {
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
