"""Where the cache lies, and whether that place may be trusted."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Final

VARIABLE: Final = "ECM_CACHE_DIR"

_OTHERS_WRITE: Final = stat.S_IWGRP | stat.S_IWOTH


class UntrustedFolderError(Exception):
    """The folder cannot be used; the message says why."""


def cache_folder() -> Path:
    """The folder that ECM_CACHE_DIR names, else the user's own cache folder; it need not exist."""
    named = os.environ.get(VARIABLE)
    if named:
        return Path(named).absolute()
    from platformdirs import user_cache_path

    return user_cache_path("ecm-extract", appauthor=False)


def require_trusted(folder: Path, *, create: bool) -> None:
    """Make sure that nobody else can have written below a folder.

    Args:
        folder: of the cache.
        create: make it, for the user alone, when it is not there.

    Raises:
        UntrustedFolderError: it is a link or no folder, belongs to or may be written by others, or cannot be made.
    """
    if not folder.is_absolute():
        message = "there is no home folder"
        raise UntrustedFolderError(message)
    try:
        if create:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = folder.lstat()
    except OSError as error:
        message = f"{error.strerror}"
        raise UntrustedFolderError(message) from error
    reason = _reason_against(status)
    if reason:
        raise UntrustedFolderError(reason)


def _reason_against(status: os.stat_result) -> str:
    if stat.S_ISLNK(status.st_mode):
        return "it is a symbolic link"
    if not stat.S_ISDIR(status.st_mode):
        return "it is not a folder"
    if status.st_uid != os.geteuid():
        return "it belongs to somebody else"
    if status.st_mode & _OTHERS_WRITE:
        return "others may write into it"
    return ""
