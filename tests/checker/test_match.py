"""Requirements against provisions: met, dangling, incompatible, unknown."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest
from ecm_checker.contract import Evidence
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, provided
from ecm_checker.hub.provision import Form, Provision
from ecm_checker.hub.requirement import Given, Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.engine import match
from ecm_checker.match.packages import Packages, broken
from ecm_checker.match.provisions import Provisions
from ecm_checker.rules.ver008 import RULE
from ecm_checker.unmet_findings import unmet_findings
from ecm_checker.wire import NotRead


def provision(kind: str, name: str, owner: str = "", path: str = "a.hpp", **more: Any) -> Provision:
    return Provision(**{"package": "arm", **more}, kind=kind, owner=owner, name=name, path=path, line=1)


def requirement(use: str, name: str, owner: str = "", path: str = "b.cpp", **more: Any) -> Requirement:
    fields: dict[str, Any] = {"package": None, "type": None, "certainty": "proved", **more}
    kind = uses()[use].of[0]
    return Requirement(
        use=use, kind=kind, owner=owner, name=name, conditions=(), by="", evidence=(Evidence(path, 1),), **fields
    )


INCLUDE = requirement("includes", "arm/arm.hpp")
HEADER = provision("file", "arm/arm.hpp")
ARM = provision("class", "arm::Arm")
JOINT = provision("class", "arm::Joint", bases=("Arm",))
MOVE = provision("method", "move", "arm::Arm", forms=(Form(("int",), 1, "void", ("to",), virtual=True),))
ARM_LAUNCH = provision("launch_file", "arm.launch", path="arm.launch")
SIDE = provision("launch_argument", "side", "arm.launch", path="arm.launch", default="left")
MODE = provision("message", "arm_msgs/msg/Mode", package="arm_msgs")
OFF = provision("constant", "OFF", "arm_msgs/msg/Mode", package="arm_msgs")
STATES: dict[str, tuple[list[Provision], Requirement, str]] = {
    "any number of arguments": (
        [ARM, provision("method", "tell", "arm::Arm", forms=(Form(("const char*", "..."), 1, "void"),))],
        requirement("calls_method", "tell", "arm::Arm", given=Given(count=4)),
        "met",
    ),
    "fewer than any number of arguments after the first": (
        [ARM, provision("method", "tell", "arm::Arm", forms=(Form(("const char*", "..."), 1, "void"),))],
        requirement("calls_method", "tell", "arm::Arm", given=Given(count=0)),
        "incompatible",
    ),
    "a future that is taken again and shared": (
        [provision("method", "send", "arm::Client", forms=(Form(("Request",), 1, "SharedFuture"),))],
        requirement("takes_again", "send"),
        "met",
    ),
    "a future that is taken again and not shared": (
        [provision("method", "send", "arm::Client", forms=(Form(("Request",), 1, "FutureAndId"),))],
        requirement("takes_again", "send"),
        "incompatible",
    ),
    "a program that is there": (
        [provision("executable", "arm_node")],
        requirement("starts", "arm_node", package="arm"),
        "met",
    ),
    "a program that its package does not have": (
        [provision("executable", "arm_node")],
        requirement("starts", "arm_driver", package="arm"),
        "dangling",
    ),
    "a program of a package that nobody has shown": (
        [provision("executable", "arm_node")],
        requirement("starts", "leg_node", package="leg"),
        "unknown",
    ),
    "a topic that anybody in the world may publish": (
        [provision("topic", "/joints", facet="published")],
        requirement("subscribes", "/other"),
        "unknown",
    ),
    "a topic below the namespace of a node": (
        [provision("topic", "~/joints", facet="published")],
        requirement("subscribes", "/robot/arm/joints"),
        "met",
    ),
    "a topic that is only subscribed": (
        [provision("topic", "/joints", facet="subscribed")],
        requirement("subscribes", "/joints"),
        "unknown",
    ),
    "a topic of another type": (
        [provision("topic", "/joints", facet="published", type="a/msg/A")],
        requirement("subscribes", "/joints", type="a/msg/B"),
        "incompatible",
    ),
    "a computed name of another type is another name": (
        [provision("service", "/get_<*>", type="a/srv/A")],
        requirement("calls_service", "/get_state", type="a/srv/B"),
        "unknown",
    ),
    "a name that is computed": (
        [provision("topic", "/joints", facet="published")],
        requirement("subscribes", "/{name}", certainty="unknown"),
        "unknown",
    ),
    "an argument that a launch file has": (
        [ARM_LAUNCH, SIDE],
        requirement("gives_argument", "side", "arm.launch", package="arm"),
        "met",
    ),
    "an argument that it does not have": (
        [ARM_LAUNCH, SIDE],
        requirement("gives_argument", "hand", "arm.launch", package="arm"),
        "dangling",
    ),
    "an argument of a launch file that does not tell all of them": (
        [provision("launch_file", "arm.launch", path="arm.launch", open=True), SIDE],
        requirement("gives_argument", "hand", "arm.launch", package="arm"),
        "unknown",
    ),
    "a parameter of a node pattern": (
        [provision("parameter", "rate", "arm_node", type="integer", ros=2)],
        requirement("sets_parameter", "rate", "/**", ros=2, type="integer"),
        "met",
    ),
    "a parameter of another node": (
        [provision("parameter", "rate", "arm_node", type="integer", ros=2)],
        requirement("sets_parameter", "rate", "/leg_node", ros=2, type="integer"),
        "unknown",
    ),
    "a generated header": (
        [provision("message", "arm_msgs/msg/JointForce")],
        requirement("includes", "arm_msgs/msg/joint_force.hpp"),
        "met",
    ),
    "a part of an action in Python": (
        [provision("message", "arm_msgs/action/Grip")],
        requirement("imports", "arm_msgs.action.Grip", path="b.py"),
        "met",
    ),
    "a field by a type as C++ writes it": (
        [provision("message_field", "goal.force", "arm_msgs/action/Grip", facet="goal")],
        requirement("reads_member", "force", "arm_msgs::action::Grip::Goal"),
        "met",
    ),
    "a method of a base class": ([ARM, JOINT, MOVE], requirement("calls_method", "move", "arm::Joint"), "met"),
    "a method that is called with too many arguments": (
        [ARM, MOVE],
        requirement("calls_method", "move", "arm::Arm", given=Given(count=2)),
        "incompatible",
    ),
    "an override of another form": (
        [ARM, MOVE],
        requirement("overrides", "move", "Arm", scope="arm::Mine", given=Given(types=("double",), returns="void")),
        "incompatible",
    ),
    "a plugin by either writing": (
        [provision("plugin", "arm/Simple")],
        requirement("loads_plugin", "arm::Simple"),
        "met",
    ),
}


@pytest.mark.parametrize(("provisions", "wanted", "state"), STATES.values(), ids=STATES)
def test_a_requirement_has_one_state(provisions: list[Provision], wanted: Requirement, state: str) -> None:
    """Unknown is never missing, and what does not fit is not met."""
    found = match(wanted, Consumer("user", [wanted]), Provisions(provisions), {"arm"})
    assert found.state == state


@pytest.mark.parametrize(("included", "state"), [((INCLUDE,), "met"), ((), "unknown")])
def test_a_name_of_another_package_needs_its_header(included: tuple[Requirement, ...], state: str) -> None:
    """Two packages may have one namespace: the include tells which is meant."""
    wanted = requirement("names_symbol", "arm::Arm")
    consumer = Consumer("user", [*included, wanted])
    assert match(wanted, consumer, Provisions([HEADER, ARM]), {"arm"}).state == state


@pytest.mark.parametrize(("name", "state"), [("OFF", "met"), ("ON", "unknown")])
def test_cpp_names_a_constant_of_a_message(name: str, state: str) -> None:
    """The header of a message is generated below the name of its package, and belongs to it as any other."""
    wanted = requirement("names_symbol", f"arm_msgs::msg::Mode::{name}")
    consumer = Consumer("user", [requirement("includes", "arm_msgs/msg/mode.hpp"), wanted])
    assert match(wanted, consumer, Provisions([MODE, OFF]), {"arm_msgs"}).state == state


def package(name: str, provides: list[Provision], requires: list[Requirement]) -> Package:
    return Package(
        name=name,
        version=None,
        path=name,
        ros=2,
        provides=tuple(map(provided, provides)),
        requires=tuple(requires),
    )


def test_what_was_met_and_is_no_longer_is_broken() -> None:
    """What was never met, and what nobody asks for, is no break."""
    wanted = [requirement("starts", name, package="arm") for name in ("arm_node", "never", "stays")]
    user = Packages([package("user", [], wanted)])
    before = Packages([package("arm", [provision("executable", name) for name in ("arm_node", "stays", "other")], [])])
    after = Packages([package("arm", [provision("executable", "stays")], [])])
    assert [each.requirement.name for each in broken(user, before, after)] == ["arm_node"]
    assert not list(broken(user, before, before))


@pytest.mark.parametrize(("kept_for", "severity"), [("", "error"), ("humble", "info")])
def test_what_is_kept_for_another_distribution_is_for_information(kept_for: str, severity: str) -> None:
    maker = Package(name="arm", version=None, path="arm", ros=None, provides=(provided(HEADER),))
    rows = (requirement("includes", "arm/arm.hpp", kept_for=kept_for),)
    user = Packages([Package(name="user", version=None, path="user", ros=None, requires=rows)])
    gone = Package(name="arm", version=None, path="arm", ros=None)
    (finding,) = unmet_findings(RULE, broken(user, Packages([maker]), Packages([gone])))
    assert finding.severity == severity


def test_nothing_is_missing_in_what_was_not_read() -> None:
    """A file of the provider is too large: a name that is not found is unknown, and a release may have broken it."""
    user = Packages([package("user", [], [requirement("starts", "arm_node", package="arm")])])
    before = Packages([package("arm", [provision("executable", "arm_node")], [])])
    gap = NotRead("arm/src/big.cpp", "too-large", carries=True)
    partly = Packages([msgspec.structs.replace(package("arm", [], []), unread=(gap,))])
    (found,) = broken(user, before, partly)
    assert found.hidden
    (finding,) = unmet_findings(RULE, [found])
    assert (finding.severity, finding.certainty) == ("warning", "unknown")
    assert "is not in what could be read" in finding.message


def test_what_a_project_leaves_out_is_no_gap() -> None:
    """Only what nobody asked to leave out makes a package unknown."""
    user = package("user", [], [requirement("starts", "arm_node", package="arm")])
    left = NotRead("arm/old", "excluded", carries=True)
    arm = msgspec.structs.replace(package("arm", [], []), unread=(left,))
    assert [each.requirement.name for each in Packages([user, arm]).unmet()] == ["arm_node"]


def test_packages_ask_each_other() -> None:
    """A program that the other one does not have is told; a plugin may come from anywhere."""
    wanted = [requirement("starts", "gone", package="arm"), requirement("loads_plugin", "else::Where")]
    found = Packages([package("user", [], wanted), package("arm", [provision("executable", "arm_node")], [])])
    assert [each.requirement.name for each in found.unmet()] == ["gone"]


@pytest.mark.parametrize(("ros", "told"), [(1, True), (2, False)])
def test_ros_2_tolerates_an_argument_that_nobody_declares(ros: int, told: bool) -> None:
    launch = Package(name="arm", version=None, path="arm", ros=None, provides=(provided(ARM_LAUNCH),))
    given = requirement("gives_argument", "side", "arm.launch", package="arm", ros=ros)
    user = Package(name="user", version=None, path="user", ros=None, requires=(given,))
    assert [each.requirement for each in Packages([launch, user]).unmet()] == [given] * told


@pytest.mark.parametrize(("takes", "told"), [("1 value", False), ("3 values", True)])
def test_one_variable_takes_all_values(takes: str, told: bool) -> None:
    """Python binds a tuple to it."""
    split = provision("function", "arm.split", path="arm/__init__.py", forms=(Form((), 0, "2 values"),))
    maker = Package(name="arm", version=None, path="arm", ros=None, provides=(provided(split),))
    rows = (requirement("imports", "arm.split", path="u.py"),)
    rows += (requirement("takes_result", "arm.split", path="u.py", given=Given(takes=takes)),)
    user = Package(name="user", version=None, path="user", ros=None, requires=rows)
    assert [each.match.breach for each in Packages([maker, user]).unmet()] == ["signature"] * told


def test_a_use_is_broken_only_in_the_ways_that_its_kind_can_be() -> None:
    """Who calls a function imports it too, and the import tells that it is gone."""
    maker = Package(
        name="arm", version=None, path="arm", ros=None,
        provides=(provided(provision("function", "arm.move", path="arm/__init__.py")),),
    )  # fmt: skip
    gone = Package(name="arm", version=None, path="arm", ros=None)
    rows = tuple(requirement(use, "arm.move", path="u.py", given=Given(count=0)) for use in ("imports", "calls"))
    user = Packages([Package(name="user", version=None, path="user", ros=None, requires=rows)])
    assert [each.requirement.use for each in broken(user, Packages([maker]), Packages([gone]))] == ["imports"]


def test_a_program_may_be_a_file_of_its_package() -> None:
    """ROS 1 runs a script from the source folder, installed or not."""
    user = package("user", [], [requirement("starts", "drive.py", package="arm")])
    arm = package("arm", [], [])
    held = msgspec.structs.replace(arm, files={"arm/scripts/drive.py": ""})
    assert [each.requirement.name for each in Packages([user, arm]).unmet()] == ["drive.py"]
    assert not list(Packages([user, held]).unmet())


@pytest.mark.parametrize(
    ("more", "unmet"),
    [
        ({}, ["drive", "arm.msg.Grip"]),
        ({"possible": {"executable": ("drive",)}}, ["arm.msg.Grip"]),
        ({"possible": {"message": ("arm/msg/Grip",)}}, ["drive"]),
        ({"open": ("executable", "message")}, []),
        ({"files": {"arm/drive.py": ""}}, ["arm.msg.Grip"]),
        ({"files": {"arm/drive.py": ""}, "runs_files": False}, ["drive", "arm.msg.Grip"]),
    ],
)
def test_what_a_build_may_make_is_not_missing(more: dict[str, Any], unmet: list[str]) -> None:
    """A program that is not installed, an interface that a build lists, anything of a build that is not understood."""
    wanted = [requirement("starts", "drive", package="arm"), requirement("imports", "arm.msg.Grip")]
    arm = package("arm", [provision("message", "arm/msg/Mode")], [])
    found = Packages([package("user", [], wanted), msgspec.structs.replace(arm, **more)]).unmet()
    assert [each.requirement.name for each in found] == unmet


def test_what_has_no_name_is_not_looked_for() -> None:
    """An unnamed member is no computed name: it was compared with each use of all that is stored."""
    unnamed = [provision("member", "", "arm::Arm"), provision("constant", "", "arm")]
    computed = provision("topic", "/<*>", "driver")
    assert [each.name for each in Provisions([*unnamed, computed]).sought()] == ["", "/<*>"]
    assert list(Provisions(unnamed).sought()) == []
    assert Provisions(unnamed).named(requirement("names_symbol", "arm::Arm"), Consumer("user", ())) == []
