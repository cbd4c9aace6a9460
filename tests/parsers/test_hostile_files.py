"""Files that somebody made to hurt: each parser of settings ends at once and says what it left out."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, Final

import pytest
from ecm_parsers.behavior_tree import parse_behavior_tree
from ecm_parsers.controllers_yaml import parse_controllers
from ecm_parsers.diagnostics_yaml import parse_diagnostics
from ecm_parsers.recorder_topics import parse_recorder
from ecm_parsers.result import Parsed
from ecm_parsers.sros_policy import parse_policy

ALIASES: Final = b"a: &a [x,x,x,x,x,x,x,x,x]\n" + b"".join(
    b"%c: &%c [%s]\n" % (97 + n, 97 + n, b",".join([b"*%c" % (96 + n)] * 9)) for n in range(1, 9)
)
ENTITIES: Final = b'<!DOCTYPE r [<!ENTITY a "b"><!ENTITY c "&a;&a;">]>'
NULS: Final = b"\0" * 1000
DEEP: Final = 10_000
ROWS: Final = [
    (parse_behavior_tree, ENTITIES + b"<root>&c;</root>", "xml-entity"),
    (parse_behavior_tree, b"<root><BehaviorTree ID='A'>" + b"<Sequence>" * DEEP, "xml-"),
    (parse_behavior_tree, b"<root><BehaviorTree ID='A'>\0</BehaviorTree>\0</root>", ""),
    (parse_behavior_tree, NULS, ""),
    (parse_controllers, ALIASES, "yaml-limit"),
    (parse_controllers, b"controller_manager: {ros__parameters: " + b"{x: " * DEEP, "yaml-limit"),
    (parse_controllers, b"arm: " + b"[" * DEEP, "yaml-limit"),
    (parse_controllers, b"arm: \0{type: \0}", ""),
    (parse_controllers, NULS, ""),
    (parse_diagnostics, ALIASES, "yaml-limit"),
    (parse_diagnostics, b"analyzers: " + b"{x: " * DEEP, "yaml-limit"),
    (parse_diagnostics, b"analyzers: " + b"[" * DEEP, "yaml-limit"),
    (parse_diagnostics, b"analyzers: \0{x: \0}", ""),
    (parse_diagnostics, NULS, ""),
    (parse_policy, ENTITIES + b"<policy>&c;</policy>", "xml-entity"),
    (parse_policy, b"<policy>" + b"<profile>" * DEEP, "xml-"),
    (parse_policy, b"<policy>\0<profiles>\0</profiles></policy>", ""),
    (parse_policy, NULS, ""),
    (parse_recorder, ALIASES, "yaml-limit"),
    (parse_recorder, b"n: {ros__parameters: {record: " + b"{x: " * DEEP, "yaml-limit"),
    (parse_recorder, b"n: {ros__parameters: {record: {topics: " + b"[" * DEEP, "yaml-limit"),
    (parse_recorder, b"n: \0{ros__parameters: \0{record: {topics: [\0]}}}", ""),
    (parse_recorder, NULS, ""),
]


@pytest.mark.parametrize(("parse", "data", "code"), ROWS)
def test_hostile(parse: Callable[[bytes], Parsed[Any]], data: bytes, code: str) -> None:
    """Bombs of aliases or entities, deep nesting and NULs are a diagnostic in less than a second."""
    started = time.process_time()
    found = [entry.code for entry in parse(data).diagnostics]
    assert time.process_time() - started < 1
    assert any(entry.startswith(code) for entry in found)
