"""MD5 sums and RIHS01 hashes equal those that ROS computes."""

from functools import cache

import pytest
from ecm_parsers.interface import parse
from ecm_parsers.interface_derived import ros1_messages, ros2_messages
from ecm_parsers.interface_facts import Definition, Shape
from ecm_parsers.interface_hash import MAX_DEPTH, Hashed, md5, rihs01
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

SERVICE_EVENT = "uint8 event_type\nbuiltin_interfaces/Time stamp\nchar[16] client_gid\nint64 sequence_number\n"


def read(text: str, shape: Shape = "msg") -> Definition:
    parsed = parse(text.encode(), shape)
    assert parsed.diagnostics == ()
    return parsed.facts


KNOWN = {
    "service_msgs/msg/ServiceEventInfo": read(SERVICE_EVENT),
    "builtin_interfaces/msg/Time": read("int32 sec\nuint32 nanosec\n"),
    "unique_identifier_msgs/msg/UUID": read("uint8[16] uuid\n"),
    "std_msgs/msg/Header": read("uint32 seq\ntime stamp\nstring frame_id\n"),
    "actionlib_msgs/msg/GoalID": read("time stamp\nstring id\n"),
    "actionlib_msgs/msg/GoalStatus": read(
        "GoalID goal_id\nuint8 status\n"
        "uint8 PENDING=0\nuint8 ACTIVE=1\nuint8 PREEMPTED=2\nuint8 SUCCEEDED=3\nuint8 ABORTED=4\n"
        "uint8 REJECTED=5\nuint8 PREEMPTING=6\nuint8 RECALLING=7\nuint8 RECALLED=8\nuint8 LOST=9\n"
        "string text\n"
    ),
}


@cache
def store_texts(store: Stores) -> tuple[Typestore, dict[str, tuple[str, str]]]:
    typestore = get_typestore(store)
    version = 1 if store is Stores.ROS1_NOETIC else 2
    return typestore, {name: typestore.gendefhash(name, {}, version) for name in typestore.fielddefs}


def nothing(_: str) -> None:
    """Resolve no name."""


def test_md5_of_every_noetic_message() -> None:
    """Our parse and our sum agree with rosbags on each type of ROS 1 Noetic."""
    _, texts = store_texts(Stores.ROS1_NOETIC)
    definitions = {name: read(text) for name, (text, _) in texts.items()}
    wrong = [
        name
        for name, definition in definitions.items()
        if md5(name, definition, definitions.get) != Hashed(texts[name][1])
    ]
    assert len(definitions) > 150
    assert wrong == []


@pytest.mark.parametrize("store", [Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY])
def test_rihs01_of_every_ros2_message(store: Stores) -> None:
    """Our parse and our hash agree with rosbags, but for `char`, which rosidl hashes as uint8."""
    typestore, texts = store_texts(store)
    definitions = {name: read(text) for name, (text, _) in texts.items()}
    with_char = {name for name in texts if "char" in typestore.generate_msgdef(name, ros_version=2)[0]}
    wrong = [
        name
        for name, definition in definitions.items()
        if rihs01(name, definition, definitions.get) != Hashed(typestore.hash_rihs01(name))
    ]
    assert len(definitions) > 140
    assert set(wrong) <= with_char
    assert len(with_char) < 8


@pytest.mark.parametrize(
    ("name", "shape", "text", "value"),
    [
        (
            "example_interfaces/srv/AddTwoInts",
            "srv",
            "int64 a\nint64 b\n---\nint64 sum\n",
            "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a",
        ),
        (
            "rosapi_msgs/srv/GetROSVersion",
            "srv",
            "---\nuint8 version\nstring distro\n",
            "RIHS01_526058384b92d9d5a46cadafdcdfadddc28aa53c593a1ce174bdc36e714cb097",
        ),
        (
            "custom_action_interfaces/action/Fibonacci",
            "action",
            "int32 order\n---\nint32[] sequence\n---\nint32[] partial_sequence\n",
            "RIHS01_cd2d79189d941df81b8a4bd952ce1f6f8bab678efaf2851a4b1ef6031a633828",
        ),
    ],
)
def test_rihs01_of_services_and_actions(name: str, shape: Shape, text: str, value: str) -> None:
    """Services and actions hash to what rosidl generated for the same text, derived messages included."""
    assert rihs01(name, read(text, shape), KNOWN.get) == Hashed(value)


