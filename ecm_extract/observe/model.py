"""What was seen of a running system or of a recording: the one model that all sources fill and that rules read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import msgspec
from ecm_checker.contract import Qos
from ecm_checker.hub.roles import RoleKind, roles

SourceKind = Literal["ros1", "dds", "bag"]
if TYPE_CHECKING:
    Sense: TypeAlias = str
else:
    _SEEN = tuple(role for role, row in roles().items() if not row.transform)
    Sense = Literal[("node", *_SEEN, "qos", "rate", "transform", "diagnostic")]
"""What a source can see: endpoints by their role, and more."""
IncidentKind = Literal["incompatible_qos", "deadline_missed", "liveliness_lost", "message_lost"]
Level = Literal["ok", "warn", "error", "stale"]


class Node(msgspec.Struct, frozen=True):
    """A node by its full name; where its process answers (ROS 1) or its security enclave (ROS 2), when told."""

    name: str
    address: str = ""
    enclave: str = ""


class Endpoint(msgspec.Struct, frozen=True):
    """One end of a topic, service or action.

    Attributes:
        role: as in a contract.
        name: full name in the graph.
        type: `package/msg|srv|action/Name`; None when nobody tells it.
        node: full name of its node; None when the source does not know it.
        hash: md5 of ROS 1, `RIHS01_...` of ROS 2; None when not told.
        definition: text of the message definition; None when not told.
        qos: policies that are known of it; a policy that the source cannot see is None and named in `unseen`.
        unseen: names of policies that the source cannot tell from their default.
    """

    role: str
    name: str
    type: str | None
    node: str | None = None
    hash: str | None = None
    definition: str | None = None
    qos: Qos | None = None
    unseen: tuple[str, ...] = ()

    @property
    def row(self) -> RoleKind:
        """What its role is to others."""
        return roles()[self.role]


class Parameter(msgspec.Struct, frozen=True):
    """A parameter with its value as data; `name` is absolute in ROS 1, that of the node in ROS 2."""

    name: str
    value: Any
    node: str | None = None


class Stream(msgspec.Struct, frozen=True):
    """How messages of one topic arrived, of one writer where the source tells writers apart.

    Attributes:
        topic: full name. node: writer; None when not told apart.
        count: messages. size: bytes of all messages.
        hz: mean rate in hertz; None with fewer than two messages.
        longest_gap_s: longest time between two messages in seconds. typical_gap_s: the median.
        frames: `header.frame_id` that were seen.
        latest_s, earliest_s: receipt minus stamp in seconds, the largest and the smallest; None without stamps.
        backwards: stamps that lay before the one before them.
        latched: whether the last message is kept for late subscribers, so that one message is no outage.
    """

    topic: str
    node: str | None
    count: int
    size: int = 0
    hz: float | None = None
    longest_gap_s: float | None = None
    typical_gap_s: float | None = None
    frames: tuple[str, ...] = ()
    latest_s: float | None = None
    earliest_s: float | None = None
    backwards: int = 0
    latched: bool = False


class Transform(msgspec.Struct, frozen=True):
    """A transform from parent to child frame.

    Attributes:
        static: on `/tf_static`. count: how often it was sent.
        writers: nodes that sent it, where they can be told apart.
        largest_step_m: longest way between two that follow each other, in metres. step_s: their distance in seconds.
    """

    parent: str
    child: str
    static: bool = False
    count: int = 1
    writers: tuple[str, ...] = ()
    largest_step_m: float = 0.0
    step_s: float = 0.0


class Status(msgspec.Struct, frozen=True):
    """The worst level that one diagnostic task reported, and the message that came with it."""

    name: str
    level: Level
    message: str
    hardware: str = ""


class State(msgspec.Struct, frozen=True):
    """The state of the life cycle that a node was last seen in: `active`, `inactive`, ..."""

    node: str
    name: str


class Incident(msgspec.Struct, frozen=True):
    """Something that the middleware itself reported.

    Attributes:
        kind: what. name: topic. detail: the policy, for QoS. node: whose end reported it; None when not known.
        count: how often.
    """

    kind: IncidentKind
    name: str
    detail: str = ""
    node: str | None = None
    count: int = 1


class Gap(msgspec.Struct, frozen=True):
    """What could not be read, so that nothing is concluded from its absence: what, and why."""

    what: str
    why: str


class Observation(msgspec.Struct, frozen=True, kw_only=True):
    """Everything that one source saw.

    Attributes:
        source: kind of source. target: what was looked at: URI of the master, domain, files.
        ros: 1 or 2; None when nothing told.
        begun: time of the first look, or of the first message of a recording, ISO 8601 in UTC.
        seconds: how long it was looked at, or how long the recording is.
        senses: what this source can see at all; nothing is concluded from the absence of anything else.
        digest: `sha256:` over what was looked at: the files of a bag, or the observation itself.
    """

    source: SourceKind
    target: str
    ros: Literal[1, 2] | None
    begun: str
    seconds: float
    senses: tuple[Sense, ...]
    nodes: tuple[Node, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    streams: tuple[Stream, ...] = ()
    transforms: tuple[Transform, ...] = ()
    statuses: tuple[Status, ...] = ()
    states: tuple[State, ...] = ()
    incidents: tuple[Incident, ...] = ()
    gaps: tuple[Gap, ...] = ()
    digest: str = ""
