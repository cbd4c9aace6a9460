"""`ecm-extract brief CASE`: interface-only briefs of a case, for a person or another tool to judge."""

from __future__ import annotations

from pathlib import Path

import click


@click.command(short_help="Interface-only briefs of a documented bug.")
@click.argument("case")
@click.option("--corpus", metavar="DIR", help="Folder with results and documents.  [default: the one of the checkout]")
@click.option("--key", metavar="FILE", help="Write here which brief is which; keep it from who judges.")
def command(case: str, corpus: str | None, key: str | None) -> None:
    """Print what the sides of CASE declare, its repaired twins and unrelated pairs mixed in, without the story.

    Answers go to `ecm-extract agree`.
    """
    from ecm_corpus.brief import briefs
    from ecm_corpus.documents import STORE
    from ecm_corpus.folder import corpus_folder, read_results
    from ecm_extract.errors import InputError

    folder = corpus_folder(corpus)
    results = read_results(folder / "results.json")
    wanted = next((entry for entry in results.cases if entry.case == case), None)
    if wanted is None:
        message = f"no results of a case {case!r}"
        raise InputError(message, "ecm-extract blind judges cases and writes results")
    found = briefs(wanted, results, folder / STORE)
    click.echo("\n".join(brief.text for brief in found), nl=False)
    if key is not None:
        Path(key).write_text("".join(f"{brief.id}: {brief.origin}\n" for brief in found), "utf-8")
