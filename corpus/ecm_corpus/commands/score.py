"""`ecm-extract score`: the tables of the evaluation from the results of a blind run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ecm_corpus.score import Score

FORMATS = ("text", "markdown", "json", "svg")

_EPILOG = """\b
Examples:
  ecm-extract score                              the tables, from the results in the corpus
  ecm-extract score --format svg > recall.svg    recall with intervals, as a plot
"""


@click.command(short_help="Score a blind run against the documented bugs.", epilog=_EPILOG)
@click.option("--corpus", metavar="DIR", help="Folder with cases and results.  [default: the one of the checkout]")
@click.option("--results", metavar="FILE", help="Results of a blind run.  [default: results.json of the corpus]")
@click.option("--format", type=click.Choice(FORMATS), default="text", show_default=True, help="For whom.")
@click.pass_context
def command(ctx: click.Context, /, corpus: str | None, results: str | None, format: str) -> None:  # noqa: A002
    """Score the results of `ecm-extract blind` against the narratives, beside the paper's own numbers.

    No clone is needed. Exit status 1 when the chain of hashes of the results does not hold.
    """
    from importlib import import_module

    module = import_module(f"ecm_corpus.formats.{format}")
    try:
        scored = _score(corpus, results)
        text = module.render(scored)
    except ModuleNotFoundError as error:
        from ecm_extract.errors import InputError

        message = f"{error.name} is not installed"
        raise InputError(message, "pip install 'ecm-extract[evaluation]'") from error
    click.echo(text, nl=False)
    ctx.exit(1 if scored.broken else 0)


def _score(corpus: str | None, results: str | None) -> Score:
    from ecm_corpus.chain import broken_links
    from ecm_corpus.folder import corpus_folder, interfaces, narratives, read_results
    from ecm_corpus.paper import read_paper
    from ecm_corpus.score import score

    folder = corpus_folder(corpus)
    found = read_results(Path(results) if results is not None else folder / "results.json")
    broken = broken_links(found, interfaces(folder))
    return score(found, narratives(folder), read_paper(folder / "cases" / "paper.yaml"), broken)
