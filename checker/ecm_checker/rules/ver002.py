"""A module depends on a version that is not installed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.profiles import Runtime
from ecm_checker.rule import Rule
from ecm_checker.versions import in_range
from ecm_checker.view import View

RULE = Rule(
    id="VER002",
    name="dependency_unsatisfied",
    dimension="versioning",
    severity="error",
    who="config",
    part_of=("DepSat",),
    tier="semver",
    consequence="the module does not start, or calls what another version no longer has",
    resolution="install a version in the range, or choose a release of the module that fits what is installed",
)


def check(case: Case) -> Iterator[Finding]:
    """Dependency ranges against versions of the runtime."""
    runtime = case.profiles.runtime
    for module in case.modules if runtime is not None else ():
        assert runtime is not None
        evidence = module.evidence("versioning.dependencies")
        if module.dependencies is None:
            text = f"the dependencies of {module.id} are undeclared"
            yield RULE.finding(text, Entity("dependency", ""), (module,), evidence, certainty="unknown")
        for name, text, certainty in _unsatisfied(module, runtime):
            yield RULE.finding(text, Entity("dependency", name), (module,), evidence, certainty=certainty)


def _unsatisfied(module: View, runtime: Runtime) -> Iterator[tuple[str, str, Certainty]]:
    for name, wanted in (module.dependencies or {}).items():
        has = runtime.versions.get(name)
        if has is None:
            certainty: Certainty = "proved" if runtime.complete else "unknown"
            yield name, f"{module.id} depends on {name}, which is not installed", certainty
            continue
        fits = in_range(has, str(wanted))
        if not fits:
            certainty = "unknown" if fits is None else "proved"
            yield name, f"{module.id} depends on {name} {wanted}, installed is {has}", certainty
