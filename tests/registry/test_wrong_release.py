"""Ways in which a release could pass that must not: each was open once, or is what somebody would try."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from ecm_checker.hub.package import Package
from ecm_checker.profiles import Profiles
from ecm_checker.wire import NotRead
from sample import driver, manifest, packages, panel, published
from scenario import contract, package
from sqlalchemy import select, update
from test_gates import PANEL, TOPIC, Bench

from ecm_extract.cli.run import run
from ecm_extract.diff.migration import Migration
from ecm_extract.registry.evidence import Statement, add_evidence, stated
from ecm_extract.registry.fit import fit
from ecm_extract.registry.gates import Waiver
from ecm_extract.registry.migration_documents import keep_migration
from ecm_extract.registry.promotion import waive
from ecm_extract.registry.resolution import NoResolutionError, resolve
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.sides import two_sides
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import EvidenceRow, MigrationRow, Release, Standing, WaiverRow
from ecm_extract.registry.verify import verify
from ecm_extract.registry.wishes import Wish

GAP = NotRead("delivery/grasp.py", "too-large", carries=True)


def _release(version: str, *contracts: Any, **rest: Any) -> Package:
    return package(version, *(contracts or (contract(),)), **{"provides": (TOPIC,), **rest})


def _shown(registry: Registry, new: Package, old: Package | None = None) -> Bench:
    bench = Bench(registry, new, old)
    bench.show("validation", "upgrade_test", "policy_review", "rollback_test")
    bench.show("policy_review", by="Grace")
    return bench


def test_what_breaks_the_channel_is_told_though_a_release_between_broke_it_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """2.0.1 changes nothing against 2.0.0, which never left the sandbox, and everything for those who run 1.0.0."""
    monkeypatch.setenv("ECM_REGISTRY", str(tmp_path / "registry.sqlite"))
    with Registry.create() as registry:
        published(registry, packages(tmp_path / "a", {**driver(), **panel()}))
        for number, version in enumerate(("2.0.0", "2.0.1")):
            published(registry, packages(tmp_path / str(number), driver(version, topic="status")))
        with registry.writing() as session:
            for release in session.scalars(select(Release).filter_by(version="1.0.0")):
                session.get_one(Standing, release.id).channel = "beta"
    capsys.readouterr()
    run(["promote", "driver@2.0.1", "--to", "beta", "--format", "json"])
    found = json.loads(capsys.readouterr().out)
    assert found["compatibility_class"] == "breaking"
    reasons = {each["gate"]: each["reasons"] for each in found["gates"] if each["state"] == "refused"}
    assert "it is breaking and brings no migration" in reasons["compatibility"]


def test_a_new_module_asks_for_permissions_and_resources(small: Registry) -> None:
    """It was not there before, so all that it asks for is new."""
    base = contract()
    more = contract(permissions__physical={"motion": True, "zone": "lab"}, resources__compute={"cpu_cores": 4})
    identity = msgspec.structs.replace(more.ecm, module_id="ecm.delivery.second")
    second = msgspec.structs.replace(more, ecm=identity)
    bench = Bench(small, _release("1.1.0", base, second))
    assert {"policy", "resource"} <= bench.refused("beta")


def test_of_a_first_release_every_permission_is_new(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nobody has reviewed what it may do."""
    monkeypatch.setenv("ECM_REGISTRY", str(tmp_path / "registry.sqlite"))
    with Registry.create() as registry:
        published(registry, (_release("1.0.0"),))
    run(["promote", "delivery@1.0.0", "--to", "beta"])
    assert "refused  policy" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("new", "old", "gate", "channel"),
    [
        pytest.param({"unread": (GAP,)}, {}, "contract", "beta", id="of the release"),
        pytest.param({}, {"unread": (GAP,)}, "compatibility", "stable", id="of the release before"),
    ],
)
def test_what_was_not_read_is_not_complete(
    small: Registry, new: dict[str, Any], old: dict[str, Any], gate: str, channel: str
) -> None:
    """A file that was not read may declare anything."""
    bench = _shown(small, _release("1.0.1", **new), _release("1.0.0", **old))
    assert gate in bench.refused(channel)


