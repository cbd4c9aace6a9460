"""The command line as a whole: commands, exit status, errors."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import click
import pytest

from ecm_extract.cli.app import app
from ecm_extract.cli.run import run
from ecm_extract.errors import GitError, InputError

PROGRAM = [sys.executable, "-c", "from ecm_extract.cli import main; main()"]


def failing_with(error: BaseException) -> click.Command:
    @click.command()
    def command() -> None:
        raise error

    return command


@pytest.fixture
def failing(monkeypatch: pytest.MonkeyPatch) -> Callable[[BaseException], int]:
    def end(error: BaseException) -> int:
        monkeypatch.setattr(app, "get_command", lambda _ctx, _name: failing_with(error))
        return run(["extract"])

    return end


def test_version_answers_at_once() -> None:
    """Completion and scripts ask for it; the bound is generous, a desk machine takes a tenth."""
    start = time.process_time()
    done = subprocess.run([*PROGRAM, "--version"], capture_output=True, text=True, check=True)
    assert time.process_time() - start < 1.0
    assert done.stdout.startswith("ecm-extract 0.")


def test_version_imports_nothing_heavy() -> None:
    """What reads source or paints tables is imported when it is used."""
    code = "import sys; from ecm_extract.cli.run import run; run(['--version']); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert not loaded & {"rich", "tree_sitter", "yaml", "lxml", "git", "msgspec", "jsonschema", "rosbags"}


def test_commands_of_plugins_stand_apart(capsys: pytest.CaptureFixture[str]) -> None:
    """Who reads packages need not read about the evaluation of the paper."""
    run(["--help"])
    own, _, others = capsys.readouterr().out.partition("Evaluation and plugins:")
    assert [name for name in ("agree", "blind", "brief", "score") if f"\n  {name} " not in others] == []
    assert [name for name in ("accept", "diff", "lint") if f"\n  {name} " not in own] == []


def test_help_shows_examples(capsys: pytest.CaptureFixture[str]) -> None:
    """A person copies an example before reading options."""
    assert run(["--help"]) == 0
    assert "Examples:" in capsys.readouterr().out
    assert run(["extract", "-h"]) == 0
    assert "Examples:" in capsys.readouterr().out


def test_no_arguments_show_help(capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing was asked for, so the command line is wrong, and the help says what could be."""
    assert run([]) == 2
    assert "Usage:" in capsys.readouterr().err


def test_every_command_has_help() -> None:
    """Each command says in one line what it does."""
    context = click.Context(app)
    for name in app.list_commands(context):
        command = app.get_command(context, name)
        assert command is not None
        assert command.name
        assert command.get_short_help_str()


