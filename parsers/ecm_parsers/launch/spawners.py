"""Helpers of `controller_manager.launch_utils` that start one spawner for the controllers they are given."""

from __future__ import annotations

from ecm_parsers.launch.model import Node
from ecm_parsers.launch.values import Description, command_words
from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.values import Value


def controller_spawner(given: Arguments) -> Value:
    """Return the spawner that a helper starts."""
    names = given.get("controller_names", 0) or given.get("controller_name", 0) or given.get("controller_info_dict", 0)
    listed = list(names) if isinstance(names, list | tuple | dict) else [names]
    files = given.get("controller_params_files") or given.get("controller_params_file", 1) or []
    if isinstance(names, dict):
        files = [file for value in names.values() for file in (value if isinstance(value, list) else [value])]
    options = [word for file in (files if isinstance(files, list) else [files]) for word in ("--param-file", file)]
    extra = given.get("extra_spawner_args", default=[])
    words = [*listed, *options, *(extra if isinstance(extra, list) else [])]
    spawner = Node(
        line=given.line,
        kind="node",
        package=("controller_manager",),
        executable=("spawner",),
        arguments=command_words([word for word in words if word is not None]),
    )
    return Description([spawner])
