"""`ecm-extract registry ...`: contracts of all releases, kept and asked."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click
import msgspec

from ecm_extract.cli.registries import open_registry, registry_option, require_extra

if TYPE_CHECKING:
    from ecm_extract.registry.index import Job, Outcome
    from ecm_extract.registry.workers import Workers

_EPILOG: Final = """\b
Examples:
  ecm-extract registry init
  ecm-extract registry publish src/my_robot@1.2.0
  ecm-extract registry index clones/*
  ecm-extract registry search cmd_vel
  ecm-extract registry who-uses nav2_controller FollowPath
"""

_format = click.option("--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True)


@click.group(short_help="Keep the contracts of releases, and ask who uses what.", epilog=_EPILOG)
def command() -> None:
    """Keep the contracts of releases, and ask them.

    A registry is one SQLite file in the user's data folder, or a PostgreSQL database that a team shares.
    """


@command.command()
@registry_option
def init(url: str | None) -> None:
    """Make the registry, or bring that of an older version up to date."""
    require_extra()
    from ecm_extract.registry.store import Registry

    with Registry.create(url) as registry:
        click.echo(f"registry: {registry.shown}")


@command.command()
@click.argument("source")
@click.option("--tag", help="Under which it was released, where SOURCE does not tell.")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
@registry_option
def publish(source: str, tag: str | None, jobs: int | None, url: str | None) -> None:
    """Store the packages of SOURCE as releases: a folder, `DIR@REF`, or documents that were extracted.

    All of them or none. A release never changes: the same content may be published again, other content under a
    version that is stored is refused.
    """
    with open_registry(url) as registry:
        from ecm_extract.registry.publish import make_ready, publish, require_all
        from ecm_extract.registry.sources import read_source

        found = read_source(source, tag, jobs)
        ready = [make_ready(each) for each in found.packages]
        with registry.writing() as session:
            done = publish(session, ready, found.origin)
            require_all(done)
    for each in done:
        click.echo(f"{_plain(each.release)}: {'is there already' if each.state == 'same' else each.state}")


@command.command()
@click.argument("repositories", nargs=-1, required=True, metavar="REPOSITORY...")
@click.option("--tags", metavar="PATTERN", help="Only tags like this, e.g. `1.*`.  [default: all but pre-releases]")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
@click.option("--dask", metavar="ADDRESS", help="Let the workers of this Dask scheduler do it.")
@registry_option
def index(repositories: tuple[str, ...], tags: str | None, jobs: int | None, dask: str | None, url: str | None) -> int:
    """Store all releases of clones, oldest first: each tag that names a version.

    May be stopped at any time and run again: what is stored is not read again. What was skipped is told with its
    reason; the exit status is 1 when a tag could not be read. The workers of a cluster need the clones under the same
    paths, and a registry on a server.
    """
    with open_registry(url) as registry:
        from ecm_extract.registry.index import run, split_known
        from ecm_extract.registry.place import registry_url

        place = registry_url(url)
        workers = _workers(jobs, dask, place)
        todo, known = split_known(registry, _jobs(repositories, tags))
        done = list(known)
        for number, outcome in enumerate(run(place, todo, workers), 1):
            _say_outcome(outcome, f"{number}/{len(todo)}")
            done.append(outcome)
    return _say_sum(done)


def _jobs(repositories: Sequence[str], tags: str | None) -> list[Job]:
    from ecm_extract.registry.index import jobs_of

    return [job for each in repositories for job in jobs_of(Path(each), tags)]


def _workers(jobs: int | None, dask: str | None, url: str) -> Workers:
    from ecm_extract.registry.workers import Here, Processes

    if dask is not None:
        from ecm_extract.registry.cluster import Cluster, require_shared

        require_shared(url)
        return Cluster(dask)
    count = jobs or os.cpu_count() or 1
    return Processes(count) if count > 1 else Here()


def _say_outcome(outcome: Outcome, place: str) -> None:
    click.echo(f"[{place}] {_plain(outcome.repository)} {_plain(outcome.tag)}: {outcome.releases} new", err=True)
    for why in outcome.skipped:
        click.echo(f"  skipped: {_plain(why)}", err=True)


def _say_sum(done: Sequence[Outcome]) -> int:
    counted = {state: sum(each.state == state for each in done) for state in ("indexed", "known", "skipped")}
    new = sum(each.releases for each in done)
    told = f"{counted['indexed']} indexed, {counted['known']} known before, {counted['skipped']} skipped"
    click.echo(f"tags: {told}; {new} new releases")
    return int(counted["skipped"] > 0)


@command.command(name="list")
@click.argument("package", required=False)
@click.option("--newest", is_flag=True, help="Only the newest release of each package.")
@_format
@registry_option
def list_(package: str | None, newest: bool, form: str, url: str | None) -> None:
    """List releases, those of PACKAGE or all."""
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.releases import list_releases

        found = list_releases(session, package, newest)
    if form == "json":
        click.echo(_json({"schema": "ecm-extract/releases/1", "releases": found}))
        return
    for each in found:
        state = "withdrawn" if each.withdrawn else f"{each.channel}, deprecated" if each.deprecated else each.channel
        click.echo(_plain(f"{each.name}  {state}  {each.repository}  {each.tag or each.commit or ''}".rstrip()))


@command.command()
@click.argument("release")
@_format
@registry_option
def show(release: str, form: str, url: str | None) -> None:
    """Show a release, `PACKAGE@VERSION` or the newest of PACKAGE; with `--format json` its whole document."""
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.releases import find_release, info, package_of_release
        from ecm_extract.registry.tables import Standing

        found = find_release(session, release)
        package = package_of_release(session, found)
        about = info(found, session.get_one(Standing, found.id))
    if form == "json":
        source = {"path": about.repository, "commit": about.commit}
        document = {"schema": "ecm-extract/package/1", "source": source, **msgspec.to_builtins(package)}
        click.echo(_json(document))
        return
    for name, value in msgspec.structs.asdict(about).items():
        if value is not None:
            click.echo(_plain(f"{name + ':':12}{value}"))
    click.echo(f"{'modules:':12}{len(package.modules)}")
    click.echo(f"{'provides:':12}{len(package.provides)} names")
    click.echo(f"{'requires:':12}{len(package.requires)} names")


@command.command()
@click.argument("texts", nargs=-1, required=True, metavar="TEXT...")
@click.option("--kind", help="Only names of this kind: topic, parameter, message, package, ...")
@click.option("--environment", metavar="NAME", help="Search only what this environment runs.")
@click.option("--limit", type=click.IntRange(min=1), default=100, show_default=True, help="Names that are told.")
@_format
@registry_option
def search(
    texts: tuple[str, ...], kind: str | None, environment: str | None, limit: int, form: str, url: str | None
) -> None:
    """Find public names by their words: `cmd_vel` finds `/robot/cmd_vel_smoothed`, `navigate` finds `NavigateToPose`.

    A name must have every TEXT in it, and words that are written together stand together; the last may go on.
    Searched is the newest release of each package.
    """
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.name_search import search
        from ecm_extract.registry.scope import EVERYTHING, environment_scope

        scope = environment_scope(session, environment) if environment else EVERYTHING
        found = search(session, texts, scope, kind)
    if form == "json":
        click.echo(_json({"schema": "ecm-extract/search/1", "count": len(found), "names": found[:limit]}))
        return
    for each in found[:limit]:
        of, typed = f" of {each.owner}" if each.owner else "", f" ({each.type})" if each.type else ""
        click.echo(_plain(f"{each.kind} {each.name}{of}{typed}  {each.package}@{each.version}"))
    if len(found) > limit:
        click.echo(f"and {len(found) - limit} more; add a word, --kind or --limit", err=True)


@command.command(name="who-uses")
@click.argument("release")
@click.argument("name", required=False)
@click.option("--kind", help="Only names of this kind: topic, parameter, message_field, ...")
@click.option("--environment", metavar="NAME", help="Ask only what this environment runs.")
@_format
@registry_option
def who_uses(
    release: str, name: str | None, kind: str | None, environment: str | None, form: str, url: str | None
) -> int:
    """Tell who uses what a package provides: all its names, or NAME, or the names that end in NAME.

    RELEASE is `PACKAGE@VERSION`, or PACKAGE for its newest one. Asked is the newest release of each package. Status
    1 when more may use it than is known: what was not read, and names that are computed.
    """
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.questions import Asked, who_uses
        from ecm_extract.registry.scope import EVERYTHING, environment_scope

        scope = environment_scope(session, environment) if environment else EVERYTHING
        found = who_uses(session, release, Asked(name, kind), scope)
    if form == "json":
        click.echo(_json({"schema": "ecm-extract/who-uses/1", "release": release, **msgspec.structs.asdict(found)}))
        return int(bool(found.doubts))
    for each in found.names:
        click.echo(_plain(f"{each.kind} {each.name}{f' of {each.owner}' if each.owner else ''}"))
        for user in each.users:
            for at in user.lines:
                fits = "" if user.fits else "  (does not fit)"
                click.echo(_plain(f"  {user.package}@{user.version} {at.path}:{at.line} {at.what}{fits}"))
    from ecm_extract.registry.texts import doubts_text

    click.echo(doubts_text(found.doubts), nl=False, err=True)
    return int(bool(found.doubts))


@command.command()
@click.argument("release")
@click.argument("file")
@registry_option
def migration(release: str, file: str, url: str | None) -> None:
    """Keep how those who use RELEASE follow it: a FILE of `ecm-extract diff OLD NEW --format migration-spec`."""
    with open_registry(url) as registry:
        from ecm_extract.registry.migration_documents import keep_migration, read_migration

        found = read_migration(file)
        with registry.writing() as session:
            done = keep_migration(session, release, found)
    click.echo(_plain(f"{done}: {len(found.steps)} steps"))


@command.command()
@click.argument("environment")
@click.argument("releases", nargs=-1, required=True, metavar="RELEASE...")
@click.option("--whole", is_flag=True, help="These are all that it runs; packages that are not named are gone.")
@registry_option
def record(environment: str, releases: tuple[str, ...], whole: bool, url: str | None) -> None:
    """Keep which releases ENVIRONMENT runs now: a robot, a site, a simulation."""
    with open_registry(url) as registry:
        from ecm_extract.registry.environments import record

        with registry.writing() as session:
            done = record(session, environment, releases, whole=whole)
    for each in done:
        before = f", before {each.before}" if each.before not in (None, each.release) else ""
        click.echo(_plain(f"{environment}: {each.release}{before}"))


@command.command()
@registry_option
def verify(url: str | None) -> int:
    """Check that all contents, rows and the audit log are as they were stored."""
    with open_registry(url) as registry, registry.reading() as session:
        from ecm_extract.registry.verify import verify

        found = verify(session)
    for problem in found.problems:
        click.echo(_plain(problem))
    click.echo(f"{found.releases} releases, {found.entries} audit entries, {len(found.problems)} problems", err=True)
    return int(bool(found.problems))


def _json(document: dict[str, Any]) -> str:
    return msgspec.json.format(msgspec.json.encode(document), indent=1).decode()


def _plain(text: str) -> str:
    from ecm_extract.report.terminal import one_line

    return one_line(text, 1000)
