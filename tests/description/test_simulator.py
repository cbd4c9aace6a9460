from __future__ import annotations

import tomllib
from importlib import resources

import pytest
from memory_files import MemoryFiles, robot

from ecm_extract.description.read import read_description
from ecm_extract.description.simulator import SimulatorEndpoint, library_name, simulator_endpoints


def endpoints(body: str, ros: int) -> list[SimulatorEndpoint]:
    return simulator_endpoints(read_description("a", {}, MemoryFiles({"a": robot(body)})), ros)


def shown(body: str, ros: int) -> list[str]:
    return [
        f"{entry.role} {entry.name} {entry.type} {entry.frame}{'<-' + entry.child if entry.child else ''}".strip()
        for entry in endpoints(body, ros)
    ]


DRIVE = '<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">{}</plugin></gazebo>'
SENSOR = '<gazebo reference="top"><sensor name="s" type="{}">{}</sensor></gazebo>'
TWIST, ODOMETRY, TF = "geometry_msgs/msg/Twist", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"


@pytest.mark.parametrize(
    ("body", "ros", "found"),
    [
        pytest.param(
            DRIVE.format(
                "<ros><namespace>/bot</namespace><remapping>cmd_vel:=drive</remapping></ros><publish_odom>true"
                "</publish_odom><publish_odom_tf>1</publish_odom_tf><odometry_frame>map</odometry_frame>"
            ),
            2,
            [
                f"subscriber /bot/drive {TWIST}",
                f"publisher /bot/odom {ODOMETRY} map",
                f"tf_broadcast /tf {TF} map<-base_footprint",
            ],
            id="ros2-drive",
        ),
        pytest.param(DRIVE.format(""), 2, [f"subscriber /cmd_vel {TWIST}"], id="ros2-switches-are-off"),
        pytest.param(
            DRIVE.format("<robotNamespace>bot</robotNamespace><commandTopic>/drive</commandTopic>"),
            1,
            [
                f"subscriber /drive {TWIST}",
                f"publisher /bot/odom {ODOMETRY} odom",
                f"tf_broadcast /tf {TF} odom<-base_footprint",
            ],
            id="ros1-drive",
        ),
        pytest.param(
            SENSOR.format(
                "ray",
                '<plugin name="scan" filename="libgazebo_ros_ray_sensor.so"><ros><remapping>~/out:=scan</remapping>'
                "</ros><output_type>sensor_msgs/LaserScan</output_type></plugin>",
            ),
            2,
            ["publisher /scan sensor_msgs/msg/LaserScan top"],
            id="ros2-laser",
        ),
        pytest.param(
            SENSOR.format("imu", '<plugin name="imu" filename="libgazebo_ros_imu_sensor.so"/>'),
            2,
            ["publisher /imu/out sensor_msgs/msg/Imu top"],
            id="ros2-private-name",
        ),
        pytest.param(
            SENSOR.format("camera", '<plugin name="c" filename="libgazebo_ros_camera.so"><ros/></plugin>'),
            1,
            [
                "publisher /s/image_raw sensor_msgs/msg/Image top",
                "publisher /s/camera_info sensor_msgs/msg/CameraInfo top",
            ],
            id="a-ros-block-means-ros2",
        ),
        pytest.param(
            SENSOR.format("gpu_lidar", "<topic>scan</topic><gz_frame_id>laser</gz_frame_id>"),
            2,
            [
                "publisher /scan sensor_msgs/msg/LaserScan laser",
                "publisher /scan/points sensor_msgs/msg/PointCloud2 laser",
            ],
            id="gz-lidar",
        ),
        pytest.param(
            SENSOR.format("camera", "<topic>front/image</topic>"),
            2,
            [
                "publisher /front/image sensor_msgs/msg/Image top",
                "publisher /front/camera_info sensor_msgs/msg/CameraInfo top",
            ],
            id="gz-camera",
        ),
        pytest.param(SENSOR.format("imu", ""), 2, [], id="gz-without-topic"),
        pytest.param(
            '<gazebo><plugin name="gz::sim::systems::JointStatePublisher" '
            'filename="gz-sim-joint-state-publisher-system"/></gazebo>',
            2,
            ["publisher /world/{world}/model/r/joint_state sensor_msgs/msg/JointState"],
            id="gz-unknown-world",
        ),
        pytest.param('<gazebo><plugin name="x" filename="libmy_own.so"/></gazebo>', 2, [], id="unknown-plugin"),
        pytest.param(
            SENSOR.format(
                "ray",
                '<plugin name="l" filename="libgazebo_ros_ray_sensor.so"><ros><argument>~/out:=cloud</argument>'
                "<argument>__log_level:=debug</argument></ros></plugin>",
            ),
            2,
            ["publisher /cloud sensor_msgs/msg/PointCloud2 top"],
            id="remap-as-argument",
        ),
    ],
)
def test_plugins_create_endpoints(body: str, ros: int, found: list[str]) -> None:
    """A simulator plugin is a node like others: its names, types and frames are known from a table."""
    assert shown(body, ros) == found


def test_endpoints_of_gz_need_a_bridge() -> None:
    """What speaks gz is told apart from what speaks ROS, with the node and the line that make it."""
    (gz, _) = endpoints(SENSOR.format("gpu_lidar", "<topic>scan</topic>"), 2)
    (ros,) = endpoints(DRIVE.format(""), 2)
    assert (gz.transport, gz.source, gz.node, gz.where) == ("gz", "sensor gpu_lidar", "", ("a", 1))
    assert (ros.transport, ros.source, ros.node) == ("ros", "gazebo_ros_diff_drive", "drive")


@pytest.mark.parametrize(
    ("filename", "name"),
    [
        ("libgazebo_ros_camera.so", "gazebo_ros_camera"),
        ("gazebo_ros_camera", "gazebo_ros_camera"),
        ("/opt/lib/libx.so", "x"),
        ("gz-sim-imu-system", "gz-sim-imu-system"),
        ("", ""),
    ],
)
def test_a_library_is_known_by_its_name(filename: str, name: str) -> None:
    """Folder, prefix and suffix of a library say nothing."""
    assert library_name(filename) == name


def test_the_table_has_one_row_for_an_endpoint() -> None:
    """Two rows for the same endpoint of a plugin would double it."""
    text = resources.files("ecm_extract.description").joinpath("simulator.toml").read_text("utf-8")
    rows = [
        (library, row.get("ros"), row["role"], row["topic"], row.get("sensor"))
        for row in tomllib.loads(text)["endpoint"]
        for library in row["library"]
    ]
    assert len(rows) == len(set(rows))
