"""LNT050: what a class lets others take is taken, and nobody ever gives it back."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT050",
    name="never_released",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="what was taken stays taken: whoever asks for it next is refused until a restart",
    resolution="give it back where the work ends",
)
_PAIRS: Final = (("assign_", "release_"), ("acquire_", "release_"), ("claim_", "release_"), ("lock_", "unlock_"))

_NOTHING: Final = frozenset({"void", "bool"})
"""What is returned besides may be a handle that gives back by itself."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report C++ methods that take, called by others, whose counterpart in the same class nothing calls."""
    for group in workspace.linker.program.classes.values():
        for cls in group:
            if cls.file.language == "cpp" and cls.file.package in workspace.by_name:
                yield from _of(cls, workspace)


def _of(cls: Cls, workspace: Workspace) -> Iterator[Finding]:
    names = {method.fact.name for method in cls.methods}
    plain = {method.fact.name for method in cls.methods if method.fact.returns in _NOTHING}
    calls = workspace.linker.sites.calls
    for take, give in _PAIRS:
        for name in sorted(plain):
            back = give + name.removeprefix(take)
            if not name.startswith(take) or back not in names or calls.get(back):
                continue
            taken = [call for call in calls.get(name, ()) if _is_outside(call, cls)]
            if taken:
                call = min(taken, key=lambda each: (each.func.file.path, each.line))
                text = f"{name} of {cls.fact.name} is called here, and nothing calls {back}"
                entity = Entity("method", f"{cls.qualified}::{name}", back)
                evidence = [Evidence(call.func.file.path, call.line), Evidence(cls.file.path, cls.fact.line)]
                yield RULE.finding(text, entity, call.func.file.package, evidence, certainty="likely")


def _is_outside(call: Invocation, cls: Cls) -> bool:
    """Whether somebody else calls it on an object: own helpers are the class's own affair."""
    return call.receiver is not None and call.func.cls is not cls
