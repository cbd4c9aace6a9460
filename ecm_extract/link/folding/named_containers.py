"""Containers of C++ that have a name of their own: `typedef std::map<std::string, int> Limits`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_extract.link.code.containers import is_container, is_map
from ecm_extract.link.code.spelling import plain

if TYPE_CHECKING:
    from ecm_extract.infer.held import Held
    from ecm_extract.link.code.units import Cls, Func
    from ecm_extract.link.index.program import Program


def container_of_member(written: str, cls: Cls, program: Program) -> str:
    """Return the type of a data member, of an alias of a container what that stands for."""
    if not written or is_container(written):
        return written
    return program.alias(plain(written), cls.file, cls.qualified) or written


def container_of_variable(written: str, func: Func, program: Program) -> str:
    """Return the type of a variable of a function, of an alias of a container what that stands for."""
    if not written or is_container(written):
        return written
    return program.alias(plain(written), func.file, func.scope) or written


def is_table(held: Held, program: Program) -> bool:
    """Tell whether what a variable holds was declared as a table."""
    func = held.env.func if held.env is not None else None
    if func is None or not 0 <= held.at < len(func.fact.body):
        return False
    return is_map(container_of_variable(func.fact.body[held.at].type, func, program))
