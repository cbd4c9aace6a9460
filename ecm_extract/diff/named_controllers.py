"""Controllers that parameter files name: who starts, switches or sends to one does so by that name.

One is a setting `arm_controller.type` (ROS 1: `arm_controller/type`) whose value is a type of controller.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Final

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair
from ecm_extract.shipped import shipped

_TYPE: Final = "type"
_SURE: Final = 0.9
_GONE: Final = "who starts it, switches to it or sends to it by that name fails"
Now = Callable[[Provision], str]
"""The path that the file of an old setting has now."""


def controller_of(setting: Provision) -> str | None:
    """Return the name of the controller whose type a setting tells; None for all others."""
    if not setting.row.sets or setting.default not in shipped("system/controllers.toml")["claims"]:
        return None
    *_, name, last = ("", *setting.name.replace("/", ".").split("."))
    return name if last == _TYPE and name else None


def gone_controller(setting: Provision) -> str | None:
    """Return why it breaks somebody that a file no longer has a setting; None where it does not."""
    name = controller_of(setting)
    return None if name is None else f"the file no longer has the controller {name}; {_GONE}"


def controller_pairs(
    old: Iterable[Provision], new: Iterable[Provision], every: Iterable[Provision], now: Now
) -> Iterator[Pair]:
    """Yield what controllers became that their files have no more: in another file, or the only new one of their type.

    Args:
        old: settings that are gone.
        new: those that came.
        every: all of the new side.
        now: tells where the file of an old one is.
    """
    gone, came = list(old), list(new)
    elsewhere = {(each.package, each.name, str(each.default)): each for each in every if controller_of(each)}
    before, after = _by_type(gone, now), _by_type(came, lambda entity: entity.path)
    for place, lost in before.items():
        moved = [(each, elsewhere.get((each.package, each.name, str(each.default)))) for each in lost]
        yield from (Pair(each, there) for each, there in moved if there is not None)
        left = [each for each, there in moved if there is None]
        found = after.get(place, [])
        if len(left) == 1 and len(found) == 1:
            yield from _renamed(left[0], found[0], gone, came)


def _renamed(old: Provision, new: Provision, gone: list[Provision], came: list[Provision]) -> Iterator[Pair]:
    """A controller under another name, with all that its file sets for it."""
    names = controller_of(old), controller_of(new)
    reason = f"controller {names[0]} is called {names[1]} now, the only one of its type in the file; {_GONE}"
    yield Pair(old, new, "renamed", _SURE, reason)
    there = {each.name: each for each in came if each.path == new.path and each is not new}
    for each in gone:
        head, mark, tail = each.name.partition(names[0] or "")
        target = there.get(f"{head}{names[1]}{tail}")
        if each is not old and each.path == old.path and not head and tail[:1] in {".", "/"} and mark and target:
            yield Pair(each, target)


def _by_type(settings: Iterable[Provision], now: Now) -> Mapping[tuple[str, str], list[Provision]]:
    found: dict[tuple[str, str], list[Provision]] = defaultdict(list)
    for each in settings:
        if controller_of(each) is not None:
            found[now(each), str(each.default)].append(each)
    return found
