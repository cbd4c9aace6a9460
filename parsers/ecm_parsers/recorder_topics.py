"""What a rosbag2 recorder node records, from the `record:` parameters of its parameter file.

Source: the README of rosbag2, "Using in launch" and "composable recorder"; `ros2 bag record` for the meaning of
the options. Command lines of the recorder are not read here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Final

import msgspec

from ecm_parsers.parameter_yaml import ParameterSet, parse_parameter_yaml
from ecm_parsers.result import Diagnostic, Parsed, Severity, shortened

MAX_DIAGNOSTICS = 100
_PREFIX: Final = "record."
_LISTS: Final = (
    "topics",
    "topic_types",
    "services",
    "actions",
    "exclude_topics",
    "exclude_topic_types",
    "exclude_services",
    "exclude_actions",
)
_FLAGS: Final = ("all", "all_topics", "all_services", "all_actions", "include_hidden_topics", "is_discovery_disabled")
_TEXTS: Final = ("regex", "exclude", "exclude_regex", "node_prefix", "qos_profile_overrides_path")
_SELECTING: Final = (
    "all",
    "all_topics",
    "all_services",
    "all_actions",
    "include_hidden_topics",
    "regex",
    "topics",
    "topic_types",
    "services",
    "actions",
)
_TYPES: Final[dict[str, tuple[str, ...]]] = {
    **dict.fromkeys(_LISTS, ("string_array",)),
    **dict.fromkeys(_FLAGS, ("bool",)),
    **dict.fromkeys(_TEXTS, ("string",)),
}
_KINDS: Final = {"string_array": "a list of text", "bool": "true or false", "string": "text"}


class Recorder(msgspec.Struct, frozen=True):
    """What one section of a parameter file tells a recorder; several sections may hold for one node.

    Attributes:
        node: absolute name or pattern of the recorder.
        all_topics, all_services, all_actions: whether all that is not excluded is recorded.
        topics, topic_types, services, actions: what is recorded by name, or by type of the topic.
        regex: of names that are recorded; empty without one.
        exclude_topics, exclude_topic_types, exclude_services, exclude_actions, exclude_regex: what is left out.
        include_hidden_topics: whether names with a leading `_` count.
        discovers: whether topics that appear later are recorded too.
        qos_overrides: path of the file with the QoS of the subscriptions; empty without one.
        storage_uri: where the bag is written; empty without one.
        lines: 1-based line by parameter below `record`, such as `topics`. line: the first of them.
    """

    node: str
    all_topics: bool
    all_services: bool
    all_actions: bool
    topics: tuple[str, ...]
    topic_types: tuple[str, ...]
    services: tuple[str, ...]
    actions: tuple[str, ...]
    regex: str
    exclude_topics: tuple[str, ...]
    exclude_topic_types: tuple[str, ...]
    exclude_services: tuple[str, ...]
    exclude_actions: tuple[str, ...]
    exclude_regex: str
    include_hidden_topics: bool
    discovers: bool
    qos_overrides: str
    storage_uri: str
    lines: dict[str, int]
    line: int


def is_recorder(data: bytes) -> bool:
    """Tell by its words whether a YAML file may configure a recorder."""
    return b"record" in data and b"ros__parameters" in data


def parse_recorder(data: bytes) -> Parsed[tuple[Recorder, ...]]:
    """Read the recorders of a ROS 2 parameter file, one per section with `record` parameters."""
    parsed = parse_parameter_yaml(data)
    problems = list(parsed.diagnostics)
    sections: dict[str, dict[str, ParameterSet]] = {}
    for entry in parsed.facts.sets if parsed.facts.ros == 2 else ():
        sections.setdefault(entry.node or "/**", {})[entry.name] = entry
    found = tuple(
        _recorder(node, section, problems) for node, section in sections.items() if _is_recorder(section.values())
    )
    return Parsed(found, shortened(problems, MAX_DIAGNOSTICS))


def _is_recorder(section: Iterable[ParameterSet]) -> bool:
    return any(entry.name.startswith(_PREFIX) and entry.name.removeprefix(_PREFIX) in _TYPES for entry in section)


def _recorder(node: str, section: Mapping[str, ParameterSet], problems: list[Diagnostic]) -> Recorder:
    sets = {name.removeprefix(_PREFIX): entry for name, entry in section.items() if name.startswith(_PREFIX)}
    values = {name: entry.value for name, entry in sets.items() if name in _TYPES and _fits(name, entry, problems)}
    lines = {name: entry.line for name, entry in sets.items()}
    lists = {name: tuple(str(item) for item in values.get(name, ())) for name in _LISTS}
    storage = section.get("storage.uri")
    recorder = Recorder(
        node=node,
        all_topics=values.get("all_topics", values.get("all", False)),
        all_services=values.get("all_services", False),
        all_actions=values.get("all_actions", False),
        regex=values.get("regex", ""),
        exclude_regex=values.get("exclude_regex", values.get("exclude", "")),
        include_hidden_topics=values.get("include_hidden_topics", False),
        discovers=not values.get("is_discovery_disabled", False),
        qos_overrides=values.get("qos_profile_overrides_path", ""),
        storage_uri=storage.value if storage is not None and isinstance(storage.value, str) else "",
        lines=lines,
        line=min(lines.values()),
        **lists,
    )
    _check(recorder, values, section.get("use_sim_time"), problems)
    return recorder


def _fits(name: str, entry: ParameterSet, problems: list[Diagnostic]) -> bool:
    """Tell whether a value has the type that the node declares; launch substitutions may become any."""
    if entry.type in _TYPES[name] or entry.value == [] or entry.value is None:
        return entry.value is not None
    if isinstance(entry.value, str) and "$(" in entry.value:
        return False
    wanted = _KINDS[_TYPES[name][0]]
    message = f"`record.{name}` must be {wanted}, the recorder does not start otherwise. Correct the value."
    _report(problems, "error", "recorder-wrong-type", entry.line, message)
    return False


def _check(
    recorder: Recorder, values: Mapping[str, Any], sim_time: ParameterSet | None, problems: list[Diagnostic]
) -> None:
    if not any(values.get(name) for name in _SELECTING) and not set(_SELECTING) & (set(recorder.lines) - set(values)):
        message = "Nothing says what is recorded. Add `topics`, `regex` or `all_topics`."
        _report(problems, "warning", "recorder-records-nothing", recorder.line, message)
    if sim_time is not None and sim_time.value is True and not recorder.discovers:
        message = "`use_sim_time` needs discovery of /clock, the recorder does not start. Remove one of the two."
        _report(problems, "error", "recorder-sim-time", sim_time.line, message)


def _report(problems: list[Diagnostic], severity: Severity, code: str, line: int, message: str) -> None:
    problems.append(Diagnostic(severity, code, line, message))
