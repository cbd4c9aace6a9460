"""`ecm-extract can-deploy ENV RELEASE...`: may these releases go where others run already?"""

from __future__ import annotations

import click

from ecm_extract.cli.registries import (
    ProfileFiles,
    fit_options,
    open_registry,
    profile_options,
    registry_option,
    say_fit,
)


@click.command(short_help="Decide whether releases may go to an environment.")
@click.argument("environment")
@click.argument("releases", nargs=-1, required=True, metavar="RELEASE...")
@profile_options
@fit_options
@registry_option
def command(
    environment: str,
    releases: tuple[str, ...],
    profiles: ProfileFiles,
    form: str,
    fail_on: str,
    url: str | None,
) -> int:
    """Tell whether releases may go to ENVIRONMENT together, with what runs there (`registry record`).

    Nobody there may break, all that they depend on must run there, and the robot and its governance must allow
    them. Status 0: they may.
    """
    from ecm_extract.cli.registries import read_profiles

    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.fit import fit
        from ecm_extract.registry.scope import environment_scope
        from ecm_extract.registry.sides import sides_of_environment

        scope = environment_scope(session, environment)
        pairs = sides_of_environment(session, environment, releases)
        found = fit(session, pairs, scope, read_profiles(profiles))
    return say_fit(found, form, fail_on)
