"""What a C++ or Python file declares and does: classes, functions, statements, constants, imports.

Nothing here is about ROS. Which calls are publishers is a table of forms, applied when linking.
Scopes and owners are written with `::` in both languages (`ns::Class`, Python `Outer::Inner`).
"""

from __future__ import annotations

from typing import Final, Literal

import msgspec

from ecm_parsers.source.expr import Expr
from ecm_parsers.source.flow import Block

StatementKind = Literal["do", "let", "set", "init", "return", "each"]


class _Fact(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """Base of all source facts."""


class Statement(_Fact, frozen=True):
    """One step of a body that can carry a value or a call.

    Attributes:
        kind: `do` expression; `let` declaration; `set` assignment; `init` constructor initialiser (target is the
            member or the base class); `return`; `each` loop over `value` binding `target`.
        line: 1-based.
        value: the expression; None for a declaration without a value.
        target: what is bound (`let`, `set`, `init`, `each`).
        type: declared type as written (`let` and `each` in C++, annotated Python); of `x += y` in Python the operator,
            of what a function yields `yield` or `yield from`.
        depth: how many conditions and loops enclose it; `Function.flow` says which.
        deferred: it stands in an anonymous lambda, which runs when somebody calls it.
        kept: it declares a variable of C++ that keeps what it holds from one call to the next (`static`).
    """

    kind: StatementKind
    line: int
    value: Expr | None
    target: Expr | None = None
    type: str = ""
    depth: int = 0
    deferred: bool = False
    kept: bool = False


class Parameter(_Fact, frozen=True):
    """A parameter of a function, with its type as written."""

    name: str
    type: str = ""
    default: Expr | None = None


class Function(_Fact, frozen=True):
    """A function or method, declared or defined; a Python module body is the function `<module>`.

    Attributes:
        name: own name; the class name for a C++ constructor, `__init__` for a Python one.
        scope: enclosing namespaces and classes (`ns::Class`), for a lambda or nested function also the function.
        params: without the implicit `this` / `self`.
        returns: return type as written.
        line: first line. end_line: last line.
        body: its statements, those of its anonymous lambdas included; empty for a declaration.
        template: names of template parameters. defaults: name and default of those of C++ types that have one.
        traits: of `declaration`, `static`, `virtual`, `override`, `pure`, `deleted`, `private`, `protected`,
            `anonymous` (namespace), `deprecated`, `const`, `generator`, `receiving` (one that uses what it is
            sent), `coroutine`, `reference` (it returns one,
            or a pointer, to what may be changed), `lending` (to what may not), `elsewhere` (its name says in
            which class or namespace of C++ it was declared: `void A::b() {}`), `variadic` (a parameter of its
            template is a pack).
        decorators: Python decorators or C++ attributes, as written.
        flow: how the statements of its body follow each other; empty where they simply do.
        shared: names that a Python function takes from around it to assign them (`global`, `nonlocal`).
        specializes: of an explicit specialization of a C++ template the arguments that stand after its name, none
            where its signature shows them; None of what is no specialization.
    """

    name: str
    scope: str
    params: tuple[Parameter, ...]
    returns: str
    line: int
    end_line: int
    body: tuple[Statement, ...] = ()
    template: tuple[str, ...] = ()
    traits: tuple[str, ...] = ()
    decorators: tuple[str, ...] = ()
    flow: Block = ()
    shared: tuple[str, ...] = ()
    specializes: tuple[str, ...] | None = None
    defaults: tuple[tuple[str, str], ...] = ()


OVERLAID: Final = "overlaid"
"""Trait of a field of C++ that may hold something else than it is given: of a union, or some bits of a number."""


class Field(_Fact, frozen=True):
    """A data member of a class; for Python a class attribute or what `__init__` sets on self with an annotation."""

    name: str
    type: str
    line: int
    default: Expr | None = None
    traits: tuple[str, ...] = ()


class Class(_Fact, frozen=True):
    """A class or struct with its bases as written (template arguments kept), in Python with what decorates it.

    One of Python has the trait `remade` where its attributes may be others than its body gives them.
    """

    name: str
    scope: str
    bases: tuple[str, ...]
    line: int
    end_line: int
    fields: tuple[Field, ...] = ()
    template: tuple[str, ...] = ()
    traits: tuple[str, ...] = ()
    decorators: tuple[Expr, ...] = ()


class Constant(_Fact, frozen=True):
    """A named value outside functions: namespace constant, static member, `#define`, enum value, module global.

    A value of an enum has the enum as scope and type, and the trait `scoped` when it is known within that only. A
    `#define` has the trait `default` where it stands for a value that a build does not give.
    """

    name: str
    scope: str
    value: Expr | None
    line: int
    type: str = ""
    traits: tuple[str, ...] = ()


class Alias(_Fact, frozen=True):
    """`using A = B`, `typedef B A`, `namespace A = B`; the scope of one within a function ends in `()`.

    `deprecated` when an attribute says so; `partly` as for `Using`; `template` are the names of its own parameters.
    """

    name: str
    scope: str
    target: str
    line: int
    deprecated: bool = False
    partly: bool = False
    template: tuple[str, ...] = ()

    @property
    def local(self) -> bool:
        """Whether it stands within a function, and is known there only."""
        return self.scope.endswith("()")


class Import(_Fact, frozen=True):
    """An include (`module` is the path, `name` empty) or a Python import.

    Python `import a.b as c` -> module `a.b`, name empty, alias `c`; `from a import b as c` -> module `a`, name `b`,
    alias `c`. A star import has name `*`. `angled`: `#include <...>`, which is not looked for beside the file.
    """

    module: str
    name: str
    alias: str
    line: int
    angled: bool = False


class Using(_Fact, frozen=True):
    """`using namespace a` in a scope; that of one within a function ends in `()`.

    `partly`: whether a part of the function does not have it: it stands in a block, or behind a statement.
    """

    namespace: str
    scope: str = ""
    partly: bool = False

    @property
    def where(self) -> str:
        """Return the scope in which it holds; within a function the function."""
        return self.scope.removesuffix("()")

    def holds_in(self, scope: str) -> bool:
        """Tell whether names in a scope may mean what it brings; one of a namespace may stand for all that use it."""
        return self.where == self.scope or scope == self.where or scope.startswith(f"{self.where}::")


class Macro(_Fact, frozen=True):
    """A macro used like a declaration, e.g. `PLUGINLIB_EXPORT_CLASS(a::B, c::D)`; arguments as written.

    `scope` is the namespace in which it stands.
    """

    name: str
    args: tuple[str, ...]
    line: int
    scope: str = ""


class Mention(_Fact, frozen=True):
    """A name with its namespace, as C++ writes it (`a::B`): 1-based line and column, and how a call of it is made.

    `arguments` is how many a call gives; -1 where the name is not called.
    """

    name: str
    line: int
    column: int
    arguments: int = -1


class Replacement(_Fact, frozen=True):
    """What a macro stands for; `params` are None of one without parentheses, the last may be `...`."""

    name: bytes
    params: tuple[bytes, ...] | None
    body: bytes


class SourceFile(_Fact, frozen=True):
    """All facts of one source file.

    `exported` are the macros by which a C++ file that includes it calls something; `undecided` what those may stand for
    that it calls itself, of which several definitions may hold.
    """

    language: Literal["cpp", "python"]
    imports: tuple[Import, ...] = ()
    usings: tuple[Using, ...] = ()
    aliases: tuple[Alias, ...] = ()
    classes: tuple[Class, ...] = ()
    functions: tuple[Function, ...] = ()
    constants: tuple[Constant, ...] = ()
    macros: tuple[Macro, ...] = ()
    shebang: str = ""
    mentions: tuple[Mention, ...] = ()
    exported: tuple[Replacement, ...] = ()
    undecided: tuple[Replacement, ...] = ()
