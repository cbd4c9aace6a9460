"""`ecm-extract lint [PATH]`: findings on the lines that cause them."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from functools import partial
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
    from ecm_checker.finding import Finding

    from ecm_extract.answers.answered import Answered
    from ecm_extract.diff.model import RefInfo
    from ecm_extract.lint.completeness import Completeness
    from ecm_extract.lint.request import Linted, LintRequest
    from ecm_extract.lint.workspace import Workspace
    from ecm_extract.outside import Known, Outside
    from ecm_extract.report.places import Places

FORMATS: Final = ("text", "json", *FINDING_FORMATS)

_EPILOG: Final = """\b
Examples:
  ecm-extract lint                              the workspace here
  ecm-extract lint src --base origin/main       only what this branch brings in
  git diff main | ecm-extract lint --patch -    only lines of a patch
  ecm-extract lint --output sarif=ecm.sarif     text here, SARIF into a file
"""


class Shown(msgspec.Struct, frozen=True):
    """How the answer is given, as on the command line."""

    format: str
    output: tuple[str, ...]
    statistics: bool
    fail_on: Literal["error", "warning", "info", "never"]


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
@click.option(
    "--documents",
    multiple=True,
    metavar="FILE|DIR",
    help="Documents of packages that are not in PATH. May be repeated.",
)
@known_options
def command(**options: Any) -> int:
    """Lint the ROS packages below PATH: launch files, parameter files, descriptions, plugins, sources.

    Findings go to standard output, the summary to standard error.
    """
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.lint.answering import answered_findings, baseline_of
    from ecm_extract.lint.linted import linted

    shown = Shown(*(options.pop(name) for name in Shown.__struct_fields__))
    baseline, writes, fixes = (options.pop(name) for name in ("baseline", "write_baseline", "fix"))
    request = _request(options)
    refuse_statistics_as(shown.format, shown.statistics)
    with progress_bar() as progress:
        found = linted(request, _Said(), progress)
    if writes:
        return _write_baseline(found.findings, baseline_of(request, baseline))
    answered = answered_findings(found, request, baseline_of(request, baseline))
    if fixes:
        _fix(answered.findings, found.workspace, request)
    _print(answered.findings, found, request, shown)
    _say(answered, request, found.read)
    _say_tests(found.workspace)
    return _status(answered.findings, shown.fail_on, found.read)


def _request(options: dict[str, Any]) -> LintRequest:
    from ecm_extract.lint.request import LintRequest

    if options["base_tip"] and options["base"] is None:
        message = "--base-tip says how to take --base REF, which is not given"
        raise click.UsageError(message, click.get_current_context())
    patch = _text_of(options["patch"]) if options["patch"] is not None else None
    outside = _outside(options.pop("known"), options.pop("documents"))
    return LintRequest(**{**options, "select": _selected(options["select"]), "patch": patch, "outside": outside})


def _outside(known: KnownFrom, documents: tuple[str, ...]) -> Known | None:
    """What gives the packages outside of the tree, None where nothing is named."""
    from ecm_extract.outside import gathered
    from ecm_extract.stored import read_stored

    if not known.is_asked and not documents:
        return None
    packages = [package for spec in documents for package in read_stored(spec).packages]
    return gathered(packages, partial(outside_packages, known) if known.is_asked else None)


class _Said:
    """Says on standard error what a run stands on."""

    def base(self, info: RefInfo) -> None:
        click.echo(f"base: {info.ref} {(info.commit or '')[:12]} ({info.why})", err=True)

    def outside(self, known: Outside) -> None:
        from ecm_extract.outside import told
        from ecm_extract.report.terminal import one_line

        for line in (*told(known), *_not_asked(known)):
            click.echo(one_line(line, 1000), err=True)


def _not_asked(known: Outside) -> Iterator[str]:
    """What findings on the packages together would hold, and findings on one with documents of the others do not."""
    from ecm_extract.lint.catalogue import catalogue

    if known.documents:
        rules = ", ".join(entry.rule.id for entry in catalogue() if entry.rule.of_one_tree)
        yield f"not asked of documents: {rules}, which compare packages of one tree"
        told = ", ".join(f"{entry.rule.id} ({entry.rule.of_sources})" for entry in catalogue() if entry.rule.of_sources)
        yield f"asked of sources alone: {told}"


def _selected(texts: tuple[str, ...]) -> frozenset[str]:
    """Ids of the rules that `--select` means; empty for all."""
    if not texts:
        return frozenset()
    from ecm_extract.rule_ids import rules_meant
    from ecm_extract.rule_pages import lint_rule_ids

    return rules_meant(texts, lint_rule_ids())


def _text_of(name: str) -> str:
    if name == "-":
        return sys.stdin.read()
    try:
        return Path(name).read_text("utf-8", errors="replace")
    except OSError as error:
        message = f"{name} cannot be read: {error.strerror}"
        raise InputError(message, "name a patch file, or - for standard input") from None


def _write_baseline(findings: Sequence[Finding], target: Path) -> int:
    from ecm_extract.lint.baseline_file import baseline_text

    target.write_text(baseline_text(findings), "utf-8")
    click.echo(f"written: {target} with {len({each.fingerprint for each in findings})} findings", err=True)
    return 0


def _fix(findings: tuple[Finding, ...], workspace: Workspace, request: LintRequest) -> None:
    from ecm_extract.lint.fixes import fixed_texts, fixes_of, shown

    root = Path(request.path)
    if not root.is_dir() or workspace.tree.label.count("@"):
        message = "--fix changes files, so it needs a folder"
        raise InputError(message, "name the folder of the work tree")
    for path, before, after in fixed_texts(fixes_of(findings, workspace), workspace):
        click.echo(shown(path, before, after), err=True, nl=False)
        (root / path).write_text(after, "utf-8", errors="surrogateescape", newline="")


def _print(findings: tuple[Finding, ...], found: Linted, request: LintRequest, shown: Shown) -> None:
    from ecm_extract.lint.fixes import fixes_of
    from ecm_extract.lint.linted import places_of

    output = Output(places_of(found.workspace, request), found.read)
    write_outputs(shown.output, FORMATS, lambda form: _rendered(findings, form, output))
    if shown.statistics:
        echo_report(statistics_as(shown.format, findings, lambda each: bool(fixes_of([each], found.workspace))))
    else:
        echo_report(_rendered(findings, shown.format, output, color=True))


class Output(NamedTuple):
    """What rendering needs beside the findings: how paths are written, and what was not read."""

    places: Places
    read: Completeness


def _rendered(findings: tuple[Finding, ...], form: str, output: Output, color: bool = False) -> str:
    if form == "json":
        from ecm_extract.lint.json_document import lint_json

        return lint_json(findings, output.read)
    return findings_as(form, findings, output.places, color)


def _say(answered: Answered, request: LintRequest, read: Completeness) -> None:
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


def _say_tests(workspace: Workspace) -> None:
    """What is for tests is left out of its tree, and judged where it is named itself."""
    from ecm_extract.lint.beside import tests_named

    for name in tests_named(workspace.stored, workspace.roots):
        click.echo(f"judged because it is named: {name}, which is for tests by its folder", err=True)


def _say_held(request: LintRequest) -> None:
    """What did not run is said, so that nothing found is never taken for nothing there."""
    from ecm_extract.lint.request import held

    count = len(held(request))
    if count:
        click.echo(f"{count} preview rules did not run; --preview runs them too", err=True)


def _is_failure(findings: tuple[Finding, ...], fail_on: str) -> bool:
    levels = ("error", "warning", "info")
    return fail_on != "never" and any(levels.index(each.severity) <= levels.index(fail_on) for each in findings)
