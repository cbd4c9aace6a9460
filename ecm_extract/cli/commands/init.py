"""`ecm-extract init PATH`: write the overlay that a person starts from."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click
import msgspec

from ecm_extract.cli.completions import packages

if TYPE_CHECKING:
    from ecm_extract.extraction_model import Extraction, PackageContracts

_EPILOG: Final = """\b
Examples:
  ecm-extract init src/my_robot              an ecm.yaml beside each package.xml
  ecm-extract init . --package my_driver     for one package only
  ecm-extract init . --print                 show it, write nothing
"""


class Request(msgspec.Struct, frozen=True):
    """What the user asked for, as on the command line."""

    path: str
    package: str | None
    print_only: bool
    config: str | None
    jobs: int | None
    no_cache: bool


@click.command(short_help="Write an ecm.yaml with what no tool can know.", epilog=_EPILOG)
@click.argument("path", type=click.Path())
@click.option("--package", metavar="NAME", shell_complete=packages, help="Only this package.")
@click.option("--print", "print_only", is_flag=True, help="Print the overlays, write nothing.")
@click.option("--config", type=click.Path(), metavar="FILE", help="Use this ecm.toml.  [default: the one in PATH]")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
def command(**options: Any) -> None:
    """Write an `ecm.yaml` beside the package.xml of each package below PATH.

    It holds only the required fields that could not be read off the sources, commented out, each with what it means
    and an example. A file that is already there is left alone.
    """
    request = Request(**options)
    packages = _packages(request)
    for package in packages:
        _write(package, request)


def _packages(request: Request) -> list[PackageContracts]:
    from ecm_extract.asked import refuse_unknown_packages

    extraction = _extract(request)
    asked = () if request.package is None else (request.package,)
    refuse_unknown_packages(asked, {each.name for each in extraction.packages}, extraction.path)
    return [each for each in extraction.packages if request.package in (None, each.name)]


def _extract(request: Request) -> Extraction:
    from ecm_extract.asked import refuse_nothing_read
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.extraction import extract
    from ecm_extract.extraction_model import Options
    from ecm_extract.tree import open_tree

    with progress_bar() as progress:
        options = Options(False, request.config, request.jobs, progress, not request.no_cache)
        extraction = extract(open_tree(request.path), options)
    refuse_nothing_read(extraction)
    return extraction


def _write(package: PackageContracts, request: Request) -> None:
    from ecm_extract.overlay.merge import FILE_NAME
    from ecm_extract.overlay.template import overlay_template

    text = overlay_template(package.name, package.modules)
    target = Path(request.path) / package.path / FILE_NAME
    if request.print_only:
        sys.stdout.write(f"# {package.path}/{FILE_NAME}\n{text}")
    elif target.exists() or target.is_symlink():
        click.echo(f"{target} is already there and is left alone", err=True)
    else:
        target.write_text(text, "utf-8")
        click.echo(f"written: {target}")
