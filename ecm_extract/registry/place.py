"""Where the registry of a user lies."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

from ecm_extract.errors import InputError

VARIABLE: Final = "ECM_REGISTRY"
_FILE: Final = "registry.sqlite"


def registry_url(named: str | None = None) -> str:
    """Return the URL of the registry: the one that is named, else ECM_REGISTRY, else a file in the user's data folder.

    A path stands for a SQLite file there.
    """
    text = named or os.environ.get(VARIABLE) or str(_default())
    return text if "://" in text else f"sqlite:///{Path(text).absolute()}"


def _default() -> Path:
    from platformdirs import user_data_path

    folder = user_data_path("ecm-extract", appauthor=False)
    if not folder.is_absolute():
        message = "there is no home folder for the registry"
        raise InputError(message, f"name a file or a server with --registry or {VARIABLE}")
    return folder / _FILE
