"""Which contract a running node is an instance of, and what is said where nobody can tell."""

from __future__ import annotations

from typing import Any

from observe_fixtures import contracts, observation

from ecm_extract.observe.compare import compare
from ecm_extract.observe.evidence import Run, records
from ecm_extract.observe.report import summary_text
from ecm_extract.observe.watch import Watch

STRING = "std_msgs/msg/String"
GRAPH = ["node", "publisher", "subscriber", "qos"]
RELIABLE = {"reliability": "reliable", "durability": "volatile"}


def end(name: str, role: str = "publisher", **more: Any) -> dict[str, Any]:
    return {"role": role, "name": name, "type": STRING, **more}


def module(name: str, *ends: dict[str, Any], **sections: Any) -> dict[str, Any]:
    return {"id": name, "interfaces": list(ends), **sections}


def results(watch: Watch) -> dict[str, str]:
    return {each.subject.module_id: each.result for each in records(watch, compare(watch), Run("lab"))}


def test_of_several_with_its_name_the_one_that_fits() -> None:
    """A workspace may hold any number of nodes that are called `talker`; the others do not run."""
    promised = contracts(
        [
            module("ecm.demo.talker", end("/chatter")),
            module("ecm.deadline.talker", end("/deadline_chatter")),
            module("ecm.stress.talker", end("/chatter"), end("/load")),
        ]
    )
    watch = Watch(observation(endpoints=[end("/chatter", node="/talker")], senses=GRAPH), promised)
    assert compare(watch) == ()
    expected = {"ecm.demo.talker": "confirmed", "ecm.deadline.talker": "not_seen", "ecm.stress.talker": "not_seen"}
    assert results(watch) == expected


def test_what_fits_alike_is_not_told_apart() -> None:
    """Nothing is proved of either, neither is confirmed, and people are told."""
    promised = contracts(
        [
            module("ecm.demo_cpp.talker", end("/chatter", qos={"reliability": "best_effort"})),
            module("ecm.demo_py.talker", end("/chatter")),
        ]
    )
    seen = observation(endpoints=[end("/chatter", node="/talker", type="a/msg/B", qos=RELIABLE)], senses=GRAPH)
    watch = Watch(seen, promised)
    found = compare(watch)
    assert {each.rule for each in found} == {"OBS003", "OBS006"}
    assert {(each.severity, each.certainty) for each in found} == {("warning", "likely")}
    assert all("unless what was seen is of" in each.message for each in found)
    assert set(results(watch).values()) == {"doubtful"}
    assert "/talker may be an instance of ecm.demo_cpp.talker or ecm.demo_py.talker" in summary_text(watch, found)


def test_a_topic_of_another_node_is_no_sign_of_a_module() -> None:
    """Where nodes are known, a module is seen by its own."""
    promised = contracts([module("ecm.demo.talker", end("/chatter")), module("ecm.demo.talker_qos", end("/chatter"))])
    watch = Watch(observation(endpoints=[end("/chatter", node="/talker")], senses=GRAPH), promised)
    assert results(watch) == {"ecm.demo.talker": "confirmed", "ecm.demo.talker_qos": "not_seen"}


def test_a_topic_of_nobody_may_be_of_either() -> None:
    """A recording of ROS 2 knows no nodes: who has a topic of its own is known by that, others are not."""
    promised = contracts(
        [module("ecm.demo.talker", end("/chatter")), module("ecm.demo.logger", end("/chatter"), end("/log"))]
    )
    both = Watch(observation(source="bag", endpoints=[end("/chatter"), end("/log")], senses=["rate"]), promised)
    assert results(both) == {"ecm.demo.talker": "doubtful", "ecm.demo.logger": "confirmed"}


def test_a_managed_node_that_is_not_configured_lacks_nothing() -> None:
    """It makes what it promises when it is configured; once it was seen to be, what is missing is missing."""
    active = {"behavior": {"preconditions": {"value": ["lifecycle_state == active"], "origin": "inferred"}}}
    promised = contracts([module("ecm.arm.driver", end("/state"), **active)])
    plain: dict[str, Any] = {"nodes": [{"name": "/driver"}], "senses": GRAPH}
    (unknown,) = compare(Watch(observation(**plain), promised))
    assert (unknown.rule, unknown.severity, unknown.certainty) == ("OBS001", "info", "unknown")
    found = compare(Watch(observation(**plain, states=[{"node": "/driver", "name": "active"}]), promised))
    assert [(each.rule, each.severity) for each in found] == [("OBS001", "warning")]
