"""What a person declares is laid over what was read; contradictions are told."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from diagnosed import is_told
from ecm_checker.contract import Contract
from ecm_checker.fields import FIELDS, FieldRow
from ecm_checker.overlay import is_declarable
from ecm_parsers.overlay_yaml import parse_overlay
from hypothesis import given, settings
from hypothesis import strategies as st
from workspaces import Workspace

from ecm_extract.cli.run import run
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Extraction, Options
from ecm_extract.overlay.drift import contradiction
from ecm_extract.overlay.template import examples
from ecm_extract.tree import open_tree

NODE = """
#include <rclcpp/rclcpp.hpp>
class N : public rclcpp::Node {
public:
  N() : Node("n") {
    declare_parameter<double>("cmd_vel_timeout", 0.5);
    declare_parameter<double>("server_timeout", 0.5);
    create_service<std_srvs::srv::Trigger>("stop", f);
    create_subscription<sensor_msgs::msg::LaserScan>("scan", 10, f);
  }
};
"""


SCHEMA = "schema: ecm-extract/overlay/1\n"


def extraction(workspace: Workspace, overlay: str, source: str = NODE) -> Extraction:
    """With the line that says what the file is at its end, so that lines count as they are written."""
    text = overlay if "schema" in overlay or overlay.startswith("[") else f"{overlay.rstrip()}\n{SCHEMA}"
    workspace.package({"src/n.cpp": source, "ecm.yaml": text})
    return extract(open_tree(workspace.root), Options(jobs=1))


def module(found: Extraction) -> Contract:
    return found.packages[0].modules[0]


def test_declared_takes_the_place_of_inferred(workspace: Workspace) -> None:
    """With its line, and no longer missing."""
    text = "modules:\n  n:\n    behavior:\n      postconditions: [stopped]\n    signature: {timeout_ms: 500}\n"
    found = module(extraction(workspace, text))
    assert found.behavior.postconditions is not None
    assert (found.behavior.postconditions.value, found.behavior.postconditions.origin) == (["stopped"], "declared")
    assert [(entry.path, entry.line) for entry in found.behavior.postconditions.evidence] == [("pkg/ecm.yaml", 4)]
    assert "behavior.postconditions" not in found.missing
    assert found.signature.timeout_ms is not None
    assert found.signature.timeout_ms.origin == "declared"


def test_all_and_defaults(workspace: Workspace) -> None:
    """`all` declares for every module, `defaults` only fill what is left, under their name."""
    text = (
        "all: {permissions: {audit: standard}}\n"
        "defaults:\n  name: lab\n  recovery: {retry: {max: 1}}\n  signature: {timeout_ms: 9}\n"
    )
    found = module(extraction(workspace, text))
    assert found.permissions.audit is not None
    assert found.permissions.audit.origin == "declared"
    assert found.recovery.retry is not None
    assert found.recovery.retry.origin == "default"
    assert found.signature.timeout_ms is not None
    assert found.signature.timeout_ms.origin == "inferred"


@pytest.mark.parametrize(
    ("text", "code", "hint"),
    [
        ("modules: {n: {signature: {timeout_ms: 900}}}", "drift", "900 here, 500.0 there"),
        ("modules: {n: {resources: {sensors: [imu]}}}", "drift", "lidar is left out"),
        ("modules: {n: {resources: {sensor: [imu]}}}", "overlay-unknown-field", "resources.sensors"),
        ("modules: {m: {resources: {sensors: [lidar]}}}", "overlay-unknown-module", "Remove it"),
        ("modules: {n: {resource: {sensors: [lidar]}}}", "overlay-unknown-section", "resources"),
        ("module: {}", "overlay-unknown-key", "modules"),
        ("[1]", "overlay-not-a-map", "modules"),
        ("modules: [n]", "overlay-not-a-map", "`modules` is no map"),
        ("modules: {n: 5}", "overlay-not-a-map", "`n` is no map"),
        ("all: {signature: 5}", "overlay-not-a-map", "`signature` is no map"),
        ("schema: ecm-extract/overlay/2\nmodules: {m: {}}", "overlay-schema", "Write `schema: ecm-extract/overlay/1`"),
        ("schema: [1]", "overlay-schema", "nothing of this file is used"),
        ("modules: {n: {}} # no schema", "overlay-schema", "Begin with `schema: ecm-extract/overlay/1`"),
        ("modules: {n: {signature: {timeout_ms: fast}}}", "overlay-wrong-value", "Write it like `timeout_ms: 5000`"),
        ("modules: {n: {signature: {timeout_ms: -1}}}", "overlay-wrong-value", "how long a call may take"),
        ("all: {recovery: {retry: lots}}", "overlay-wrong-value", "cannot be 'lots'"),
        ("defaults: {recovery: {retry: {min: 2}}}", "overlay-wrong-value", "such a list or map"),
        ("all: {versioning: {policy_change: maybe}}", "overlay-wrong-value", "`policy_change: false`"),
    ],
)
def test_what_is_wrong_is_told(text: str, code: str, hint: str, workspace: Workspace) -> None:
    """A misspelt name is not silently without effect, a contradiction names both lines."""
    (problem,) = extraction(workspace, text).diagnostics
    assert problem.code == code
    assert hint in problem.message
    assert problem.path == "pkg/ecm.yaml"


@pytest.mark.parametrize(
    ("declared", "inferred", "differs"),
    [
        ([1, 2], [1], False),
        ([2], [1], True),
        ("a", ["a"], False),
        ({"a": 1, "b": 2}, {"a": 1}, False),
        ({"b": 2}, {"a": 1}, False),
        ({"a": 2}, {"a": 1}, True),
        (1, 1.0, False),
        (True, 1, True),
        ("x", "y", True),
    ],
)
def test_contradiction(declared: object, inferred: object, differs: bool) -> None:
    """More detail is no contradiction, another value is."""
    assert (contradiction(declared, inferred) is not None) is differs


def test_init_writes_what_is_missing_and_reads_it_back(
    workspace: Workspace, capsys: pytest.CaptureFixture[str]
) -> None:
    """The file declares nothing as it is, every line of it can be uncommented, and it is never written twice."""
    workspace.package({"src/n.cpp": NODE})
    assert run(["init", str(workspace.root)]) == 0
    path = workspace.root / "pkg" / "ecm.yaml"
    text = path.read_text()
    assert "# sensors:" not in text  # that was read
    assert parse_overlay(text.encode()).facts.modules[0].fields == ()
    declared = parse_overlay(_uncommented(text).encode())
    assert declared.diagnostics == ()
    assert {f"{entry.section}.{entry.field}" for entry in declared.facts.modules[0].fields} == set(
        module(extract(open_tree(workspace.root), Options(jobs=1))).missing
    )
    path.write_text("modules: {}\n")
    assert run(["init", str(workspace.root)]) == 0
    assert path.read_text() == "modules: {}\n"
    assert "left alone" in capsys.readouterr().err


def _uncommented(text: str) -> str:
    return "\n".join(
        line.replace("# ", "", 1) if line.startswith("      # ") and ": " in line else line
        for line in text.splitlines()
    )


def test_init_of_an_unknown_package(tmp_path: Path, workspace: Workspace) -> None:
    """A misspelt name is the user's error."""
    workspace.package({"src/n.cpp": NODE})
    assert run(["init", str(workspace.root), "--package", "no"]) == 2


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="modulesa:{}[],- \n", max_size=80))
def test_never_raises(text: str) -> None:
    """No text breaks the parser."""
    for data in (text.encode(), f"modules: {text}".encode()):
        assert is_told(data, parse_overlay(data))


