"""Parameters that somebody must set: the call that declares them has no default, and stops the node without a value."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Constant, Name, Op, Text
from ecm_parsers.source.flow import Block, Branch, Leave, Step, blocks

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import perhaps_called
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.endpoints.demanded import Asked, ends_without
from ecm_extract.link.owning.modules import Modules

_DESCRIPTOR: Final = "ParameterDescriptor"
_MAIN: Final = "main"
_PYTHON: Final = "python"
_ENTERED: Final = (Constant("true"), Op("==", (Name("__name__"), Text("__main__"))))
"""Tests of blocks that stand by themselves, and of what a script does where it is run."""


class Needed:
    """Tells which sites surely leave a value to who starts the node, and are surely reached.

    Args:
        sites: where callers are known.
        modules: which classes run by themselves.
    """

    def __init__(self, sites: Sites, modules: Modules) -> None:
        self.sites = sites
        self.modules = modules
        self._reached: dict[Func, bool] = {}

    def has(self, site: Site) -> bool:
        """Whether a site is so; a second argument may be its descriptor alone."""
        if not site.certain or not all(map(_is_plain, site.chain)):
            return False
        throws = site.form.needed and not site.call.keywords and self._is_bare(site) and _is_plain(site.call)
        return (throws or _is_demanded(site)) and self._is_reached(site.root)

    def _is_bare(self, site: Site) -> bool:
        """Whether nothing is given beside the name; C++ tells the type as a template argument then."""
        others = site.call.args[1:]
        if site.form.language == _PYTHON:
            return not others
        types = self.sites.folder.objects
        is_described = not others or last_name(types.type_of(others[0], site.env)) == _DESCRIPTOR
        return bool(site.call.types) and is_described

    def _is_reached(self, func: Func) -> bool:
        """Whether each run of a node enters a function: by its constructor, through calls that nothing decides."""
        known = self._reached.get(func)
        if known is None:
            self._reached[func] = False  # who asks in a circle
            known = self._reached[func] = self._is_entered(func)
        return known

    def _is_entered(self, func: Func) -> bool:
        if func.is_constructor and func.cls is not None and self.modules.is_module(func.cls):
            return True
        if func.cls is None and (func.fact.name == _MAIN or self.modules.is_program(func)):
            return True
        if func.is_constructor and func.cls is not None:
            return any(_is_plain(call) and self._is_reached(call.func) for call in self.sites.makers(func.cls))
        return any(_is_plain(call) and self._is_reached(call.func) for call in self.sites.callers(func))


def _is_demanded(site: Site) -> bool:
    """Whether the function of a site ends the node where what it asks for is not set."""
    if not site.form.asks:
        return False
    asked = Asked(site.call, site.form.language, site.form.asks)
    return ends_without(asked, _surely(site.call.func))


def _is_plain(call: Invocation) -> bool:
    """Whether each run of its function gets to a call: no branch, loop or attempt is around it, no return before it."""
    if any(each.line == call.line and each.args == call.args for each in perhaps_called(call.statement.value)):
        return False
    block = call.func.fact.flow
    if not block:
        return True
    for step in _without_braces(block):
        if isinstance(step, int):
            if step == call.at:
                return True
            if call.func.fact.body[step].kind == "return":
                return False
        elif _may_leave((step,), call.func):
            return False
    return call.at >= len(call.func.fact.body)


def _surely(func: Func) -> Iterator[Step]:
    """The steps of a function up to the first one that may end it and leave the node running."""
    straight = tuple(range(len(func.fact.body)))  # one without any branch has no flow of its own
    for step in _without_braces(func.fact.flow or straight):
        yield step
        if _may_leave((step,), func):
            return


def _without_braces(block: Block) -> Iterator[Step]:
    """The steps of a block, and in their place those of blocks that a program always enters: `{ ... }`."""
    for step in block:
        if isinstance(step, Branch) and step.test in _ENTERED:
            yield from _without_braces(step.then)
        else:
            yield step


def _may_leave(block: Block, func: Func) -> bool:
    """Whether something in a block may end the function and leave the node running."""
    for step in block:
        if isinstance(step, int):
            if func.fact.body[step].kind == "return":
                return True
        elif isinstance(step, Leave):
            if step.how in {"return", "goto"}:
                return True
        elif any(_may_leave(inner, func) for inner in blocks(step)):
            return True
    return False
