"""Small recordings of every kind, written where a test asks for them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

KINDS = ("ros1", "sqlite3", "mcap")
START_NS = 1_700_000_000_000_000_000
PERIOD_NS = 50_000_000
FOREVER = QosTime(9223372036, 854775807)
SENSOR = Qos(
    QosHistory.KEEP_LAST,
    5,
    QosReliability.BEST_EFFORT,
    QosDurability.VOLATILE,
    QosTime(0, 100_000_000),
    FOREVER,
    QosLiveliness.AUTOMATIC,
    FOREVER,
    False,
)


class Recorder:
    """Writes one recording; messages are made by the types of its ROS."""

    def __init__(self, folder: Path, kind: str) -> None:
        self.kind = kind
        self.ros = 1 if kind == "ros1" else 2
        self.path = folder / ("run.bag" if self.ros == 1 else "run")
        self.store: Any = get_typestore(Stores.ROS1_NOETIC if self.ros == 1 else Stores.LATEST)
        if self.ros == 1:
            latest = get_typestore(Stores.LATEST)
            self.store.register({"tf2_msgs/msg/TFMessage": latest.fielddefs["tf2_msgs/msg/TFMessage"]})
            self.writer: Any = Writer1(self.path)
        else:
            plugin = StoragePlugin.SQLITE3 if kind == "sqlite3" else StoragePlugin.MCAP
            self.writer = Writer2(self.path, version=9, storage_plugin=plugin)

    def __enter__(self) -> Recorder:
        self.writer.open()
        return self

    def __exit__(self, *_: object) -> None:
        self.writer.close()

    def topic(self, name: str, kind: str, node: str = "/driver", qos: Qos = SENSOR) -> Any:
        if self.ros == 1:
            return self.writer.add_connection(name, kind, typestore=self.store, callerid=node, latching=0)
        return self.writer.add_connection(name, kind, typestore=self.store, offered_qos_profiles=[qos])

    def write(self, connection: Any, at_ns: int, message: Any) -> None:
        serialize = self.store.serialize_ros1 if self.ros == 1 else self.store.serialize_cdr
        self.writer.write(connection, at_ns, serialize(message, connection.msgtype))

    def type(self, name: str) -> Any:
        return self.store.types[name]

    def header(self, stamp_ns: int, frame: str) -> Any:
        time = self.type("builtin_interfaces/msg/Time")(stamp_ns // 10**9, stamp_ns % 10**9)
        sequence = {"seq": 0} if self.ros == 1 else {}
        return self.type("std_msgs/msg/Header")(stamp=time, frame_id=frame, **sequence)

    def transform(self, stamp_ns: int, parent: str, child: str, x: float = 0.0) -> Any:
        way = self.type("geometry_msgs/msg/Vector3")(x, 0.0, 0.0)
        turn = self.type("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, 1.0)
        pose = self.type("geometry_msgs/msg/Transform")(way, turn)
        return self.type("geometry_msgs/msg/TransformStamped")(self.header(stamp_ns, parent), child, pose)

    def transforms(self, *each: Any) -> Any:
        return self.type("tf2_msgs/msg/TFMessage")(list(each))

    def imu(self, stamp_ns: int, frame: str) -> Any:
        vector = self.type("geometry_msgs/msg/Vector3")(0.0, 0.0, 9.8)
        turn = self.type("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, 1.0)
        none = np.zeros(9)
        return self.type("sensor_msgs/msg/Imu")(self.header(stamp_ns, frame), turn, none, vector, none, vector, none)

    def diagnostics(self, stamp_ns: int, level: int, text: str) -> Any:
        value = [self.type("diagnostic_msgs/msg/KeyValue")("temperature", "91")]
        status = self.type("diagnostic_msgs/msg/DiagnosticStatus")(level, "base: motor", text, "m1", value)
        return self.type("diagnostic_msgs/msg/DiagnosticArray")(self.header(stamp_ns, ""), [status])


def times(count: int, period_ns: int = PERIOD_NS) -> Iterator[int]:
    return iter(range(START_NS, START_NS + count * period_ns, period_ns))
