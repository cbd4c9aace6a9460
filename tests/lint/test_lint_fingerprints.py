"""A fingerprint stands for one cause of one subject: who accepts it has accepted nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest
from ecm_checker.finding import Finding
from ecm_checker.release import Change, fingerprint_of

from ecm_extract.extraction_model import Options
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import open_tree

MANIFEST = "<package format='2'><name>arm_description</name><version>1.0.0</version></package>"
ROBOT = """<robot name="{robot}">
  <joint name="wheel" type="fixed"><origin rpy="-1.57 0 0"/><parent link="a"/><child link="b"/></joint>
</robot>
"""
PART = """<robot>
  <macro name="{robot}">
    <joint name="wheel" type="fixed"><origin rpy="-1.57 0 0"/><parent link="a"/><child link="b"/></joint>
  </macro>
</robot>
"""


def linted(folder: Path, files: dict[str, str], rule: str) -> list[Finding]:
    """Findings of one rule over a package with these files."""
    for path, text in {"package.xml": MANIFEST, **files}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return findings_of(Workspace(open_tree(folder), Options()), (rule,))


@pytest.mark.parametrize("form", [ROBOT, PART])
def test_each_robot_is_a_subject(form: str, tmp_path: Path) -> None:
    """The same joint of three robots of one package is three findings to accept."""
    files = {f"urdf/{name}.urdf": form.format(robot=name) for name in ("small", "tall", "wide")}
    found = linted(tmp_path, files, "LNT038")
    assert len(found) == 3
    assert len({each.fingerprint for each in found}) == 3


def test_a_path_is_no_subject(tmp_path: Path) -> None:
    """A file that moves keeps its exceptions."""
    before = linted(tmp_path / "a", {"urdf/arm.urdf": ROBOT.format(robot="arm")}, "LNT038")
    after = linted(tmp_path / "b", {"robots/new/arm.urdf": "<!-- moved -->\n" + ROBOT.format(robot="arm")}, "LNT038")
    assert [each.fingerprint for each in before] == [each.fingerprint for each in after]


def change(**fields: object) -> Change:
    plain = {
        "kind": "parameter",
        "change": "type_changed",
        "package": "p",
        "owner": "n",
        "old": "rate",
        "new": "rate",
        "breaking": True,
        "dimension": "versioning",
        "old_value": "integer",
        "new_value": "double",
    }
    return Change(**(plain | fields))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "field",
    [{"owner": "other"}, {"package": "q"}, {"change": "deprecated"}, {"new": "hz"}, {"new_value": "string"}],
)
def test_another_change_is_another_fingerprint(field: dict[str, str]) -> None:
    """Accepting a deprecation accepts no removal, and accepting one type does not accept the next."""
    assert fingerprint_of(change()) != fingerprint_of(change(**field))


def test_how_a_change_is_told_makes_no_difference() -> None:
    """Wording, confidence and lines may get better without costing anybody an exception."""
    assert fingerprint_of(change()) == fingerprint_of(change(reason="other words", confidence=0.5))
