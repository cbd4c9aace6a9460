"""Classes of Python of which objects may be made where no call names them: `run(Part)`, `for kind in (A, B): kind()`.

Who is handed a class, or is called on it (`cls()`), may make an object of it with any arguments, beside those that its
name makes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.decorators import is_of_class
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.making import Making
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.index.handed import Handed
from ecm_extract.link.index.own_class import is_own_class
from ecm_extract.link.index.registered import Registered
from ecm_extract.link.running.given_functions import GivenFunctions
from ecm_extract.link.running.named_classes import class_asked


class OtherMakers:
    """Tells whether there are any; each class is asked about once.

    Args:
        making: tells which calls make objects.
        calls: all calls by the last part of what they name.
        given: tells which names somebody gets.
    """

    def __init__(self, making: Making, calls: Mapping[str, Sequence[Invocation]], given: GivenFunctions) -> None:
        self.making = making
        self.program = program = making.program
        self._calls = calls
        self._given = given
        self._handed = Handed(program)
        self._registered = Registered(program)
        self._known: dict[Cls, bool] = {}

    def has(self, cls: Cls) -> bool:
        """Tell whether somebody may make objects of just this class without its name."""
        if cls.file.language != "python":
            return False
        if cls not in self._known:
            self._known[cls] = self._is_given(cls) or any(self._makes(each, cls) for each in self._on_own_class(cls))
        return self._known[cls]

    def _is_given(self, cls: Cls) -> bool:
        """Whether somebody hands a class over by a form that is not read as a call, or a decorator keeps it."""
        if not cls.fact.decorators and not self._given.has_class(cls):
            return False
        return bool(self._registered.readers(cls)) or next(self._handed.classes(cls), None) is not None

    def are_left_out(self, site: Site, wider: Sequence[Site]) -> bool:
        """Tell whether somebody may make the object of a site who is none of those that lead to `wider` ones."""
        cls = site.owner
        if cls is None or not self.has(cls):
            return False
        return any(each.root is site.root or self.making.makes(each.chain[0], cls) for each in wider)

    def _on_own_class(self, cls: Cls) -> Iterator[Func]:
        """The methods that make objects of their class, where that may be another one (`index.own_class`)."""
        for owner in self.program.ancestry(cls):
            if self.program.derived(owner):
                yield from (each for each in owner.methods if _makes_own(each))

    def _makes(self, method: Func, cls: Cls) -> bool:
        """Whether a method may have a class for its own: a class method is called on it, an object is of any."""
        calls = self._calls.get(method.fact.name, ())
        return not is_of_class(method) or any(class_asked(call, self.program) is cls for call in calls)


def _makes_own(method: Func) -> bool:
    return any(is_own_class(call.callee, method) for group in method.calls for call in group)
