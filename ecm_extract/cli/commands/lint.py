"""`ecm-extract lint [PATH]`: findings on the lines that cause them."""

from __future__ import annotations

import sys
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple

import click
import msgspec

from ecm_extract.cli.completions import lint_rules, refs
from ecm_extract.cli.outputs import (
    FINDING_FORMATS,
    INCOMPLETE,
    echo_report,
    findings_as,
    refuse_statistics_as,
    statistics_as,
    write_outputs,
)
from ecm_extract.cli.registries import KnownFrom, known_options, outside_packages
from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_checker.contract import Evidence
    from ecm_checker.finding import Finding

    from ecm_extract.answers.answered import Answered
    from ecm_extract.answers.scope import Scope
    from ecm_extract.diff.model import Comparison, RefInfo
    from ecm_extract.entities.side import Side
    from ecm_extract.entities.workspace import PackagesRead
    from ecm_extract.extraction_model import Options, Progress
    from ecm_extract.lint.completeness import Completeness
    from ecm_extract.lint.workspace import Workspace
    from ecm_extract.outside import Outside
    from ecm_extract.report.places import Places
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
    base_tip: bool
    patch: str | None
    select: frozenset[str]
    preview: bool
    statistics: bool
    format: str
    output: tuple[str, ...]
    fail_on: Literal["error", "warning", "info", "never"]
    baseline: str | None
    write_baseline: bool
    fix: bool
    include_tests: bool
    config: str | None
    jobs: int | None
    known: KnownFrom


@click.command(short_help="Report what will break somebody, on the line that does.", epilog=_EPILOG)
@click.argument("path", default=".", type=click.Path())
@click.option(
    "--base",
    metavar="REF",
    shell_complete=refs,
    help="Only what changed since REF and this one parted, with its interface changes.",
)
@click.option("--base-tip", is_flag=True, help="Compare with REF as it is, not with where the change left it.")
@click.option("--patch", metavar="FILE|-", help="Only lines that a patch touches.")
@click.option(
    "--select",
    multiple=True,
    metavar="RULE",
    shell_complete=lint_rules,
    help="Only this rule, or all that begin so: LNT0. May be repeated.",
)
@click.option("--preview", is_flag=True, help="Also rules whose precision was not yet shown.")
@click.option("--statistics", is_flag=True, help="Show how many findings each rule has, and how many --fix mends.")
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
@known_options
def command(**options: Any) -> int:
    """Lint the ROS packages below PATH: launch files, parameter files, descriptions, plugins, sources.

    Findings go to standard output, the summary to standard error.
    """
    from ecm_extract.cli.progress import progress_bar

    request = Request(**{**options, "select": _selected(options["select"])})
    refuse_statistics_as(request.format, request.statistics)
    if request.base_tip and request.base is None:
        message = "--base-tip says how to take --base REF, which is not given"
        raise click.UsageError(message, click.get_current_context())
    _refuse_rules_without_matter(request)
    with progress_bar() as progress:
        findings, workspace, read = _findings(request, progress)
    if request.write_baseline:
        return _write_baseline(findings, request)
    answered = _answered(findings, workspace, request)
    if request.fix:
        _fix(answered.findings, workspace, request)
    output = Output(_places(workspace, request), read)
    if request.statistics:
        _print_statistics(answered.findings, workspace, request, output)
    else:
        _print(answered.findings, request, output)
    _say(answered, request, read)
    return _status(answered.findings, request.fail_on, read)


def _selected(texts: tuple[str, ...]) -> frozenset[str]:
    """Ids of the rules that `--select` means; empty for all."""
    if not texts:
        return frozenset()
    from ecm_extract.rule_ids import rules_meant
    from ecm_extract.rule_pages import lint_rule_ids

    return rules_meant(texts, lint_rule_ids())


def _refuse_rules_without_matter(request: Request) -> None:
    """A rule that has nothing to look at finds nothing, which must not look like nothing there."""
    from ecm_extract.lint.base import OF_CHANGES
    from ecm_extract.outside import RULE_ID as OUTSIDE

    if request.base is None and request.select and request.select <= OF_CHANGES:
        message = f"{min(request.select)} tells what a change does, and no base is given to compare with"
        raise InputError(message, "add --base REF")
    if request.select == frozenset({OUTSIDE}) and not request.known.is_asked:
        message = f"{OUTSIDE} tells what packages outside of the tree do not provide, and nothing tells of these"
        raise InputError(message, "add --registry")


class Linted(NamedTuple):
    """What a run has found, where, and what it has not read."""

    findings: list[Finding]
    workspace: Workspace
    read: Completeness


