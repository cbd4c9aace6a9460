"""The manifests and the two motivating scenarios of the paper."""

from __future__ import annotations

import msgspec
from ecm_checker.baselines import schema_only, schema_only_upgrade, semver_only
from ecm_checker.contract import Contract
from ecm_checker.operations.chain import chain
from ecm_checker.operations.install import install
from ecm_checker.operations.invoke import invoke
from ecm_checker.operations.upgrade import upgrade
from ecm_checker.outcome import Report
from ecm_checker.profiles import Call, Embodiment, Profiles, Runtime
from ecm_checker.view import view
from rule_fixtures import ROOT, contract, profile, profiles

PAPER = ROOT / "fixtures" / "paper"
UPGRADE = PAPER / "scenario_upgrade"


def run_chain(scenario: str) -> tuple[list[Contract], Report]:
    folder = PAPER / scenario
    modules = [contract(path) for path in sorted(folder.glob("*.ecm.yaml"))]
    return modules, chain(modules, profiles(folder))


def errors(report: Report) -> set[tuple[str, str]]:
    return {(each.name, each.dimension) for each in report.findings if each.severity == "error"}


def test_listings_load() -> None:
    """What the paper writes is understood field by field."""
    navigation = view(contract(PAPER / "manifests" / "navigation_precise.ecm.yaml"))
    assert navigation.id == "ecm.navigation.precise"
    assert navigation.timing == {"ctrl_hz": 20}
    assert navigation.physical == {"motion": True, "restricted_zone": False}
    assert navigation.retry is not None
    assert navigation.retry.count == 1
    grasp = view(contract(PAPER / "manifests" / "precision_grasp.ecm.yaml"))
    assert [field.frame for field in grasp.inputs or ()] == ["base_link", None]
    assert [field.optional for field in grasp.inputs or ()] == [False, True]
    assert dict(grasp.failure_modes or {})["excessive_force"] == "critical"
    assert grasp.escalation is not None
    assert grasp.escalation[0].action == "emergency_stop"


def test_navigation_is_not_called_when_localization_dropped() -> None:
    """A module may be installed yet not currently safe to call."""
    navigation = contract(PAPER / "manifests" / "navigation_precise.ecm.yaml")
    inputs = [{"target_pose": {"type": "Pose3D", "frame": "map"}}, {"tolerance": "Float"}]
    state = {"localization_confidence": 0.95, "base_ready": True}
    call = Call(inputs=inputs, state=state, handles=("*",))
    assert invoke(navigation, call).outcome == "accept"
    lost = msgspec.structs.replace(call, state={**state, "localization_confidence": 0.7})
    assert errors(invoke(navigation, lost)) == {("precondition_not_established", "behavior")}


def test_composition_failure_has_its_four_conflicts() -> None:
    """Navigate, grasp, handover: frame, sensor, permission and recovery, and nothing else; schemas see none."""
    modules, report = run_chain("scenario_composition")
    assert report.outcome == "reject"
    assert errors(report) == {
        ("frame_mismatch", "signature"),
        ("sensor_missing", "resources"),
        ("human_contact_not_permitted", "permissions"),
        ("recovery_conflict", "recovery"),
    }
    assert schema_only(modules) == "accept"


def test_composition_twin_is_accepted() -> None:
    """With the transform, the sensor, the permission and one answer to the failure it runs."""
    _, report = run_chain("scenario_composition_twin")
    assert report.outcome == "accept"
    assert not [each for each in report.findings if each.severity != "info"]


def test_switching_a_dimension_off_hides_its_conflict() -> None:
    """Ablation: a dimension that is not consulted finds nothing."""
    folder = PAPER / "scenario_composition"
    modules = [contract(path) for path in sorted(folder.glob("*.ecm.yaml"))]
    report = chain(modules, profiles(folder), ("signature", "behavior", "permissions", "recovery"))
    assert "resources" not in {each.dimension for each in report.findings}
    assert report.dimensions == ("signature", "behavior", "permissions", "recovery")


def test_upgrade_failure() -> None:
    """GPU, changed recovery, an added output: breaking for the robot although the schema is the same."""
    old, new = contract(UPGRADE / "old.ecm.yaml"), contract(UPGRADE / "new.ecm.yaml")
    robot = profile(UPGRADE / "embodiment.yaml", Embodiment)
    report = upgrade(old, new, Profiles(embodiment=robot))
    said = {(each.name, each.severity) for each in report.findings}
    assert report.outcome == "reject"
    assert said == {("resource_demand_grew", "error"), ("recovery_changed", "warning"), ("output_added", "info")}
    assert schema_only_upgrade(old, new) == "accept"
    relabelled = msgspec.structs.replace(new, ecm=msgspec.structs.replace(new.ecm, version="1.1.0"))
    assert semver_only(old, relabelled) == "accept"


def test_upgrade_without_a_robot_is_reviewed() -> None:
    """Whether there is a GPU is not known: neither fine nor wrong."""
    old, new = contract(UPGRADE / "old.ecm.yaml"), contract(UPGRADE / "new.ecm.yaml")
    assert upgrade(old, new).outcome == "review"


def test_patch_is_accepted() -> None:
    """A release that changes no dimension goes through."""
    old, new = contract(UPGRADE / "old.ecm.yaml"), contract(UPGRADE / "patch.ecm.yaml")
    assert upgrade(old, new, Profiles(runtime=Runtime())).outcome == "accept"


def test_incomplete_contract_is_reviewed_on_installation() -> None:
    """The listing of the paper is simplified: what it leaves out is named."""
    report = install(contract(PAPER / "manifests" / "navigation_precise.ecm.yaml"))
    assert report.outcome == "review"
    assert "recovery.escalation" in report.findings[0].message
    assert report.not_asked
