"""`ecm-extract agree RESULTS...`: how far judges of briefs agree."""

from __future__ import annotations

from pathlib import Path

import click

_EPILOG = """\b
A file holds what one judge says:
  judge: a name
  verdicts:
    3f9a12c4: {outcome: incompatible, dimension: signature}
    77b0e1d2: {outcome: compatible}
"""


@click.command(short_help="Agreement between judges of briefs.", epilog=_EPILOG)
@click.argument("results", nargs=-1, required=True, metavar="RESULTS...")
@click.option("--format", type=click.Choice(["text", "json"]), default="text", show_default=True, help="For whom.")
def command(results: tuple[str, ...], format: str) -> None:  # noqa: A002
    """Compute agreement and Cohen's kappa of every two judges over the briefs that both have judged."""
    import msgspec

    from ecm_corpus.agree import agreements, read_judges

    found = agreements(read_judges([Path(path) for path in results]))
    if format == "json":
        click.echo(msgspec.json.format(msgspec.json.encode(found), indent=1).decode())
        return
    for entry in found:
        click.echo(
            f"{entry.judges[0]} and {entry.judges[1]}, {entry.briefs} briefs: "
            f"outcome {entry.outcomes}/{entry.briefs}, kappa {_shown(entry.kappa_outcomes)}; "
            f"with dimension {entry.labels}/{entry.briefs}, kappa {_shown(entry.kappa_labels)}"
        )


def _shown(kappa: float | None) -> str:
    return "not defined" if kappa is None else f"{kappa:.2f}"
