"""`ecm-extract can-release PACKAGE [NEW]`: may this be released beside what is there?"""

from __future__ import annotations

import click

from ecm_extract.cli.registries import (
    ProfileFiles,
    fit_options,
    open_registry,
    profile_options,
    registry_option,
    say_fit,
    scope_of,
)


@click.command(short_help="Decide whether a release fits what is released already.")
@click.argument("package")
@click.argument("new", required=False)
@click.option("--to", "channel", metavar="CHANNEL", help="Beside what is in this channel or above.")
@click.option("--distribution", metavar="FILE", help="Beside what a distribution.yaml or .repos file lists.")
@profile_options
@fit_options
@registry_option
def command(
    package: str,
    new: str | None,
    channel: str | None,
    distribution: str | None,
    profiles: ProfileFiles,
    form: str,
    fail_on: str,
    url: str | None,
) -> int:
    """Tell whether NEW may take the place of PACKAGE among the releases that are there.

    Nobody there may break, all that it depends on must be there in the versions that it names, and provide the
    names that it needs. PACKAGE and NEW are those of `impact`. Status 0: it may.
    """
    from ecm_extract.cli.registries import read_profiles

    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.fit import fit
        from ecm_extract.registry.scope import channel_scope
        from ecm_extract.registry.sides import two_sides

        scope = channel_scope(session, channel) if channel else scope_of(session, None, distribution)
        sides = two_sides(session, package, new)
        found = fit(session, [sides], scope, read_profiles(profiles))
    return say_fit(found, form, fail_on)
