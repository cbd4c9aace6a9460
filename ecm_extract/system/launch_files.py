"""Which files are launch files, and the parser of each."""

from __future__ import annotations

from typing import cast

from ecm_parsers.launch.files import parse_launch_xml, parse_launch_yaml
from ecm_parsers.launch.model import LaunchFile
from ecm_parsers.launch.python import parse_launch_python
from ecm_parsers.python.sources import Sources
from ecm_parsers.result import Parsed

_XML_SUFFIXES = (".launch", ".launch.xml", ".test")
_YAML_SUFFIXES = (".launch.yaml", ".launch.yml")
_PYTHON_SUFFIXES = (".launch.py", "_launch.py")


def is_aside(path: str) -> bool:
    """Tell whether a file lies in a hidden folder, where editors keep copies."""
    return any(folder.startswith(".") for folder in path.split("/")[:-1])


def is_launch_file(path: str) -> bool:
    """Tell by its name whether a file is a launch file."""
    if path.endswith((*_XML_SUFFIXES, *_YAML_SUFFIXES, *_PYTHON_SUFFIXES)):
        return not path.endswith(".test") or "test" in path
    if not path.endswith((".py", ".xml")) or path.endswith("__init__.py"):
        return False
    return "launch" in path.split("/")[:-1]


def read_launch(
    path: str, data: bytes, ros: int | None = None, sources: Sources | None = None
) -> Parsed[LaunchFile | None]:
    """Read a launch file by the syntax that its name tells; `sources` gives what a Python file imports."""
    if path.endswith(".py"):
        return parse_launch_python(data, sources)
    if path.endswith((".yaml", ".yml")):
        return parse_launch_yaml(data)
    return parse_launch_xml(data, cast("None", ros if ros in {1, 2} else None))
