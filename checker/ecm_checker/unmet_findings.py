"""Requirements that are not met, as findings: one for each name, with all lines that need it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from ecm_checker.any_rule import Said
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.hub.kinds import kinds
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.fit import left_out
from ecm_checker.match.packages import Unmet
from ecm_checker.rule import Rule

_SHOWN = 3
_ADVISED = "it warns at each call, and does what its authors advise against"


def unmet_findings(rule: Rule, unmet: Iterable[Unmet]) -> Iterator[Finding]:
    """Yield one finding of a rule for each name that somebody needs and does not get.

    Files that a project keeps for another distribution, and picks when it is launched, are for information.
    """
    grouped: dict[tuple[str, str | None, str, str], list[Unmet]] = defaultdict(list)
    for each in sorted(unmet, key=lambda entry: bool(entry.requirement.when)):  # what is surely asked speaks first
        wanted = each.requirement
        grouped[wanted.kind, wanted.package, wanted.owner, wanted.name].append(each)
    for group in grouped.values():
        yield _finding(rule, group)


def _finding(rule: Rule, group: list[Unmet]) -> Finding:
    wanted, provided = group[0].requirement, _provided(group)
    home = provided[0].package if provided else wanted.package
    lines = [at for each in group for at in each.requirement.evidence]
    lines += [Evidence(each.path, each.line) for each in provided]
    packages = tuple(dict.fromkeys([*([home] if home else []), *sorted({each.consumer for each in group})]))
    kind = kinds()[wanted.kind]
    said = Said(
        text=_text(group, wanted, home),
        consequence=_ADVISED if group[0].match.breach == "advice" else kind.silence,
        entity=Entity(wanted.kind, wanted.name),
        who=kind.who,
        owners=packages,
        subjects=tuple(f"ecm.{name}" for name in packages),
        evidence=tuple(dict.fromkeys(lines)),
        certainty=_certainty(group),
        severity="info" if all(each.requirement.kept_for for each in group) else None,
    )
    return rule.found(said)


def _provided(group: list[Unmet]) -> list[Provision]:
    """What met it before, else what is there and does not fit."""
    found = [each for unmet in group for each in (unmet.before or unmet.match.found)]
    return list({each.key: each for each in found}.values())


def _text(group: list[Unmet], wanted: Requirement, home: str | None) -> str:
    lines = [f"{at.path}:{at.line}" for each in group for at in each.requirement.evidence]
    more = f" and {len(lines) - _SHOWN} more" if len(lines) > _SHOWN else ""
    of = f" of {home}" if home else ""
    kind = wanted.kind.replace("_", " ")
    return f"{kind} {wanted.name}{of} {_state(group)}, and {', '.join(lines[:_SHOWN])}{more} {wanted.phrase}"


def _state(group: list[Unmet]) -> str:
    """What is wrong with the name, in words."""
    first = group[0]
    breach, given = first.match.breach, first.requirement.given
    if breach == "advice" and given is not None:
        names = dict.fromkeys(name for each in first.match.found for name in left_out(given, each))
        return f"warns of calls without {', '.join(names)}"
    return f"has another {breach}" if breach else _absence(group)


def _absence(group: list[Unmet]) -> str:
    return "is not in what could be read" if _is_hidden(group) else "is not there"


def _is_hidden(group: list[Unmet]) -> bool:
    return all(each.hidden and not each.match.found for each in group)


def _certainty(group: list[Unmet]) -> Certainty:
    if _is_hidden(group):
        return "unknown"
    return "proved" if any(each.requirement.needs == "proved" for each in group) else "likely"
