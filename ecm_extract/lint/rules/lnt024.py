"""LNT024: a stamped message is published and its header was never written."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import calls_in
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.unstamped_receivers import Publishers
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT024",
    name="header_never_written",
    dimension="behavior",
    severity="warning",
    who="wire",
    consequence="time and frame are zero and empty: transforms fail and filters drop the message",
    resolution="set header.stamp and header.frame_id before it is published",
)
_SENSORS = frozenset(
    {"LaserScan", "Imu", "PointCloud2", "Image", "CameraInfo", "JointState", "NavSatFix", "Range", "MagneticField"}
    | {"FluidPressure", "Temperature", "BatteryState", "TimeReference"}
)
_STAMPED = {"sensor_msgs": _SENSORS, "nav_msgs": frozenset({"Odometry", "Path", "OccupancyGrid"})}
_STAMPS = frozenset({"header", "stamp"})
"""Some stamped messages hold a bare stamp."""
_SENDERS = frozenset({"publish", "sendTransform", "send_transform"})


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report local messages of C++ that nothing but plain assignments to other fields has touched, in what is built.

    Where the receivers are known not to look at the header it is an info.
    """
    own, publishers = frozenset(workspace.versions), Publishers(workspace)
    for functions in workspace.linker.program.functions.values():
        for func in functions:
            if func.file.language == "cpp" and func.file.is_built and func.file.package in workspace.by_name:
                yield from _of(func, own, publishers)


def _of(func: Func, own: frozenset[str], publishers: Publishers) -> Iterator[Finding]:
    for at, statement in enumerate(func.fact.body):
        made = statement.value
        kind = _made_type(statement.type, made)
        if statement.kind != "let" or not isinstance(statement.target, Name) or not _is_stamped(kind, own):
            continue
        name = statement.target.id
        if made is not None and not _is_fresh(made):
            continue  # a copy may bring a header
        body = _life(func.fact.body[at:], name)
        sent = [other for other in body if other.value is not None and _sends(other.value, name)]
        if sent and not any(_touches(other.target, other.value, name) for other in body if other not in sent):
            text = f"{kind} {name} is sent and its header (stamp, frame_id) is never written"
            evidence = [Evidence(func.file.path, sent[0].line), Evidence(func.file.path, statement.line)]
            entity = Entity("message", f"{func.fact.scope}::{func.fact.name}", name)
            level: Severity | None = "info" if publishers.need_no_header(func.file.package, kind) else None
            yield RULE.finding(text, entity, func.file.package, evidence, certainty="likely", severity=level)


def _life(body: tuple[Statement, ...], name: str) -> tuple[Statement, ...]:
    """The statements up to the next variable of the same name, which is another one."""
    for at, statement in enumerate(body[1:], 1):
        if statement.kind == "let" and isinstance(statement.target, Name) and statement.target.id == name:
            return body[:at]
    return body


def _made_type(written: str, made: Expr | None) -> str:
    """The message type of a declaration: of the object behind a pointer, of what `make_shared` makes for `auto`."""
    types = made.types if isinstance(made, Call) else ()
    bare = plain(types[0]) if types and plain(written) in {"auto", ""} else plain(written)
    for suffix in ("::Ptr", "::SharedPtr", "::UniquePtr", "Ptr"):
        bare = bare.removesuffix(suffix)
    return bare


def _is_stamped(kind: str, own: frozenset[str]) -> bool:
    """Tell whether a type is known to have a header: of the packages of ROS, or called so elsewhere."""
    parts = [part for part in kind.split("::") if part]
    if parts[:1] and parts[0] in own and parts[0] not in {"geometry_msgs", *_STAMPED}:
        return False
    return len(parts) > 1 and (parts[-1].endswith("Stamped") or parts[-1] in _STAMPED.get(parts[0], ()))


def _sends(expr: Expr, name: str) -> bool:
    calls = (call for call in calls_in(expr) if _called(call) in _SENDERS)
    return any(isinstance(arg, Name) and arg.id == name for call in calls for arg in call.args)


def _called(call: Call) -> str:
    callee = call.callee
    return (
        callee.name if isinstance(callee, Member) else callee.id.rsplit("::", 1)[-1] if isinstance(callee, Name) else ""
    )


def _touches(target: Expr | None, value: Expr | None, name: str) -> bool:
    """Tell whether a statement writes the header, the whole message, or hands the message to somebody."""
    if isinstance(target, Call) and any(_root(arg) == name for arg in target.args):
        return True  # `tie(a, b) = f()`
    if (
        target is not None
        and _root(target) == name
        and ((isinstance(target, Name) and value is not None) or _STAMPS & set(_path(target)))
    ):
        return not (isinstance(target, Name) and _is_fresh(value))
    if isinstance(value, Op) and value.op == "&" and len(value.operands) == 1 and _root(value) == name:
        return True  # whoever has the address may write it
    for call in calls_in(value):
        if any(_root(arg) == name for arg in call.args) or (
            _STAMPS & set(_path(call.callee)) and _root(call.callee) == name
        ):
            return True
    return False


def _is_fresh(made: Expr | None) -> bool:
    """Tell whether an expression makes an empty message; what a function returns may have a header."""
    if not isinstance(made, Call) or not isinstance(made.callee, Name) or made.args:
        return False
    last = plain(made.callee.id).rpartition("::")[2]
    return last[:1].isupper() or last.startswith("make_")


def _path(expr: Expr) -> list[str]:
    parts = []
    node: Expr = expr
    while isinstance(node, Member):
        parts.append(node.name)
        node = node.base
    return parts


def _root(expr: Expr) -> str:
    node: Expr = expr
    while isinstance(node, Member) or (isinstance(node, Call) and isinstance(node.callee, Member)):
        node = node.base if isinstance(node, Member) else node.callee  # `message.get()` hands it on
    if hasattr(node, "operands") and len(node.operands) == 1:
        return _root(node.operands[0])
    return node.id if isinstance(node, Name) else ""
