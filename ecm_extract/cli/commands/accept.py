"""`ecm-extract accept FINGERPRINT`: answer a finding in a committed file."""

from __future__ import annotations

import re
from datetime import UTC, date, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_extract.answers.shown import Shown


@click.command(short_help="Accept a finding of lint, diff or check, with a reason.")
@click.argument("fingerprint")
@click.option("--reason", required=True, help="Why it is right as it is.")
@click.option("--until", metavar="YYYY-MM-DD", help="The day after which it counts again.")
@click.option(
    "--path", metavar="DIR", help="Workspace whose file is written.  [default: that of the run that showed it]"
)
@click.option("--force", is_flag=True, help="Accept what no run on this machine has shown.")
def command(fingerprint: str, reason: str, until: str | None, path: str | None, force: bool) -> None:
    """Add a row to `ecm-accepted.toml`, which is meant to be committed; lint, diff and check read it.

    The fingerprint stands beside each finding and each breaking change; it does not change when lines move or words
    change. The file is the nearest one above the workspace, else it is made in the root of the repository.
    """
    from ecm_extract.answers.shown import recall

    if not re.fullmatch(r"[0-9a-f]{16}", fingerprint):
        message = f"{fingerprint} is no fingerprint"
        raise InputError(message, "it is the 16 digits that lint, diff and check print behind `accept`")
    day = _day(until)
    shown = recall(fingerprint)
    if shown is None and not force:
        message = f"no run of lint, diff or check on this machine has shown {fingerprint}"
        raise InputError(
            message, "run the command that finds it here, or add --force when it comes from another machine"
        )
    target = _target(path, shown)
    _add(target, fingerprint, reason, day, shown)
    click.echo(
        f"accepted: {shown.rule} {shown.message}" if shown else "accepted unseen: nothing here shows it", err=True
    )
    click.echo(f"written: {target}", err=True)


def _target(path: str | None, shown: Shown | None) -> Path:
    from ecm_extract.answers.accepted_file import accepted_file
    from ecm_extract.own_files import own_file

    if path is not None and not Path(path).is_dir():
        message = f"there is no folder {path}"
        raise InputError(message, "name the folder of the workspace")
    if path is None and shown is not None:
        known = Path(shown.file)  # what lies there may be a link by now
        return own_file(known.parent, known.name)
    return accepted_file(Path(path or "."))


def _add(target: Path, fingerprint: str, reason: str, until: date | None, shown: Shown | None) -> None:
    from ecm_extract.answers.accepted_file import Accepted, accepted_bytes, accepted_row, parse_accepted

    before = accepted_bytes(target)
    if any(row.fingerprint == fingerprint for row in parse_accepted(before, str(target))):
        message = f"{fingerprint} is already in {target}"
        raise InputError(message, "edit the row there")
    scope = shown.scope if shown else "tree"
    row = Accepted(fingerprint, reason, shown.rule if shown else "", until, scope)
    try:
        target.write_text(before.decode("utf-8") + accepted_row(row), "utf-8")
    except OSError as error:
        message = f"{target} cannot be written: {error.strerror}"
        raise InputError(message, "name a workspace that you may write into with --path") from None


def _day(text: str | None) -> date | None:
    if text is None:
        return None
    try:
        day = date.fromisoformat(text)
    except ValueError:
        message = f"--until {text} is no date"
        raise InputError(message, "write it as YYYY-MM-DD") from None
    if day < datetime.now(tz=UTC).date():
        message = f"--until {text} is in the past, so nothing would be accepted"
        raise InputError(message, "name a day to come, or leave --until out")
    return day
