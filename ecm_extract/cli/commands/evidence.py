"""`ecm-extract evidence add|state|list`: what was observed, tested or reviewed of a release."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ecm_extract.cli.registries import open_registry, registry_option

if TYPE_CHECKING:
    from ecm_checker.wire import EvidenceRecord

_KINDS = ("observation", "validation", "upgrade_test", "policy_review", "rollback_test")
_RESULTS = ("confirmed", "contradicted", "doubtful", "not_seen")


@click.group(short_help="Keep what was observed, tested or reviewed of a release.")
def command() -> None:
    """Keep evidence of releases: gates stand on it."""


@command.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@registry_option
def add(files: tuple[str, ...], url: str | None) -> None:
    """Keep the records of files, one JSON document a line (`ecm-extract/evidence/1`); all of them or none."""
    with open_registry(url) as registry:
        from ecm_extract.registry.evidence import add_evidence, read_evidence
        from ecm_extract.registry.texts import added_lines

        records = [record for file in files for record in read_evidence(file)]
        with registry.writing() as session:
            added = add_evidence(session, records)
    for line in added_lines(added):
        click.echo(_plain(line))


@command.command()
@click.argument("release")
@click.option("--kind", type=click.Choice(_KINDS), required=True, help="What was done.")
@click.option("--by", required=True, metavar="NAME", help="Who did it.")
@click.option("--on", metavar="TEXT", help="On what: a robot, a ticket, a report.")
@click.option("--result", type=click.Choice(_RESULTS), default="confirmed", show_default=True, help="What came of it.")
@click.option("--note", default="", help="In words.")
@registry_option
def state(release: str, url: str | None, **said: Any) -> None:
    """State evidence of RELEASE: it names the content that is stored of it now."""
    with open_registry(url) as registry:
        from ecm_extract.registry.evidence import Statement, add_evidence, stated

        with registry.writing() as session:
            add_evidence(session, [stated(session, release, Statement(**said))])
    click.echo(f"{_plain(release)}: {said['kind']} {said['result']}")


@command.command(name="list")
@click.argument("release")
@registry_option
def list_(release: str, url: str | None) -> None:
    """List the evidence of RELEASE, oldest first."""
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.evidence import evidence_of
        from ecm_extract.registry.releases import find_release

        found = evidence_of(session, find_release(session, release).id)
    for each in found:
        record = each.evidence
        click.echo(_plain(f"{each.digest[:12]} {_told(record)}"))


def _told(record: EvidenceRecord) -> str:
    about = f" of {record.subject.module_id}" if record.subject.module_id else ""
    said = f"{record.begun} {record.kind}{about} {record.result} by {record.by.name}{_on(record)}"
    return f"{said} {record.note}" if record.note else said


def _on(record: EvidenceRecord) -> str:
    if not record.on:
        return ""
    return f" on {record.on}" if isinstance(record.on, str) else f" on {record.on.source} {record.on.target}"


def _plain(text: str) -> str:
    from ecm_extract.report.terminal import one_line

    return one_line(text, 1000)
