"""What a change does, to whom, and whether it breaks: one function per way in which a pair can differ.

Each takes a pair and yields the differences that it knows; `changes.py` makes records of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.hub.provision import HOLE, Form, Provision
from ecm_checker.release import ChangeWord

from ecm_extract.diff.conversions import returns_as_well, takes
from ecm_extract.diff.deduced import deduced
from ecm_extract.diff.keyword_only import has_keyword_only, takes_keywords
from ecm_extract.diff.model import Pair
from ecm_extract.diff.named_controllers import gone_controller
from ecm_extract.diff.overriding import no_longer_overridable
from ecm_extract.diff.similarity import words

_RELIABILITY: Final = ("best_effort", "reliable")
_DURABILITY: Final = ("volatile", "transient_local")
_LATCHED: Final = "transient_local"
_POLICY_KIND: Final = "qos"
_RECOVERY: Final = frozenset({"retry", "retries", "recovery", "fallback", "watchdog", "timeout"})
_RESOURCE: Final = frozenset({"thread", "threads", "gpu", "memory", "cpu"})
_POLICY: Final = frozenset({"vel", "velocity", "accel", "acceleration", "force", "effort", "torque", "jerk"})


class Difference(msgspec.Struct, frozen=True):
    """One way in which a pair differs.

    `old` and `new` replace the names where a policy is what changed; the values are type, default or form.
    """

    change: ChangeWord
    breaking: bool
    reason: str
    dimension: str = "versioning"
    kind: str = ""
    old: str | None = None
    new: str | None = None
    old_value: str | None = None
    new_value: str | None = None


Effect = Callable[[Provision, Provision, Pair], Iterator[Difference]]


def renamed(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """Gone under the old name."""
    if pair.how == "renamed":
        kept = "; the old name still stands for it" if pair.kept else ""
        yield Difference("renamed", not pair.kept, f"{pair.reason}{kept}")


def moved(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """The name is the same, its place is not; a graph name is where it was as long as it is absolute."""
    if pair.how != "moved":
        return
    harmless = (old.is_endpoint and not old.name.startswith("~") and old.package == new.package) or old.name.startswith(
        HOLE
    )
    harmless = harmless or pair.kept or (old.row.anywhere and old.name == new.name)
    yield Difference("moved", not harmless, pair.reason)


def type_changed(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """Message type of an endpoint, type of a parameter, field, member or constant, base class of a plugin."""
    if old.type is None or new.type is None or old.type == new.type or old.row.holds:
        return
    if (old.row.fixed and old.default == new.default) or old.type in new.others or new.type in old.others:
        return
    if pair.how == "renamed" and old.row.symbol and old.row.part:
        return
    if old.row.based and _tail(old.type) == _tail(new.type):
        return
    if old.type.partition("/")[0] == old.package and new.type == old.type.replace(old.package, new.package, 1):
        return  # a type of its own package, which has another name now
    reason = f"type {old.type} became {new.type}"
    widened = old.is_value and (old.type, new.type) == ("integer", "double")
    note = " and YAML integers are refused" if widened else ""
    yield Difference("type_changed", True, reason + note, old_value=old.type, new_value=new.type)


def default_changed(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """Another value where nobody states one; of a message constant, another meaning of the same number."""
    if old.default == new.default or not old.row.default:
        return
    if old.row.duty and new.default is None:
        reason = f"default {old.default!r} is gone: a value must be given now"
        yield Difference("default_changed", True, reason, old_value=str(old.default))
        return
    if new.needed and not new.when and old.default is not None:
        reason = f"default {old.default!r} is gone: a node that is started without a value for it stops"
        yield Difference("default_changed", True, reason, old_value=str(old.default))
        return
    if old.default is None or new.default is None:
        return
    in_message = old.row.fixed and "/" in old.owner
    dimension = _dimension(old.name)
    what = "the value that the file sets" if old.row.sets else "default"
    reason = f"{what} {old.default!r} became {new.default!r}"
    if in_message:
        run = "" if alters_bytes(old) else "both sides run, "
        reason = f"value {old.default!r} became {new.default!r}: {run}each means another thing"
    values = str(old.default), str(new.default)
    yield Difference("default_changed", in_message, reason, dimension, old_value=values[0], new_value=values[1])


def _dimension(name: str) -> str:
    found = words(name)
    for dimension, marks in (("recovery", _RECOVERY), ("resources", _RESOURCE), ("permissions", _POLICY)):
        if found & marks:
            return dimension
    return "behavior"


def qos_changed(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """A publisher that offers less, or a subscriber that asks for more, no longer matches its peers."""
    if old.qos is None or new.qos is None or old.ros != 2 or new.ros != 2:
        return
    for policy, order in (("reliability", _RELIABILITY), ("durability", _DURABILITY)):
        before, after = getattr(old.qos, policy), getattr(new.qos, policy)
        if before == after or before not in order or after not in order:
            continue
        weaker = order.index(after) < order.index(before)
        breaking = weaker if old.facet == "published" else not weaker
        reason = f"{policy} of the {old.facet} topic: {before} became {after}"
        yield Difference(
            "type_changed",
            breaking,
            reason,
            "behavior",
            _POLICY_KIND,
            f"{old.name} {policy}={before}",
            f"{new.name} {policy}={after}",
        )


def latch_changed(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """A ROS 1 publisher that no longer keeps its last message leaves out who comes later."""
    if not old.is_endpoint or (old.facet, old.ros, new.ros) != ("published", 1, 1):
        return
    before, after = (entity.qos.durability if entity.qos is not None else None for entity in (old, new))
    if before == after or "unknown" in (before, after):
        return
    latched = after == _LATCHED
    reason = "latched now" if latched else "no longer latched: who subscribes later gets no message until the next one"
    word = {True: "latch=true", False: "latch=false"}
    names = f"{old.name} {word[not latched]}", f"{new.name} {word[latched]}"
    yield Difference("type_changed", not latched, reason, "behavior", _POLICY_KIND, *names)


def deprecated(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """The old name still works and its end is announced."""
    if new.deprecated and not old.deprecated:
        yield Difference("deprecated", False, new.deprecated[:300])


def signature_changed(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """A call or an override that was right no longer is; an overload that went takes its users with it."""
    if not old.forms or not new.forms or pair.how == "renamed":
        return
    by_alias = old.name != new.name  # its class is another name of one that copies itself
    lost = [form for form in old.forms if not (is_answered(form, new.forms) or (by_alias and _copies(form, old.name)))]
    if lost:
        shown_old = " | ".join(form.text for form in lost)
        shown_new = " | ".join(form.text for form in new.forms)
        reason = f"{shown_old} became {shown_new}"[:400]
        yield Difference("signature_changed", True, reason, old_value=shown_old, new_value=shown_new)
    outdated = [form for form in new.forms if form.deprecated]
    before = {form.types for form in old.forms if form.deprecated}
    fresh = [form for form in outdated if form.types not in before]
    if fresh and not new.deprecated:
        others = " | ".join(form.text for form in new.forms if not form.deprecated)
        yield Difference("deprecated", False, f"{fresh[0].text} is marked deprecated; use {others}"[:400])


def no_longer_virtual(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """A method that classes overrode, and that they only hide now; see `with_inherited_virtual`."""
    for form in no_longer_overridable(old, new) if pair.how != "renamed" else ():
        reason = "no longer virtual" if not form.final else "final now"
        said = f"{form.text} is {reason}: who overrides it no longer builds, or is no longer called"
        yield Difference("signature_changed", True, said[:400], old_value=f"virtual {form.text}", new_value=form.text)


def _copies(form: Form, name: str) -> bool:
    return form.types in {(f"const {name}&",), (f"{name}&&",)}


def is_answered(form: Form, news: Iterable[Form]) -> bool:
    """Whether each call that was right, however many optional arguments it gives, is right with a new form."""
    after = tuple(news)
    if any(accepts(other, form) for other in after):
        return True
    if form.virtual:
        return False
    calls = (_with_arguments(form, count) for count in range(form.required, len(form.types) + 1))
    return all(any(accepts(other, call) for other in after) for call in calls)


def _with_arguments(form: Form, count: int) -> Form:
    return msgspec.structs.replace(form, types=form.types[:count], names=form.names[:count], required=count)


def accepts(new: Form, old: Form) -> bool:
    """Whether code written for the old form is right with the new one."""
    new = deduced(new, old)
    count = len(old.types)
    if old.virtual and new.virtual:
        return new.types == old.types and new.returns == old.returns
    if new.required > old.required or _returns_otherwise(new, old):
        return False
    if has_keyword_only(new) or has_keyword_only(old):
        return takes_keywords(new, old)
    if len(new.types) < count:
        return False
    if any(new.types[:count]) or any(old.types):
        return all(takes(after, before) for after, before in zip(new.types, old.types, strict=False))
    return _takes_names(new.names, old.names)


def _takes_names(new: Sequence[str], old: Sequence[str]) -> bool:
    """Whether names that callers gave are there, in their order; `**kwargs` stands at the end and takes any name."""
    before, after = ([name for name in names if not name.startswith("**")] for names in (old, new))
    takes_any = len(after) < len(new)
    return after[: len(before)] == before and (takes_any or len(before) == len(old))


def _returns_otherwise(new: Form, old: Form) -> bool:
    """Whether a result differs; how many values Python returns is not always known."""
    known = (new.returns and old.returns) or any((*new.types, *old.types))
    return bool(known) and not returns_as_well(new.returns, old.returns)


def relocated(old: Provision, new: Provision, pair: Pair) -> Iterator[Difference]:
    """A launch file that keeps its name in another folder: `ros2 launch` finds it, an include by its path does not."""
    if not old.row.is_placed or old.name != new.name or pair.how != "same":
        return
    before, after = placed(old.path), placed(new.path)
    if before != after:
        reason = "it lies in another folder; who includes it by its path no longer finds it"
        yield Difference("moved", True, reason, old=before, new=after)


def placed(path: str) -> str:
    """Return the end of a path that tells in which folder a file lies: `launch/arm/arm.launch` -> `arm/arm.launch`."""
    return "/".join(path.split("/")[-2:])


EFFECTS: Final[tuple[Effect, ...]] = (
    renamed,
    moved,
    relocated,
    type_changed,
    default_changed,
    qos_changed,
    latch_changed,
    signature_changed,
    no_longer_virtual,
    deprecated,
)


def hidden(holder: Provision) -> Difference:
    """Nothing declares a name any more, and its node or launch file declares some that are not known."""
    if holder.row.is_placed:
        said = f"no longer declared; what {holder.name} declares is not wholly known, and this may be a part of it"
        return Difference("removed", False, said)
    what = holder.name if holder.is_value else "parameters by names that are not known"
    said = f"no longer declared by its name; {holder.node or holder.owner} declares {what}"
    return Difference("removed", False, f"{said}, and this may be one of them")


def no_longer_set(entity: Provision) -> Difference:
    """A parameter file that no longer sets a value leaves it to the node; one of a controller makes none."""
    controller = gone_controller(entity)
    if controller is not None:
        return Difference("removed", True, controller)
    reason = "the file no longer sets it: the default of the node counts"
    return Difference("default_changed", False, reason, _dimension(entity.name), old_value=str(entity.default))


def set_now(entity: Provision) -> Difference:
    """A parameter file that sets a value now takes the place of the node's default."""
    reason = "the file sets it now, in the place of the node's default"
    return Difference("default_changed", False, reason, _dimension(entity.name), new_value=str(entity.default))


def added_breaks(entity: Provision) -> str | None:
    """Return why an addition breaks somebody; None when it does not."""
    if entity.row.layout:
        return "a new field changes the layout: old and new sides of this type do not talk, bags need migration"
    if alters_bytes(entity):
        return "a new constant changes the MD5 sum: old and new sides of this type do not talk, bags need migration"
    if entity.row.duty and entity.default is None:
        return "a new argument without a default: whoever starts or includes the file must give it"
    if entity.needed and not entity.when:
        return "a new parameter without a default: a node that is started without a value for it stops"
    if any(form.pure for form in entity.forms):
        return "a new pure virtual method: classes that derive from it no longer build"
    return None


def alters_bytes(entity: Provision) -> bool:
    """Whether one more, less or otherwise makes another type of its owner: of ROS 1 a constant does, by its sum."""
    return entity.row.layout or (entity.row.fixed and entity.ros == 1 and "/" in entity.owner)


def _tail(name: str) -> str:
    return name.rsplit("::", 1)[-1]
