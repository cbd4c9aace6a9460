"""Resources: sensors and actuators by message types, hardware interfaces, GPU, control period."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

import msgspec
from ecm_checker.contract import Evidence, Interface, Resources, Value
from ecm_checker.hub.local_name import OpenPart, Parts, shown
from ecm_checker.hub.roles import roles

from ecm_extract.assemble.controller_settings import ControllerSettings
from ecm_extract.assemble.evidence import inferred, number_of, of_interfaces, parameters_where
from ecm_extract.link.linker import LinkedModule
from ecm_extract.link.naming.filling import filled
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped_as

_BETWEEN_WORDS = re.compile(r"[/_]")
_CONTROL_RATES = frozenset({"update_rate", "controller_frequency", "control_rate", "control_frequency"})


class Actuator(msgspec.Struct, frozen=True):
    """What a type moves; with `commands`, only on topics whose name has one of these words.

    Who receives the type also moves on topics with a word of `obeys`, where others may publish what they measured.
    """

    part: str
    commands: tuple[str, ...] = ()
    obeys: tuple[str, ...] = ()


class HardwareTable(msgspec.Struct, frozen=True):
    """Message type -> sensor, and -> actuator."""

    sensors: dict[str, str]
    actuators: dict[str, Actuator]

    def moved(self, role: str, kind: str | None, name: str) -> str | None:
        """Return what an endpoint of this role, type and name moves; None when it moves nothing for sure."""
        actuator = self.actuators.get(kind or "") if not roles()[role].value else None
        return actuator.part if actuator is not None and _is_command(actuator, role, name) else None


@cache
def hardware_table() -> HardwareTable:
    """Return the table that ships with the package."""
    return shipped_as("assemble/hardware.toml", HardwareTable)


def resources_of(entry: LinkedModule, facts: PackageFacts, settings: ControllerSettings) -> Resources:
    """Return the resources section of a module."""
    return Resources(
        sensors=_sensors(entry.interfaces),
        actuators=actuators_of(entry),
        compute=_compute(facts),
        timing=_timing(entry.interfaces),
        exclusive_locks=configured_locks(entry, settings) or locks_of(entry),
    )


def _sensors(interfaces: Sequence[Interface]) -> Value | None:
    table = hardware_table().sensors
    found = [entry for entry in interfaces if roles()[entry.role].shape == "msg" and entry.type in table]
    return of_interfaces(sorted({table[entry.type or ""] for entry in found}), found)


def actuators_of(entry: LinkedModule) -> Value | None:
    """Return what a module moves: by the types of its topics and actions, and by the hardware that it commands."""
    table = hardware_table()
    moved = [(each, table.moved(each.role, each.type, each.name)) for each in entry.interfaces]
    parts = {part for _, part in moved if part is not None}
    evidence = [each.evidence[0] for each, part in moved if part is not None]
    commands = [claim for claim in entry.claims or () if claim.kind == "command"]
    if commands:
        parts.add("joints")
        evidence += [claim.evidence for claim in commands]
    return inferred(sorted(parts), evidence)


def _is_command(actuator: Actuator, role: str, name: str) -> bool:
    """Where a type is also a measurement, only the topic tells."""
    words = actuator.commands + (actuator.obeys if roles()[role].reads else ())
    return not actuator.commands or not set(words).isdisjoint(_BETWEEN_WORDS.split(name))


def _compute(facts: PackageFacts) -> Value | None:
    lines = [Evidence(path, entry.line) for path, file in facts.cmake.items() for entry in file.gpu]
    return inferred({"gpu": True} if lines else None, lines)


def _timing(interfaces: Sequence[Interface]) -> Value | None:
    for entry in parameters_where(interfaces, _CONTROL_RATES.__contains__):
        number = number_of(entry)
        if number:
            return inferred({"ctrl_hz": number}, entry.evidence[:1], "default")
    return None


def locks_of(entry: LinkedModule) -> Value | None:
    """Return the command interfaces that a controller claims; an empty list when it says that it claims none."""
    if entry.claims is None:
        return None
    commands = [claim for claim in entry.claims if claim.kind == "command"]
    names = list(dict.fromkeys(shown_claim(claim.name) for claim in commands))
    confidence = "pattern" if any("{" in name for name in names) else "folded"
    evidence = tuple(dict.fromkeys(claim.evidence for claim in commands))
    return Value(names, "inferred", confidence, evidence)  # type: ignore[arg-type]


def configured_locks(entry: LinkedModule, settings: ControllerSettings) -> Value | None:
    """Return what a controller claims with the parameters of the one YAML file that configures it.

    With several configurations the claims stay as the code writes them: which one holds, only a launch tells.
    """
    found = settings.of(entry) if entry.claims else []
    if len(found) != 1:
        return None
    path, controller = found[0]
    values = {each.name: each.value for each in controller.parameters}
    commands = [claim for claim in entry.claims or () if claim.kind == "command"]
    names = [shown(name) for claim in commands for name in filled(claim.name, values.get)]
    lines = [Evidence(path, controller.line), *(claim.evidence for claim in commands)]
    return inferred([name for name in dict.fromkeys(names) if "{" not in name], lines, "folded")


def shown_claim(name: Parts) -> str:
    """Return a claim with each parameter as its default, or as `{parameter}` where it has none."""
    return "".join(part if isinstance(part, str) else _shown(part) for part in name)


def _shown(part: OpenPart) -> str:
    known = part.of != "parameter" or all(isinstance(each, str) for each in part.default)
    return part.shown if known else f"{{{part.label}}}"
