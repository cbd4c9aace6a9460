"""Objects that nobody hands over, as by a static pointer: where the tree makes one object of a class it is that one."""

from __future__ import annotations

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.made_unseen import SeenMakers
from ecm_extract.link.running.env import Env, Instance


class SoleObjects:
    """Finds how the only object of a class is made; each class is asked about once.

    Args:
        sites: knows the calls that make objects.
        makers: tells whose objects are all made where it is seen.
    """

    def __init__(self, sites: Sites, makers: SeenMakers) -> None:
        self.sites = sites
        self._makers = makers
        self._known: dict[Cls, Instance | None] = {}

    def of(self, cls: Cls) -> Instance | None:
        """Return how it is made; None of a class of which there may be several objects, or some that nobody sees."""
        if cls not in self._known:
            self._known[cls] = None  # who asks in a circle
            self._known[cls] = self._made(cls) if self._is_followed(cls) else None
        return self._known[cls]

    def _made(self, cls: Cls) -> Instance | None:
        calls = list(self.sites.makers(cls))
        return self.sites.made_by(calls[0], cls, self._place(calls[0])) if len(calls) == 1 else None

    def _place(self, call: Invocation) -> Env:
        """The place of a call, of the only object of the class whose constructor calls."""
        func = call.func
        holder = self.of(func.cls) if func.is_constructor and func.cls is not None else None
        if holder is None or holder.maker is not func:
            return self.sites.root_env(func, call.at)
        return Env(func, call.at, holder.args, this=func.cls, made=holder)

    def _is_followed(self, cls: Cls) -> bool:
        return cls.file.language == "cpp" and self._makers.is_seen(cls)