@pytest.mark.parametrize("arguments", [["--no-such-option"], ["extract"], [".", "--format", "xml"], ["."] * 2])
def test_a_wrong_command_line_is_two(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """Exit status 2, one line of error, one of hint, nothing on standard output."""
    assert run(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert [line.split(":")[0] for line in err.splitlines()] == ["error", "hint"]


def test_a_mistyped_command_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    """It is not taken for a path."""
    assert run(["extarct", "x"]) == 2
    assert "did you mean 'extract'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("error", "status", "words"),
    [
        (
            InputError("no such tag: 1.0", "git fetch --tags"),
            2,
            "error: no such tag: 1.0\nhint: git fetch --tags\n",
        ),
        (GitError("git is not installed"), 2, "error: git is not installed\n"),
        (ValueError("oops"), 3, "error: ecm-extract failed: ValueError: oops\nhint: this is a bug"),
        (KeyboardInterrupt(), 130, "interrupted\n"),
        (click.Abort(), 130, "interrupted\n"),
    ],
)
def test_every_end_has_its_status(
    failing: Callable[[BaseException], int],
    capsys: pytest.CaptureFixture[str],
    error: BaseException,
    status: int,
    words: str,
) -> None:
    """Wrong input is told from a failure of the tool, and neither shows a traceback."""
    assert failing(error) == status
    err = capsys.readouterr().err
    assert words in err
    assert "Traceback" not in err


def test_debug_shows_the_traceback(
    failing: Callable[[BaseException], int],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """ECM_DEBUG is for whoever reports a bug."""
    monkeypatch.setenv("ECM_DEBUG", "1")
    assert failing(ValueError("oops")) == 3
    assert "Traceback" in capsys.readouterr().err


def test_names_in_errors_cannot_act_on_the_terminal(
    failing: Callable[[BaseException], int], capsys: pytest.CaptureFixture[str]
) -> None:
    """An error that quotes a hostile name is still one clean line."""
    failing(InputError("no such file: \x1b]0;evil\x07"))
    assert "\x1b" not in capsys.readouterr().err


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_completion_script(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The script calls us back through the variable that click reads."""
    assert run(["completion", shell]) == 0
    assert "_ECM_EXTRACT_COMPLETE" in capsys.readouterr().out


def test_commands_are_completed() -> None:
    """What the shell's script asks is answered with our commands."""
    variables = {"_ECM_EXTRACT_COMPLETE": "zsh_complete", "COMP_WORDS": "ecm-extract e", "COMP_CWORD": "1"}
    done = subprocess.run(PROGRAM, env=variables, capture_output=True, text=True, check=False)
    assert "extract" in done.stdout


def completed(words: str, folder: Path) -> list[str]:
    variables = {"_ECM_EXTRACT_COMPLETE": "bash_complete", "COMP_WORDS": words, "COMP_CWORD": str(words.count(" "))}
    done = subprocess.run(PROGRAM, env=variables, capture_output=True, text=True, check=False, cwd=folder)
    assert done.stderr == ""
    return done.stdout.split()


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("ecm-extract explain ver00", "plain,VER001"),
        ("ecm-extract lint --select lnt00", "plain,LNT001"),
        ("ecm-extract lint --base v1", "plain,v1.0.0"),
        ("ecm-extract diff v1", "plain,v1.0.0"),
        ("ecm-extract extract . --ref v1", "plain,v1.0.0"),
        ("ecm-extract diff --package ar", "plain,arm"),
        ("ecm-extract init . --package ar", "plain,arm"),
        ("ecm-extract diff sr", "dir,sr"),
        ("ecm-extract lint sr", "file,sr"),
    ],
)
def test_words_are_completed(words: str, answer: str, tmp_path: Path) -> None:
    """Rules in any case, refs of the repository, packages of the tree, and paths where paths stand."""
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    (tmp_path / "package.xml").write_text("<package><name>arm</name><version>1.0.0</version></package>")
    git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b"]
    subprocess.run([*git, "add", "."], check=True)
    subprocess.run([*git, "commit", "-qm", "a"], check=True)
    subprocess.run([*git, "tag", "v1.0.0"], check=True)
    assert answer in completed(words, tmp_path)


def test_a_completion_never_fails(tmp_path: Path) -> None:
    """Outside a repository there are no refs, and the line that is being typed stays clean."""
    assert completed("ecm-extract lint --base v", tmp_path) == []


def test_a_closed_pipe_is_silent(tmp_path: Path) -> None:
    """`ecm-extract ... | head` ends without a word, and not with the status of findings."""
    err = tmp_path / "err"
    with err.open("w") as stderr:
        process = subprocess.Popen([*PROGRAM, "--help"], stdout=subprocess.PIPE, stderr=stderr)
        assert process.stdout is not None
        process.stdout.close()
        assert process.wait(timeout=20) == 141
    assert err.read_text() == ""


def test_an_option_is_no_command(capsys: pytest.CaptureFixture[str]) -> None:
    """An option before the path lacks a path; no command is called like it."""
    assert run(["--ref", "1.0.0"]) == 2
    err = capsys.readouterr().err
    assert "did you mean" not in err
    assert "Missing argument 'PATH'" in err


@pytest.mark.parametrize(
    "line", [["diff", "{}", "."], ["system", "{}"], ["diff", ".", ".", "--consumer", "{}"], ["lint", "{}"]]
)
def test_a_name_of_any_length_is_wrong_input(
    line: list[str], capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The system refuses to look for it; that is no fault of the tool."""
    (tmp_path / "package.xml").write_text("<package format='3'><name>a</name><version>1.0.0</version></package>")
    monkeypatch.chdir(tmp_path)
    assert run([word.format("a" * 5000) for word in line]) == 2
    assert len(capsys.readouterr().err) < 7000
