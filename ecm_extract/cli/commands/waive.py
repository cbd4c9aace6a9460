"""`ecm-extract waive RELEASE GATE --to CHANNEL`: somebody answers for a gate."""

from __future__ import annotations

from datetime import UTC, datetime, time

import click

from ecm_extract.cli.registries import open_registry, registry_option
from ecm_extract.errors import InputError


@click.command(short_help="Answer for a gate that a release does not pass.")
@click.argument("release")
@click.argument("gate")
@click.option("--to", "channel", required=True, metavar="CHANNEL", help="For the way to this channel.")
@click.option("--name", required=True, help="Who answers for it.")
@click.option("--reason", required=True, help="Why it may be passed all the same.")
@click.option("--until", required=True, metavar="YYYY-MM-DD", help="The last day on which it counts.")
@click.option("--gates", metavar="FILE", help="Channels and gates of the project.  [default: those of the paper]")
@registry_option
def command(
    release: str,
    gate: str,
    channel: str,
    name: str,
    reason: str,
    until: str,
    gates: str | None,
    url: str | None,
) -> None:
    """Keep that somebody answers for GATE when RELEASE goes to CHANNEL; the promotion tells who and why."""
    with open_registry(url) as registry:
        from ecm_extract.registry.channels import gate_table
        from ecm_extract.registry.gates import Waiver
        from ecm_extract.registry.promotion import waive

        table = gate_table(gates)
        table.require_channel(channel)
        if gate not in table.gates:
            message = f"there is no gate {gate}"
            raise InputError(message, f"gates: {', '.join(table.gates)}")
        with registry.writing() as session:
            done = waive(session, release, channel, Waiver(gate, name, reason, _end(until)))
    click.echo(f"{done}: {name} answers for the {gate} gate of {channel} until {until}")


def _end(day: str) -> str:
    from ecm_extract.registry import clock

    try:
        found = datetime.strptime(day, "%Y-%m-%d").date()
    except ValueError as error:
        message = f"--until {day} is no day"
        raise InputError(message, "write YYYY-MM-DD") from error
    return clock.written(datetime.combine(found, time.max, UTC))
