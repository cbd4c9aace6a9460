"""`ecm-extract check PATH...`: may these modules be installed, invoked, composed, chained, upgraded, run together?"""

from __future__ import annotations

import sys
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import click
import msgspec

from ecm_extract.cli.outputs import (
    FINDING_FORMATS,
    INCOMPLETE,
    echo_report,
    findings_as,
    refuse_statistics_as,
    statistics_as,
    write_outputs,
)
from ecm_extract.cli.overlays import WRONG_INPUT, tell_overlay_problems
from ecm_extract.cli.registries import KnownFrom, known_options, outside_packages
from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_checker.outcome import Report

    from ecm_extract.answers.answered import Answered
    from ecm_extract.check import Given
    from ecm_extract.extraction_model import LocatedDiagnostic
    from ecm_extract.report.places import Places
    from ecm_extract.tree import Tree

OPERATIONS: Final = ("system", "compose", "chain", "install", "upgrade", "invoke")
FORMATS: Final = ("text", "json", *FINDING_FORMATS)
DIMENSIONS: Final = ("signature", "behavior", "resources", "permissions", "recovery", "versioning")

_EPILOG: Final = """\b
Examples:
  ecm-extract check src/my_robot                      what of this repository would not run together
  ecm-extract check contracts --together              these modules do run together
  ecm-extract check . --launch my_bringup/robot.launch.py     what this launch file composes
  ecm-extract check upgrade old.ecm.yaml new.ecm.yaml --embodiment robot.yaml
  ecm-extract check chain a.ecm.yaml b.ecm.yaml --policy ward.yaml --without recovery
"""


class Request(msgspec.Struct, frozen=True, kw_only=True):
    """What the user asked for, as on the command line."""

    paths: tuple[str, ...]
    operation: str
    embodiment: str | None
    policy: str | None
    runtime: str | None
    call: str | None
    dimensions: str | None
    without: tuple[str, ...]
    together: bool
    statistics: bool
    format: str
    output: tuple[str, ...]
    fail_on: Literal["error", "warning", "info", "never"]
    freeze: bool
    launch: tuple[str, ...]
    no_cache: bool
    quiet: bool
    known: KnownFrom


@click.command(short_help="Decide whether modules can be installed, composed, upgraded.", epilog=_EPILOG)
@click.argument("paths", nargs=-1, type=click.Path())
@click.option("--operation", type=click.Choice(OPERATIONS), default="system", show_default=True, help="What to decide.")
@click.option("--embodiment", type=click.Path(), metavar="FILE", help="What the robot has.")
@click.option("--policy", type=click.Path(), metavar="FILE", help="What governance allows.")
@click.option("--runtime", type=click.Path(), metavar="FILE", help="What is installed and holds.")
@click.option("--call", type=click.Path(), metavar="FILE", help="What the caller brings; for invoke.")
@click.option("--dimensions", metavar="DIM,...", help="Consult these dimensions only.")
@click.option("--without", metavar="DIM", multiple=True, help="Do not consult this dimension; may be repeated.")
@click.option("--together", is_flag=True, help="The modules of a system are known to run together.")
@click.option(
    "--launch",
    metavar="FILE|NAME:=VALUE",
    multiple=True,
    help="Check what this launch file of the workspace PATH starts, under its own names; may be repeated.",
)
@click.option("--statistics", is_flag=True, help="Show how many findings each rule has, not the findings.")
@click.option("--format", type=click.Choice(FORMATS), default="text", show_default=True, help="On standard output.")
@click.option("--output", multiple=True, metavar="FORMAT=FILE", help="Also into a file. May be repeated.")
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "info", "never"]),
    default="error",
    show_default=True,
    help="Least severity that gives exit status 1.",
)
@click.option("--freeze", is_flag=True, help="Pin the content hash of this checker and exit.")
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
@click.option("-q", "--quiet", is_flag=True, help="Print no summary.")
@known_options
@click.pass_context
def command(ctx: click.Context, /, **options: Any) -> None:
    """Check the contracts that PATHS name; the first word may be the operation.

    A path is a manifest, a folder of manifests, an extract document or a source tree. compose and chain take
    modules in their order, upgrade takes OLD NEW and then modules that use the old one. Findings go to standard
    output, the outcome and its conditions to standard error.
    """
    request = _request(options)
    if request.freeze:
        _freeze()
        return
    if not request.paths:
        message = "name at least one manifest, folder or tree"
        raise click.UsageError(message, ctx)
    refuse_statistics_as(request.format, request.statistics)
    diagnostics: list[LocatedDiagnostic] = []
    places = _places(request)
    report, answered = _answered(_decide(request, diagnostics), request)
    _print(report, request, places)
    _say_answered(answered, request)
    if tell_overlay_problems(diagnostics):
        ctx.exit(WRONG_INPUT)
    if _fails(report, request.fail_on):
        ctx.exit(1)
    if report.unread:
        ctx.exit(INCOMPLETE)


def _request(options: dict[str, Any]) -> Request:
    paths: tuple[str, ...] = options.pop("paths")
    if paths and paths[0] in OPERATIONS and not Path(paths[0]).exists():
        options["operation"], paths = paths[0], paths[1:]
    return Request(paths=paths, **options)


