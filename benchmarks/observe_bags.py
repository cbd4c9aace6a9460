"""How fast recordings are read, and in how much memory: megabytes a second for each kind of bag.

python benchmarks/observe_bags.py [--mb 1000] [--message-kb 64]

Each bag holds images, which need no decoding; it is written into a temporary folder and read in a process of its own.
Speed is judged by the clock; processor time stands beside it, as it does not depend on who else is at work.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

MOST_MEMORY_MB = 300
LEAST_MB_S = 100


def _ros1(path: Path, compression: Any = None) -> Any:
    from rosbags.rosbag1 import Writer

    writer = Writer(path)
    if compression is not None:
        writer.set_compression(compression)
    return writer


def _ros2(path: Path, plugin: str, compression: str | None = None) -> Any:
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    writer = Writer(path, version=9, storage_plugin=StoragePlugin[plugin])
    if compression is not None:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat[compression])
    return writer


def _kinds() -> dict[str, Callable[[Path], Any]]:
    from rosbags.rosbag1 import Writer

    return {
        "ros1.bag": _ros1,
        "ros1-lz4.bag": lambda path: _ros1(path, Writer.CompressionFormat.LZ4),
        "sqlite3": lambda path: _ros2(path, "SQLITE3"),
        "mcap": lambda path: _ros2(path, "MCAP"),
        "mcap-zstd": lambda path: _ros2(path, "MCAP", "ZSTD"),
    }


def write(path: Path, writer: Any, megabytes: int, message_bytes: int) -> None:
    from rosbags.typesys import Stores, get_typestore

    ros1 = path.suffix == ".bag"
    store = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.LATEST)
    head = (b"\0" * 16) if ros1 else (b"\0\1\0\0" + b"\0" * 12)
    body = bytes(range(256)) * (message_bytes // 256)
    with writer:
        connection = writer.add_connection("/camera/image", "sensor_msgs/msg/Image", typestore=store)
        for number in range(megabytes * 1_000_000 // message_bytes):
            writer.write(connection, 1_700_000_000_000_000_000 + number * 10_000_000, head + body)


def read(path: Path) -> None:
    """Print seconds, seconds of the processor, messages, bytes and peak memory in megabytes."""
    from ecm_extract.observe.bag import observe_bags

    start, worked = time.perf_counter(), time.process_time()
    seen = observe_bags([path])
    seconds, worked = time.perf_counter() - start, time.process_time() - worked
    status = Path("/proc/self/status").read_text()
    peak = int(status.partition("VmHWM:")[2].split()[0]) / 1000
    print(seconds, worked, seen.streams[0].count, sum(stream.size for stream in seen.streams), peak)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mb", type=int, default=1000)
    parser.add_argument("--message-kb", type=int, default=64)
    parser.add_argument("--read", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.read:
        read(given.read)
        return
    all_fit = True
    for name, make in _kinds().items():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            write(path, make(path), given.mb, given.message_kb * 1024)
            command = [sys.executable, __file__, "--read", str(path)]
            words = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
            seconds, worked, count, size, peak = map(float, words)
            speed = size / 1e6 / seconds
            fits = speed >= LEAST_MB_S and peak <= MOST_MEMORY_MB
            all_fit = all_fit and fits
            verdict = "ok" if fits else "BELOW"
            busy = size / 1e6 / worked
            shown = f"{speed:6.0f} MB/s by the clock, {busy:6.0f} of processor time, peak {peak:4.0f} MB  {verdict}"
            print(f"{name:13} {size / 1e6:6.0f} MB {count:7.0f} messages {shown}")
    sys.exit(not all_fit)


if __name__ == "__main__":
    main()
