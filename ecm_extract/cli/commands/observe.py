"""`ecm-extract observe`: a running robot or a recording against the contracts of what should be there."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import click
import msgspec

from ecm_extract.cli.outputs import FINDING_FORMATS, findings_as, write_outputs
from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ecm_checker.finding import Finding

    from ecm_extract.observe.watch import Watch

FORMATS: Final = ("text", "json", *FINDING_FORMATS)

_EPILOG: Final = """\b
Examples:
  ecm-extract observe --ros1 --workspace src                 a running ROS 1 graph against the contracts of src
  ecm-extract observe --dds --workspace src --launch my_bringup/robot.launch.py --for 30
  ecm-extract observe --bag run.mcap --contracts contracts   a recording against manifests
  ecm-extract observe --dds --once --format json             what is there, as one document
"""


class Request(msgspec.Struct, frozen=True, kw_only=True):
    """What the user asked for, as on the command line."""

    ros1: str | None
    dds: str | None
    bag: tuple[str, ...]
    files: tuple[str, ...]
    contracts: tuple[str, ...]
    workspace: str | None
    launch: tuple[str, ...]
    seconds: float
    once: bool
    format: str
    output: tuple[str, ...]
    evidence: str | None
    witness: str | None
    complete: str | None
    fail_on: Literal["error", "warning", "info", "never"]
    no_cache: bool
    quiet: bool


@click.command(short_help="Compare what runs, or a recording, with contracts.", epilog=_EPILOG)
@click.argument("files", nargs=-1, metavar="[FILE]...")
@click.option("--ros1", is_flag=False, flag_value="", metavar="[URI]", help="A ROS 1 graph.  [default: ROS_MASTER_URI]")
@click.option("--dds", is_flag=False, flag_value="", metavar="[DOMAIN]", help="A DDS domain.  [default: ROS_DOMAIN_ID]")
@click.option("--bag", multiple=True, metavar="FILE", help="A recording; more FILEs may follow.")
@click.option("--contracts", multiple=True, metavar="PATH", help="Manifests or an extract document. May be repeated.")
@click.option("--workspace", metavar="DIR", help="Extract the contracts of this source tree.")
@click.option(
    "--launch",
    metavar="FILE|NAME:=VALUE",
    multiple=True,
    help="Expect what this launch file of the workspace starts, under its own names; may be repeated.",
)
@click.option(
    "--for", "seconds", type=click.FloatRange(min=0), default=10.0, show_default=True, help="Seconds to listen."
)
@click.option("--once", is_flag=True, help="Look once and do not listen: no rates, no transforms.")
@click.option("--format", type=click.Choice(FORMATS), default="text", show_default=True, help="On standard output.")
@click.option("--output", multiple=True, metavar="FORMAT=FILE", help="Also into a file. May be repeated.")
@click.option("--evidence", metavar="FILE", help="Add a record for each module to this file, one JSON a line.")
@click.option("--witness", metavar="NAME", help="Who looked, for the evidence.  [default: USER@HOST]")
@click.option("--complete", metavar="FILE", help="Write what the contracts leave open, as seen, as an overlay.")
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "info", "never"]),
    default="error",
    show_default=True,
    help="Least severity that gives exit status 1.",
)
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
@click.option("-q", "--quiet", is_flag=True, help="Print no summary.")
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Look at a running robot or a recording, and say where it differs from its contracts.

    Nothing is published, called or set. Findings go to standard output, what was seen and what could not be read to
    standard error.
    """
    request = Request(**options)
    watch = _watch(request)
    from ecm_extract.observe.compare import compare

    findings = compare(watch)
    _print(watch, findings, request)
    _keep(watch, findings, request)
    if _fails(findings, request.fail_on):
        ctx.exit(1)
    _refuse_if_nothing_was_compared(watch)
    _refuse_gaps(watch)


def _watch(request: Request) -> Watch:
    """Contracts first: a wrong path is told before anybody waits."""
    from ecm_extract.observe.inputs import Promised, Target, observations, promised_contracts
    from ecm_extract.observe.live_view import last_shown
    from ecm_extract.observe.watch import Watch

    promised = Promised(request.contracts, request.workspace, request.launch, not request.no_cache)
    contracts = promised_contracts(promised)
    bags = (*request.bag, *request.files)
    target = Target(request.ros1, request.dds, bags, request.seconds, request.once)
    return Watch(last_shown(observations(target)), contracts, launched=bool(request.launch))


def _print(watch: Watch, findings: Sequence[Finding], request: Request) -> None:
    from ecm_extract.observe.report import summary_text

    write_outputs(request.output, FORMATS, lambda form: _rendered(watch, findings, form))
    click.echo(_rendered(watch, findings, request.format), nl=False)
    if not request.quiet:
        sys.stdout.flush()
        click.echo(summary_text(watch, findings), err=True, nl=False)


def _rendered(watch: Watch, findings: Sequence[Finding], form: str) -> str:
    from ecm_extract.report.places import Places

    if form == "json":
        from ecm_extract.observe.report import report_json

        return report_json(watch, findings)
    if form == "text":
        from ecm_extract.report.findings.text import render

        return render(findings, answerable=False)
    return findings_as(form, findings, Places())


def _keep(watch: Watch, findings: Sequence[Finding], request: Request) -> None:
    if request.evidence is not None:
        from ecm_extract.observe.evidence import document, records

        _write(request.evidence, document(records(watch, findings, request.witness or _user())), "a")
    if request.complete is not None:
        from ecm_extract.observe.complete import overlay_text

        _write(request.complete, overlay_text(watch), "w")


def _write(name: str, text: str, mode: Literal["a", "w"]) -> None:
    try:
        with Path(name).open(mode, encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        message = f"{name} cannot be written: {error.strerror}"
        raise InputError(message, "name a file in a folder that is there") from None


def _user() -> str:
    import getpass
    import platform

    try:
        return f"{getpass.getuser()}@{platform.node()}"
    except (KeyError, OSError):
        return f"?@{platform.node()}"


def _refuse_if_nothing_was_compared(watch: Watch) -> None:
    """Silence about an empty place, or about contracts of which nothing runs, would be a wrong all-clear."""
    hint = "is it the right master, domain or recording? --launch gives nodes their real names"
    if watch.is_empty and not watch.seen.gaps:
        message = f"nothing is there: {watch.seen.source} {watch.seen.target}"
        raise InputError(message, hint)
    if watch.modules and not watch.present:
        message = f"nothing of the {len(watch.modules)} modules with a contract was seen, so nothing was compared"
        raise InputError(message, hint)


def _refuse_gaps(watch: Watch) -> None:
    """A run without findings that could not read everything is none without findings."""
    gaps = watch.seen.gaps
    if gaps:
        more = f", and {len(gaps) - 1} more" if len(gaps) > 1 else ""
        message = f"not everything could be read: {gaps[0].what}: {gaps[0].why}{more}"
        raise InputError(message, "what was found holds; that nothing else is wrong was not shown (OBS020)")


def _fails(findings: Sequence[Finding], threshold: str) -> bool:
    from ecm_checker.finding import SEVERITIES

    levels = SEVERITIES[: SEVERITIES.index(threshold) + 1] if threshold in SEVERITIES else ()
    return any(finding.severity in levels for finding in findings)