@pytest.mark.parametrize(
    ("name", "shape", "text", "value"),
    [
        ("std_srvs/srv/Empty", "srv", "---\n", "d41d8cd98f00b204e9800998ecf8427e"),
        (
            "std_srvs/srv/Trigger",
            "srv",
            "---\nbool success # whether\nstring message\n",
            "937c9679a518e3a18d831e57125ea522",
        ),
        (
            "std_srvs/srv/SetBool",
            "srv",
            "bool data\n---\nbool success\nstring message\n",
            "09fb03525b03e7ea1fd3992bafd87e16",
        ),
        (
            "actionlib_tutorials/action/Fibonacci",
            "action",
            "int32 order\n---\nint32[] sequence\n---\nint32[] sequence\n",
            "f59df5767bf7634684781c92598b2406",
        ),
    ],
)
def test_md5_of_services_and_actions(name: str, shape: Shape, text: str, value: str) -> None:
    """ROS 1 sums run over request and response, and for actions over the generated action message."""
    assert md5(name, read(text, shape), KNOWN.get) == Hashed(value)


def test_md5_sees_what_is_on_the_wire() -> None:
    """Comments change no sum; names, order, constants and array bounds do."""
    base = md5("p/msg/A", read("int8 a\nint8 b\n"), KNOWN.get)
    assert md5("p/msg/A", read("# x\nint8 a # y\n\nint8   b\n"), KNOWN.get) == base
    for text in ("int8 b\nint8 a\n", "int8 a\nint8 c\n", "int8 a\nint8[2] b\n", "int8 X=1\nint8 a\nint8 b\n"):
        assert md5("p/msg/A", read(text), KNOWN.get) != base


def test_constants_and_defaults_are_not_in_rihs01() -> None:
    """The ROS 2 hash covers names and types only."""
    base = rihs01("p/msg/A", read("int8 a\n"), KNOWN.get)
    assert rihs01("p/msg/A", read("int8 X=1\nint8 a 5\n"), KNOWN.get) == base
    assert rihs01("p/msg/A", read("int8 a\nstring<=3 b\n"), KNOWN.get) != base


@pytest.mark.parametrize("function", [md5, rihs01])
def test_missing_types_are_named(function: object) -> None:
    """A type that nobody knows gives no hash and its own name, also from two levels down."""
    assert callable(function)
    known = {"p/msg/B": read("q/C[] c\n")}
    assert function("p/msg/A", read("B b\n"), known.get) == Hashed(None, "q/msg/C")


def test_header_alone_is_local_in_ros2() -> None:
    """`Header` is std_msgs in ROS 1 and, as any bare name, of the own package in ROS 2."""
    assert md5("p/msg/A", read("Header header\n"), nothing).missing == "std_msgs/msg/Header"
    assert rihs01("p/msg/A", read("Header header\n"), nothing).missing == "p/msg/Header"


def test_types_that_hold_themselves_end() -> None:
    """A cycle and a chain without end give no sum, in no time."""
    cyclic = {"p/msg/A": read("B x\nB y\n"), "p/msg/B": read("A x\nA y\n")}
    assert md5("p/msg/A", cyclic["p/msg/A"], cyclic.get).missing == "p/msg/A"
    chain = {f"p/msg/A{i}": read(f"A{i + 1} x\nA{i + 1} y\n") for i in range(2 * MAX_DEPTH)}
    assert md5("p/msg/A0", chain["p/msg/A0"], chain.get).missing == f"p/msg/A{MAX_DEPTH}"


def test_derived_names() -> None:
    """A generated message can be looked up under the name that source code uses."""
    action = read("int8 a\n---\n---\n", "action")
    assert "p/msg/MoveActionGoal" in ros1_messages("p/action/Move", action)
    assert "p/action/Move_SendGoal_Request" in ros2_messages("p/action/Move", action)
    service = read("int8 a\n---\n", "srv")
    assert list(ros1_messages("p/srv/Get", service)) == ["p/srv/GetRequest", "p/srv/GetResponse"]