def _findings(request: Request, progress: Progress | None) -> Linted:
    from ecm_extract.asked import refuse_empty
    from ecm_extract.lint.completeness import completeness_of
    from ecm_extract.tree import open_tree

    tree = open_tree(request.path)
    parsed: dict[str, Any] = {}
    read = _read(tree, _options(request, progress), parsed)
    refuse_empty(tree, [package.root for package in read.packages])
    base = _base(tree, request, parsed) if request.base is not None else None
    workspace = _workspace(read, request)
    found = _run(workspace, request)
    comparison = None
    if base is not None:
        found, comparison = _brought_in(found, workspace, request, base)
    if request.patch is not None:
        from ecm_extract.lint.hunks import touched_lines

        lines = touched_lines(_text_of(request.patch))
        places = _places(workspace, request)
        found = [each for each in found if each.evidence and _is_touched(each.evidence[0], lines, places)]
    return Linted(found, workspace, completeness_of(tree, comparison))


def _is_touched(place: Evidence, lines: dict[str, set[int]], places: Places) -> bool:
    """Paths of a patch begin at the root of the repository, or at the folder where it was made."""
    return any(place.line in lines.get(path, ()) for path in (places.from_repository(place).path, place.path))


def _places(workspace: Workspace, request: Request) -> Places:
    from ecm_extract.report.places import Places, typed_folder
    from ecm_extract.report.source_lines import source_lines

    return Places(typed_folder(request.path), line=source_lines(workspace.files.read))


def _read(tree: Tree, options: Options, parsed: dict[str, Any]) -> PackagesRead:
    from ecm_extract.entities.workspace import read_packages

    return read_packages(tree, options, parsed)


def _workspace(read: PackagesRead, request: Request) -> Workspace:
    from ecm_extract.lint.workspace import Workspace

    return Workspace(read.tree, _options(request, None), read)


def _options(request: Request, progress: Progress | None) -> Options:
    from ecm_extract.extraction_model import Options

    return Options(request.include_tests, request.config, request.jobs, progress)


def _run(workspace: Workspace, request: Request, *, say: bool = True) -> list[Finding]:
    from ecm_extract.lint.run import findings_of

    if request.select and _held(request) == request.select:
        message = f"{min(request.select)} is a preview rule, which does not run by itself"
        raise InputError(message, "add --preview")
    config = workspace.config
    found = [
        *findings_of(workspace, request.select, config.severity, preview=request.preview),
        *_outside(workspace, request, say=say),
    ]
    return [each for each in found if not config.promise or each.who in config.promise]


def _outside(workspace: Workspace, request: Request, *, say: bool) -> list[Finding]:
    """What the registry tells of names that packages outside of the tree must provide."""
    from ecm_extract.outside import RULE_ID, outside_findings
    from ecm_extract.requires.collect import requiring_packages

    if not request.known.is_asked or (request.select and RULE_ID not in request.select):
        return []
    inside = requiring_packages(workspace.as_side())
    outside = outside_packages(request.known, inside)
    if say:
        _say_outside(outside)
    return list(outside_findings(inside, outside))


def _say_outside(outside: Outside) -> None:
    from ecm_extract.outside import told
    from ecm_extract.report.terminal import one_line

    for line in told(outside):
        click.echo(one_line(line, 1000), err=True)


class Base(NamedTuple):
    """The state before the change: its tree, why it is this one, and what gives its findings and side."""

    tree: Tree
    info: RefInfo
    result: Callable[[], tuple[list[Finding], Side]]


def _base(now: Tree, request: Request, parsed: dict[str, Any]) -> Base:
    """Lint the base in another process, while this one lints the state of now."""
    from ecm_extract.diff.baseline import open_base
    from ecm_extract.entities.workspace import side_of
    from ecm_extract.parallel_work import meanwhile

    tree, info = open_base(str(request.base), _folder(request), now, request.base_tip)
    click.echo(f"base: {info.ref} {(info.commit or '')[:12]} ({info.why})", err=True)

    def work() -> tuple[list[Finding], Side]:
        workspace = _workspace(_read(tree, _options(request, None), parsed), request)
        return _run(workspace, request, say=False), side_of(workspace.as_side())

    return Base(tree, info, meanwhile(work, request.jobs))


def _brought_in(
    found: list[Finding], workspace: Workspace, request: Request, base: Base
) -> tuple[list[Finding], Comparison]:
    from ecm_extract.diff.model import RefInfo
    from ecm_extract.diff.run import Request as Comparing
    from ecm_extract.diff.run import compared
    from ecm_extract.diff.sides import Sides
    from ecm_extract.entities.workspace import side_of
    from ecm_extract.lint.base import change_findings, new_findings
    from ecm_extract.requires.collect import consumers

    now = workspace.as_side()
    after = side_of(now)
    before, old = base.result()
    tree = workspace.tree
    infos = base.info, RefInfo(request.path, tree.commit, "named")
    comparing = Comparing(base.tree, tree, _folder(request), "", infos)
    comparison = compared(comparing, Sides(old, after, lambda: consumers(now)), {})
    comparison = _with_accepted(comparison, (base.tree, tree), workspace, request)
    changes = change_findings(comparison, base.tree, tree)
    wanted = [each for each in changes if not request.select or each.rule in request.select]
    return [*new_findings(found, before), *wanted], comparison


