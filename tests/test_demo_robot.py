"""The demo robot is read without a complaint: it shows what works, not what does not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from ecm_parsers import interface, package_xml, parameter_yaml, python_setup
from ecm_parsers.cmake_tokens import parse_commands
from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.python import parse_python

DEMO = Path(__file__).parent.parent / "fixtures" / "demo_robot"
FILES = sorted(path.relative_to(DEMO) for path in DEMO.rglob("*") if path.is_file() and path.stat().st_size)
Parse = Callable[[bytes], Any]
BY_NAME: dict[str, Parse] = {
    "package.xml": package_xml.parse,
    "CMakeLists.txt": parse_commands,
    "setup.py": python_setup.parse_setup_py,
}
BY_SUFFIX: dict[str, Parse] = {
    ".cpp": parse_cpp,
    ".hpp": parse_cpp,
    ".py": parse_python,
    ".yaml": parameter_yaml.parse_parameter_yaml,
    ".msg": lambda data: interface.parse(data, "msg"),
    ".srv": lambda data: interface.parse(data, "srv"),
    ".action": lambda data: interface.parse(data, "action"),
}


@pytest.mark.parametrize("path", [path for path in FILES if path.suffix != ".cfg"], ids=str)
def test_every_file_is_read_without_a_complaint(path: Path) -> None:
    """A diagnostic in the demo would be the first thing that a newcomer sees."""
    parse = BY_NAME.get(path.name) or BY_SUFFIX[path.suffix]
    assert parse((DEMO / path).read_bytes()).diagnostics == ()
