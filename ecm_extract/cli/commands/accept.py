"""`ecm-extract accept FINGERPRINT`: answer a finding in a committed file."""

from __future__ import annotations

import re
from datetime import date
from pathlib import Path

import click

from ecm_extract.errors import InputError


@click.command(short_help="Accept a finding, with a reason.")
@click.argument("fingerprint")
@click.option("--reason", required=True, help="Why it is right as it is.")
@click.option("--until", metavar="YYYY-MM-DD", help="The day after which it counts again.")
@click.option("--path", default=".", show_default=True, help="The workspace whose file is written.")
def command(fingerprint: str, reason: str, until: str | None, path: str) -> None:
    """Add a row to `ecm-accepted.toml` in the workspace, which is meant to be committed.

    The fingerprint stands below each finding; it does not change when lines move or words change.
    """
    from ecm_extract.lint.suppressions import FILE_NAME, Accepted, accepted_row, parse_accepted
    from ecm_extract.own_files import own_file

    if not re.fullmatch(r"[0-9a-f]{16}", fingerprint):
        message = f"{fingerprint} is no fingerprint"
        raise InputError(message, "it is the 16 digits that lint prints behind `accept:`")
    target = own_file(Path(path), FILE_NAME)
    before = target.read_bytes() if target.is_file() else b""
    if any(row.fingerprint == fingerprint for row in parse_accepted(before, str(target))):
        message = f"{fingerprint} is already in {target}"
        raise InputError(message, "edit the row there")
    row = accepted_row(Accepted(fingerprint, reason, until=_day(until)))
    target.write_text(before.decode("utf-8") + row, "utf-8")
    click.echo(f"written: {target}", err=True)


def _day(text: str | None) -> date | None:
    try:
        return None if text is None else date.fromisoformat(text)
    except ValueError:
        message = f"--until {text} is no date"
        raise InputError(message, "write it as YYYY-MM-DD") from None
