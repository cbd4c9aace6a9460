"""Claims of controllers against what their YAML and descriptions say: `python benchmarks/claims.py TREE [LAUNCH...]`.

The oracle reads YAML files with PyYAML and multiplies joints by interfaces; it shares nothing with the tool. Without
LAUNCH every launch file below TREE that starts a controller manager is taken.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path

import yaml

LISTS = {
    "joint_trajectory_controller/JointTrajectoryController": ("joints", "command_interfaces"),
    "forward_command_controller/ForwardCommandController": ("joints", "interface_name"),
    "pid_controller/PidController": ("dof_names", "command_interface"),
}
WHEELS = {
    "diff_drive_controller/DiffDriveController": (("left_wheel_names", "velocity"), ("right_wheel_names", "velocity")),
    "bicycle_steering_controller/BicycleSteeringController": (
        ("traction_joints_names", "velocity"),
        ("rear_wheels_names", "velocity"),
        ("steering_joints_names", "position"),
        ("front_wheels_names", "position"),
    ),
}


def parameters(root: Path, name: str) -> list[dict[str, object]]:
    """Every section of a YAML file below a folder that is for a controller of this name."""
    found = []
    for path in sorted(root.rglob("*.yaml")):
        try:
            data = yaml.safe_load(path.read_text("utf-8"))
        except yaml.YAMLError:
            continue
        found += _sections(data, name)
    return found


def _sections(data: object, name: str) -> list[dict[str, object]]:
    if not isinstance(data, dict):
        return []
    own = [
        value["ros__parameters"]
        for key, value in data.items()
        if str(key).rpartition("/")[2] == name and _is_node(value)
    ]
    return own + [section for value in data.values() for section in _sections(value, name) if not _is_node(value)]


def _is_node(value: object) -> bool:
    return isinstance(value, dict) and "ros__parameters" in value


def expected(kind: str, section: dict[str, object]) -> set[str] | None:
    """What a section claims, None for a type that the oracle does not know."""
    if kind in LISTS:
        joints, interfaces = (_listed(section.get(key)) for key in LISTS[kind])
        return {f"{joint}/{interface}" for joint in joints for interface in interfaces}
    if kind in WHEELS:
        return {f"{joint}/{interface}" for key, interface in WHEELS[kind] for joint in _listed(section.get(key))}
    return set() if kind.endswith("Broadcaster") else None


def _listed(value: object) -> list[object]:
    return value if isinstance(value, list) else [] if value is None else [value]


def system(tree: Path, launch: str) -> dict[str, list[dict[str, object]]]:
    program = [sys.executable, "-c", "from ecm_extract.cli import main; main()"]
    command = [*program, "system", launch, "--workspace", str(tree), "--format", "json"]
    found: dict[str, list[dict[str, object]]] = json.loads(
        subprocess.run(command, check=True, capture_output=True).stdout
    )
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tree", type=Path)
    parser.add_argument("launch", nargs="*")
    arguments = parser.parse_args()
    launches = arguments.launch or [
        str(path.relative_to(arguments.tree))
        for path in sorted(arguments.tree.rglob("*launch*"))
        if path.is_file() and b"ros2_control_node" in path.read_bytes() and "test" not in path.name
    ]
    controllers = equal = claims = offered = asked = 0
    for launch in launches:
        document = system(arguments.tree, launch)
        root = arguments.tree / Path(launch).parts[0]
        hardware = {
            name for robot in document["robots"] for each in robot["hardware"] for name in each["command_interfaces"]
        }  # type: ignore[attr-defined]
        names = {str(each["name"]) for each in document["controllers"]}
        for each in document["controllers"]:
            controllers += 1
            mine = set(each["claims"] or ())  # type: ignore[call-overload]
            options = [expected(str(each["type"]), section) for section in parameters(root, str(each["name"]))] or [
                expected(str(each["type"]), {})
            ]
            fits = mine in options
            equal += fits
            claims += len(mine)
            offered += sum(claim in hardware or claim.partition("/")[0] in names for claim in mine)
            asked += len(mine) if hardware else 0
            if not fits:
                print(f"  {launch}: {each['name']} ({each['type']}) claims {sorted(mine)}, oracle {options}")
    print(f"{len(launches)} launch files, {controllers} controllers, {equal} with exactly the claims of their YAML")
    print(f"{claims} claims, {offered} of {asked} that a description could offer are offered")


if __name__ == "__main__":
    main()
