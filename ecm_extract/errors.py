"""Every way in which a run can end without a result, each with its exit status.

The tree of exceptions:

    EcmError                    base: message, hint, exit status
    ├── InputError        (2)   what was given cannot be used
    │   ├── TreeError           the folder, repository or ref cannot be opened
    │   │   ├── RefError        no such ref, or no such folder at that ref
    │   │   └── TreeReadError   one file of a tree cannot be read
    │   ├── GitError            git is not installed, or cannot read the repository: damaged, or too slow
    │   └── ConfigError         `ecm.toml` is wrong: file, line and key
    └── ToolError         (3)   the tool itself failed

Content of artefacts never raises: it gives diagnostics. Source of the exit statuses: DESIGN §6.
"""

from typing import ClassVar, Literal

ExitStatus = Literal[2, 3]


class EcmError(Exception):
    """Base of all errors that the command line shows to a person.

    Attributes:
        message: what is wrong, one line, safe to print.
        hint: what to do about it; empty when there is nothing to add.
        exit_status: 2 when the input is wrong, 3 when the tool failed.
    """

    exit_status: ClassVar[ExitStatus] = 3

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message, hint)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message}\n{self.hint}" if self.hint else self.message


class InputError(EcmError):
    """What the user gave cannot be used."""

    exit_status = 2


class GitError(InputError):
    """Git is not installed, or cannot read the repository: it is damaged, or takes too long."""


class TreeError(InputError):
    """A folder, a repository or a ref cannot be opened or listed."""


class RefError(TreeError):
    """A ref, or a folder at a ref, does not exist in the repository."""


class TreeReadError(TreeError):
    """One file of a tree cannot be read.

    Attributes:
        code: stable name of the reason: `not-in-tree`, `missing-blob`, `too-large`, `unreadable`.
        path: of the file, relative to the root of the tree, printable.
    """

    def __init__(self, path: str, code: str, message: str, hint: str = "") -> None:
        super().__init__(message, hint)
        self.args = (path, code, message, hint)
        self.code = code
        self.path = path


class ConfigError(InputError):
    """The configuration file is wrong.

    Attributes:
        path: of the file, as given.
        line: 1-based; 0 when the file as a whole is meant.
        key: dotted key, e.g. `extract.exclude`; empty when the text is not TOML.
    """

    def __init__(self, path: str, line: int, key: str, message: str) -> None:
        where = f"{path}:{line}" if line else path
        super().__init__(f"{where}: {key}: {message}" if key else f"{where}: {message}")
        self.args = (path, line, key, message)
        self.path = path
        self.line = line
        self.key = key


class ToolError(EcmError):
    """The tool itself failed; the input may be right."""
