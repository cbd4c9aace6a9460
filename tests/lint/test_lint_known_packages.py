"""The table of names that rosdep knows, and how it is made."""

from __future__ import annotations

from pathlib import Path

from ecm_extract.lint.known_packages import collected, known_packages


def test_the_table_tells_both_ros_and_keys_apart() -> None:
    """Names whose place is well known."""
    known = known_packages()
    assert {name: known.get(name) for name in ("roscpp", "rclcpp", "xacro", "eigen", "no_such_package")} == {
        "roscpp": "1",
        "rclcpp": "2",
        "xacro": "12",
        "eigen": "k",
        "no_such_package": None,
    }


def test_it_is_made_from_distributions_and_keys(tmp_path: Path) -> None:
    """Packages of a repository, a repository that is its one package, one that only has sources, and keys."""
    files = {
        "noetic/distribution.yaml": "repositories:\n  many:\n    release:\n      packages: [one, two]\n",
        "humble/distribution.yaml": "repositories:\n  two:\n    release: {version: 1.0.0}\n  three: {source: {}}\n",
        "rosdep/base.yaml": "boost: {ubuntu: [libboost-all-dev]}\n",
        "rosdep/python.yaml": "python3-yaml: {ubuntu: [python3-yaml]}\n",
        "rosdep/ruby.yaml": "",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    assert collected(tmp_path) == {"boost": "k", "one": "1", "python3-yaml": "k", "three": "2", "two": "12"}
