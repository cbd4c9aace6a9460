"""The messages and services that ROS generates from one interface file, under their full names.

Sources: genmsg and actionlib `genaction` (ROS 1), rosidl_parser (ROS 2, Iron and later for service events).
"""

from __future__ import annotations

from ecm_parsers.interface import parse
from ecm_parsers.interface_facts import Definition, Section

_EVENT_INFO = "service_msgs/ServiceEventInfo"
_GOAL_ID = "unique_identifier_msgs/UUID goal_id"


def ros1_messages(name: str, definition: Definition) -> dict[str, Section]:
    """Return what genmsg makes of a definition; the first entry stands for the whole.

    Args:
        name: full name, `package/msg|srv|action/Name`.
        definition: a service yields `NameRequest` and `NameResponse` and no whole, an action seven messages.
    """
    if definition.shape == "msg":
        return {name: definition.section("message")}
    package, own = _split(name)
    if definition.shape == "srv":
        return {
            f"{package}/srv/{own}Request": definition.section("request"),
            f"{package}/srv/{own}Response": definition.section("response"),
        }
    return _ros1_action(f"{package}/msg/{own}", definition)


def _ros1_action(stem: str, definition: Definition) -> dict[str, Section]:
    envelopes = {
        f"{stem}Action": f"{stem}ActionGoal action_goal\n{stem}ActionResult action_result\n"
        f"{stem}ActionFeedback action_feedback",
        f"{stem}ActionGoal": f"Header header\nactionlib_msgs/GoalID goal_id\n{stem}Goal goal",
        f"{stem}ActionResult": f"Header header\nactionlib_msgs/GoalStatus status\n{stem}Result result",
        f"{stem}ActionFeedback": f"Header header\nactionlib_msgs/GoalStatus status\n{stem}Feedback feedback",
    }
    parts = ("goal", "result", "feedback")
    written = {f"{stem}{part.capitalize()}": definition.section(part) for part in parts}
    return {full: _section(text) for full, text in envelopes.items()} | written


def ros2_messages(name: str, definition: Definition) -> dict[str, Section]:
    """Return what rosidl makes of a definition; the first entry stands for the whole.

    Args:
        name: full name, `package/msg|srv|action/Name`.
        definition: a service yields request, response and event, an action also its two services.
    """
    if definition.shape == "msg":
        return {name: definition.section("message")}
    if definition.shape == "srv":
        return _service(name, definition.section("request"), definition.section("response"))
    return _ros2_action(name, definition)


def _service(name: str, request: Section, response: Section) -> dict[str, Section]:
    whole = f"{name}_Request request_message\n{name}_Response response_message\n{name}_Event event_message"
    event = f"{_EVENT_INFO} info\n{name}_Request[<=1] request\n{name}_Response[<=1] response"
    return {
        name: _section(whole),
        f"{name}_Request": request,
        f"{name}_Response": response,
        f"{name}_Event": _section(event),
    }


def _ros2_action(name: str, definition: Definition) -> dict[str, Section]:
    whole = (
        f"{name}_Goal goal\n{name}_Result result\n{name}_Feedback feedback\n"
        f"{name}_SendGoal send_goal_service\n{name}_GetResult get_result_service\n"
        f"{name}_FeedbackMessage feedback_message"
    )
    send_goal = _service(
        f"{name}_SendGoal",
        _section(f"{_GOAL_ID}\n{name}_Goal goal"),
        _section("bool accepted\nbuiltin_interfaces/Time stamp"),
    )
    get_result = _service(f"{name}_GetResult", _section(_GOAL_ID), _section(f"int8 status\n{name}_Result result"))
    parts = ("goal", "result", "feedback")
    written = {f"{name}_{part.capitalize()}": definition.section(part) for part in parts}
    feedback = {f"{name}_FeedbackMessage": _section(f"{_GOAL_ID}\n{name}_Feedback feedback")}
    return {name: _section(whole)} | written | send_goal | get_result | feedback


def _section(text: str) -> Section:
    return parse(text.encode(), "msg").facts.section("message")


def _split(name: str) -> tuple[str, str]:
    package, _, rest = name.partition("/")
    return package, rest.rpartition("/")[2]
