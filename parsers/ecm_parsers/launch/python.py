"""Launch files of ROS 2 in Python -> actions. The file is parsed and read, never run."""

from __future__ import annotations

import ast

from ecm_parsers.launch.interpreter import LaunchInterpreter
from ecm_parsers.launch.lost import lost_actions
from ecm_parsers.launch.model import LaunchFile, Unread
from ecm_parsers.launch.values import Description, actions_of
from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.expressions import TooLongError
from ecm_parsers.python.sources import Sources
from ecm_parsers.python.syntax import parsed
from ecm_parsers.python.values import Function, Value
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.text import decode

MAX_BYTES = 500_000
_BOUNDS = frozenset({"launch-too-large", "launch-too-deep", "launch-too-long"})
ENTRY_POINTS = ("generate_launch_description", "generate_test_description")


def parse_launch_python(data: bytes, sources: Sources | None = None) -> Parsed[LaunchFile | None]:
    """Read a launch file in Python.

    Args:
        data: its bytes, at most `MAX_BYTES`.
        sources: gives the modules that it imports and the files that it reads; without, they stay unknown.

    Returns:
        The file, None when it has no `generate_launch_description`, and diagnostics.
    """
    if len(data) > MAX_BYTES:
        return _refused("launch-too-large", 0, f"The file exceeds {MAX_BYTES} bytes and is skipped. Split it.")
    text, doubts = decode(data)
    try:
        tree = parsed(text)
    except SyntaxError as error:
        return _refused("launch-syntax", error.lineno or 0, f"No valid Python: {error.msg}. Correct it.")
    except (RecursionError, MemoryError, ValueError):
        return _refused("launch-too-deep", 0, "Expressions nest too deeply to be read. Flatten them.")
    try:
        found = _read(tree, sources)
    except TooLongError as error:
        message = "The file builds more than can be read without running it; all of it is left out. Simplify it."
        return _refused("launch-too-long", error.line, message)
    except RecursionError:
        return _refused("launch-too-deep", 0, "Expressions nest too deeply to be read. Flatten them.")
    return Parsed(found.facts, (*doubts, *found.diagnostics))


def _read(tree: ast.Module, sources: Sources | None) -> Parsed[LaunchFile | None]:
    interpreter = LaunchInterpreter(sources)
    interpreter.run(tree.body, interpreter.module)
    entry = next(
        (interpreter.module.names.get(name) for name in ENTRY_POINTS if name in interpreter.module.names), None
    )
    if not isinstance(entry, Function):
        message = "There is no `generate_launch_description`; the file is no launch file. Add it."
        return Parsed(None, (Diagnostic("info", "launch-no-entry", 0, message),))
    made = interpreter.call(entry, Arguments((), {}, 0))
    problems = () if interpreter.problem is None else (interpreter.problem,)
    problems = (*problems, *lost_actions(tree, interpreter.doubts.made))
    if isinstance(made, tuple) and made:
        made = made[0]  # generate_test_description returns (description, context)
    if not isinstance(made, Description | list):
        rest = (Unread(line=entry.node.lineno, text=ENTRY_POINTS[0]),) if made is not None else ()
        return Parsed(LaunchFile(2, actions_of(made) or rest), (*problems, _unread(entry, made)))
    doubts = interpreter.doubts
    return Parsed(LaunchFile(2, actions_of(made), doubts.texts), (*problems, *doubts.told()))


def _unread(entry: Function, made: Value) -> Diagnostic:
    if made is None:
        message = "`generate_launch_description` returns nothing, so the launch stops here. Return the description."
        return Diagnostic("error", "launch-returns-nothing", entry.node.lineno, message)
    message = "What `generate_launch_description` returns cannot be read without running it."
    return Diagnostic("warning", "launch-unread", entry.node.lineno, message)


def _refused(code: str, line: int, message: str) -> Parsed[LaunchFile | None]:
    return Parsed(None, (Diagnostic("error", code, line, message, cut=code in _BOUNDS),))
