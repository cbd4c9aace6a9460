"""Small packages in real git repositories: a provider in two releases, and consumers of it."""

from __future__ import annotations

from pathlib import Path

from git_repos import commit_all


def release(folder: Path, files: dict[str, str | None], tag: str) -> None:
    """Write files (None deletes), commit them and tag the commit."""
    folder.mkdir(parents=True, exist_ok=True)
    write(folder, files)
    commit_all(folder, tag)


def write(folder: Path, files: dict[str, str | None]) -> None:
    """Write files below a folder; None deletes."""
    for path, text in files.items():
        place = folder / path
        if text is None:
            place.unlink()
            continue
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        place.chmod(0o755 if text.startswith("#!") else 0o644)


def package(name: str, version: str = "1.0.0") -> str:
    """A package.xml of ROS 2."""
    return (
        f'<package format="3"><name>{name}</name><version>{version}</version><description>d</description>\n'
        "<maintainer email='a@b.c'>m</maintainer><license>Apache-2.0</license>\n"
        "<buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend>\n"
        "<export><build_type>ament_cmake</build_type></export></package>\n"
    )


def node(*lines: str) -> str:
    """A C++ node class `Arm` whose constructor holds these lines."""
    body = "\n".join(f"  {line}" for line in lines)
    return (
        "#include <rclcpp/rclcpp.hpp>\n#include <sensor_msgs/msg/joint_state.hpp>\n#include <std_msgs/msg/bool.hpp>\n"
        'class Arm : public rclcpp::Node {\npublic:\n  Arm() : Node("arm") {\n'
        f"{body}\n"
        "  }\n};\nint main(int argc, char ** argv) { rclcpp::spin(std::make_shared<Arm>()); }\n"
    )
