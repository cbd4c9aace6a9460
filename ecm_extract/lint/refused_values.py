"""Values of launch files in XML and YAML that whoever reads the file refuses."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from ecm_parsers.launch.files import refused_xml_1, refused_xml_2, refused_yaml
from ecm_parsers.launch.model import LaunchFile
from ecm_parsers.launch.refusals import Refusal

from ecm_extract.entities.launch_values import is_judged
from ecm_extract.lint.workspace import Workspace

_YAML = (".yaml", ".yml")


def refused_values(path: str, ros: int | None, workspace: Workspace) -> Mapping[str, Sequence[Refusal]]:
    """Return what is refused in a launch file, by what is wrong; `ros` is the version of its package."""
    found: dict[str, list[Refusal]] = defaultdict(list)
    file = workspace.launches.get(path)
    if file is None or path.endswith(".py") or not is_judged(path) or is_left_behind(file, ros):
        return found
    parser = refused_yaml if path.endswith(_YAML) else refused_xml_1 if file.ros == 1 else refused_xml_2
    for each in workspace.files.parsed(path, parser) or ():
        found[each.wrong].append(each)
    return found


def is_left_behind(file: LaunchFile, ros: int | None) -> bool:
    """A file of ROS 1 in a package of ROS 2 runs nowhere, whatever its values are."""
    return ros == 2 and file.ros == 1
