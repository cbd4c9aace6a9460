"""`ecm-extract cache info|clear`: what is kept from run to run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import click

from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_extract.cache.store import Info, Store

_MEGABYTE: Final = 1_000_000


@click.group(short_help="Tell or delete what is kept from run to run.")
def command() -> None:
    """Look after the cache: facts of source files by their content, and whole extractions.

    It lies in the user's cache folder, or where ECM_CACHE_DIR says. Losing it costs only time.
    """


@command.command()
def info() -> None:
    """Tell where the cache lies and how much it holds."""
    from ecm_extract.cache.version import EXTRACTION, FACTS, version_of

    found = _store().info()
    click.echo(f"folder:  {_shown(found)}")
    click.echo(f"entries: {found.entries}")
    click.echo(f"size:    {found.bytes / _MEGABYTE:.1f} MB of at most {found.limit / _MEGABYTE:.0f} MB")
    click.echo(f"version: facts {version_of(FACTS)[:12]}, extractions {version_of(EXTRACTION)[:12]}")
    if found.problem:
        click.echo(f"not used: {found.problem}")


@command.command()
def clear() -> None:
    """Delete what is kept."""
    from ecm_extract.cache.folder import UntrustedFolderError

    store = _store()
    try:
        store.clear()
    except (OSError, UntrustedFolderError) as error:
        message = f"the cache in {store.folder} cannot be deleted: {error}"
        raise InputError(message, "look at the folder, or name another with ECM_CACHE_DIR") from error


def _store() -> Store:
    from ecm_extract.cache.folder import cache_folder
    from ecm_extract.cache.store import Store

    return Store(cache_folder())


def _shown(found: Info) -> str:
    from ecm_extract.report.terminal import one_line

    return one_line(str(found.folder))
