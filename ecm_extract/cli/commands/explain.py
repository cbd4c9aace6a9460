"""`ecm-extract explain RULE`: the page of a rule."""

from __future__ import annotations

import click

from ecm_extract.cli.completions import rules


@click.command(short_help="Print the page of a rule.")
@click.argument("rule", shell_complete=rules)
def command(rule: str) -> None:
    """Print what a RULE means, when it speaks up, how it is silenced and what to do about it."""
    from ecm_extract.rule_pages import page_of

    click.echo(page_of(rule), nl=False)
