"""`ecm-extract lint [PATH]`: findings on the lines that cause them."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple

import click
import msgspec

from ecm_extract.cli.outputs import FINDING_FORMATS, findings_as, write_outputs
from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_checker.finding import Finding

    from ecm_extract.entities.side import PackagesRead, Side
    from ecm_extract.extraction_model import Options, Progress
    from ecm_extract.lint.suppressions import Answered
    from ecm_extract.lint.workspace import Workspace
    from ecm_extract.tree import Tree

FORMATS: Final = ("text", "json", *FINDING_FORMATS)

_EPILOG: Final = """\b
Examples:
  ecm-extract lint                              the workspace here
  ecm-extract lint src --base origin/main       only what this branch brings in
  git diff main | ecm-extract lint --patch -    only lines of a patch
  ecm-extract lint --output sarif=ecm.sarif     text here, SARIF into a file
"""


class Request(msgspec.Struct, frozen=True):
    """What the user asked for, as on the command line."""

    path: str
    base: str | None
    patch: str | None
    select: tuple[str, ...]
    preview: bool
    format: str
    output: tuple[str, ...]
    fail_on: Literal["error", "warning", "info", "never"]
    baseline: str | None
    write_baseline: bool
    fix: bool
    include_tests: bool
    config: str | None
    jobs: int | None


@click.command(short_help="Report what will break somebody, on the line that does.", epilog=_EPILOG)
@click.argument("path", default=".")
@click.option("--base", metavar="REF", help="Only what the change from REF brings in, with its interface changes.")
@click.option("--patch", metavar="FILE|-", help="Only lines that a patch touches.")
@click.option("--select", multiple=True, metavar="RULE", help="Only this rule. May be repeated.")
@click.option("--preview", is_flag=True, help="Also rules whose precision was not yet shown.")
@click.option("--format", type=click.Choice(FORMATS), default="text", show_default=True, help="On standard output.")
@click.option("--output", multiple=True, metavar="FORMAT=FILE", help="Also into a file. May be repeated.")
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "info", "never"]),
    default="error",
    show_default=True,
    help="Exit with 1 from findings of this severity on.",
)
@click.option("--baseline", metavar="FILE", help="Findings to leave out.  [default: ecm-baseline.txt in PATH]")
@click.option("--write-baseline", is_flag=True, help="Write all findings of now into the baseline and exit.")
@click.option("--fix", is_flag=True, help="Correct what is sure, after showing the change.")
@click.option("--include-tests", is_flag=True, help="Read test folders too.")
@click.option("--config", metavar="FILE", help="Use this ecm.toml.  [default: the one in PATH]")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
def command(**options: Any) -> int:
    """Lint the ROS packages below PATH: launch files, parameter files, descriptions, plugins, sources.

    Findings go to standard output, the summary to standard error.
    """
    request = Request(**options)
    findings, workspace = _findings(request)
    if request.write_baseline:
        return _write_baseline(findings, request)
    answered = _answered(findings, workspace, request)
    if request.fix:
        _fix(answered.findings, workspace, request)
    _print(answered.findings, request)
    _say(answered, request)
    return int(_is_failure(answered.findings, request.fail_on))


def _findings(request: Request) -> tuple[list[Finding], Workspace]:
    from ecm_extract.tree import open_tree

    tree = open_tree(request.path)
    parsed: dict[str, Any] = {}
    read = _read(tree, request, parsed)
    base = _base(request, parsed) if request.base is not None else None
    workspace = _workspace(read, request)
    found = _run(workspace, request)
    if base is not None:
        found = _brought_in(found, workspace, request, base)
    if request.patch is not None:
        from ecm_extract.lint.hunks import touched_lines

        lines = touched_lines(_text_of(request.patch))
        found = [
            each for each in found if each.evidence and each.evidence[0].line in lines.get(each.evidence[0].path, ())
        ]
    return found, workspace


def _read(tree: Tree, request: Request, parsed: dict[str, Any]) -> PackagesRead:
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.entities.side import read_packages

    with progress_bar() as progress:
        return read_packages(tree, _options(request, progress), parsed)


def _workspace(read: PackagesRead, request: Request) -> Workspace:
    from ecm_extract.lint.workspace import Workspace

    return Workspace(read.tree, _options(request, None), read)


def _options(request: Request, progress: Progress | None) -> Options:
    from ecm_extract.extraction_model import Options

    return Options(request.include_tests, request.config, request.jobs, progress)


def _run(workspace: Workspace, request: Request) -> list[Finding]:
    from ecm_extract.lint.catalogue import catalogue
    from ecm_extract.lint.run import findings_of

    tiers = {entry.rule.id: entry.rule.tier for entry in catalogue()}
    unknown = [rule for rule in request.select if rule not in tiers]
    if unknown:
        message = f"there is no rule {unknown[0]}"
        raise InputError(message, "`ecm-extract rules` lists them")
    held = [rule for rule in request.select if tiers[rule] == "preview" and not request.preview]
    if held:
        message = f"{held[0]} is a preview rule, which does not run by itself"
        raise InputError(message, "add --preview")
    config = workspace.config
    found = findings_of(workspace, request.select, config.severity, preview=request.preview)
    return [each for each in found if not config.promise or each.who in config.promise]


class Base(NamedTuple):
    """The state before the change: its tree, and what gives its findings and its side once they are there."""

    tree: Tree
    result: Callable[[], tuple[list[Finding], Side]]


def _base(request: Request, parsed: dict[str, Any]) -> Base:
    """Lint the base in another process, while this one lints the state of now."""
    from ecm_extract.diff.background import meanwhile
    from ecm_extract.diff.baseline import open_side
    from ecm_extract.entities.side import side_of

    tree = open_side(str(request.base), _folder(request))

    def work() -> tuple[list[Finding], Side]:
        workspace = _workspace(_read(tree, request, parsed), request)
        return _run(workspace, request), side_of(workspace.as_side())

    return Base(tree, meanwhile(work, request.jobs))


def _brought_in(found: list[Finding], workspace: Workspace, request: Request, base: Base) -> list[Finding]:
    from ecm_extract.diff.model import RefInfo
    from ecm_extract.diff.run import Request as Comparing
    from ecm_extract.diff.run import compared
    from ecm_extract.diff.sides import Sides
    from ecm_extract.entities.side import side_of
    from ecm_extract.lint.base import change_findings, new_findings

    now = workspace.as_side()
    after = side_of(now)
    before, old = base.result()
    name, tree = str(request.base), workspace.tree
    click.echo(f"base: {name} {(base.tree.commit or '')[:12]}", err=True)
    infos = RefInfo(name, base.tree.commit, "named"), RefInfo(request.path, tree.commit, "named")
    comparing = Comparing(base.tree, tree, _folder(request), "", infos)
    comparison = compared(comparing, Sides(old, after, now), {})
    changes = [] if request.select else list(change_findings(comparison, base.tree, tree))
    return [*new_findings(found, before), *changes]


def _folder(request: Request) -> Path:
    """The folder of `DIR` or `DIR@REF`."""
    whole = Path(request.path)
    return whole if whole.exists() else Path(request.path.rpartition("@")[0] or request.path)


def _text_of(name: str) -> str:
    if name == "-":
        return sys.stdin.read()
    try:
        return Path(name).read_text("utf-8", errors="replace")
    except OSError as error:
        message = f"{name} cannot be read: {error.strerror}"
        raise InputError(message, "name a patch file, or - for standard input") from None


def _answered(findings: list[Finding], workspace: Workspace, request: Request) -> Answered:
    from ecm_extract.lint.baseline_file import FILE_NAME, read_baseline
    from ecm_extract.lint.suppressions import FILE_NAME as ACCEPTED
    from ecm_extract.lint.suppressions import answered, parse_accepted

    folder = _folder(request)
    baseline = Path(request.baseline) if request.baseline else folder / FILE_NAME
    known = read_baseline(baseline.read_text("utf-8", errors="replace")) if baseline.is_file() else frozenset()
    left = [each for each in findings if each.fingerprint not in known]
    accepted = folder / ACCEPTED
    rows = parse_accepted(accepted.read_bytes(), str(accepted)) if accepted.is_file() else ()
    return answered(left, rows, workspace.files, datetime.now(tz=UTC).date())


def _write_baseline(findings: list[Finding], request: Request) -> int:
    from ecm_extract.lint.baseline_file import FILE_NAME, baseline_text

    target = Path(request.baseline) if request.baseline else _folder(request) / FILE_NAME
    target.write_text(baseline_text(findings), "utf-8")
    click.echo(f"written: {target} with {len({each.fingerprint for each in findings})} findings", err=True)
    return 0


def _fix(findings: tuple[Finding, ...], workspace: Workspace, request: Request) -> None:
    from ecm_extract.lint.fixes import fixed_texts, fixes_of, shown

    root = Path(request.path)
    if not root.is_dir() or workspace.tree.label.count("@"):
        message = "--fix changes files, so it needs a folder"
        raise InputError(message, "name the folder of the work tree")
    for path, before, after in fixed_texts(fixes_of(findings, workspace), workspace):
        click.echo(shown(path, before, after), err=True, nl=False)
        (root / path).write_text(after, "utf-8", errors="surrogateescape", newline="")


def _print(findings: tuple[Finding, ...], request: Request) -> None:
    write_outputs(request.output, FORMATS, lambda form: _rendered(findings, form))
    if request.format == "text":
        from ecm_extract.report.findings.text import styled

        click.echo(styled(findings), nl=False, color=False if "NO_COLOR" in os.environ else None)
    else:
        sys.stdout.write(_rendered(findings, request.format))
        sys.stdout.flush()


def _rendered(findings: tuple[Finding, ...], form: str) -> str:
    if form == "json":
        from ecm_extract.lint.json_document import lint_json

        return lint_json(findings)
    return findings_as(form, findings)


def _say(answered: Answered, request: Request) -> None:
    counts = {
        level: sum(each.severity == level for each in answered.findings) for level in ("error", "warning", "info")
    }
    shown = ", ".join(f"{count} {level}" for level, count in counts.items() if count) or "nothing found"
    suppressed = f", {answered.suppressed} answered" if answered.suppressed else ""
    click.echo(f"{shown}{suppressed}", err=True)
    _say_held(request)
    for line in answered.unused:
        click.echo(f"unused: {line}", err=True)


def _say_held(request: Request) -> None:
    """What did not run is said, so that nothing found is never taken for nothing there."""
    from ecm_extract.lint.catalogue import catalogue

    held = sum(entry.rule.tier == "preview" for entry in catalogue())
    if held and not request.preview and not request.select:
        click.echo(f"{held} preview rules did not run; --preview runs them too", err=True)


def _is_failure(findings: tuple[Finding, ...], fail_on: str) -> bool:
    levels = ("error", "warning", "info")
    return fail_on != "never" and any(levels.index(each.severity) <= levels.index(fail_on) for each in findings)
