"""One registry: its database at the right revision, and sessions that read or that write in one transaction."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType

from sqlalchemy import Connection, select
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError, ToolError
from ecm_extract.registry.engine import WRITES, open_engine
from ecm_extract.registry.place import registry_url
from ecm_extract.registry.revisions import newest_revision, revision_of, upgrade
from ecm_extract.registry.tables import AuditHead


class Registry:
    """A registry that is open; also a context manager that closes it.

    Attributes:
        shown: its URL without a password.
    """

    def __init__(self, url: str | None = None) -> None:
        """Open a registry that `create` made.

        Args:
            url: of the database; None for ECM_REGISTRY or the user's own.

        Raises:
            InputError: there is none, it cannot be reached, or it is of another revision.
        """
        self._engine = open_engine(registry_url(url))
        self.shown = self._engine.url.render_as_string(hide_password=True)
        try:
            self._require_revision()
        except BaseException:
            self.close()
            raise

    @classmethod
    def create(cls, url: str | None = None) -> Registry:
        """Make the tables, or bring those of an older version up to date, and open the registry.

        Raises:
            InputError: the database cannot be reached or written.
        """
        engine = open_engine(registry_url(url))
        try:
            with told(), engine.execution_options(**{WRITES: True}).begin() as connection:
                upgrade(connection)
                _begin_audit(connection)
        finally:
            engine.dispose()
        return cls(url)

    def _require_revision(self) -> None:
        with told(), self._engine.connect() as connection:
            found = revision_of(connection)
        if found is None:
            message = f"there is no registry at {self.shown}"
            raise InputError(message, "make it with `ecm-extract registry init`")
        if found != newest_revision():
            message = f"the registry at {self.shown} is of revision {found}, this version reads {newest_revision()}"
            raise InputError(message, "bring it up to date with `ecm-extract registry init`, or update ecm-extract")

    @contextmanager
    def reading(self) -> Iterator[Session]:
        """Give a session that sees one state of the registry."""
        level = "SERIALIZABLE" if self._engine.dialect.name == "sqlite" else "REPEATABLE READ"
        with told(), Session(self._engine.execution_options(isolation_level=level)) as session:
            yield session

    @contextmanager
    def writing(self) -> Iterator[Session]:
        """Give a session whose changes are all there when the block ends, or none of them.

        Writers come one after the other: each appends to the audit log.
        """
        with told(), Session(self._engine.execution_options(**{WRITES: True})) as session, session.begin():
            session.scalars(select(AuditHead).with_for_update()).one()
            yield session

    def close(self) -> None:
        """Close all connections."""
        self._engine.dispose()

    def __enter__(self) -> Registry:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _begin_audit(connection: Connection) -> None:
    with Session(connection) as session:
        if session.get(AuditHead, 1) is None:
            session.add(AuditHead(id=1, number=0, at="", digest=""))
        session.commit()


@contextmanager
def told() -> Iterator[None]:
    """Tell errors of the database as those of the user: a full disk, no rights, a server that is gone."""
    try:
        yield
    except DBAPIError as error:
        message = f"the registry cannot be used: {str(error.orig).splitlines()[0]}"
        raise InputError(message, "nothing was changed; look at the disk, its rights, or the server") from error
    except SQLAlchemyError as error:
        message = f"the registry failed: {error}"
        raise ToolError(message) from error
