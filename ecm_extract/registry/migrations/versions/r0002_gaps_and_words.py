"""What was not read of a release, the words of names, and requirements by their use."""

from collections.abc import Iterator
from typing import Any

import msgspec
import sqlalchemy as sa
from alembic import op
from ecm_checker.hub.package import Package

from ecm_extract.registry.contents import decompress
from ecm_extract.registry.gaps import gaps_of
from ecm_extract.registry.words import searched_words

revision = "0002"
down_revision = "0001"

_TABLE = "CREATE VIRTUAL TABLE name_search USING fts5(words, content='name', content_rowid='id')"
_TRIGGER = """
CREATE TRIGGER name_added AFTER INSERT ON name BEGIN
    INSERT INTO name_search(rowid, words) VALUES (new.id, new.words);
END
"""
_ADDED = (_TABLE, _TRIGGER)
_INDEXED = ("CREATE INDEX name_words ON name USING gin (to_tsvector('simple', words))",)
_AT_ONCE = 1000


def upgrade() -> None:
    """Make the tables and fill them from what is stored."""
    gap = op.create_table(
        "gap",
        sa.Column("release_id", sa.Integer(), nullable=False),
        sa.Column("path", sa.Text(), nullable=False),
        sa.Column("reason", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["release_id"], ["release.id"]),
        sa.PrimaryKeyConstraint("release_id", "path"),
    )
    name = op.create_table(
        "name",
        sa.Column("id", sa.Integer(), nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("words", sa.Text(), nullable=False),
        sa.PrimaryKeyConstraint("id"),
        sa.UniqueConstraint("name"),
    )
    op.create_index("requirement_of_use", "requirement", ["use"], unique=False)
    for statement in _ADDED if op.get_bind().dialect.name == "sqlite" else _INDEXED:
        op.execute(statement)
    _fill(gap, _gaps())
    _fill(name, _names())


def _fill(table: sa.Table, rows: Iterator[dict[str, Any]]) -> None:
    kept = list(rows)
    for first in range(0, len(kept), _AT_ONCE):
        op.bulk_insert(table, kept[first : first + _AT_ONCE])


def _gaps() -> Iterator[dict[str, Any]]:
    stored = sa.text("SELECT release.id, content.digest, content.data FROM release JOIN content USING (digest)")
    for row in op.get_bind().execute(stored):
        package = msgspec.json.decode(decompress(row.data, row.digest), type=Package)
        yield from ({"release_id": row.id, **each} for each in gaps_of(package))


def _names() -> Iterator[dict[str, Any]]:
    for row in op.get_bind().execute(sa.text("SELECT DISTINCT name FROM provision ORDER BY name")):
        yield {"name": row.name, "words": searched_words(row.name)}
