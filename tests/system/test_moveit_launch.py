"""Launch files that leave their work to `moveit_configs_utils`: what they start is known without its source."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.read.reader import Reader
from ecm_extract.system.evaluate import launched
from ecm_extract.system.files import Files
from ecm_extract.system.model import Given, Instance
from ecm_extract.system.package_folders import folders_read
from ecm_extract.tree import open_tree

IMPORTS = (
    "from moveit_configs_utils import MoveItConfigsBuilder\n"
    "from moveit_configs_utils.launches import *\n"
    "from launch_ros.actions import Node\n"
)
WHOLE = (
    "def generate_launch_description():\n"
    "    moveit_config = MoveItConfigsBuilder('arm').to_moveit_configs()\n"
    "    return {}(moveit_config)\n"
)
PARTS = (
    "def generate_launch_description():\n"
    "    moveit_config = MoveItConfigsBuilder('arm', package_name='arm_moveit_config'){}\n"
    "    return LaunchDescription([Node(package='p', executable='e', parameters=[{}])])\n"
)
ATTRIBUTES = (
    "robot_description",
    "robot_description_kinematics",
    "joint_limits",
    "planning_pipelines",
    "trajectory_execution",
)
PACKAGE = {
    "package.xml": "<package format='3'><name>arm_moveit_config</name><version>1.0.0</version></package>",
    ".setup_assistant": (
        "moveit_setup_assistant_config:\n"
        "  urdf: {package: arm_moveit_config, relative_path: urdf/told.xacro, xacro_args: 'dof:=6 tool:=none'}\n"
        "  srdf: {relative_path: config/arm.srdf}\n"
    ),
    "urdf/told.xacro": "<robot name='arm'/>",
    "config/arm.srdf": (
        "<robot name='arm'><virtual_joint name='v' type='fixed' parent_frame='world' child_link='base'/></robot>"
    ),
    "config/kinematics.yaml": "arm:\n  kinematics_solver: k/Plugin\n",
    "config/joint_limits.yaml": "joint_limits:\n  j1: {max_velocity: 1.5}\n",
    "config/moveit_controllers.yaml": "moveit_simple_controller_manager:\n  controller_names: [arm_controller]\n",
    "config/ompl_planning.yaml": "planning_plugins: [ompl/Planner]\n",
    "config/ros2_controllers.yaml": "controller_manager:\n  ros__parameters: {update_rate: 100}\n",
}


def instances(folder: Path, text: str, others: dict[str, str] | None = None) -> list[Instance]:
    files = {**PACKAGE, "launch/a.launch.py": IMPORTS + text, **(others or {})}
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    tree = open_tree(str(folder))
    found = launched(tree, Files(tree, folders_read(Reader(tree).read(1))), ["launch/a.launch.py"], Given())
    assert [entry.message for entry in tree.diagnostics] == []
    return found.instances


def values(instance: Instance) -> dict[str, object]:
    return {setting.name: setting.value for setting in instance.settings}


@pytest.mark.parametrize(
    ("function", "programs"),
    [
        ("generate_move_group_launch", ["move_group"]),
        ("generate_rsp_launch", ["robot_state_publisher"]),
        ("generate_moveit_rviz_launch", ["rviz2"]),
        ("generate_static_virtual_joint_tfs_launch", ["static_transform_publisher"]),
        ("generate_spawn_controllers_launch", ["spawner", "spawner"]),
        ("generate_warehouse_db_launch", ["mongo_wrapper_ros.py"]),
        ("generate_setup_assistant_launch", ["moveit_setup_assistant"]),
    ],
)
def test_whole_launches(function: str, programs: list[str], tmp_path: Path) -> None:
    """The launch files that the setup assistant writes hold one line; all that it starts is known."""
    assert [each.executable for each in instances(tmp_path, WHOLE.format(function))] == programs


def test_demo_includes_its_parts(tmp_path: Path) -> None:
    """The demo starts the files beside it; a part that is not there is not missed where it is optional."""
    parts = {
        "rsp": "generate_rsp_launch",
        "move_group": "generate_move_group_launch",
        "moveit_rviz": "generate_moveit_rviz_launch",
        "spawn_controllers": "generate_spawn_controllers_launch",
    }
    others = {f"launch/{name}.launch.py": IMPORTS + WHOLE.format(text) for name, text in parts.items()}
    found = instances(tmp_path, WHOLE.format("generate_demo_launch"), others)
    programs = ["robot_state_publisher", "move_group", "rviz2", "ros2_control_node", "spawner", "spawner"]
    assert [each.executable for each in found] == programs
    assert values(found[3])["update_rate"] == 100


def test_virtual_joint_and_controllers_are_read(tmp_path: Path) -> None:
    """Frames of the semantic description and names of the controller file reach the command lines."""
    (static,) = instances(tmp_path, WHOLE.format("generate_static_virtual_joint_tfs_launch"))
    assert [word.text for word in static.arguments] == ["--frame-id", "world", "--child-frame-id", "base"]
    spawners = instances(tmp_path, WHOLE.format("generate_spawn_controllers_launch"))
    assert [each.arguments[0].text for each in spawners] == ["arm_controller", "joint_state_broadcaster"]


@pytest.mark.parametrize(
    ("calls", "parameters"),
    [
        (".to_moveit_configs()", "moveit_config.to_dict()"),
        ("", "moveit_config.to_dict()"),
        (".to_moveit_configs()", "{**moveit_config.to_dict(), 'other': 1}"),
        (
            ".to_moveit_configs()",
            ", ".join(f"moveit_config.{name}" for name in ATTRIBUTES),
        ),
    ],
)
def test_parameters(calls: str, parameters: str, tmp_path: Path) -> None:
    """Each file of the configuration is below its prefix, and says where each value stands."""
    (node,) = instances(tmp_path, PARTS.format(calls, parameters))
    found = values(node)
    assert str(found["robot_description"]) == "{command xacro tree:/urdf/told.xacro dof:=6 tool:=none}"
    assert found["robot_description_kinematics.arm.kinematics_solver"] == "k/Plugin"
    assert found["robot_description_planning.joint_limits.j1.max_velocity"] == 1.5
    assert found["ompl.planning_plugins"] == ["ompl/Planner"]
    assert found["moveit_simple_controller_manager.controller_names"] == ["arm_controller"]
    places = {setting.name: setting.place for setting in node.settings}
    assert places["ompl.planning_plugins"] == ("config/ompl_planning.yaml", 1)


def test_name_that_depends_on_an_argument(tmp_path: Path) -> None:
    """A configuration whose robot is an argument is found by the argument's default."""
    text = (
        "def setup(context):\n"
        "    name = LaunchConfiguration('robot').perform(context)\n"
        "    config = MoveItConfigsBuilder(name, package_name=f'{name}_moveit_config')\n"
        "    return [Node(package='p', executable='e', parameters=[config.to_dict()])]\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([DeclareLaunchArgument('robot', default_value='arm'), OpaqueFunction(function=setup)])\n"
    )
    (node,) = instances(tmp_path, text)
    assert values(node)["robot_description_kinematics.arm.kinematics_solver"] == "k/Plugin"
