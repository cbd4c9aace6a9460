"""Which calls make listeners of generate_parameter_library, and below which prefix these declare their parameters.

Source: the templates of generate_parameter_library, `ParamListener(node, prefix = "")` and in C++ also
`ParamListener(parameters, logger, prefix = "")`: a prefix that has no point behind it gets one.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.references import Unit
from ecm_extract.link.running.env import invocation_of
from ecm_extract.link.running.values import Value

LISTENER: Final = "ParamListener"
_LOGGER: Final = "Logger"
_LOGGING: Final = frozenset({"get_logger", "get_child"})
"""Calls that give a logger, which C++ takes before the prefix."""
_PREFIX: Final = "prefix"
"""What Python calls the argument."""
_NONE: Final = Text("")


class Listener(NamedTuple):
    """Who makes a listener, and the values that its prefix can have."""

    unit: Unit
    prefixes: tuple[Value, ...]


class Listeners:
    """Finds the listeners of a namespace of parameters; `sites` has the calls of the tree."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites

    def made(self, namespace: str, packages: Container[str]) -> Iterator[Listener]:
        """Yield the listeners that some packages make of a namespace."""
        for call in self.sites.calls.get(LISTENER, ()):
            if call.func.file.package in packages and self._is_of(call, namespace):
                yield Listener(call.func.holder or call.func, self._prefixes(call))

    def _prefixes(self, call: Invocation) -> tuple[Value, ...]:
        env = self.sites.root_env(call.func, call.at)
        given = dict(call.keywords).get(_PREFIX) or next(iter(call.args[2:] or call.args[1:2]), _NONE)
        if len(call.args) == 2 and self._is_logger(given, call):
            given = _NONE
        return self.sites.folder.fold(given, env)

    def _is_logger(self, given: Expr, call: Invocation) -> bool:
        if isinstance(given, Call) and invocation_of(given, self.sites.root_env(call.func, call.at)).last in _LOGGING:
            return True
        written = self.sites.folder.objects.type_of(given, self.sites.root_env(call.func, call.at))
        return last_name(plain(pointee(written))) == _LOGGER

    def _is_of(self, call: Invocation, namespace: str) -> bool:
        """Tell whether a call means the listener of a namespace, by its path or what stands behind that."""
        meant = self.sites.program.alias(call.path, call.func.file, call.func.scope) or call.path
        around = plain(meant).replace("::", ".").rpartition(".")[0]
        return f".{around}".endswith(f".{namespace.replace('::', '.')}")
