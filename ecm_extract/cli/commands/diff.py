"""`ecm-extract diff OLD NEW`: what a release changed, and whom it breaks."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import click
import msgspec

from ecm_extract.cli.completions import packages, sides
from ecm_extract.cli.outputs import INCOMPLETE, echo_report, findings_as, write_outputs
from ecm_extract.report.terminal import one_line

if TYPE_CHECKING:
    from ecm_checker.release import Change

    from ecm_extract.answers.answered import Answered
    from ecm_extract.answers.scope import Scope
    from ecm_extract.diff.model import Comparison, RefInfo
    from ecm_extract.diff.run import Request
    from ecm_extract.diff.steps import ShortStep
    from ecm_extract.extraction_model import Progress
    from ecm_extract.report.places import Places
    from ecm_extract.stored import Stored
    from ecm_extract.tree import Tree

FORMATS: Final = ("text", "json", "migration", "migration-spec", "markdown", "html", "sarif", "github", "junit")

_EPILOG: Final = """\b
Examples:
  ecm-extract diff                              newest release tag against the work tree
  ecm-extract diff 1.1.20 1.3.0 --repo nav2     two tags of a clone, nothing is checked out
  ecm-extract diff 1.1.20 1.3.0 --repo nav2 --consumer src/my_robot
  ecm-extract diff 1.2.0 . --format migration   the section for a migration guide