def test_who_could_not_be_read_may_break(small: Registry) -> None:
    """A topic is gone: of who was read in part only nobody knows that nothing breaks."""
    partly = msgspec.structs.replace(PANEL, version="1.1.0", unread=(GAP,))
    depends = contract(versioning__dependencies={"delivery": "*"})
    identity = msgspec.structs.replace(depends.ecm, package="panel", module_id="ecm.panel.show")
    user = package("1.1.0", msgspec.structs.replace(depends, ecm=identity))
    bench = _shown(small, _release("1.0.1", provides=()), _release("1.0.0"))
    quiet = msgspec.structs.replace(partly, modules=user.modules, requires=())
    published(small, (quiet,))
    verdict = bench.judge("stable", scope=("panel",))
    assert "panel@1.1.0 delivery/grasp.py was not read: too-large" in str(verdict.gates)


def test_a_fit_with_who_was_not_read_is_a_doubt(small: Registry) -> None:
    """What a release lost is not known where a file of it was not read."""
    published(small, (_release("1.0.0"),))
    published(small, (_release("1.0.1", unread=(GAP,)),))
    with small.reading() as session:
        found = fit(session, [two_sides(session, "delivery", None)], EVERYTHING)
    assert {each.release for impact in found.impacts for each in impact.doubts} == {"delivery@1.0.1"}
    assert found.outcome == "review"


def test_nobody_says_that_some_robot_has_what_it_needs(small: Registry) -> None:
    """A module that needs sensors and arms is not tested without a robot that has them."""
    bench = _shown(small, _release("1.0.1"))
    assert "resource" not in bench.refused("stable")
    assert "resource" in bench.refused("stable", profiles=Profiles())


def test_each_name_that_is_not_there_is_a_clash(small: Registry, tmp_path: Path) -> None:
    """A launch file that starts two programs, of which the second is gone and the first only likely needed."""
    launch = "<launch><node pkg='driver' exec='$(var exec)'/><node pkg='driver' exec='drive'/></launch>\n"
    files = {**panel(), "panel/launch/robot.launch.xml": launch, "panel/launch/other.launch.xml": launch}
    files["panel/package.xml"] = manifest("panel", "1.0.0", {"driver": ""})
    renamed = driver("1.0.0")
    renamed["driver/setup.py"] = renamed["driver/setup.py"].replace("drive =", "run =")
    published(small, packages(tmp_path, {**renamed, **files}))
    with small.reading() as session, pytest.raises(NoResolutionError, match="starts drive of driver"):
        resolve(session, [Wish("panel")])


def _channel(registry: Registry) -> None:
    with registry.writing() as session:
        session.execute(update(Standing).values(channel="certified"))


def _evidence(registry: Registry) -> None:
    with registry.writing() as session:
        add_evidence(session, [stated(session, "delivery", Statement("upgrade_test", "Ada", result="contradicted"))])
        row = session.scalars(select(EvidenceRow)).one()
        session.execute(update(EvidenceRow).values(document=row.document.replace("contradicted", "confirmed")))


def _own_evidence(registry: Registry) -> None:
    with registry.writing() as session:
        record = stated(session, "delivery", Statement("upgrade_test", "Ada"))
        document = msgspec.json.encode(record, order="deterministic").decode()
        release = session.scalars(select(Release)).one()
        digest = hashlib.sha256(document.encode()).hexdigest()
        session.add(EvidenceRow(digest=digest, release_id=release.id, document=document))


def _waiver(registry: Registry) -> None:
    with registry.writing() as session:
        waive(session, "delivery", "beta", Waiver("contract", "Ada", "a bench", "2999-01-01T00:00:00.000000Z"))
        session.execute(update(WaiverRow).values(gate="compatibility"))


def _migration(registry: Registry) -> None:
    with registry.writing() as session:
        keep_migration(session, "delivery", Migration(old="1", new="2", steps=()))
        session.execute(update(MigrationRow).values(document='{"old": "1", "new": "2", "steps": [ ]}'))


@pytest.mark.parametrize("change", [_channel, _evidence, _own_evidence, _waiver, _migration])
def test_verify_sees_what_came_in_beside_the_log(small: Registry, change: Callable[[Registry], None]) -> None:
    """A row that was written by hand decides nothing without being found."""
    published(small, (_release("1.0.0"),))
    with small.reading() as session:
        assert verify(session).problems == ()
    change(small)
    with small.reading() as session:
        assert len(verify(session).problems) == 1
