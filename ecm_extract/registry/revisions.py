"""Revisions of the tables: Alembic runs those of `migrations/versions` that a database has not seen."""

from __future__ import annotations

from functools import cache
from importlib import resources

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection

CONNECTION = "connection"
"""Attribute by which `migrations/env.py` gets the connection."""


def upgrade(connection: Connection) -> None:
    """Run what is new, in the transaction of the connection."""
    config = _config()
    config.attributes[CONNECTION] = connection
    command.upgrade(config, "head")


def revision_of(connection: Connection) -> str | None:
    """Return the revision of a database; None when it has none."""
    return MigrationContext.configure(connection).get_current_revision()


@cache
def newest_revision() -> str | None:
    """Return the revision that this version reads."""
    return ScriptDirectory.from_config(_config()).get_current_head()


def _config() -> Config:
    config = Config()
    folder = str(resources.files("ecm_extract.registry").joinpath("migrations"))
    config.set_main_option("script_location", folder.replace("%", "%%"))
    return config
