"""What the constructors of an object, from its own to that of a base, leave a member with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_extract.infer.held import Held
from ecm_extract.link.running.env import Env, Instance

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def left_by_constructors(name: str, made: Instance, env: Env, folder: Folder) -> tuple[Held, ...]:
    """Return what a member holds when an object is made; where its own constructor leaves it alone, a base gave it."""
    lineage = folder.program.ancestry(made.cls)
    owner = next((each for each in lineage if name in each.fields), made.cls)
    for entry in (each for each in lineage if owner in folder.program.ancestry(each)):
        part = folder.objects.part(made, entry)
        if part is None or part.maker is None:
            break
        run = folder.flow.run(Env(part.maker, 0, part.args, this=made.cls, made=part, depth=env.depth + 1))
        if run is None or run.end is None or run.end.called or run.end.holds.within(f".{name}"):
            break  # somebody may have given it, or a field of it, something else
        if ways := folder.flow.left(run, f".{name}"):
            return ways
    return ()
