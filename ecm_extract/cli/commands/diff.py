"""`ecm-extract diff OLD NEW`: what a release changed, and whom it breaks."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import click
import msgspec

from ecm_extract.cli.outputs import findings_as, write_outputs

if TYPE_CHECKING:
    from ecm_extract.diff.model import Comparison, RefInfo
    from ecm_extract.diff.run import Request

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
@click.argument("old", required=False)
@click.argument("new", required=False, default=".")
@click.option("--repo", metavar="DIR", default=".", show_default=True, help="Repository of the refs.")
@click.option(
    "--consumer",
    metavar="PATH|DIR@REF",
    multiple=True,
    help="Packages that use these; their lines that break are findings.  [the new side always is one]",
)
@click.option("--package", metavar="NAME", multiple=True, help="Only changes of this package.")
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
    help="Exit with 1 from findings of this severity on; breaking: on any breaking change.",
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
    asked = Asked(**options)
    comparison = _compare(asked)
    _print(comparison, asked)
    _say_verdict(comparison)
    return int(_is_failure(comparison, asked.fail_on))


def _compare(asked: Asked) -> Comparison:
    from ecm_extract.diff.run import compare

    return compare(_request(asked))


def _request(asked: Asked) -> Request:
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.diff.baseline import default_baseline, open_consumer, open_side
    from ecm_extract.diff.model import RefInfo
    from ecm_extract.diff.run import Request
    from ecm_extract.extraction_model import Options
    from ecm_extract.tree.git_repo import find_repo

    folder = Path(asked.repo)
    spec, why = (asked.old, "named") if asked.old else default_baseline(asked.new, folder)
    old, new = open_side(spec, folder), open_side(asked.new, folder)
    infos = RefInfo(spec, old.commit, why), RefInfo(asked.new, new.commit, "named")
    _say_baseline(infos)
    repo = find_repo(folder)
    with progress_bar() as progress:
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


def _shown(info: RefInfo) -> str:
    from ecm_extract.report.terminal import one_line

    return one_line(f"{info.ref} {info.commit[:12] if info.commit else 'files in no commit'}")


def _print(comparison: Comparison, asked: Asked) -> None:
    if asked.backport:
        from ecm_extract.diff.verdict import backport_line

        click.echo(backport_line(comparison.changes))
        return
    write_outputs(asked.output, FORMATS, lambda form: _rendered(comparison, form))
    sys.stdout.write(_rendered(comparison, asked.format))


def _rendered(comparison: Comparison, form: str) -> str:
    if form in {"sarif", "github", "junit"}:
        return findings_as(form, comparison.findings)
    text: str = import_module(f"ecm_extract.diff.formats.{form.replace('-', '_')}").render(comparison)
    return text


def _say_verdict(comparison: Comparison) -> None:
    verdict = comparison.verdict
    declared = verdict.declared_bump or "unknown"
    breaking = sum(change.breaking for change in comparison.changes)
    click.echo(
        f"verdict: {verdict.compatibility_class}, needs {verdict.required_bump}, takes {declared}; "
        f"{len(comparison.changes)} changes, {breaking} breaking; {len(comparison.findings)} findings",
        err=True,
    )


def _is_failure(comparison: Comparison, fail_on: FailOn) -> bool:
    if fail_on == "never":
        return False
    if fail_on == "breaking":
        return any(change.breaking for change in comparison.changes)
    levels = ("error", "warning", "info")
    return any(levels.index(entry.severity) <= levels.index(fail_on) for entry in comparison.findings)
