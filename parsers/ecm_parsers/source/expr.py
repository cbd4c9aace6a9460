"""Expressions of C++ and Python in one small vocabulary, so that values fold the same way in both.

`this->x` and `self.x` are both `Member(THIS, "x")`. What has no counterpart here is `Opaque`.
Records are array-like: they travel between processes and into the cache by the hundred thousand.
"""

from __future__ import annotations

from typing import Final, TypeAlias

import msgspec

_CUT: Final = 80
"""Length at which the text of an expression that is not read is cut."""


class _Node(msgspec.Struct, frozen=True, array_like=True, tag=True, gc=False):
    """Base of all expressions; the tag is the class name."""


class Text(_Node, frozen=True):
    """A string literal, unescaped; in C++ also one character, whose type is another."""

    value: str
    is_character: bool = False


class Number(_Node, frozen=True):
    """A numeric literal."""

    value: int | float


class Constant(_Node, frozen=True):
    """`true`, `false` or `null`, whatever the language calls them."""

    name: str


class Name(_Node, frozen=True):
    """An identifier; C++ qualification is kept with `::`, template arguments are dropped."""

    id: str


class Member(_Node, frozen=True):
    """`base.name` or `base->name`."""

    base: Expr
    name: str


class Call(_Node, frozen=True):
    """A call or an object construction (`T(x)`, `T{x}`, `new T(x)`).

    Attributes:
        callee: what is called; a type name for a construction.
        args: positional arguments.
        keywords: Python keyword arguments.
        types: C++ template arguments, as written.
        line: 1-based line of the callee's last name, where people look for the call.
        keyword_lines: 1-based line of each keyword argument.
    """

    callee: Expr
    args: tuple[Expr, ...]
    keywords: tuple[tuple[str, Expr], ...] = ()
    types: tuple[str, ...] = ()
    line: int = 0
    keyword_lines: tuple[int, ...] = ()


class Op(_Node, frozen=True):
    """An operator over its operands: `+`, `%`, `/`, `|`, `!`, `&` (address of), `?:`, `[]`, `==` ..."""

    op: str
    operands: tuple[Expr, ...]


REST: Final = "*rest"
"""Operator of a variable of Python that takes what is left over of a value: `first, *others = value`."""


class Items(_Node, frozen=True):
    """A list, tuple, set or braced initialiser."""

    items: tuple[Expr, ...]


class Table(_Node, frozen=True):
    """A Python dict display; a `**spread` has key `Constant("null")`."""

    entries: tuple[tuple[Expr, Expr], ...]


class Template(_Node, frozen=True):
    """A Python f-string: its literal and computed parts in order."""

    parts: tuple[Expr, ...]


class Lambda(_Node, frozen=True):
    """An anonymous function; its statements are those of the enclosing function.

    `params` and `body` are what a Python lambda gives for what; a call in it is found among the statements. `name` is
    that of the function that it is read as, which has its statements; `body` is None where it needs them.
    """

    param_types: tuple[str, ...]
    params: tuple[str, ...] = ()
    body: Expr | None = None
    name: str = ""


class Comprehension(_Node, frozen=True):
    """`[element for ... in ... if test]`: its loops are `each` statements just before, here by their index.

    The element of a dict comprehension is a `Table` of one entry.
    """

    element: Expr
    loops: tuple[int, ...]
    tests: tuple[Expr, ...] = ()


class Opaque(_Node, frozen=True):
    """Source text that means nothing to the linker, cut at 80 characters."""

    text: str

    def may_name(self, name: str) -> bool:
        """Tell whether a name stands in the text, or may stand where it is cut."""
        return name in self.text or len(self.text) >= _CUT


Expr: TypeAlias = (
    Text | Number | Constant | Name | Member | Call | Op | Items | Table | Template | Lambda | Comprehension | Opaque
)

THIS: Final = Name("this")
"""The object at hand of a method, in either language."""

CAST: Final = Name("static_cast")
"""What C++ calls to have an object as another class, where a member of that is named; `link` tells what it means."""

MOVED: Final = Opaque("std::move")
"""What a variable of C++ holds that was moved from: nobody knows; a number or a pointer is what it was."""
