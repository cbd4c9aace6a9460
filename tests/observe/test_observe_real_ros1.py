"""The same against Debian's own master and rospy, where they are installed."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from ecm_extract.errors import InputError
from ecm_extract.observe.ros1 import watch_ros1

PYTHON = "/usr/bin/python3"
WRITER = """
import sys, rospy
from geometry_msgs.msg import Twist
rospy.init_node(sys.argv[1])
rospy.set_param("~max_vel", 0.5)
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(20)
while not rospy.is_shutdown():
    publisher.publish(Twist())
    rate.sleep()
"""


def _is_there() -> bool:
    if shutil.which("rosmaster") is None or not Path(PYTHON).exists():
        return False
    return (
        subprocess.run([PYTHON, "-c", "import rospy, geometry_msgs"], capture_output=True, check=False).returncode == 0
    )


pytestmark = pytest.mark.skipif(
    not _is_there(), reason="needs Debian's python3-rosmaster, python3-rospy and python3-geometry-msgs"
)


@contextmanager
def started(*command: str, environment: dict[str, str]) -> Iterator[None]:
    quiet = subprocess.DEVNULL
    process = subprocess.Popen(command, env=environment, stdout=quiet, stderr=quiet, start_new_session=True)
    try:
        yield
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return int(listener.getsockname()[1])


@pytest.fixture
def environment(tmp_path: Path) -> Iterator[dict[str, str]]:
    """A master on a port of its own."""
    port = free_port()
    found = {
        "PATH": os.environ["PATH"],
        "HOME": str(tmp_path),
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(tmp_path),
        "ROS_LOG_DIR": str(tmp_path / "log"),
    }
    with started("rosmaster", "--core", "-p", str(port), environment=found):
        yield found


def test_two_writers_of_rospy(environment: dict[str, str]) -> None:
    """What rospy tells is what the emulation of the other tests tells."""
    uri = environment["ROS_MASTER_URI"]
    with (
        started(PYTHON, "-c", WRITER, "teleop", environment=environment),
        started(PYTHON, "-c", WRITER, "move_base", environment=environment),
    ):
        for _ in range(600):
            seen = _looked(uri)
            if seen is not None and {"/teleop", "/move_base"} <= {node.name for node in seen.nodes}:
                break
            time.sleep(0.1)
        *_, seen = watch_ros1(uri, 2.0)
    commands = [end for end in seen.endpoints if (end.role, end.name) == ("publisher", "/cmd_vel")]
    assert {(end.node, end.hash) for end in commands} == {
        ("/teleop", "9f195f881246fdfa2798d1d3eebca84a"),
        ("/move_base", "9f195f881246fdfa2798d1d3eebca84a"),
    }
    assert {(each.name, each.value) for each in seen.parameters} >= {("/teleop/max_vel", 0.5)}
    rates = [each.hz or 0 for each in seen.streams if each.topic == "/cmd_vel"]
    assert len(rates) == 2
    assert all(0 < rate < 60 for rate in rates)
    assert seen.gaps == ()


def _looked(uri: str):  # type: ignore[no-untyped-def]
    try:
        (seen,) = watch_ros1(uri, 0, once=True)
    except InputError:
        return None
    return seen
