"""The same name under another owner, package, namespace or file."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from ecm_checker.hub.provision import HOLE, Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.similarity import last_part, name_similarity, same_language, shape_equal, words

GENERATED = "*.yaml"
"""Stands for all files of a package that parameters are generated from."""


@dataclass(frozen=True, slots=True)
class Places:
    """What tells whether two places are one.

    Attributes:
        files: new path of each file that moved. packages: new name of each package that has one.
        same_module: whether the module that had it still exists. before: paths of the old side.
        owners: package and name of the programs and modules of the new side.
        wholes: names of what holds parts, as classes and messages do, of both sides.
    """

    files: Mapping[str, str]
    packages: Mapping[str, str]
    same_module: Callable[[Provision, Provision], bool]
    before: frozenset[str] = frozenset()
    owners: frozenset[tuple[str, str]] = frozenset()
    wholes: frozenset[str] = frozenset()

    def same_package(self, old: Provision, new: Provision) -> bool:
        """Whether an entity stayed in its package, however that is called now."""
        return self.packages.get(old.package, old.package) == new.package


def best_home(entity: Provision, homes: Sequence[Provision], places: Places) -> Pair | None:
    """Return the pair with the likeliest new home of an entity; None when no home is likely.

    Args:
        entity: gone under its key.
        homes: new entities of its kind and name.
        places: what tells whether two places are one.
    """
    files = places.files
    if not entity.row.moves:
        return None
    likely = [home for home in homes if _is_likely(entity, home, places)]
    if not likely:
        return None
    best = max(likely, key=lambda home: _nearness(entity, home, files))
    if _is_unmoved(entity, best, places):
        return Pair(entity, best)
    if entity.row.included and entity.name == best.name and entity.package == best.package:
        return Pair(entity, best)
    confidence = 0.97 if _same_file(entity, best, files) else 0.9 if len(likely) == 1 else 0.75
    return Pair(entity, best, "moved", confidence, _reason(entity, best, files))


def _is_unmoved(old: Provision, new: Provision, places: Places) -> bool:
    """Whether only our view of the owner changed: the declaration stands where it stood."""
    files = places.files
    if old.is_value and old.path.endswith((".yaml", ".yml")) and _same_file(old, new, files):
        return True  # generated for whoever uses the library
    if old.is_of_module and not places.same_package(old, new):
        return new.node is None and old.path == new.path and (old.package, old.owner) not in places.owners
    if not old.is_of_module:
        return False
    if None in (old.node, new.node) or new.owner in old.sharers or old.owner in new.sharers or old.node == new.node:
        return True  # an owner without a node goes by the name of a class or file, which no user writes
    if not _same_file(old, new, files):
        return False
    return places.same_module(old, new) or old.name.startswith(HOLE) or not old.is_value


def values_by_place(entities: Iterable[Provision]) -> dict[tuple[str, str], list[Provision]]:
    """Return parameters by owner, by the file that names them, and those of generated libraries."""
    index: dict[tuple[str, str], list[Provision]] = defaultdict(list)
    for entity in entities:
        if entity.is_value:
            generated = (f"{entity.package}/{GENERATED}",) if entity.path.endswith((".yaml", ".yml")) else ()
            for place in (f"{entity.package}/{entity.owner}", entity.path, *generated):
                index[place, tail_of(entity)].append(entity)
    return index


def tail_of(entity: Provision) -> str:
    """The last part of a name, without what is computed before it: of `/<*>rate` that may end in a slash."""
    return last_part(entity.name).removeprefix(HOLE)


def move_key(entity: Provision) -> tuple[str, str, str]:
    """What two entities have in common of which one may be the other in another place."""
    name, place = entity.name, entity.row.place
    if place == "scope":
        name = name.replace("::", ".").replace("/", ".").rsplit(".", 1)[-1]
    elif place == "folder":
        name = name.rsplit("/", 1)[-1]
    elif place == "section":
        return entity.kind, "", name.rsplit(".", 1)[-1]
    return entity.kind, entity.facet, name


def is_private(entity: Provision) -> bool:
    """Whether a channel is called below the name of its node, so that another node has another one."""
    return entity.is_endpoint and entity.name.startswith("~")


def is_of_its_node(old: Provision, new: Provision) -> bool:
    """Whether only the node tells what a private channel is: its name is bare (`~/image`), or that of the other one."""
    return is_private(old) and (old.name == new.name or old.name.count("/") == 1)


def is_reshaped(old: Provision, new: Provision) -> bool:
    """Whether two parameter names differ only in a prefix that no artefact shows.

    The prefix of a generated parameter is given where its listener is made, so its own file shows none.
    """
    if new.name == f"{HOLE}.{old.name}" and not re.search(r"[./]", old.name):
        return False  # it had no prefix at all, now users must write one
    if old.name.removeprefix(f"{HOLE}.") == new.name.removeprefix(f"{HOLE}."):
        return True
    if new.name.replace(f"/{HOLE}", "/", 1) == old.name:
        return True
    if new.path.endswith((".yaml", ".yml")) and old.name.endswith(f".{new.name}"):
        return True
    tail = old.name.rsplit(HOLE, 1)[-1].strip("./_")
    return HOLE in old.name and len(tail) > 0 and new.name.rsplit(HOLE, 1)[-1].strip("./_") == tail


def _is_likely(old: Provision, new: Provision, places: Places) -> bool:
    if old.row.fixed and not _same_holder(old, new, places.wholes):
        return False
    if _same_file(old, new, places.files):
        return True
    if not same_language(old, new) or is_private(old) or (old.row.is_file and new.path in places.before):
        return False
    if old.is_of_module:
        return places.same_package(old, new) and shape_equal(old, new) >= 0.5 and not old.name.startswith(HOLE)
    if old.row.included:
        return old.package == new.package or old.name == new.name
    if old.row.common and old.package != new.package:
        return False
    if old.row.layout:
        return old.owner == new.owner and old.type == new.type
    if old.row.fixed:
        return old.default == new.default and old.type == new.type and old.package == new.package
    if old.row.symbol and not old.row.part:
        near = not old.row.called or places.same_package(old, new) or _same_surroundings(old, new)
        alike = shape_equal(old, new) > 0 and name_similarity(old.name, new.name) > 0.5
        return near and alike and _same_nest(old, new, places.wholes)
    return True


def _same_surroundings(old: Provision, new: Provision) -> bool:
    """Whether the modules or namespaces of two functions share a word: many packages have a `main` and a `load`."""
    first, second = (words(entity.name.removesuffix(last_part(entity.name))) for entity in (old, new))
    return bool(first & second) or not (first or second)


def _same_nest(old: Provision, new: Provision, wholes: frozenset[str]) -> bool:
    """Whether two classes of one name are no parts of classes of other names: each class may have its `Params`."""
    around = [entity.name.rpartition("::")[0] for entity in (old, new)]
    return last_part(around[0]) == last_part(around[1]) or wholes.isdisjoint(around)


def _same_holder(old: Provision, new: Provision, wholes: frozenset[str]) -> bool:
    """Whether two constants are not of types of different names: each class may have its `MIN`."""
    if last_part(old.owner) == last_part(new.owner):
        return True
    return not any(each.owner in wholes or _is_enumerator(each) for each in (old, new))


def _is_enumerator(entity: Provision) -> bool:
    """Whether a constant is of the very type that it stands in."""
    return entity.type is not None and entity.type == last_part(entity.owner)


def _nearness(old: Provision, new: Provision, files: Mapping[str, str]) -> tuple[float, ...]:
    return (
        float(_same_file(old, new, files)),
        float(old.package == new.package),
        float(old.owner == new.owner),
        shape_equal(old, new),
        name_similarity(old.owner + old.name, new.owner + new.name),
    )


def _same_file(old: Provision, new: Provision, files: Mapping[str, str]) -> bool:
    return files.get(old.path, old.path) == new.path


def _reason(old: Provision, new: Provision, files: Mapping[str, str]) -> str:
    same_file = _same_file(old, new, files)
    if old.package != new.package:
        how = f"the same name, now in package {new.package}"
    elif old.owner != new.owner:
        how = f"the same name, now of {new.owner or new.package}"
    elif old.facet != new.facet:
        how = f"the same name, now in the {new.facet}"
    else:
        how = "the same name in another place"
    if not same_file:
        return how
    return f"{how}; git sees its file move" if old.path in files else f"{how}, in the same file"
