"""`ecm-extract rules`: every rule in one line."""

from __future__ import annotations

import click


@click.command(short_help="List every rule.")
def command() -> None:
    """List the rules of check, lint and observe: id, severity, dimension, name."""
    from ecm_extract.rule_pages import every_rule

    for rule in every_rule():
        mark = "  (preview)" if getattr(rule, "tier", "stable") == "preview" else ""
        click.echo(f"{rule.id}  {rule.severity:<7}  {rule.dimension:<11}  {rule.name}{mark}")
