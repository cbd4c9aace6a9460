"""The values that launch files substitute, each by its path, and what parameter files do where they are loaded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.finding import Certainty
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.launch.model import LaunchFile
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.launch.templates import plain_text, substitutions
from ecm_parsers.parameter_yaml import parse_parameter_yaml

from ecm_extract.entities.launch_values import is_judged
from ecm_extract.entities.paths import inside
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, Reader, required
from ecm_extract.test_code import is_test_path

SUBSTITUTES: Final = "substitutes_argument"
_ROS_1: Final = 1
_YAML: Final = (".yaml", ".yml")


def value_requirements(facts: PackageFacts, path: str, file: LaunchFile) -> Iterator[Requirement]:
    """Yield what a launch file substitutes without a default, each once; in ROS 2 an includer may set it too."""
    lines: dict[str, int] = {}
    sure: set[str] = set()
    for each in substitutions(file.actions) if is_judged(path) else ():
        found = each.substitution
        name = plain_text(found.args[0]) if found.kind == "arg" and len(found.args) == 1 else None
        if name is not None:
            lines.setdefault(name, each.line)
            sure.update({name} if each.is_sure else ())
    for name, line in lines.items():
        here: Certainty = "proved" if name in sure else "likely"
        certainty = here if file.ros == _ROS_1 else "unknown"
        place = Place(path, line, f"launch_file {path.rpartition('/')[2]}")
        yield required(
            SUBSTITUTES, name, place, certainty, package=facts.name, owner=inside(path, facts.root.path), ros=file.ros
        )


def loaded_value_requirements(read: Reader, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what parameter files of a package substitute where a launch file loads them, whichever does."""
    own = [entry.path for entry in facts.root.files if entry.path.endswith(_YAML)]
    for path, data in read(sorted(each for each in own if not is_test_path(each, facts.root.path))):
        if b"$(var " not in data:
            continue
        for entry in parse_parameter_yaml(data).facts.sets:
            for name in _variables(f"{entry.name} {entry.value}"):
                yield required(
                    SUBSTITUTES, name, Place(path, entry.line, f"file {path}"), "unknown", package=facts.name
                )


def _variables(text: str) -> Iterator[str]:
    """What launch_ros fills in when it loads the file: `$(var x)`."""
    for found in substitutions(parse_template(text)) if "$(" in text else ():
        name = plain_text(found.substitution.args[0]) if found.substitution.kind == "arg" else None
        if name is not None:
            yield name
