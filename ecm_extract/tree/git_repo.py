"""Running git over somebody else's repository without letting its configuration run anything.

A repository's own `config` may name programs (`core.fsmonitor`, `core.sshCommand`, `diff.external`,
aliases, remotes with `uploadpack`), so git never sees it: each call gets a throw-away git folder with a
config of ours, whose refs are links to the repository's and whose objects are read in place. The same
trick opens bare folders without `config` and folders of another owner, and a partial clone cannot start
a download. GitPython reads that configuration and takes a bare folder without `config` for a work tree,
so plumbing commands are called instead; refs and object names go in by standard input, never as options.
"""

import os
import re
import secrets
import shutil
import stat
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec

from ecm_extract.errors import GitError, TreeError
from ecm_extract.tree.base import printable

TIMEOUT_S = 120
"""Longest that one git command may take, in seconds."""

_SHARED = ("refs", "packed-refs", "reftable", "shallow")
_OBJECT_LISTS = ("objects/info", "objects/pack")
_OWN = ("logs", "FETCH_HEAD", "ORIG_HEAD", "MERGE_HEAD", "index")
_HEAD = re.compile(r"ref: .+|[0-9a-f]{40}|[0-9a-f]{64}")
_MAX_HEAD_BYTES = 4096
_MAX_CONFIG_BYTES = 1024 * 1024
_EXTENSION = re.compile(r"^\s*(objectformat|refstorage)\s*=\s*(sha1|sha256|files|reftable)\s*$", re.I | re.M)


class GitRepo(msgspec.Struct, frozen=True):
    """Where a repository lies on disk; nothing is opened.

    Attributes:
        git_dir: has HEAD; of a linked work tree its own.
        common_dir: has refs and objects; the same as `git_dir` except in linked work trees.
        work_tree: the folder that holds `.git`; None of a bare repository.
    """

    git_dir: Path
    common_dir: Path
    work_tree: Path | None

    @property
    def name(self) -> str:
        """Name of the repository's folder without `.git`."""
        folder = self.work_tree or self.git_dir
        return printable((folder.parent if folder.name == ".git" else folder).name.removesuffix(".git"))

    def run(self, *args: str, stdin: bytes = b"", accept: tuple[int, ...] = (0,)) -> tuple[int, bytes]:
        """Exit status and standard output of one git plumbing command.

        Raises:
            GitError: git is missing, too slow, or its exit status is not one of `accept`.
        """
        with self.process(*args, stderr=subprocess.PIPE) as process:
            try:
                out, err = process.communicate(stdin, TIMEOUT_S)
            except subprocess.TimeoutExpired:
                message = f"git {args[0]} took more than {TIMEOUT_S} s."
                raise GitError(message) from None
        if process.returncode not in accept:
            raise _failure(args[0], process.returncode, err)
        return process.returncode, out

    @contextmanager
    def process(self, *args: str, stderr: int = subprocess.DEVNULL) -> Iterator[subprocess.Popen[bytes]]:
        """A running git command with pipes; killed if it still runs at the end of the block.

        Who asks for `stderr` must drain it beside standard output.

        Raises:
            GitError: git is not installed.
        """
        with _view(self) as view, _started(view, self.common_dir, args, stderr) as process:
            yield process


def find_repo(folder: Path) -> GitRepo | None:
    """The repository that `folder` is, or lies in; None outside any."""
    start = folder.resolve()
    try:
        if _is_git_dir(start):
            return _repo(start, None)
        found = (repo_at(place / ".git", place) for place in (start, *start.parents))
        return next((repo for repo in found if repo is not None), None)
    except PermissionError:
        return None


def repo_at(dot_git: Path, work_tree: Path | None) -> GitRepo | None:
    """The repository whose git folder `dot_git` is, or that the file `dot_git` names; None when it is neither."""
    pointer = _first_line(dot_git)
    if pointer.startswith("gitdir: "):
        dot_git = (dot_git.parent / pointer.removeprefix("gitdir: ")).resolve()
    return _repo(dot_git, work_tree) if _is_git_dir(dot_git) else None


def _repo(git_dir: Path, work_tree: Path | None) -> GitRepo:
    common = _first_line(git_dir / "commondir")
    return GitRepo(git_dir, (git_dir / common).resolve() if common else git_dir, work_tree)


def _is_git_dir(folder: Path) -> bool:
    has_objects = (folder / "objects").is_dir() or (folder / "commondir").is_file()
    return has_objects and _HEAD.fullmatch(_first_line(folder / "HEAD")) is not None


def _first_line(file: Path) -> str:
    """First line of a small file; empty when it is not one."""
    if not file.is_file():
        return ""
    try:
        with file.open("rb") as stream:
            lines = stream.read(_MAX_HEAD_BYTES).splitlines()
    except OSError:
        return ""
    return os.fsdecode(lines[0]).strip() if lines else ""


