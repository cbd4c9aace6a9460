"""`ecm-extract demote RELEASE --to CHANNEL`: a release goes back."""

from __future__ import annotations

import click

from ecm_extract.cli.registries import open_registry, registry_option


@click.command(short_help="Lead a release back to a lower channel.")
@click.argument("release")
@click.option("--to", "channel", required=True, metavar="CHANNEL", help="A channel below its own.")
@click.option("--reason", required=True, help="Why; it stands in the audit log.")
@click.option("--gates", metavar="FILE", help="Channels and gates of the project.  [default: those of the paper]")
@registry_option
def command(release: str, channel: str, reason: str, gates: str | None, url: str | None) -> None:
    """Lead RELEASE back to CHANNEL."""
    with open_registry(url) as registry:
        from ecm_extract.registry.channels import gate_table
        from ecm_extract.registry.promotion import demote

        with registry.writing() as session:
            done = demote(session, release, channel, reason, gate_table(gates))
    click.echo(f"{done}: back in {channel}")
