"""What is raised and which types a handler is for, as sources write it."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.flow import Attempt, Branch, Leave
from ecm_parsers.source.python import parse_python

_CPP = b"""void f() {
  try { throw std::runtime_error("x"); }
  catch (const std::out_of_range & e) { throw; } catch (int) { throw 1; } catch (...) {}
}"""
_PYTHON = b"""def f():
    try:
        raise own.Trouble("x")
    except (KeyError, own.Worse) as error:
        raise
    except ValueError:
        raise error
    except:
        pass
"""


@pytest.mark.parametrize(
    ("facts", "types", "raised"),
    [
        (parse_cpp(_CPP).facts, [("std::out_of_range",), ("int",), ()], ["std::runtime_error", "", "int"]),
        (
            parse_python(_PYTHON).facts,
            [("KeyError", "own.Worse"), ("ValueError",), ()],
            ["own.Trouble", "", "error"],
        ),
    ],
    ids=["cpp", "python"],
)
def test_types_are_read_as_written(facts: object, types: object, raised: object) -> None:
    """A handler without types is for all; what is raised without a type is raised again."""
    function = next(each for each in facts.functions if each.name == "f")  # type: ignore[attr-defined]
    attempt = next(step for step in function.flow if isinstance(step, Attempt))
    assert [handler.types for handler in attempt.handlers] == types
    found = [step for block in (attempt.body, *[each.body for each in attempt.handlers]) for step in block]
    assert [step.raised for step in found if isinstance(step, Leave)] == raised


def test_contexts_that_suppress_handle() -> None:
    flow = parse_python(b"def f():\n    with suppress(KeyError):\n        a()\n").facts.functions[1].flow
    assert [handler.types for step in flow if isinstance(step, Attempt) for handler in step.handlers] == [("KeyError",)]


def test_assertions_raise_unless_they_hold() -> None:
    flow = parse_python(b"def f(x):\n    assert x, 'why'\n").facts.functions[1].flow
    assert [step.then for step in flow if isinstance(step, Branch)] == [(Leave("throw", "AssertionError"),)]


def test_coroutines_do_not_run_when_they_are_called() -> None:
    functions = parse_python(b"async def f():\n    pass\ndef g():\n    pass\n").facts.functions
    assert {function.name: function.traits for function in functions if function.name in "fg"} == {
        "f": ("coroutine",),
        "g": (),
    }
