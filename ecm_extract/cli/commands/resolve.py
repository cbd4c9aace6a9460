"""`ecm-extract resolve REQUEST...`: one release of each package that is needed, best first."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import click

from ecm_extract.cli.registries import ProfileFiles, open_registry, profile_options, registry_option

_EPILOG: Final = """\b
Examples:
  ecm-extract resolve nav2_bringup
  ecm-extract resolve nav2_bringup 'moveit_ros>=2.5,<3' --embodiment robot.yaml --channel stable
  ecm-extract resolve nav2_bringup@1.1.20 --lock robot.lock.json --explain
"""


@click.command(short_help="Choose releases that fit together, a robot and its governance.", epilog=_EPILOG)
@click.argument("requests", nargs=-1, required=True, metavar="REQUEST...")
@click.option("--channel", metavar="CHANNEL", help="Only what is in this channel or above.")
@click.option("--lock", metavar="FILE", help="Write the lock file, which names contracts by their hash.")
@click.option("--explain", is_flag=True, help="Tell who needs each release, and why no better one was chosen.")
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True)
@profile_options
@registry_option
def command(
    requests: tuple[str, ...],
    channel: str | None,
    lock: str | None,
    explain: bool,
    form: str,
    profiles: ProfileFiles,
    url: str | None,
) -> int:
    """Choose one release of each requested package and of what it depends on: the newest that may go together.

    REQUEST is `PACKAGE`, `PACKAGE@1.2.0` or `PACKAGE>=1.2,<2`. Status 1: nothing fits; the reason names facts of
    which none can be left out.
    """
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.cli.registries import read_profiles
        from ecm_extract.registry.resolution import NoResolutionError, resolve
        from ecm_extract.registry.texts import as_json, lock_text
        from ecm_extract.registry.wishes import wish_of
        from ecm_extract.report.folder import write_document

        wishes = [wish_of(each) for each in requests]
        try:
            found = resolve(session, wishes, read_profiles(profiles), channel)
        except NoResolutionError as error:
            click.echo("nothing fits:")
            for reason in error.reasons:
                click.echo(f"  {_plain(reason)}")
            return 1
    if lock is not None:
        write_document(as_json(found).encode(), Path(lock))
    click.echo(as_json(found) if form == "json" else lock_text(found, explain=explain), nl=False)
    return 0


def _plain(text: str) -> str:
    from ecm_extract.report.terminal import one_line

    return one_line(text, 1000)
