"""All calls of a program by the last name of what is called; constructions also through aliases of classes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Set

from msgspec.structs import replace

from ecm_extract.link.code.beginnings import beginnings
from ecm_extract.link.code.calls import Invocation, invocations
from ecm_extract.link.code.spelling import by_value, last_name, plain, template_arguments
from ecm_extract.link.index.own_class import of_own_class
from ecm_extract.link.index.program import Program


def call_index(program: Program, wanted: Set[str], aliases: Set[str]) -> dict[str, list[Invocation]]:
    """Return name -> calls.

    Args:
        program: where the calls stand.
        wanted: last names of the calls that matter.
        aliases: names that may stand for a class of the program, or for one that a form is about.
    """
    index: dict[str, list[Invocation]] = defaultdict(list)
    names = wanted | aliases
    for functions in program.functions.values():
        for func in functions:
            for call in invocations(func, names):
                index[call.last].append(call)
            for call in of_own_class(func, program):
                index[call.last].append(call)
    for group in program.classes.values():
        for cls in group:
            for call in beginnings(cls):
                index[call.last].append(call)
    for name in sorted(aliases):
        for call in tuple(index.get(name, ())):
            _add_meant(call, program, index, wanted)
    return index


def _add_meant(call: Invocation, program: Program, index: dict[str, list[Invocation]], wanted: Set[str]) -> None:
    """`Reader reader;` with `using Reader = Basic<int>` makes a `Basic`, with the arguments of the alias."""
    if call.receiver is not None:
        return
    target = program.alias(call.path, call.func.file, call.func.scope)
    if target is None or not by_value(target):
        return  # a pointer, or what a template calls a type, such as that of its callbacks
    types = call.types or template_arguments(target)
    cls = program.class_named(call.path, call.func.file, call.func.scope)
    if cls is not None and cls.fact.name != call.last:  # a class that is called like its alias has the call already
        index[cls.fact.name].append(replace(call, types=types))
    elif last_name(plain(target)) in wanted:
        index[last_name(plain(target))].append(replace(call, path=plain(target), types=types))
