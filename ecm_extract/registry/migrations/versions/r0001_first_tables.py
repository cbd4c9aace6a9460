"""The first tables."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Make them; those that others point to come first."""
    _log()
    _parts()
    _releases()
    _requirements()
    _of_releases()
    _running()
    _decisions()


def _log() -> None:
    """The audit log, contents, and what was indexed."""
    op.create_table(
        "audit",
        sa.Column("number", sa.Integer(), autoincrement=False, nullable=False),
        _text("at"),
        _text("actor"),
        _text("action"),
        _text("subject"),
        _text("detail"),
        _text("previous"),
        _text("digest"),
        sa.PrimaryKeyConstraint("number"),
    )
    op.create_table(
        "audit_head",
        sa.Column("id", sa.Integer(), autoincrement=False, nullable=False),
        _number("number"),
        _text("at"),
        _text("digest"),
        sa.PrimaryKeyConstraint("id"),
    )
    op.create_table(
        "content",
        _text("digest"),
        sa.Column("data", sa.LargeBinary(), nullable=False),
        _number("size"),
        sa.PrimaryKeyConstraint("digest"),
    )
    op.create_table(
        "indexed",
        _text("repository"),
        _text("tag"),
        _text("commit"),
        _number("releases"),
        _text("skipped"),
        _text("at"),
        sa.PrimaryKeyConstraint("repository", "tag"),
    )


def _parts() -> None:
    """Parts of contents, and what they provide."""
    op.create_table(
        "part",
        _number("id"),
        _text("digest"),
        sa.Column("data", sa.LargeBinary(), nullable=False),
        sa.PrimaryKeyConstraint("id"),
        sa.UniqueConstraint("digest"),
    )
    op.create_table(
        "provision",
        _number("part_id"),
        _number("number"),
        _text("kind"),
        _text("owner"),
        _text("name"),
        _text("last"),
        _text("type", nullable=True),
        _number("line"),
        _points("part_id", "part.id"),
        sa.PrimaryKeyConstraint("part_id", "number"),
        sqlite_with_rowid=False,
    )
    op.create_index("provision_by_last", "provision", ["last", "kind"])
    op.create_index("provision_by_name", "provision", ["name", "kind"])


def _releases() -> None:
    """Releases."""
    op.create_table(
        "release",
        _number("id"),
        _text("package"),
        _text("version"),
        _text("rank"),
        sa.Column("ros", sa.Integer(), nullable=True),
        _text("repository"),
        _text("path"),
        _text("tag", nullable=True),
        _text("commit", nullable=True),
        _text("stored"),
        _text("digest"),
        _points("digest", "content.digest"),
        sa.PrimaryKeyConstraint("id"),
        sa.UniqueConstraint("package", "version"),
    )
    op.create_index("release_newest", "release", ["package", "rank"])
    op.create_index("release_of_repository", "release", ["repository", "commit"])


def _requirements() -> None:
    """What parts need of others."""
    op.create_table(
        "requirement",
        _number("part_id"),
        _number("number"),
        _text("use"),
        _text("kind"),
        _text("package", nullable=True),
        _text("owner"),
        _text("name"),
        _number("line"),
        _text("certainty"),
        _points("part_id", "part.id"),
        sa.PrimaryKeyConstraint("part_id", "number"),
        sqlite_with_rowid=False,
    )
    op.create_index("requirement_of_package", "requirement", ["package", "kind"])
    op.create_table(
        "requirement_key",
        _text("key"),
        _text("use"),
        _number("part_id"),
        _number("number"),
        _points("part_id", "part.id"),
        sa.PrimaryKeyConstraint("key", "use", "part_id", "number"),
        sqlite_with_rowid=False,
    )


def _of_releases() -> None:
    """What belongs to one release."""
    op.create_table(
        "dependency",
        _number("release_id"),
        _text("package"),
        _text("wanted"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("release_id", "package"),
    )
    op.create_index(op.f("ix_dependency_package"), "dependency", ["package"], unique=False)
    op.create_table(
        "evidence",
        _text("digest"),
        _number("release_id"),
        _text("document"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("digest", "release_id"),
    )
    op.create_index(op.f("ix_evidence_release_id"), "evidence", ["release_id"], unique=False)
    op.create_table(
        "holds",
        _number("part_id"),
        _number("release_id"),
        _points("part_id", "part.id"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("part_id", "release_id"),
        sqlite_with_rowid=False,
    )
    op.create_index(op.f("ix_holds_release_id"), "holds", ["release_id"], unique=False)
    op.create_table(
        "migration",
        _number("release_id"),
        _text("document"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("release_id"),
    )


def _running() -> None:
    """What runs where, and how a release stands."""
    op.create_table(
        "running",
        _text("environment"),
        _text("package"),
        _number("release_id"),
        _text("since"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("environment", "package"),
    )
    op.create_table(
        "standing",
        _number("release_id"),
        _text("channel", nullable=True),
        _text("since"),
        _text("deprecated", nullable=True),
        _text("reason", nullable=True),
        _text("successor", nullable=True),
        _text("withdrawn", nullable=True),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("release_id"),
    )
    op.create_index(op.f("ix_standing_channel"), "standing", ["channel"], unique=False)


def _decisions() -> None:
    """What gates said, and who answers for what they refuse."""
    op.create_table(
        "verdict",
        _number("id"),
        _number("release_id"),
        _text("channel"),
        _text("at"),
        sa.Column("passed", sa.Boolean(), nullable=False),
        _text("document"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("id"),
    )
    op.create_index(op.f("ix_verdict_release_id"), "verdict", ["release_id"], unique=False)
    op.create_table(
        "waiver",
        _number("id"),
        _number("release_id"),
        _text("channel"),
        _text("gate"),
        _text("name"),
        _text("reason"),
        _text("ends"),
        _points("release_id", "release.id"),
        sa.PrimaryKeyConstraint("id"),
    )
    op.create_index(op.f("ix_waiver_release_id"), "waiver", ["release_id"], unique=False)


def _text(name: str, nullable: bool = False) -> sa.Column[str]:
    return sa.Column(name, sa.Text(), nullable=nullable)


def _number(name: str) -> sa.Column[int]:
    return sa.Column(name, sa.Integer(), nullable=False)


def _points(column: str, target: str) -> sa.ForeignKeyConstraint:
    return sa.ForeignKeyConstraint([column], [target])
