"""`ecm-extract promote RELEASE --to CHANNEL`: six gates decide whether a release may run where more depends on it."""

from __future__ import annotations

import click

from ecm_extract.cli.registries import ProfileFiles, open_registry, profile_options, registry_option


@click.command(short_help="Ask the gates whether a release may go one channel up.")
@click.argument("release")
@click.option("--to", "channel", required=True, metavar="CHANNEL", help="sandbox, beta, stable, certified.")
@click.option("--gates", metavar="FILE", help="Channels and gates of the project.  [default: those of the paper]")
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True)
@profile_options
@registry_option
def command(release: str, channel: str, gates: str | None, form: str, profiles: ProfileFiles, url: str | None) -> int:
    """Judge RELEASE by the gates of CHANNEL, and let it go when all agree; the verdict is kept either way.

    Status 0: it went. Status 1: a gate refused; each says why, and what would do.
    """
    with open_registry(url) as registry:
        from ecm_extract.cli.registries import read_profiles
        from ecm_extract.registry.channels import gate_table
        from ecm_extract.registry.promotion import promote
        from ecm_extract.registry.texts import as_json, verdict_text

        table, given = gate_table(gates), read_profiles(profiles)
        with registry.writing() as session:
            verdict = promote(session, release, channel, table, given)
    click.echo(as_json(verdict) if form == "json" else verdict_text(verdict), nl=False)
    return int(not verdict.passed)
