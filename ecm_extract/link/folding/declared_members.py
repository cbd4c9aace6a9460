"""Members that may still be what their class declares them with, though one of its methods gives them something."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Constant, Expr, Items, Member, Name, Table

from ecm_extract.infer.held import Held
from ecm_extract.infer.run import Run
from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env, Instance

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_LEFT_ALONE = frozenset({"given", "shared"})


def only_source(
    expr: Name | Member, given: Sequence[tuple[Held, Env]], env: Env, folder: Folder
) -> tuple[Held, Env] | None:
    """Return the one thing that methods give a list or a table; None where it may also be as its class declares it.

    None, too, where functions that have the object of the member change it.
    """
    is_one = len(given) == 1 and not _may_be_as_declared(expr, given[0][1].func, env, folder)
    is_one = is_one and not folder.lists.is_others(expr, env)
    return given[0] if is_one else None


def _may_be_as_declared(expr: Name | Member, giver: Func, env: Env, folder: Folder) -> bool:
    """Whether a constructor may leave it as it is declared; one that is declared empty makes nothing."""
    cls, name = env.this or env.func.cls, own_name(expr)
    if cls is None or giver.is_constructor:
        return False
    declared = next((each.fields[name].default for each in folder.program.ancestry(cls) if name in each.fields), None)
    return declared is not None and not _is_empty(declared) and not is_surely_made(name, cls, env, folder)


def is_surely_made(name: str, cls: Cls, env: Env, folder: Folder) -> bool:
    """Tell whether each constructor gives a member something, if by methods that it calls."""
    ends = [run for run in _ends_of_makers(cls, env, folder) if run is None or run.end is not None]
    return bool(ends) and all(run is not None and _is_given(name, run, folder) for run in ends)


def _is_given(name: str, run: Run, folder: Folder) -> bool:
    helds = folder.flow.left(run, f".{name}")
    return bool(helds) and not any(held.how in _LEFT_ALONE for held in helds)


def _ends_of_makers(cls: Cls, env: Env, folder: Folder) -> Iterator[Run | None]:
    """Yield the run of each constructor of a class, or of the nearest base that has one."""
    makers = next((each.constructors for each in folder.program.ancestry(cls) if each.constructors), [])
    made = env.made if env.made is not None and env.made.cls is cls else Instance(cls, {}, {})
    for maker in makers:
        if maker.fact.body and folder.objects.runs(maker, env.made):
            yield folder.flow.run(Env(maker, this=cls, made=made, depth=env.depth + 1), whole=True)


def _is_empty(declared: Expr) -> bool:
    parts = declared.items if isinstance(declared, Items) else declared.entries if isinstance(declared, Table) else None
    return isinstance(declared, Constant) or parts == ()
