"""What the effects of statements ask of who resolves calls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from typing import TYPE_CHECKING, Protocol

from ecm_parsers.source.expr import Call, Expr, Member

from ecm_extract.infer.kinds import Exceptions

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func


class Lending(Protocol):
    """Who knows which functions are handed to those that only call them."""

    def is_lent(self, call: Call, func: Func, index: int) -> bool:
        """Tell whether a function of the tree does nothing with an argument of a call in another one but call it."""


class Parameters(Protocol):
    """Who knows what functions change that they are given."""

    def may(self, func: Func, name: str) -> bool:
        """Tell whether a function may change what its parameter consists of; in C++ the fields of that."""

    def gives(self, func: Func, name: str) -> bool:
        """Tell whether a function of C++ may give what its pointer leads to something else."""

    def hands(self, func: Func, name: str) -> bool:
        """Tell whether a function of C++ hands its pointer to somebody who is not seen."""

    def rivals(self, call: Call, func: Func, at: int) -> Sequence[Func]:
        """Return the functions of C++ that a call in a statement may mean as well as the one that it is held to."""

    def may_by(self, call: Call, func: Func, at: int) -> bool:
        """Tell whether a call in a statement of a function, of one of the tree, may change its first argument."""

    def changes_object(self, method: Member, func: Func, at: int) -> bool:
        """Tell whether a method that a statement of a function of Python hands on may change what it is a method of."""

    def changes_by_class(self, method: Member, func: Func) -> bool:
        """Tell whether a method that Python calls by its class may change the object that it gets: `Base.reset(x)`."""

    def fields(self, func: Func, name: str) -> Set[str] | None:
        """Return the fields of a parameter that a function changes, by key; None where it may do anything to it."""

    def is_left(self, call: Call, arg: Expr, func: Func, at: int) -> bool:
        """Tell whether the class of Python that a call makes an object of leaves an argument alone and keeps it not."""

    def leaves_object(self, method: Func) -> bool:
        """Tell whether a method changes no member of its object, and calls no other one that might."""


class Targets(Protocol):
    """Who knows which function of the tree a call means."""

    def target(self, call: Call, func: Func, at: int) -> Func | None:
        """Return the function with a body that a call in a statement of a function means."""

    def keeps(self, path: str) -> bool:
        """Tell whether a call that is written so is one of a client library, which leaves what it gets as it is."""

    def finds(self, path: str) -> bool:
        """Tell whether a call that is written so gives its last argument the name of a parameter that it looks for."""

    def is_outside(self, name: str, func: Func) -> bool:
        """Tell whether a name in a method of C++ means a variable of a namespace."""

    def is_of_library(self, name: str, func: Func) -> bool:
        """Tell whether a name that the file of a function of Python imports is of a module outside of the tree."""

    def shared_members(self, func: Func) -> Mapping[str, Set[str]]:
        """Return, for members of the object at hand, the others that each may be or consist of, by key."""

    def shown_part(self, call: Call, func: Func) -> Expr | None:
        """Return the part of an object of C++ that a method gives a reference to; None of other calls."""

    def has_setter(self, name: str, method: Func | None) -> bool:
        """Tell whether objects of Python have a property that a method sets: that of a method, None for any object."""

    def changed_by_ending(self, func: Func) -> Set[str]:
        """Return the variables of C++, by key, that objects change when they end which a function makes."""

    @property
    def lent(self) -> Lending:
        """Who knows which functions are handed to those that only call them."""

    @property
    def parameters(self) -> Parameters:
        """Who knows what functions change that they are given."""

    @property
    def exceptions(self) -> Exceptions:
        """Who knows what raises."""
