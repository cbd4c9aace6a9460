"""Calls of Python of which nobody sees what they declare: of libraries that get a node and a name, or by made-up names.

`other.Widget(self, "status")` of a library that neither the tree nor a row shows, `getattr(self, f"create_{kind}")(x)`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Set
from functools import cached_property
from pathlib import PurePosixPath
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Template, Text

from ecm_extract.link.code.callables import text_of
from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children, dotted, given_to
from ecm_extract.link.declaring.client_libraries import is_client_library
from ecm_extract.link.declaring.escaping import handed_makers
from ecm_extract.link.declaring.forms import FormTable
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.index.module_kinds import class_kind, is_node_base
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value

MADE_UP: Final = "getattr"
"""What calls are told by that run a method of which the name is put together."""
RUN_TEXT: Final = "exec"
"""What calls are told by that run code which stands in a text: docs.python.org, built-in functions."""
_RUNNING: Final = (Name(RUN_TEXT), Name("execfile"))


class UnmodelledPython:
    """Finds them.

    Args:
        folder: what is known of the tree.
        forms: the rows.
    """

    def __init__(self, folder: Folder, forms: FormTable) -> None:
        self.folder = folder
        self.program = folder.program
        self.known = forms.keys()
        self.makers = handed_makers(forms)

    def called(self, call: Call, env: Env) -> str:
        """Return how what a call runs is written, where nobody sees what that declares; else nothing."""
        if call.callee in _RUNNING:
            return RUN_TEXT if self._may_declare(call, env.func) else ""
        if env.func.file.ros != 2:
            return ""
        asked = call.callee if isinstance(call.callee, Call) and call.callee.callee == Name(MADE_UP) else None
        if asked is not None:
            return MADE_UP if len(asked.args) > 1 and self._may_be_maker(asked.args[0], asked.args[1], env) else ""
        written = full_name(dotted(call.callee) or "", env.func.file.imported)
        if not written or not self._is_outside(written) or not any(map(_has_text, given_to(call))):
            return ""
        return written if any(self._is_node(arg, env) for arg in given_to(call)) else ""

    def calls(self, func: Func) -> Iterator[tuple[int, Call]]:
        """Yield the calls of a function that may be some, with their statements."""
        for at, group in enumerate(func.calls):
            yield from ((at, call) for call in group if isinstance(call.callee, Name | Member | Call))

    def _may_declare(self, call: Call, func: Func) -> bool:
        """Whether a text that is run as code may declare: one that is not written out, or names a row's call."""
        if not any(is_client_library(name.partition(".")[0]) for name in func.file.imported.values()):
            return False
        code = call.args[0] if call.args else None
        return not isinstance(code, Text) or any(name in code.value for name in self.makers)

    def _is_outside(self, written: str) -> bool:
        """Whether a dotted name is of a library that the tree does not have and no row tells of."""
        root, last = written.partition(".")[0], written.rpartition(".")[2]
        if not root or root in sys.stdlib_module_names or is_client_library(root) or root in self._own:
            return False
        return last not in self.known

    @cached_property
    def _own(self) -> Set[str]:
        """What modules and packages of the tree may be called."""
        paths = [PurePosixPath(file.path) for file in self.program.files if file.language == "python"]
        return frozenset(name for path in paths for name in (*path.parts[:-1], path.stem))

    def _is_node(self, arg: Expr, env: Env) -> bool:
        if arg != THIS and not isinstance(arg, Name | Member):
            return False
        own = self.folder.nesting.object_of(env.func) if arg == THIS else self.folder.objects.class_of(arg, env)
        if own is not None:
            return class_kind(own, self.program) == "node"
        written = plain(self.folder.objects.type_of(arg, env)) if arg != THIS else ""
        return bool(written) and is_node_base(last_name(written))

    def _may_be_maker(self, node: Expr, name: Expr, env: Env) -> bool:
        """Whether what is asked for by a name that is put together may be a method that declares."""
        if text_of(name) is not None or not self._is_node(node, env):
            return False
        values = self.folder.fold(name, env)
        return any(_fits(value, maker) for value in values for maker in self.makers)


def _has_text(expr: Expr) -> bool:
    return isinstance(expr, Text | Template) or (not isinstance(expr, Call) and any(map(_has_text, children(expr))))


def _fits(value: Value, name: str) -> bool:
    """Whether a text of which something is known may be a name."""
    first, last = value.parts[0] if value.parts else "", value.parts[-1] if value.parts else ""
    begin, end = first if isinstance(first, str) else "", last if isinstance(last, str) else ""
    return bool(begin or end) and name.startswith(begin) and name.endswith(end)