"""

FailOn = Literal["error", "warning", "info", "breaking", "never"]


class Asked(msgspec.Struct, frozen=True):
    """What the user asked for, as on the command line."""

    old: str | None
    new: str
    repo: str
    consumer: tuple[str, ...]
    package: tuple[str, ...]
    format: str
    output: tuple[str, ...]
    fail_on: FailOn
    backport: bool
    include_tests: bool
    config: str | None
    jobs: int | None
    no_cache: bool


@click.command(short_help="Say what changed between two releases, and whom it breaks.", epilog=_EPILOG)
@click.argument("old", required=False, shell_complete=sides)
@click.argument("new", required=False, default=".", shell_complete=sides)
@click.option("--repo", metavar="DIR", default=".", show_default=True, help="Repository of the refs.")
@click.option(
    "--consumer",
    metavar="PATH|DIR@REF",
    multiple=True,
    help="Packages that use these; their lines that break are findings.  [the new side always is one]",
)
@click.option("--package", metavar="NAME", multiple=True, shell_complete=packages, help="Only changes of this package.")
@click.option(
    "--format",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="migration: section of a guide; migration-spec: the same for programs; markdown: comment of a pull request; "
    "sarif, github, junit: findings only.",
)
@click.option("--output", multiple=True, metavar="FORMAT=FILE", help="Also into a file. May be repeated.")
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "info", "breaking", "never"]),
    default="error",
    show_default=True,
    help="Exit with 1 from findings of this severity on; breaking: on any breaking change. A version step that is less "
    "than the changes need is always 1, but for never.",
)
@click.option("--backport", is_flag=True, help="Print one line: may this go into a released distribution?")
@click.option("--include-tests", is_flag=True, help="Read test folders too.")
@click.option("--config", metavar="FILE", help="Use this ecm.toml.  [default: the one in each tree]")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
def command(**options: Any) -> int:
    """Compare the public entities of OLD and NEW: tags, branches, commits, `REF:subdir` or folders.

    OLD defaults to the newest release tag that NEW can reach, NEW to the work tree. The report goes to standard
    output, what was compared and the verdict to standard error.
    """
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.collector import without_collector
    from ecm_extract.diff.run import compare
    from ecm_extract.diff.steps import short_steps

    asked = Asked(**options)
    with progress_bar() as progress, without_collector():
        request = _request(asked, progress)
        compared = compare(request)
    comparison, answered = _answered(compared, request, asked)
    short = short_steps(comparison)
    _print(comparison, asked, _places(comparison, request, asked))
    _say_verdict(comparison)
    _say_what_to_do(comparison, short)
    _say_unused(answered)
    return _status(comparison, short, asked)


def _answered(comparison: Comparison, request: Request, asked: Asked) -> tuple[Comparison, Answered]:
    """Take out what was answered, in the new tree or in the file of the repository on disk."""
    from ecm_extract.answers.accepted_file import FILE_NAME, accepted_file, accepted_in, parse_accepted
    from ecm_extract.answers.answered import Answers
    from ecm_extract.answers.comparison import answerable, answered_comparison
    from ecm_extract.answers.shown import remember, shown_of

    old, new = (_contents(side, request) for side in (request.old, request.new))
    file = accepted_file(Path(asked.repo))
    found = answerable(comparison, None if old is None or new is None else (old, new))
    stored = parse_accepted(_content(new, FILE_NAME) or b"", f"{request.new.label}: {FILE_NAME}")
    rows = {row.fingerprint: row for row in (*stored, *accepted_in(file))}
    if not asked.no_cache:
        remember(shown_of(found, file))
    today = datetime.now(tz=UTC).date()
    scopes: tuple[Scope, ...] = () if asked.package else ("change",)
    answers = Answers(tuple(rows.values()), partial(_content, new), today, scopes)
    return answered_comparison(comparison, found, answers)


def _contents(side: Tree | Stored, request: Request) -> Tree | None:
    """The files of a side; of stored documents those that the repository holds, without one nobody has them."""
    from ecm_extract.stored import Stored, contents_of
    from ecm_extract.tree.git_repo import find_repo

    if not isinstance(side, Stored):
        return side
    repo = find_repo(request.repo) if request.repo is not None else None
    return contents_of(side, repo) if repo is not None else None


def _content(tree: Tree | None, path: str) -> bytes | None:
    """Content of a file of the new side; None where nobody has it."""
    from ecm_extract.errors import TreeReadError

    try:
        return None if tree is None else tree.read(path)
    except TreeReadError:
        return None


def _request(asked: Asked, progress: Progress | None) -> Request:
    from ecm_extract.diff.baseline import WORK_TREE, default_baseline, open_consumer, open_side, parting
    from ecm_extract.diff.model import RefInfo
    from ecm_extract.diff.run import Request
    from ecm_extract.extraction_model import Options
    from ecm_extract.tree.git_repo import find_repo
    from ecm_extract.tree.work_tree import has_uncommitted

    folder = Path(asked.repo)
    spec, why = (asked.old, "named") if asked.old else default_baseline(asked.new, folder)
    old, new = open_side(spec, folder), open_side(asked.new, folder)
    repo = find_repo(folder)
    dirty = repo is not None and asked.new == WORK_TREE and has_uncommitted(repo)
    infos = RefInfo(spec, old.commit, why), RefInfo(asked.new, new.commit, "named", dirty)
    _say_baseline(infos)
    _say_parting(infos, parting(old, new, folder))
    options = Options(asked.include_tests, asked.config, asked.jobs, progress, not asked.no_cache)
    return Request(
        old=old,
        new=new,
        repo=folder if repo is not None else None,
        name=repo.name if repo is not None else folder.resolve().name,
        infos=infos,
        consumers=tuple(open_consumer(entry) for entry in asked.consumer),
        packages=asked.package,
        options=options,
    )


def _say_baseline(infos: tuple[RefInfo, RefInfo]) -> None:
    old, new = infos
    click.echo(f"baseline: {_shown(old)} ({old.why})", err=True)
    click.echo(f"against:  {_shown(new)}", err=True)


def _say_parting(infos: tuple[RefInfo, RefInfo], commit: str | None) -> None:
    """Two branches each have what the other lacks: who compares them may want only what one of them did."""
    if commit is not None:
        old, new = infos
        why = f"what it has gained since they parted at {commit[:12]} is removed here"
        note = f"{old.ref} is not behind {new.ref}: {why}"
        click.echo(f"note: {one_line(note)}", err=True)


def _shown(info: RefInfo) -> str:
    state = " with uncommitted changes" if info.uncommitted else ""
    return one_line(f"{info.ref} {info.commit[:12] if info.commit else 'files in no commit'}{state}")


def _places(comparison: Comparison, request: Request, asked: Asked) -> Places:
    """Paths of the new side; of a ref they are those of the same files on disk."""
    from ecm_extract.diff.baseline import WORK_TREE
    from ecm_extract.report.places import Places, typed_folder
    from ecm_extract.report.source_lines import source_lines

    named = asked.new != WORK_TREE and Path(asked.new.split("@", 1)[0]).is_dir()
    folder = typed_folder(asked.new) if named else typed_folder(f"{asked.repo}@{asked.new}")
    contents = _contents(request.new, request)
    return Places(folder, comparison.homes, source_lines(partial(_content, contents), comparison.homes))


def _print(comparison: Comparison, asked: Asked, places: Places) -> None:
    if asked.backport:
        from ecm_extract.diff.verdict import backport_line

        click.echo(backport_line(comparison, _open_changes(comparison)))
        return
    write_outputs(asked.output, FORMATS, lambda form: _rendered(comparison, form, places))
    echo_report(_rendered(comparison, asked.format, places, color=True))


def _rendered(comparison: Comparison, form: str, places: Places, color: bool = False) -> str:
    if form in {"sarif", "github", "junit"}:
        return findings_as(form, comparison.findings, places)
    if form == "text":
        from ecm_extract.diff.formats.text import render, styled

        return styled(comparison, places) if color else render(comparison, places)
    module = import_module(f"ecm_extract.diff.formats.{form.replace('-', '_')}")
    text: str = module.render(_placed(comparison, form, places))
    return text


def _placed(comparison: Comparison, form: str, places: Places) -> Comparison:
    from ecm_extract.report.places import placed_for

    findings = placed_for(form, comparison.findings, places)
    return msgspec.structs.replace(comparison, findings=tuple(findings))


def _say_verdict(comparison: Comparison) -> None:
    from ecm_extract.diff.formats.phrases import counted, incomplete
    from ecm_extract.diff.verdict import needed

    verdict = comparison.verdict
    declared = verdict.declared_bump or "unknown"
    breaking = sum(change.breaking for change in comparison.changes)
    closed = len(comparison.changes) - len(_open_changes(comparison))
    accepted = f", {closed} accepted" if closed else ""
    click.echo(
        f"verdict: {verdict.compatibility_class}, needs {needed(verdict)}, declares {declared}; "
        f"{counted(len(comparison.changes), 'change')}, {breaking} breaking{accepted}; "
        f"{counted(len(comparison.findings), 'finding')}",
        err=True,
    )
    if not verdict.complete:
        click.echo(f"incomplete: {incomplete(comparison)}", err=True)


def _status(comparison: Comparison, short: Sequence[ShortStep], asked: Asked) -> int:
    """A finding is true whatever else was read; without one, what was not read leaves the answer open.

    What a version step must be is not known either then.
    """
    if _is_failure(comparison, short if comparison.verdict.complete else (), asked):
        return 1
    return 0 if comparison.verdict.complete else INCOMPLETE


def _open_changes(comparison: Comparison) -> list[Change]:
    """Changes that nobody has accepted."""
    from ecm_checker.release import fingerprint_of

    return [change for change in comparison.changes if fingerprint_of(change) not in comparison.accepted]


def _say_what_to_do(comparison: Comparison, short: Sequence[ShortStep]) -> None:
    from ecm_extract.diff.formats.phrases import step_lines

    for line in step_lines(short):
        click.echo(line, err=True)
    if short and any(change.breaking for change in _open_changes(comparison)):
        click.echo("or accept what is meant: ecm-extract accept FINGERPRINT --reason ...", err=True)


def _say_unused(answered: Answered) -> None:
    for line in answered.unused:
        click.echo(f"unused: {line}", err=True)


def _is_failure(comparison: Comparison, short: Sequence[ShortStep], asked: Asked) -> bool:
    """A release fails when it takes too small a step, or when somebody who is seen breaks."""
    if asked.fail_on == "never":
        return False
    breaks = any(change.breaking for change in _open_changes(comparison))
    if asked.backport or asked.fail_on == "breaking":
        return breaks or (bool(short) and not asked.backport)
    levels = ("error", "warning", "info")
    return bool(short) or any(
        levels.index(entry.severity) <= levels.index(asked.fail_on) for entry in comparison.findings
    )
