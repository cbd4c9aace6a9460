"""`ecm-extract withdraw RELEASE`: a deprecated release goes out of all channels."""

from __future__ import annotations

import click

from ecm_extract.cli.registries import open_registry, registry_option


@click.command(short_help="Take a deprecated release out of all channels.")
@click.argument("release")
@registry_option
def command(release: str, url: str | None) -> None:
    """Take RELEASE out of all channels: one release cycle after its deprecation at the earliest, and when nothing
    that is recorded runs it. Its contract stays.
    """  # noqa: D205
    with open_registry(url) as registry:
        from ecm_extract.registry.promotion import withdraw

        with registry.writing() as session:
            done = withdraw(session, release)
    click.echo(f"{done}: withdrawn")
