"""Channels and gates as tables: what a release must show to run where. A project may bring its own file."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources
from pathlib import Path

import msgspec

from ecm_extract.errors import InputError


class Gate(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A gate: the column of the channels that decides its level, and what each level demands."""

    column: str
    levels: dict[str, tuple[str, ...]]


class Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Channels, lowest first, with their level in each column; and gates."""

    channels: dict[str, dict[str, str]]
    gates: dict[str, Gate]

    def demands(self, gate: str, channel: str) -> tuple[str, ...]:
        """Return what a gate demands of a release that goes to a channel."""
        found = self.gates[gate]
        return found.levels[self.channels[channel][found.column]]

    def require_channel(self, channel: str) -> None:
        """Make sure that there is a channel.

        Raises:
            InputError: there is none of that name.
        """
        if channel not in self.channels:
            message = f"there is no channel {channel}"
            raise InputError(message, f"channels: {', '.join(self.channels)}")


@cache
def gate_table(file: str | None = None) -> Table:
    """Return the tables of a file, or those of the paper.

    Raises:
        InputError: the file cannot be read or does not fit.
    """
    if file is None:
        return _checked(_text(None), "gates.toml")
    return _checked(_text(file), file)


def channels_from(channel: str) -> tuple[str, ...]:
    """Return a channel and those above it.

    Raises:
        InputError: there is no such channel.
    """
    table = gate_table()
    table.require_channel(channel)
    names = list(table.channels)
    return tuple(names[names.index(channel) :])


def _text(file: str | None) -> str:
    if file is None:
        return resources.files("ecm_extract.registry").joinpath("gates.toml").read_text("utf-8")
    try:
        return Path(file).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read {file}: {error}"
        raise InputError(message) from error


def _checked(text: str, name: str) -> Table:
    try:
        table = msgspec.convert(tomllib.loads(text), Table)
        for gate in table.gates:
            for channel in table.channels:
                table.demands(gate, channel)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        message = f"{name}: {error}"
        raise InputError(message, "see gates.toml of ecm_extract.registry for the form") from error
    except KeyError as error:
        message = f"{name}: a channel has a level, or lacks a column, that its gate does not know: {error}"
        raise InputError(message) from error
    return table
