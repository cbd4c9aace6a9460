"""`ecm-extract impact PACKAGE [NEW]`: who breaks if this is released."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import click

from ecm_extract.cli.registries import open_registry, registry_option, scope_options
from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_extract.registry.impact import Impact

_EPILOG: Final = """\b
Examples:
  ecm-extract impact nav2_util                      its newest release against the one before
  ecm-extract impact nav2_util src/navigation2      what is about to be released
  ecm-extract impact nav2_util@1.1.0 1.3.0 --environment robot_7
  ecm-extract impact nav2_util . --distribution jazzy/distribution.yaml --format markdown
"""


@click.command(short_help="Say who breaks if a release is published.", epilog=_EPILOG)
@click.argument("package")
@click.argument("new", required=False)
@scope_options
@click.option("--format", "form", type=click.Choice(["text", "json", "markdown"]), default="text", show_default=True)
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "never"]),
    default="warning",
    show_default=True,
    help="Exit with 1 when a line surely breaks; also when it is likely, or not everything is known.",
)
@registry_option
def command(
    package: str,
    new: str | None,
    environment: str | None,
    distribution: str | None,
    form: str,
    fail_on: str,
    url: str | None,
) -> int:
    """Compare NEW with the release of PACKAGE before it, and name each line of all stored packages that breaks.

    PACKAGE is `PACKAGE@VERSION`, or a package; NEW a version, a folder, `DIR@REF` or a document, and by default the
    newest release. Asked is the newest release of each package, or what runs or is distributed together.
    """
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.cli.registries import scope_of
        from ecm_extract.registry.impact import impact_of
        from ecm_extract.registry.sides import two_sides

        sides = two_sides(session, package, new)
        if sides.before is None:
            message = f"{sides.after.label} is the first release of its package; nobody can break"
            raise InputError(message, "name two releases, or a folder as NEW")
        found = impact_of(session, sides.before, sides.after, scope_of(session, environment, distribution))
    click.echo(_rendered(found, form), nl=False)
    if fail_on == "warning" and not found.is_whole:
        return 1
    levels = {"error": ("error",), "warning": ("error", "warning"), "never": ()}[fail_on]
    return int(any(each.severity in levels for each in found.breaks))


def _rendered(found: Impact, form: str) -> str:
    from ecm_extract.registry.texts import as_json, impact_markdown, impact_text

    return {"text": impact_text, "json": as_json, "markdown": impact_markdown}[form](found)
