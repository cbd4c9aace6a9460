"""Python modules over two releases: names that stay, values of enums, warnings, values that are set by name."""

from __future__ import annotations

import pytest

Files = dict[str, str | None]
BASE: Files = {
    "arm/setup.py": "from setuptools import setup\nsetup(name='arm', packages=['arm'])\n",
    "arm/arm/__init__.py": "",
}
OLD = "class QoSPolicy(IntEnum):\n    FIRST = 1\n    LAST = 2\n"


def _module(text: str) -> Files:
    return {**BASE, "arm/arm/qos.py": text}


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
