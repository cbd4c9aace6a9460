"""What one launch starts, matched: whole names, QoS, claims, alternatives; and conditions that arguments decide."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.contract import Evidence, Qos
from ecm_checker.hub.condition import Condition
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, provided
from ecm_checker.hub.provision import HOLE, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.alternatives import alternatives
from ecm_checker.match.engine import Match
from ecm_checker.match.exclusive import contended
from ecm_checker.match.packages import Packages
from ecm_checker.rules.sig014 import RULE
from ecm_checker.unmet_findings import unmet_findings

REAL = Condition("argument", "real")
BEST_EFFORT = Qos(reliability="best_effort")
RELIABLE = Qos(reliability="reliable")


def offer(kind: str, name: str, **more: Any) -> Provision:
    facet = "published" if kind == "topic" else ""
    fields = {"package": "launch", "owner": "/talker", "facet": facet, **more}
    return Provision(kind=kind, name=name, path="a.cpp", line=1, **fields)


def want(use: str, name: str, **more: Any) -> Requirement:
    fields: dict[str, Any] = {
        "package": "launch",
        "type": None,
        "certainty": "likely",
        "by": "/ear",
        "line": 1,
        "conditions": (),
        **more,
    }
    at = (Evidence("b.cpp", fields.pop("line")),)
    return Requirement(use=use, kind=uses()[use].of[0], owner="", name=name, evidence=at, **fields)


def matched(offers: list[Provision], wants: list[Requirement], anything: tuple[str, ...] = ()) -> list[Match]:
    package = Package(
        name="launch",
        version=None,
        path="",
        ros=2,
        provides=tuple(map(provided, offers)),
        requires=tuple(wants),
        open=anything,
    )
    packages = Packages([package])
    return [packages.match(each, packages.consumers[0]) for each in wants]


@pytest.mark.parametrize(
    ("offers", "wanted", "anything", "state", "breach"),
    [
        ([offer("topic", "/scan")], want("hears", "/scan"), (), "met", None),
        ([offer("topic", "/robot/scan")], want("hears", "/scan"), (), "dangling", None),
        ([offer("topic", "/robot/scan")], want("hears", "/scan"), ("topic",), "unknown", None),
        ([offer("topic", "/scan", facet="subscribed")], want("hears", "/scan"), (), "dangling", None),
        ([offer("topic", f"/{HOLE}/scan")], want("hears", "/left/scan"), (), "unknown", None),
        ([offer("topic", f"/{HOLE}/scan")], want("hears", "/left/map"), (), "dangling", None),
        ([offer("topic", f"/{HOLE}/scan")], want("hears", "/scan"), (), "unknown", None),
        ([offer("topic", f"/left/{HOLE}")], want("hears", "/left/map"), (), "unknown", None),
        ([offer("topic", "/a", type="a/msg/A")], want("hears", "/a", type="a/msg/B"), (), "incompatible", "type"),
        ([offer("topic", "/a", type="a/msg/A")], want("hears", "/a", type="a/msg/A"), (), "met", None),
        ([offer("topic", "/a", qos=BEST_EFFORT)], want("hears", "/a", qos=RELIABLE), (), "incompatible", "qos"),
        ([offer("topic", "/a", qos=RELIABLE)], want("hears", "/a", qos=BEST_EFFORT), (), "met", None),
        ([offer("topic", "/a", qos=BEST_EFFORT)], want("hears", "/a", qos=RELIABLE, ros=1), (), "met", None),
        ([offer("topic", "/a", qos=BEST_EFFORT)], want("hears", "/a"), (), "met", None),
        ([], want("hears", f"/{HOLE}", certainty="unknown"), (), "unknown", None),
        ([offer("service", "/stop")], want("asks", "/stop"), (), "met", None),
        ([], want("orders", "/dock"), (), "dangling", None),
    ],
)
def test_names_of_one_launch(
    offers: list[Provision], wanted: Requirement, anything: tuple[str, ...], state: str, breach: str | None
) -> None:
    """Names are whole; what is not there is missing only where all who could offer it are known."""
    found = matched(offers, [wanted], anything)[0]
    assert (found.state, found.breach) == (state, breach)


def test_two_consumers_of_an_exclusive_name() -> None:
    """Who takes it under a condition may never meet the other; who takes it twice is one consumer."""
    joint = offer("command_interface", "arm/position")
    first, second = want("claims", "arm/position", by="/a"), want("claims", "arm/position", by="/b")
    states = [each.state for each in contended(matched([joint], [first, second]))]
    assert states == ["incompatible", "incompatible"]
    alone = want("claims", "arm/position", by="/b", when=(REAL,), conditions=("real",))
    assert [each.state for each in contended(matched([joint], [first, alone]))] == ["met", "met"]
    assert [each.state for each in contended(matched([joint], [first, first]))] == ["met", "met"]


def test_one_line_that_asks_for_one_type_or_another() -> None:
    """Only one of them is asked for, so that the other may be none; two lines ask for both."""
    topic = offer("topic", "/a", type="a/msg/A")
    one, other = want("hears", "/a", type="a/msg/A"), want("hears", "/a", type="a/msg/B")
    assert [each.state for each in alternatives(matched([topic], [one, other]))] == ["met", "unknown"]
    elsewhere = want("hears", "/a", type="a/msg/B", line=2)
    assert [each.state for each in alternatives(matched([topic], [one, elsewhere]))] == ["met", "incompatible"]


def test_conditions_of_both_sides_are_told() -> None:
    """A name that is there without a condition too is there."""
    quiet = Condition("argument", "quiet")
    wanted = want("hears", "/a", when=(REAL,), conditions=("real",))
    found = matched([offer("topic", "/a", when=(quiet,))], [wanted])[0]
    assert found.state == "met"
    assert found.conditions == (REAL, quiet)
    both = [offer("topic", "/a", when=(quiet,)), offer("topic", "/a", owner="/other")]
    assert matched(both, [wanted])[0].conditions == (REAL,)


ARM = Package(
    name="arm",
    version=None,
    path="",
    ros=2,
    provides=(provided(offer("executable", "node", package="arm", owner="")),),
    runs_files=False,
)
STARTS = want("starts", "driver", package="arm", certainty="proved", by="launch_file a.launch")
CONDITIONAL = want("starts", "driver", package="arm", certainty="proved", when=(REAL,), conditions=("$(arg real)",))


def packages(*wanted: Requirement, given: dict[str, str] | None = None) -> Packages:
    user = Package(name="bringup", version=None, path="", ros=2, requires=wanted)
    return Packages([ARM, user], given or {})


def test_what_arguments_decide_against_is_not_there() -> None:
    assert list(packages(CONDITIONAL, given={"real": "false"}).unmet()) == []
    assert len(list(packages(CONDITIONAL, given={"real": "true"}).unmet())) == 1
    assert len(list(packages(STARTS, given={"real": "false"}).unmet())) == 1


def test_what_is_provided_under_a_decided_condition_is_not_there() -> None:
    program = provided(offer("executable", "driver", package="arm", owner="", when=(REAL,)))
    arm = Package(name="arm", version=None, path="", ros=2, provides=(program,), runs_files=False)
    user = Package(name="bringup", version=None, path="", ros=2, requires=(STARTS,))
    assert list(Packages([arm, user]).unmet()) == []
    assert len(list(Packages([arm, user], {"real": "off"}).unmet())) == 1


def test_an_undecided_requirement_is_told_with_its_condition() -> None:
    """It is never surely missing, unless another line needs the name under none."""
    (found,) = unmet_findings(RULE, packages(CONDITIONAL).unmet())
    assert found.certainty == "likely"
    assert "starts driver of arm if real" in found.message
    (found,) = unmet_findings(RULE, packages(CONDITIONAL, STARTS).unmet())
    assert found.certainty == "proved"
    assert " if real" not in found.message
