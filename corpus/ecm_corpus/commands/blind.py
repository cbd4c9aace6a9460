"""`ecm-extract blind CASE...`: judge cases from their interface part alone, and tie the results to their inputs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ecm_corpus.blind import Run
    from ecm_corpus.interface import InterfaceCase

_EPILOG = """\b
Examples:
  ecm-extract blind R-bdda1fa --clones ~/clones          one case, results to standard output
  ecm-extract blind --all --clones ~/clones -o corpus    all of them, and the documents that they rest on
  ecm-extract blind --stored -o corpus                   the checker changed: its findings anew, without clones
"""


@click.command(short_help="Judge documented bugs from their interfaces alone.", epilog=_EPILOG)
@click.argument("cases", nargs=-1)
@click.option("--all", "everything", is_flag=True, help="Judge every case.")
@click.option("--clones", metavar="DIR", help="Folder with local clones, as OWNER/NAME or OWNER/NAME.git.")
@click.option("--stored", is_flag=True, help="Judge the stored documents again with the checker of today; no clones.")
@click.option("--corpus", metavar="DIR", help="Folder with the cases.  [default: the one of the checkout]")
@click.option("-o", "--output", metavar="DIR", help="Write results.json and documents/ here, not to standard output.")
@click.option("--jobs", type=click.IntRange(min=1), help="Cases at a time.  [default: one per core]")
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
@click.pass_context
def command(
    ctx: click.Context,
    /,
    cases: tuple[str, ...],
    everything: bool,
    clones: str | None,
    stored: bool,
    corpus: str | None,
    output: str | None,
    jobs: int | None,
    no_cache: bool,
) -> None:
    """Judge CASES: contracts are extracted at the refs that the interface part names, and the pinned checker decides.

    The story of a case is not opened: each case is judged by a process that cannot. Nothing is fetched; a clone that
    is missing is reported with its URL, and the case is left without a result. Exit status 2 when one is missing.
    """
    from ecm_corpus.blind import results_document, run_blind, write_outcome

    if stored:
        _again(corpus, output)
        return
    if clones is None:
        message = "name the folder of the clones with --clones, or give --stored"
        raise click.UsageError(message, ctx)
    if not cases and not everything:
        message = "name cases, or give --all"
        raise click.UsageError(message, ctx)
    outcome = run_blind(_cases(cases, corpus), _run(clones, jobs, not no_cache))
    if output is not None:
        write_outcome(outcome, Path(output))
    else:
        click.echo(results_document(outcome.results).decode(), nl=False)
    missing = {url: case.case for case in outcome.results.cases for url in case.missing}
    for url, case in missing.items():
        click.echo(f"missing: {url} (for {case})", err=True)
    ctx.exit(2 if missing else 0)


def _again(corpus: str | None, output: str | None) -> None:
    """Write the stored results with what the checker of today says of their documents."""
    from ecm_corpus.again import judged_again
    from ecm_corpus.blind import results_document
    from ecm_corpus.documents import STORE
    from ecm_corpus.folder import corpus_folder, read_results

    folder = corpus_folder(corpus)
    document = results_document(judged_again(read_results(folder / "results.json"), folder / STORE))
    if output is not None:
        (Path(output) / "results.json").write_bytes(document)
    else:
        click.echo(document.decode(), nl=False)


def _cases(names: tuple[str, ...], corpus: str | None) -> list[InterfaceCase]:
    from ecm_corpus.folder import corpus_folder, interface_of, interfaces

    folder = corpus_folder(corpus)
    return [interface_of(name, folder) for name in names] if names else interfaces(folder)


def _run(clones: str, jobs: int | None, cache: bool) -> Run:
    import os

    from ecm_corpus.blind import Run

    def tell(case: str) -> None:
        click.echo(case, err=True)

    return Run(Path(clones), cache, jobs or os.cpu_count() or 1, tell)