def test_what_cannot_be_meant_stays_undeclared(workspace: Workspace) -> None:
    """The rest of the file is used all the same."""
    text = "modules:\n  n:\n    signature: {timeout_ms: fast}\n    permissions: {audit: standard}\n"
    found = module(extraction(workspace, text))
    assert found.signature.timeout_ms is not None
    assert found.signature.timeout_ms.origin == "inferred"
    assert found.permissions.audit is not None


def test_a_file_of_another_schema_is_not_used(workspace: Workspace) -> None:
    """Its fields may mean something else."""
    found = module(extraction(workspace, "schema: ecm-extract/overlay/9\nall: {permissions: {audit: standard}}"))
    assert found.permissions.audit is None


@pytest.mark.parametrize("row", [row for row in FIELDS if not row.path.startswith("ecm.")], ids=lambda row: row.path)
def test_every_field_has_an_example_that_can_be_declared(row: FieldRow) -> None:
    """An error shows it, so it must be right."""
    section, _, field = row.path.partition(".")
    value = yaml.safe_load(examples()[row.path])
    assert is_declarable(section, field, value)


@pytest.mark.parametrize("command", ["extract", "check", "lint"])
def test_each_command_tells_of_each_mistake(
    command: str, workspace: Workspace, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two contradictions were one line of a summary, a wrong value was none, and the status was that of success."""
    text = (
        "modules:\n  n:\n    signature:\n      timeout_ms: fast\n      invocation_mode: x\n"
        f"    resources: {{sensors: [imu]}}\n{SCHEMA}"
    )
    workspace.package({"src/n.cpp": NODE, "ecm.yaml": text})
    status = run([command, str(workspace.root), *(["--format", "summary"] if command == "extract" else [])])
    out, err = capsys.readouterr()
    assert status == (1 if command == "lint" else 2)
    told = out if command == "lint" else err
    assert [f"pkg/ecm.yaml:{line}: " in told for line in (4, 5, 6)] == [True] * 3


def test_a_contradiction_alone_is_no_wrong_input(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    """The source may be what has to change."""
    workspace.package({"src/n.cpp": NODE, "ecm.yaml": f"{SCHEMA}all: {{resources: {{sensors: [imu]}}}}\n"})
    assert run(["check", str(workspace.root)]) == 0
    assert "pkg/ecm.yaml:2: warning: " in capsys.readouterr().err


OPEN = """
#include <rclcpp/rclcpp.hpp>
class N : public rclcpp::Node {
public:
  N() : Node("n") { create_publisher<std_msgs::msg::String>(std::string("/") + getenv("ROBOT") + "/state", 10); }
};
"""


def test_what_was_seen_fills_what_is_open(workspace: Workspace) -> None:
    """One endpoint for each name that was seen, as sure as a default; what the contract knows stays."""
    before = extraction(workspace, "", OPEN)
    (open_end,) = [each for each in module(before).signature.interfaces if each.role == "publisher"]
    assert "{" in open_end.name
    seen = "".join(
        f"    - {{role: publisher, was: '{open_end.name}', name: {name}, type: wrong/msg/Type}}\n"
        for name in ("/r1/state", "/r2/state")
    )
    text = f"origin: observed\nmodules:\n  n:\n    endpoints:\n{seen}    behavior: {{rates: {{/r1/state: 20.0}}}}\n"
    found = module(extraction(workspace, text, OPEN))
    ends = [each for each in found.signature.interfaces if each.role == "publisher"]
    assert [(each.name, each.type, each.confidence) for each in ends] == [
        ("/r1/state", "std_msgs/msg/String", "default"),
        ("/r2/state", "std_msgs/msg/String", "default"),
    ]
    assert found.behavior.rates is not None
    assert found.behavior.rates.origin == "observed"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("origin: guessed\n", "overlay-unknown-origin"),
        ("modules: {n: {endpoints: [{role: publisher}]}}\n", "overlay-endpoint"),
        ("modules: {n: {endpoints: [7]}}\n", "overlay-endpoint"),
    ],
)
def test_what_is_no_observation(text: str, code: str) -> None:
    """A key that means nothing is a diagnostic, and costs nothing else."""
    assert [each.code for each in parse_overlay(f"{text}{SCHEMA}".encode()).diagnostics] == [code]