def _decide(request: Request, diagnostics: list[LocatedDiagnostic]) -> Report:
    from ecm_extract.check import decide
    from ecm_extract.cli.progress import progress_bar

    with progress_bar():
        return decide(
            request.operation, request.paths, _given(request, diagnostics), _dimensions(request), request.together
        )


def _given(request: Request, diagnostics: list[LocatedDiagnostic]) -> Given:
    from ecm_checker.profiles import Call, Embodiment, Policy, Runtime

    from ecm_extract.check import Given
    from ecm_extract.check_inputs import profile

    return Given(
        profile(request.embodiment, Embodiment),
        profile(request.policy, Policy),
        profile(request.runtime, Runtime),
        profile(request.call, Call),
        not request.no_cache,
        request.launch,
        diagnostics.extend,
        partial(outside_packages, request.known) if request.known.is_asked else None,
    )


def _dimensions(request: Request) -> tuple[Any, ...]:
    wanted = request.dimensions.split(",") if request.dimensions else list(DIMENSIONS)
    unknown = [name for name in (*wanted, *request.without) if name not in DIMENSIONS]
    if unknown:
        message = f"no dimension is called {unknown[0]!r}"
        raise InputError(message, f"dimensions: {', '.join(DIMENSIONS)}")
    return tuple(name for name in wanted if name not in request.without)


def _places(request: Request) -> Places:
    """Where a source tree begins; of manifests nobody knows where the sources lie."""
    from ecm_extract.report.places import Places, typed_folder
    from ecm_extract.report.source_lines import source_lines

    tree = _source_tree(request)
    return (
        Places() if tree is None else Places(typed_folder(request.paths[0]), line=source_lines(partial(_content, tree)))
    )


def _source_tree(request: Request) -> Tree | None:
    """The tree that is checked; None where manifests are, or several trees."""
    from ecm_extract.report.manifest_yaml import SUFFIX
    from ecm_extract.tree import open_tree

    first = Path(request.paths[0])
    if len(request.paths) != 1 or first.is_file() or any(True for _ in first.rglob(f"*{SUFFIX}")):
        return None
    return open_tree(request.paths[0])


def _content(tree: Tree, path: str) -> bytes | None:
    from ecm_extract.errors import TreeError

    try:
        return tree.read(path)
    except TreeError:
        return None


def _answered(report: Report, request: Request) -> tuple[Report, Answered]:
    """Decide anew without what a person has answered."""
    from ecm_checker.outcome import decided

    from ecm_extract.answers.accepted_file import accepted_file, accepted_in
    from ecm_extract.answers.answered import Answers, answered
    from ecm_extract.answers.shown import remember, shown_of

    file = accepted_file(_near(request))
    if not request.no_cache:
        remember(shown_of(report.findings, file))
    today = datetime.now(tz=UTC).date()
    tree = _source_tree(request)
    read = partial(_content, tree) if tree is not None else lambda _path: None
    found = answered(report.findings, Answers(accepted_in(file), read, today))
    return decided(report, found.findings), found


def _near(request: Request) -> Path:
    """The folder of what is checked, whose file of accepted findings counts."""
    from ecm_extract.report.places import typed_folder

    first = Path(typed_folder(request.paths[0]))
    return first.parent if first.is_file() else first


def _say_answered(answered: Answered, request: Request) -> None:
    if answered.suppressed and not request.quiet:
        click.echo(f"  {answered.suppressed} answered", err=True)
    for line in answered.unused:
        click.echo(f"unused: {line}", err=True)


def _print(report: Report, request: Request, places: Places) -> None:
    from ecm_extract.report.check_text import summary_text

    write_outputs(request.output, FORMATS, lambda form: _rendered(report, form, places))
    echo_report(_shown(report, request, places))
    if not request.quiet:
        sys.stdout.flush()
        click.echo(summary_text(report), err=True, nl=False)


def _shown(report: Report, request: Request, places: Places) -> str:
    if not request.statistics:
        return _rendered(report, request.format, places, color=True)
    from ecm_extract.report.findings.statistics import never

    return statistics_as(request.format, report.findings, never)


def _rendered(report: Report, form: str, places: Places, color: bool = False) -> str:
    if form == "json":
        from ecm_extract.report.check_text import report_json

        return report_json(report)
    if form == "html":
        from ecm_extract.report.check_html import report_html
        from ecm_extract.report.places import placed_for

        return report_html(msgspec.structs.replace(report, findings=placed_for(form, report.findings, places)))
    return findings_as(form, report.findings, places, color)


def _fails(report: Report, threshold: str) -> bool:
    from ecm_checker.finding import SEVERITIES

    levels = SEVERITIES[: SEVERITIES.index(threshold) + 1] if threshold in SEVERITIES else ()
    return any(finding.severity in levels for finding in report.findings)


def _freeze() -> None:
    from importlib import resources

    from ecm_checker.freeze import PINNED_FILE, content_hash

    file = resources.files("ecm_checker") / PINNED_FILE
    if not isinstance(file, Path):
        message = "the checker is not installed as files, so nothing can be pinned in it"
        raise InputError(message)
    try:
        file.write_text(content_hash() + "\n", "utf-8")
    except OSError as error:
        message = f"cannot write {file}: {error.strerror}"
        raise InputError(message, "pin it in a checkout of the project") from error
    click.echo(content_hash())
