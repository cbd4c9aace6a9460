"""`ecm-extract system LAUNCH...`: what launch files start, and how that is connected."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

import click
import msgspec

from ecm_extract.cli.completions import refs
from ecm_extract.cli.outputs import tell_unread

if TYPE_CHECKING:
    from ecm_extract.system.system import System

FORMATS: Final = ("text", "json", "dot", "mermaid")

_EPILOG: Final = """\b
Examples:
  ecm-extract system bringup/launch/robot.launch.py
  ecm-extract system my_bringup/robot.launch.py use_sim_time:=true --workspace src
  ecm-extract system robot.launch --env ROBOT_MODEL=burger --format mermaid > graph.mmd
  ecm-extract system extract.json my_bringup/robot.launch.py
"""


class Request(msgspec.Struct, frozen=True):
    """What the user asked for, as on the command line."""

    launch: tuple[str, ...]
    workspace: str | None
    ref: str | None
    env: tuple[str, ...]
    format: str
    include_tests: bool
    config: str | None
    jobs: int | None
    no_cache: bool


@click.command(short_help="Show what launch files start, and how it is connected.", epilog=_EPILOG)
@click.argument(
    "launch", nargs=-1, required=True, type=click.Path(), metavar="[DOCUMENT]... LAUNCH... [NAME:=VALUE]..."
)
@click.option(
    "--workspace",
    metavar="DIR|DIR@REF",
    help="The tree that holds the launch files and packages.  [default: here, or the repository of a LAUNCH elsewhere]",
)
@click.option("--ref", shell_complete=refs, help="Read a tag, branch or commit of the workspace.")
@click.option("--env", multiple=True, metavar="NAME=VALUE", help="An environment variable of the launch.")
@click.option("--format", type=click.Choice(FORMATS), default="text", show_default=True, help="How to show it.")
@click.option("--include-tests", is_flag=True, help="Read test folders too.")
@click.option("--config", metavar="FILE", help="Use this ecm.toml.  [default: the one in the workspace]")
@click.option("--jobs", type=click.IntRange(min=1), help="Worker processes.  [default: one per core]")
@click.option("--no-cache", is_flag=True, help="Take nothing from the cache and add nothing to it.")
def command(**options: Any) -> int:
    """Evaluate launch files without running them and show the instance graph.

    LAUNCH is a launch file by its path, on disk or in the workspace, or `package/file`. NAME:=VALUE gives a launch
    argument. What only a running launch knows stays a pattern `{name}`, and what depends on it says so.

    DOCUMENT is an extract document, that of a package, or a folder of these: then no source is read.

    The exit status is 1 when a launch file is malformed or too large, so that a part of what it starts is left out,
    and 2 when not all of the packages that run could be read.
    """
    request = Request(**options)
    from ecm_extract.tree.unread import unread_in

    system = _read(request)
    sys.stdout.write(_renderer(request.format)(system))
    sys.stdout.flush()
    if not system.launched.is_complete:
        click.echo("incomplete: a part of the launch was left out; the text and JSON formats say what", err=True)
        return 1
    return tell_unread(unread_in(system.unread))


def _read(request: Request) -> System:
    from ecm_extract.cli.progress import progress_bar
    from ecm_extract.extraction_model import Options
    from ecm_extract.stored import is_stored, joined, read_stored
    from ecm_extract.system.model import Given
    from ecm_extract.system.system import read_system, stored_system
    from ecm_extract.system.workspaces import in_workspace, workspace_of
    from ecm_extract.tree import open_tree

    words = [word for word in request.launch if ":=" not in word]
    documents = [word for word in words if is_stored(word)]
    launches = [word for word in words if word not in documents]
    if not launches:
        message = "no launch file given"
        raise click.UsageError(message, click.get_current_context())
    arguments = dict(word.split(":=", 1) for word in request.launch if ":=" in word)
    given = Given(arguments, dict(_pair(word) for word in request.env))
    if documents:
        _refuse_sources(request)
        return stored_system(joined([read_stored(each) for each in documents]), launches, given)
    with progress_bar() as progress:
        options = Options(request.include_tests, request.config, request.jobs, progress, not request.no_cache)
        workspace = request.workspace or workspace_of(launches)
        named = [in_workspace(text, workspace) for text in launches]
        return read_system(open_tree(workspace, request.ref), named, given, options)


def _refuse_sources(request: Request) -> None:
    """Documents hold one state of a tree: another one cannot be asked for beside."""
    if request.workspace or request.ref:
        message = "documents are read instead of a tree; leave --workspace and --ref out, or the documents"
        raise click.UsageError(message, click.get_current_context())


def _pair(word: str) -> tuple[str, str]:
    name, separator, value = word.partition("=")
    if not separator:
        message = f"--env {word} has no value; write NAME=VALUE"
        raise click.UsageError(message, click.get_current_context())
    return name, value


def _renderer(name: str) -> Callable[[System], str]:
    from importlib import import_module

    module = import_module(f"ecm_extract.system.formats.{'document' if name == 'json' else name}")
    renderer: Callable[[System], str] = module.render
    return renderer
