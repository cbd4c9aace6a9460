"""Functions that no source shows and no row tells of, which get a node and a name: what they declare is not told."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import Final

from ecm_parsers.source.cpp_logging import is_printing
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op, Text

from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import given_to, last_of
from ecm_extract.link.declaring.client_libraries import is_client_library
from ecm_extract.link.declaring.forms import FormTable
from ecm_extract.link.declaring.unmodelled_python import MADE_UP, RUN_TEXT, UnmodelledPython
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.index.module_kinds import is_node_base
from ecm_extract.link.running.env import Env
from ecm_extract.tree import FileDiagnostic, Unread, printable

CODE: Final = "handle-given-outside"
COMPUTED: Final = "method-by-computed-name"
TEXT: Final = "code-from-text"
_HANDLE: Final = "NodeHandle"
_LANGUAGE: Final = frozenset({"std", "boost", "ros"})
"""Namespaces whose functions declare nothing but what rows tell of."""


class Unmodelled:
    """Finds them.

    Args:
        folder: what is known of the tree.
        known: last names of the calls that rows tell of.
        forms: the rows.
    """

    def __init__(self, folder: Folder, known: Set[str], forms: FormTable) -> None:
        self.folder = folder
        self.program = folder.program
        self.known = known
        self.python = UnmodelledPython(folder, forms)

    def told(self) -> Iterator[FileDiagnostic]:
        """Yield a warning for each of them in each file, where it is called first; it is a gap."""
        found: dict[tuple[str, str], int] = {}
        for func in self.program.every_function():
            for name, line in self._of(func):
                place = func.file.path, name
                found[place] = min(found.get(place, line), line)
        for (path, name), line in sorted(found.items()):
            yield _told(path, name, line)

    def _of(self, func: Func) -> Iterator[tuple[str, int]]:
        """Yield what a function calls so, as it is written, with its line."""
        if func.file.language == "python":
            for at, call in self.python.calls(func):
                name = self.python.called(call, Env(func, at, this=func.cls))
                yield from [(name, call.line)] if name else ()
            return
        for at, call in self._calls(func):
            if self._is_one(call, Env(func, at, this=func.cls)):
                yield _called(call), call.line

    def _calls(self, func: Func) -> Iterator[tuple[int, Call]]:
        """The calls of free functions with a text, which alone are asked for more."""
        for at, group in enumerate(func.calls):
            if func.fact.body[at].kind != "init":
                yield from ((at, call) for call in group if isinstance(call.callee, Name) and _has_text(call))

    def _is_one(self, call: Call, env: Env) -> bool:
        """Whether a call gives a node and a name to a function of which nothing is known."""
        name, space = last_of(call.callee), _called(call).partition("::")[0]
        if name in self.known or space in _LANGUAGE or is_client_library(space):
            return False
        if name in self.program.functions or name in self.program.classes or is_printing(name):
            return False
        return any(self._is_node(arg, env) for arg in given_to(call))

    def _is_node(self, arg: Expr, env: Env) -> bool:
        if not isinstance(arg, Name | Member | Op):
            return False
        written = self.folder.objects.type_of(arg, env)
        return _HANDLE in written or (bool(written) and is_node_base(plain(written)))


def _has_text(call: Call) -> bool:
    return any(isinstance(arg, Text) for arg in given_to(call))


def _called(call: Call) -> str:
    return plain(call.callee.id) if isinstance(call.callee, Name) else ""


def _told(path: str, name: str, line: int) -> FileDiagnostic:
    tellers = {MADE_UP: _told_computed, RUN_TEXT: _told_text}
    teller = tellers.get(name)
    return teller(printable(path), line) if teller is not None else _told_outside(printable(path), name, line)


def _told_outside(path: str, name: str, line: int) -> FileDiagnostic:
    row = printable(last_name(name.replace(".", "::")))
    text = (
        f"{printable(name)} gets a node and a name, and neither the tree nor a row shows what it does with them: what "
        f"it declares is not told. Read its package as well, or add a row for {row} to ecm.toml."
    )
    return FileDiagnostic("warning", CODE, path, line, text, Unread(path, "outside"))


def _told_computed(path: str, line: int) -> FileDiagnostic:
    text = (
        f"{MADE_UP} asks a node for a method by a name that is put together: what that declares is not told. "
        "Call the method by its name, or by a table of methods."
    )
    return FileDiagnostic("warning", COMPUTED, path, line, text, Unread(path, "unfollowed"))


def _told_text(path: str, line: int) -> FileDiagnostic:
    text = (
        f"{RUN_TEXT} runs a text as code, which nobody reads here: what that declares is not told. "
        "Write the code out, or import it as a module."
    )
    return FileDiagnostic("warning", TEXT, path, line, text, Unread(path, "unfollowed"))
