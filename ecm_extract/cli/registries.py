"""`--registry URL`, and the registry behind it; what is not installed is told with the line that installs it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

import click

from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_extract.registry.store import Registry

_NEEDED: Final = frozenset({"sqlalchemy", "alembic", "zstandard", "resolvelib", "mako"})

registry_option: Final[Callable[..., Any]] = click.option(
    "--registry",
    "url",
    metavar="URL|FILE",
    help="The registry: a SQLite file or a PostgreSQL URL.  [default: ECM_REGISTRY, else the user's own]",
)


def open_registry(url: str | None) -> Registry:
    """Open a registry that is there.

    Raises:
        InputError: there is none, or the extra that it needs is not installed.
    """
    require_extra()
    from ecm_extract.registry.store import Registry

    return Registry(url)


def require_extra() -> None:
    """Make sure that what a registry needs is installed.

    Raises:
        InputError: it is not.
    """
    from importlib.util import find_spec

    absent = sorted(name for name in _NEEDED if find_spec(name) is None)
    if absent:
        message = f"a registry needs {', '.join(absent)}, which is not installed"
        raise InputError(message, "pip install 'ecm-extract[registry]'")
