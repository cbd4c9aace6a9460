"""What is stored stays, whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext
from sample import driver, packages, panel, published
from sqlalchemy import delete, select, update

from ecm_extract.errors import InputError
from ecm_extract.registry import audit, clock
from ecm_extract.registry.engine import open_engine
from ecm_extract.registry.place import registry_url
from ecm_extract.registry.publish import Origin, require_all
from ecm_extract.registry.questions import Asked, who_uses
from ecm_extract.registry.releases import find_release, list_releases, package_of_release
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import AuditEntry, Base, Content, Part, RequirementRow
from ecm_extract.registry.verify import verify


def _verified(registry: Registry) -> tuple[str, ...]:
    with registry.reading() as session:
        return verify(session).problems


def test_tables_are_what_the_revisions_make(url: str) -> None:
    """Nobody who updates gets other tables than who begins anew."""
    Registry.create(url).close()
    engine = open_engine(registry_url(url))
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"include_object": _is_ours})
        assert compare_metadata(context, Base.metadata) == []
    engine.dispose()


def _is_ours(_object: object, name: str, *_rest: object) -> bool:
    """The index of words is the database's own: tables of FTS5, or an index over an expression."""
    return not name.startswith(("name_search", "name_words"))


def test_making_a_registry_again_loses_nothing(registry: Registry, url: str, tmp_path: Path) -> None:
    """`init` may be run at any time."""
    published(registry, packages(tmp_path / "a", driver()))
    with Registry.create(url) as again, again.reading() as session:
        assert [each.name for each in list_releases(session)] == ["driver@1.0.0"]


def test_a_document_comes_back_as_it_was(registry: Registry, tmp_path: Path) -> None:
    """Whatever is asked of a release is asked of what was extracted."""
    found = packages(tmp_path / "a", {**driver(), **panel()})
    published(registry, found, Origin("robot"))
    with registry.reading() as session:
        held = [package_of_release(session, find_release(session, each.name)) for each in found]
    assert [each.provides for each in held] == [each.provides for each in found]
    assert [each.requires for each in held] == [each.requires for each in found]
    assert _verified(registry) == ()


def test_the_same_content_may_come_again(registry: Registry, tmp_path: Path) -> None:
    """Publishing is idempotent, also from another commit."""
    found = packages(tmp_path / "a", driver())
    first = published(registry, found, Origin("robot", "1.0.0", "a" * 40))
    second = published(registry, found, Origin("robot", "1.0.1", "b" * 40))
    assert [each.state for each in (*first, *second)] == ["published", "same"]
    with registry.reading() as session:
        assert len(session.scalars(select(AuditEntry)).all()) == 1


def test_other_content_under_a_version_is_refused(registry: Registry, tmp_path: Path) -> None:
    """A release never changes, and a tag that moved is told as such."""
    published(registry, packages(tmp_path / "a", driver()), Origin("robot", "1.0.0", "a" * 40))
    moved = published(registry, packages(tmp_path / "b", driver(topic="status")), Origin("robot", "1.0.0", "b" * 40))
    assert moved[0].state == "refused"
    assert "its tag moved" in moved[0].reason
    assert "aaaaaaaaaaaa" in moved[0].reason
    with pytest.raises(InputError, match=r"driver@1\.0\.0"):
        require_all(moved)


def test_a_package_without_a_version_is_no_release(small: Registry, tmp_path: Path) -> None:
    """Nothing could be said of the next one."""
    files = driver()
    files["driver/package.xml"] = files["driver/package.xml"].replace("<version>1.0.0</version>", "")
    assert published(small, packages(tmp_path / "a", files))[0].state == "refused"


def test_nothing_of_a_transaction_that_fails_is_stored(registry: Registry, tmp_path: Path) -> None:
    """Whoever is refused one package of a source has none of it."""
    published(registry, packages(tmp_path / "a", driver()))
    mixed = packages(tmp_path / "b", {**driver(topic="status"), **panel()})
    from ecm_extract.registry.publish import make_ready, publish

    with pytest.raises(InputError), registry.writing() as session:
        require_all(publish(session, [make_ready(each) for each in mixed], Origin("robot")))
    with registry.reading() as session:
        assert [each.name for each in list_releases(session)] == ["driver@1.0.0"]
    assert _verified(registry) == ()


