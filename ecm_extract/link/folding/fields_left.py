"""Fields of objects of C++ behind the functions that the objects were handed to."""

from __future__ import annotations

from dataclasses import replace

from ecm_extract.infer.held import Held
from ecm_extract.infer.run import Run
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.flow import Flow


def field_left(held: Held, ways: tuple[Held, ...], run: Run, env: Env, flow: Flow) -> tuple[Held, ...] | None:
    """Return what a field of a parameter holds when its function returns; None where that is not known.

    Args:
        held: the field where the function was called, with what it was before.
        ways: what the function leaves the field with, `given` where it left it alone.
        run: of the function.
        env: the place of the call.
        flow: of the program.
    """
    own = tuple([way for way in ways if way.how != "given"])
    if len(own) == len(ways):
        return ways
    parts = held.name.split(".")
    around = (".".join(parts[:count]) for count in range(1, len(parts)))
    if any(way.how != "given" for whole in around for way in flow.left(run, whole)):
        return None
    return (*own, *(replace(way, env=way.env or env) for way in flow.decisions.ways(held.before)))