def _with_accepted(
    comparison: Comparison, trees: tuple[Tree, Tree], workspace: Workspace, request: Request
) -> Comparison:
    """Note which changes are accepted: a version step need not tell of them."""
    from ecm_extract.answers.accepted_file import accepted_file, accepted_in
    from ecm_extract.answers.answered import Answers
    from ecm_extract.answers.comparison import answerable, answered_comparison

    rows = accepted_in(accepted_file(_folder(request)))
    answers = Answers(rows, workspace.files.read, datetime.now(tz=UTC).date(), ())
    answered, _ = answered_comparison(comparison, answerable(comparison, trees), answers)
    return msgspec.structs.replace(comparison, accepted=answered.accepted)


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
    from ecm_extract.answers.accepted_file import accepted_file, accepted_in
    from ecm_extract.answers.answered import Answers, answered
    from ecm_extract.answers.shown import remember, shown_of
    from ecm_extract.lint.baseline_file import FILE_NAME, read_baseline
    from ecm_extract.own_files import own_file

    folder = _folder(request)
    baseline = Path(request.baseline) if request.baseline else own_file(folder, FILE_NAME)
    known = read_baseline(baseline.read_text("utf-8", errors="replace")) if baseline.is_file() else frozenset()
    left = [each for each in findings if each.fingerprint not in known]
    accepted = accepted_file(folder)
    today = datetime.now(tz=UTC).date()
    remember(shown_of(left, accepted))
    return answered(left, Answers(accepted_in(accepted), workspace.files.read, today, _whole(request)))


def _whole(request: Request) -> tuple[Scope, ...]:
    """What the run looks at as a whole; a base, a patch or a choice of rules leaves findings out."""
    return () if request.base or request.patch or request.select else ("tree",)


def _write_baseline(findings: list[Finding], request: Request) -> int:
    from ecm_extract.lint.baseline_file import FILE_NAME, baseline_text
    from ecm_extract.own_files import own_file

    target = Path(request.baseline) if request.baseline else own_file(_folder(request), FILE_NAME)
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


class Output(NamedTuple):
    """What rendering needs beside the findings: how paths are written, and what was not read."""

    places: Places
    read: Completeness


def _print_statistics(findings: tuple[Finding, ...], workspace: Workspace, request: Request, output: Output) -> None:
    from ecm_extract.lint.fixes import fixes_of

    write_outputs(request.output, FORMATS, lambda form: _rendered(findings, form, output))
    echo_report(statistics_as(request.format, findings, lambda each: bool(fixes_of([each], workspace))))


def _print(findings: tuple[Finding, ...], request: Request, output: Output) -> None:
    write_outputs(request.output, FORMATS, lambda form: _rendered(findings, form, output))
    echo_report(_rendered(findings, request.format, output, color=True))


def _rendered(findings: tuple[Finding, ...], form: str, output: Output, color: bool = False) -> str:
    if form == "json":
        from ecm_extract.lint.json_document import lint_json

        return lint_json(findings, output.read)
    return findings_as(form, findings, output.places, color)


def _say(answered: Answered, request: Request, read: Completeness) -> None:
    from ecm_extract.report.unread_text import unread_lines

    counts = {
        level: sum(each.severity == level for each in answered.findings) for level in ("error", "warning", "info")
    }
    shown = ", ".join(_counted(count, level) for level, count in counts.items() if count) or "nothing found"
    shown += "" if read.complete else " in what could be read"
    suppressed = f", {answered.suppressed} answered" if answered.suppressed else ""
    click.echo(f"{shown}{suppressed}", err=True)
    _say_held(request)
    for line in answered.unused:
        click.echo(f"unused: {line}", err=True)
    for line in unread_lines(each for each in read.unread if each.carries):
        click.echo(f"not read: {line}", err=True)


def _counted(count: int, level: str) -> str:
    """`1 error`, `2 errors`; an info has no plural."""
    return f"{count} {level}{'' if count == 1 or level == 'info' else 's'}"


def _status(findings: tuple[Finding, ...], fail_on: str, read: Completeness) -> int:
    """A finding is true whatever else was read; without one, what was not read leaves the answer open."""
    if _is_failure(findings, fail_on):
        return 1
    return 0 if read.complete else INCOMPLETE


def _held(request: Request) -> frozenset[str]:
    """Preview rules that were asked for, by name or with all others, and did not run."""
    from ecm_extract.lint.catalogue import catalogue

    preview = frozenset(entry.rule.id for entry in catalogue() if entry.rule.tier == "preview")
    wanted = preview & request.select if request.select else preview
    return frozenset() if request.preview else wanted


def _say_held(request: Request) -> None:
    """What did not run is said, so that nothing found is never taken for nothing there."""
    held = len(_held(request))
    if held:
        click.echo(f"{held} preview rules did not run; --preview runs them too", err=True)


def _is_failure(findings: tuple[Finding, ...], fail_on: str) -> bool:
    levels = ("error", "warning", "info")
    return fail_on != "never" and any(levels.index(each.severity) <= levels.index(fail_on) for each in findings)
