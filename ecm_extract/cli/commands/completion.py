"""`ecm-extract completion SHELL`: the lines that make a shell complete our commands and options."""

from __future__ import annotations

import click


@click.command(short_help="Print the completion script of a shell.")
@click.argument("shell", type=click.Choice(["bash", "fish", "zsh"]))
@click.pass_context
def command(ctx: click.Context, shell: str) -> None:
    """Print the completion script of SHELL.

    \b
    bash: ecm-extract completion bash > ~/.local/share/bash-completion/completions/ecm-extract
    zsh:  ecm-extract completion zsh > ~/.zfunc/_ecm-extract
    fish: ecm-extract completion fish > ~/.config/fish/completions/ecm-extract.fish
    """  # noqa: D301
    from click.shell_completion import get_completion_class

    from ecm_extract.cli.app import PROGRAM

    generator = get_completion_class(shell)
    if generator is None:
        message = f"no completion for {shell}"
        raise click.UsageError(message)
    click.echo(generator(ctx.find_root().command, {}, PROGRAM, "_ECM_EXTRACT_COMPLETE").source())