def test_files_that_did_not_change_are_stored_once(small: Registry, tmp_path: Path) -> None:
    """The hundredth release costs what changed in it."""
    published(small, packages(tmp_path / "a", driver("1.0.0")))
    with small.reading() as session:
        before = len(session.scalars(select(Part)).all())
    published(small, packages(tmp_path / "b", driver("1.0.1")))
    with small.reading() as session:
        assert len(session.scalars(select(Part)).all()) == before


def test_who_uses_tells_the_lines(registry: Registry, tmp_path: Path) -> None:
    """A listener and a configuration file, of the newest release only."""
    published(registry, packages(tmp_path / "a", {**driver(), **panel("0.9.0")}))
    published(registry, packages(tmp_path / "b", panel("1.0.0")))
    with registry.reading() as session:
        found = who_uses(session, "driver", Asked(), EVERYTHING)
    lines = {(name.kind, name.name, user.package, user.version) for name in found.names for user in name.users}
    assert ("topic", "/state", "panel", "1.0.0") in lines
    assert ("parameter", "rate", "panel", "1.0.0") in lines
    assert not [each for each in lines if each[3] == "0.9.0"]


def test_who_uses_names_what_is_not_there(small: Registry, tmp_path: Path) -> None:
    """A slip in a name is no all-clear."""
    published(small, packages(tmp_path / "a", driver()))
    with small.reading() as session:
        with pytest.raises(InputError, match="provides nothing"):
            who_uses(session, "driver", Asked("stats"), EVERYTHING)
        with pytest.raises(InputError, match="not in the registry") as error:
            who_uses(session, "drver", Asked(), EVERYTHING)
    assert "driver" in error.value.hint


@pytest.mark.parametrize("field", ["subject", "detail", "actor", "at"])
def test_verify_sees_a_changed_entry(registry: Registry, tmp_path: Path, field: str) -> None:
    """Each entry carries the hash of the one before."""
    published(registry, packages(tmp_path / "a", {**driver(), **panel()}))
    with registry.writing() as session:
        session.execute(update(AuditEntry).where(AuditEntry.number == 1).values({field: "2001"}))
    assert "audit entry 1 was changed" in _verified(registry)


def test_verify_sees_what_is_missing(registry: Registry, tmp_path: Path) -> None:
    """The newest entry, rows and contents."""
    published(registry, packages(tmp_path / "a", driver()))
    with registry.writing() as session:
        session.execute(delete(AuditEntry))
        session.execute(delete(RequirementRow))
        session.execute(update(Content).values(data=b"nothing"))
    problems = " ".join(_verified(registry))
    assert "newest audit entries are missing" in problems
    assert "has other rows" in problems
    assert "cannot be unpacked" in problems


def test_a_clock_that_went_back_is_refused(small: Registry, monkeypatch: pytest.MonkeyPatch) -> None:
    """Times of the log never go back; clocks of machines may differ a little."""
    present = clock.now()
    with small.writing() as session:
        first = audit.append(session, "test", "a", {})
    monkeypatch.setattr(clock, "now", lambda: present.replace(year=present.year - 1))
    with pytest.raises(InputError, match="clock"), small.writing() as session:
        audit.append(session, "test", "b", {})
    assert clock.after(first, clock.read(first).replace(microsecond=0)) == first


def test_a_registry_that_is_not_there(tmp_path: Path) -> None:
    """The message says how to make one."""
    with pytest.raises(InputError, match="no registry") as error:
        Registry(str(tmp_path / "none.sqlite"))
    assert "registry init" in error.value.hint
    with pytest.raises(InputError, match="no database"):
        Registry("mysql://nowhere/x")