@contextmanager
def _view(repo: GitRepo) -> Iterator[Path]:
    try:
        with _temporary_folder() as view:
            _fill_view(repo, view)
            yield view
    except OSError as error:
        message = f"Cannot look into the repository {repo.name}: {error.strerror}."
        raise TreeError(message, "Check its permissions and that the temporary folder is writable.") from error


@contextmanager
def _temporary_folder() -> Iterator[Path]:
    """A folder that goes wherever its making, its use or its removal is interrupted."""
    folder = Path(tempfile.gettempdir(), f"ecm-git-{secrets.token_hex(8)}")
    try:
        folder.mkdir(mode=0o700)
        yield folder
    finally:
        try:
            shutil.rmtree(folder, ignore_errors=True)
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise


def _fill_view(repo: GitRepo, view: Path) -> None:
    for name in _OBJECT_LISTS:
        _refuse_special(repo, repo.common_dir / name)
    (view / "objects").mkdir()
    (view / "HEAD").write_text(_first_line(repo.git_dir / "HEAD") + "\n", errors="surrogateescape")
    (view / "config").write_text(_config(repo))
    for folder, names in ((repo.common_dir, _SHARED), (repo.git_dir, _OWN)):
        for name in names:
            if (folder / name).exists():
                _refuse_special(repo, folder / name)
                (view / name).symlink_to(folder / name)
    if not (view / "refs").exists():
        (view / "refs").mkdir()


def _refuse_special(repo: GitRepo, place: Path) -> None:
    """Git waits for ever at a pipe that stands where it expects a file."""
    below = (Path(folder, name) for folder, _, names in os.walk(place) for name in names)
    special = next((each for each in (place, *below) if _is_special(each)), None)
    if special is not None:
        shown = printable(str(special))
        message = f"{shown} is a pipe, socket or device, so git cannot read the repository {repo.name}."
        raise GitError(message, "Remove it, and get what it held with `git fetch --tags origin`.")


def _is_special(place: Path) -> bool:
    mode = place.stat(follow_symlinks=True).st_mode if place.exists() else stat.S_IFREG
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def _config(repo: GitRepo) -> str:
    """A config of ours, with the two settings without which the objects or refs cannot be read."""
    found = {key.lower(): value.lower() for key, value in _EXTENSION.findall(config_text(repo))}
    extensions = "".join(f"\t{key} = {value}\n" for key, value in found.items())
    version = 1 if found else 0
    return f"[core]\n\trepositoryformatversion = {version}\n\tbare = true\n[extensions]\n{extensions}"


def config_text(repo: GitRepo) -> str:
    """What the repository's own configuration says, cut where it is too long; empty where there is none."""
    file = repo.common_dir / "config"
    if not file.is_file():
        return ""
    try:
        with file.open("rb") as stream:
            return stream.read(_MAX_CONFIG_BYTES).decode("utf-8", "replace")
    except OSError:
        return ""


@contextmanager
def _started(view: Path, common_dir: Path, args: tuple[str, ...], stderr: int) -> Iterator[subprocess.Popen[bytes]]:
    pipe = subprocess.PIPE
    environment = _environment(view, common_dir)
    try:
        process = subprocess.Popen(
            ["git", *args],
            stdin=pipe,
            stdout=pipe,
            stderr=stderr,
            env=environment,
            cwd=view,
            process_group=0,  # Ctrl-C is for this program, which then ends git
        )
    except FileNotFoundError:
        message = "Git is not installed, so no ref, tag or commit can be read."
        raise GitError(message, "Install git, or give folders in place of refs.") from None
    with process:
        try:
            yield process
        finally:
            if process.poll() is None:
                process.kill()


def _environment(view: Path, common_dir: Path) -> dict[str, str]:
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    return kept | {
        "GIT_DIR": str(view),
        "GIT_OBJECT_DIRECTORY": str(common_dir / "objects"),
        "GIT_CONFIG_NOSYSTEM": "1",
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_NO_REPLACE_OBJECTS": "1",
        "GIT_NO_LAZY_FETCH": "1",
        "GIT_ALLOW_PROTOCOL": "none",
        "GIT_OPTIONAL_LOCKS": "0",
        "GIT_TERMINAL_PROMPT": "0",
        "LC_ALL": "C",
    }


def _failure(command: str, status: int, err: bytes) -> GitError:
    detail = printable(err[-500:].decode("utf-8", "surrogateescape").strip().replace("\n", "; "))
    message = f"git {command} ended with status {status}: {detail}"
    return GitError(message, "Check the repository with `git fsck`.")
