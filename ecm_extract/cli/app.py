"""The group of commands. A command is a file in `commands/` that holds a click command named `command`.

The name of the file is that of the command (`_` as `-`). A command's module is imported when it is used, and
imports what does the work inside its function, so that help and completion stay fast. Click keeps the lines
of a help paragraph that begins with a backspace.
"""

from __future__ import annotations

import difflib
import pkgutil
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from ecm_extract.cli import commands

if TYPE_CHECKING:
    from importlib.metadata import EntryPoints

PROGRAM: Final = "ecm-extract"
DEFAULT_COMMAND: Final = "extract"
_ALIKE: Final = 0.7
"""From which likeness on a word is a slip of a command: `robot` is a folder, and no slip of `promote`."""
PLUGINS: Final = "ecm_extract.commands"
"""Group of entry points whose objects are click commands, called as the entry point is."""

_EPILOG: Final = """\b
Examples:
  ecm-extract src/my_robot                   contracts of all packages below a folder
  ecm-extract . --ref 1.2.0                  as they were at a tag
  ecm-extract . --format json -o - | jq .    one document for other programs
"""


class OutputClosedError(Exception):
    """Whoever read our output has left; click would end with status 1, which means findings here."""


@contextmanager
def _telling_closed_output() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError as error:
        raise OutputClosedError from error


class App(click.Group):
    """A group whose first argument may be the path of a tree: then the command is `extract`."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of the commands, sorted: ours and those of plugins."""
        return sorted({*_own_commands(), *(entry.name for entry in _plugin_commands())})

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the commands of the tool, and in a section of their own those that plugins bring."""
        own = _own_commands()
        for title, names in (
            ("Commands", own),
            ("Evaluation and plugins", [name for name in self.list_commands(ctx) if name not in own]),
        ):
            commands = ((name, self.get_command(ctx, name)) for name in names)
            rows = [(name, each.get_short_help_str(60)) for name, each in commands if each is not None]
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name; None when there is none. Ours win over those of plugins."""
        if cmd_name in _own_commands():
            module = import_module(f"{commands.__name__}.{cmd_name.replace('-', '_')}")
            command: click.Command = module.command
            return command
        for entry in _plugin_commands():
            if entry.name == cmd_name:
                loaded: click.Command = entry.load()
                return loaded
        return None

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        """The context of a run; printing help and version happens here."""
        with _telling_closed_output():
            return super().make_context(info_name, args, parent, **extra)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command that the context names."""
        with _telling_closed_output():
            return super().invoke(ctx)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Put the default command before arguments that name none."""
        if args and not self._is_ours(ctx, args[0]):
            self._refuse_typo(ctx, args[0])
            args = [DEFAULT_COMMAND, *args]
        return super().parse_args(ctx, args)

    def _is_ours(self, ctx: click.Context, argument: str) -> bool:
        options = [name for parameter in self.get_params(ctx) for name in parameter.opts]
        known = ctx.resilient_parsing or argument in options or argument in _own_commands()
        return known or argument in self.list_commands(ctx)  # which looks through all that is installed

    def _refuse_typo(self, ctx: click.Context, argument: str) -> None:
        close = difflib.get_close_matches(argument, self.list_commands(ctx), 1, _ALIKE)
        if close and not argument.startswith("-") and not Path(argument).exists():
            message = f"{argument!r} is neither a command nor a path; did you mean {close[0]!r}?"
            raise click.UsageError(message, ctx)


def _own_commands() -> list[str]:
    return [found.name.replace("_", "-") for found in pkgutil.iter_modules(commands.__path__)]


def _plugin_commands() -> EntryPoints:
    """Commands that installed packages bring, the evaluation of the corpus among them."""
    from importlib.metadata import entry_points

    return entry_points(group=PLUGINS)


def _print_version(ctx: click.Context, _parameter: click.Parameter, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        from importlib.metadata import version

        click.echo(f"{PROGRAM} {version(PROGRAM)}")
        ctx.exit()


@click.group(
    cls=App,
    no_args_is_help=True,
    epilog=_EPILOG,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_version,
    help="Print the version and exit.",
)
def app() -> None:
    """Read the interface contract of ROS packages from their source: no ROS, no build, nothing executed.

    `ecm-extract PATH` is short for `ecm-extract extract PATH`.

    \b
    Exit status: 0 done, 1 findings, 2 the input or the command line is wrong,
    3 the tool itself failed.
    """  # noqa: D301
