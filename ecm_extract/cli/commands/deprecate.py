"""`ecm-extract deprecate RELEASE`: a release is announced to go away."""

from __future__ import annotations

import click

from ecm_extract.cli.registries import open_registry, registry_option


@click.command(short_help="Announce that a release goes away.")
@click.argument("release")
@click.option("--reason", required=True, help="Why; those who use it read it.")
@click.option("--successor", metavar="RELEASE", help="What to use instead.")
@registry_option
def command(release: str, reason: str, successor: str | None, url: str | None) -> None:
    """Announce that RELEASE goes away; it can be withdrawn after the next release of its package."""
    with open_registry(url) as registry:
        from ecm_extract.registry.promotion import deprecate

        with registry.writing() as session:
            done = deprecate(session, release, reason, successor)
    click.echo(f"{done}: deprecated")
