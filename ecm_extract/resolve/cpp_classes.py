"""Which class a C++ name means."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Cls, File
from ecm_extract.resolve.aliases import Aliases, Declared
from ecm_extract.resolve.cpp_scopes import Scopes
from ecm_extract.resolve.messages import KINDS as MESSAGE_NAMESPACES
from ecm_extract.resolve.outcome import Ambiguous, External, outcome
from ecm_extract.resolve.views import View, Views

FoundClass = Cls | Ambiguous[Cls] | External


class CppClasses:
    """Looks up classes and aliases over what a translation unit sees.

    Args:
        scopes: spells out names.
        views: what files see.
        aliases: of the tree.
        classes: by their qualified names.
    """

    def __init__(self, scopes: Scopes, views: Views, aliases: Aliases, classes: Mapping[str, Sequence[Cls]]) -> None:
        self._scopes = scopes
        self._views = views
        self._aliases = aliases
        self._classes = classes
        self._asked: set[Declared] = set()

    def find(self, name: str, file: File, scope: str) -> FoundClass:
        """Return the class that a name, without template arguments, means in a scope of a file."""
        for view in self._seen(file):
            found = self._within(name, scope, view)
            surely = self._within(name, scope, view.surely) if view.surely is not view else found
            if isinstance(found, Cls) and isinstance(surely, Cls) and found is not surely:
                return Ambiguous((found, surely))  # in another part of the function it means another
            if found is not None:
                return found
        return External(name)

    def seen(self, name: str, file: File) -> FoundClass:
        """Return the class of the outermost scope that a file sees itself under a name."""
        found = self._within(name, "", self._views.of(file))
        return External(name) if found is None else found

    def readings(self, name: str, file: File, scope: str) -> Iterator[str]:
        """Yield the qualified names that a name can have in a scope, innermost first; the tree may lack them."""
        for view in self._seen(file):
            for level in self._scopes.levels(name, scope, view):
                yield from level

    def alias(self, name: str, file: File, scope: str) -> str | None:
        """Return what the alias stands for that a name means; None of other names and where several are meant."""
        for view in self._seen(file):
            targets = self._targets(name, scope, view)
            surely = self._targets(name, scope, view.surely) if view.surely is not view else targets
            if targets is not None:
                return next(iter(targets)) if len(targets) == 1 and surely in (None, targets) else None
        return None

    def _targets(self, name: str, scope: str, view: View) -> Set[str] | None:
        """What the aliases of the innermost scope stand for that has a name: none for a class; None of no scope."""
        for level in self._scopes.levels(name, scope, view):
            if any(cls.file in view for each in level for cls in self._classes.get(each, ())):
                return frozenset()
            targets = {entry.alias.target for entry in self._declared(level, view)}
            if targets:
                return targets
        return None

    def spelled_out(self, name: str, file: File) -> str:
        """Return a name with what the alias in front of it stands for; as it is where a file sees none, or several."""
        head, _, rest = name.removeprefix("::").partition("::")
        if not rest or head not in self._aliases.last_names:
            return name
        view = self._views.of(file)
        seen = {plain(entry.alias.target) for entry in self._aliases.called(head) if entry.file in view}
        target = _one_of(seen)
        return f"{target}::{rest}" if target else name

    def _seen(self, file: File) -> Iterator[View]:
        own = self._views.of(file)
        yield own
        wide = self._views.wide(file)
        if wide is not own:
            yield wide

    def _within(self, name: str, scope: str, view: View) -> FoundClass | None:
        for level in self._scopes.levels(name, scope, view):
            classes = [cls for each in level for cls in self._classes.get(each, ()) if cls.file in view]
            if classes:
                return outcome(classes, level[0])
            found = self._renamed(level, view)
            if found is not None:
                return found
        return None

    def _declared(self, level: Sequence[str], view: View) -> Iterator[Declared]:
        for each in level:
            entries = (entry for entry in self._aliases.by_name.get(each, ()) if entry.file in view)
            yield from (entry for entry in entries if view.partly or not entry.alias.partly)

    def _renamed(self, level: Sequence[str], view: View) -> FoundClass | None:
        """What the aliases of a scope stand for; an alias of something outside hides what scopes further out have."""
        found: list[Cls] = []
        outside: FoundClass | None = None
        for entry in self._declared(level, view):
            if entry in self._asked:
                continue
            self._asked.add(entry)
            meant = self.find(plain(pointee(entry.alias.target)), entry.file, entry.scope)
            self._asked.discard(entry)
            found += [meant] if isinstance(meant, Cls) else []
            outside = outside or (meant if not isinstance(meant, Cls) else None)
        return outcome(found, level[0]) if found else outside


def _one_of(targets: set[str]) -> str | None:
    """The only target; of a package and its namespace of ROS 2, which a file chooses between, the namespace."""
    longest = max(targets, key=len, default="")
    package = longest.rpartition("::")[0] if longest.rpartition("::")[2] in MESSAGE_NAMESPACES else longest
    return longest if targets <= {longest, package} else None
