"""`ecm-extract extract PATH`: read a tree and write the contracts of its modules."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, TextIO

import click
import msgspec

from ecm_extract.cli.completions import refs
from ecm_extract.cli.outputs import tell_unread
from ecm_extract.cli.overlays import tell_overlay_problems
from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_extract.extraction_model import Extraction

DEFAULT_FOLDER: Final = "ecm-manifests"
STANDARD_OUTPUT: Final = "-"

_EPILOG: Final = """\b
Examples:
  ecm-extract src/my_robot                 summary here, manifests in ecm-manifests/
  ecm-extract . --ref 1.2.0 -o contracts   a tag, into a folder of its own
  ecm-extract . --format json -o -         one document on standard output
  ecm-extract . --format summary           write nothing
"""


class Request(msgspec.Struct, frozen=True):
    """What the user asked for, as on the command line."""

    path: str
    ref: str | None
    format: Literal["yaml", "json", "summary"]
    output: str | None
    include_tests: bool
    config: str | None
    jobs: int | None
    no_cache: bool
    quiet: bool


@click.command(short_help="Write the contract of every module below a path.", epilog=_EPILOG)
@click.argument("path", type=click.Path())
@click.option("--ref", shell_complete=refs, help="Read a tag, branch or commit, not the files of the folder.")
@click.option(
    "--format",
    type=click.Choice(["yaml", "json", "summary"]),
    default="yaml",
    show_default=True,
    help="yaml: a manifest per module; json: one document; summary: write nothing.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(),
    metavar="DIR|-",
    help=f"Where to write; - is standard output.  [default: {DEFAULT_FOLDER}]",
)
@click.option("--include-tests", is_flag=True, help="Read test folders too.")
@click.option("--config", type=click.Path(), metavar="FILE", help="Use this ecm.toml.  [default: the one in PATH]")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
@click.option("-q", "--quiet", is_flag=True, help="Print no summary.")
def command(**options: Any) -> int:
    """Read the ROS packages below PATH and write the contract of every module.

    PATH is a folder in or above which packages lie, or DIR@REF. The summary goes to standard output; with
    `-o -` the documents do, and the summary goes to standard error.
    """
    request = Request(**options)
    _refuse_contradictions(request)
    extraction = _extract(request)
    if request.format == "summary":
        _summarise(extraction, sys.stdout)
    elif request.output == STANDARD_OUTPUT:
        _print_documents(extraction, request)
    else:
        _write_documents(extraction, request)
    incomplete = tell_unread(extraction.unread)
    return tell_overlay_problems(extraction.diagnostics) or incomplete


def _refuse_contradictions(request: Request) -> None:
    if request.format == "summary" and request.output not in (None, STANDARD_OUTPUT):
        message = "--format summary writes no files, so -o has nothing to say"
        raise click.UsageError(message, click.get_current_context())


def _extract(request: Request) -> Extraction:
    from ecm_extract.asked import refuse_nothing_read
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.extraction import extract
    from ecm_extract.extraction_model import Options
    from ecm_extract.tree import open_tree

    with progress_bar() as progress:
        with_hub = request.format != "summary"
        options = Options(request.include_tests, request.config, request.jobs, progress, not request.no_cache, with_hub)
        extraction = extract(open_tree(request.path, request.ref), options)
    refuse_nothing_read(extraction)
    return extraction


def _print_documents(extraction: Extraction, request: Request) -> None:
    for part in _documents(extraction, request):
        sys.stdout.buffer.write(part)
    sys.stdout.buffer.flush()
    if not request.quiet:
        _summarise(extraction, sys.stderr)


def _documents(extraction: Extraction, request: Request) -> Iterator[bytes]:
    if request.format == "json":
        from ecm_extract.report.json_document import json_document

        yield json_document(extraction)
    else:
        from ecm_extract.report.manifest_yaml import manifests_yaml

        yield from (text.encode("utf-8", "replace") for text in manifests_yaml(extraction))


def _write_documents(extraction: Extraction, request: Request) -> None:
    from ecm_extract.report.folder import keep_out_of_git, write_document, write_manifests

    folder = _folder(request)
    if request.format == "json":
        from ecm_extract.report.json_document import DOCUMENT_NAME

        written = str(write_document(b"".join(_documents(extraction, request)), folder / DOCUMENT_NAME))
    else:
        written = f"{len(write_manifests(extraction, folder))} manifests in {folder}{os.sep}"
    if request.output is None:
        keep_out_of_git(folder)
    if not request.quiet:
        _summarise(extraction, sys.stdout)
        click.echo(f"\nwritten: {written}")


def _folder(request: Request) -> Path:
    """Where to write; the default folder may not be a link, the repository could have brought it."""
    if request.output is not None:
        return Path(request.output)
    folder = Path(DEFAULT_FOLDER)
    if folder.is_symlink():
        message = f"{folder} is a symbolic link"
        raise InputError(message, f"if that is meant, say so with -o {folder}")
    return folder


def _summarise(extraction: Extraction, file: TextIO) -> None:
    from ecm_extract.report.summary import print_summary

    print_summary(extraction, file)
