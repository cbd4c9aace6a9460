"""Alembic runs this file; the registry hands it its connection."""

from alembic import context

from ecm_extract.registry.revisions import CONNECTION
from ecm_extract.registry.tables import Base

context.configure(
    connection=context.config.attributes[CONNECTION], target_metadata=Base.metadata, transactional_ddl=False
)
context.run_migrations()
