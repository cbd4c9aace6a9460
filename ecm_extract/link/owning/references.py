"""Who uses whom: from a class or function to the classes and functions that make, hold or call it.

Who makes an object has what it declares; who only keeps a pointer to it got it from somebody who has.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator

from ecm_parsers.source.expr import THIS
from ecm_parsers.source.facts import Constant

from ecm_extract.link.code.decorators import is_of_class
from ecm_extract.link.code.spelling import by_value, last_name, plain
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.index.handed import Handed, only_loads
from ecm_extract.link.index.registered import Registered
from ecm_extract.link.owning.imported import Imported
from ecm_extract.link.running.named_classes import class_asked

Unit = Cls | Func
_NAME = re.compile(r"[\w:.]+")
"""The first parameter of a method, of a class method the class."""
_Mention = tuple[Unit, str, File, str]
"""A unit, the name by which it mentions a class, and where that name is looked up: file and scope."""


class References:
    """Reverse references between units; a method belongs to the unit of its class."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self.program = sites.program
        self._handed = Handed(self.program)
        self._imported = Imported(self.program)
        self.registered = Registered(self.program)
        self._mentions: dict[str, list[_Mention]] = defaultdict(list)
        self._aliases = self.program.aliases.meaning(self.program.classes)
        self._holders: dict[str, list[_Mention]] = defaultdict(list)
        for group in self.program.classes.values():
            for cls in group:
                for field in cls.fact.fields:
                    self._mention(field.type, cls, cls.file, cls.qualified)
        for functions in self.program.functions.values():
            for func in functions:
                self._mention_body(func)

        for constants in self.program.constants.values():
            for file, constant in constants:
                if constant.type and file.language == "cpp":
                    self._mention_global(constant, file)

    def _mention_global(self, constant: Constant, file: File) -> None:
        """An object outside of functions is of the program that its file is the main one of."""
        for main in self.program.functions_in(file):
            if main.fact.name == "main":
                self._mention(constant.type, main, file, constant.scope)

    def _mention_body(self, func: Func) -> None:
        unit: Unit = func.holder or func
        for statement in func.fact.body:
            if statement.type and plain(statement.type) != "auto":
                self._mention(statement.type, unit, func.file, func.scope)

    def _mention(self, text: str, unit: Unit, file: File, scope: str) -> None:
        held = by_value(text) and not only_loads(text)
        for name in _NAME.findall(text):
            last = last_name(name)
            if last in self._aliases:
                meant = self.program.class_named(name, file, scope)
                last = meant.fact.name if meant is not None else last
            if last in self.program.classes:
                self._mentions[last].append((unit, name, file, scope))
                if held:
                    self._holders[last].append((unit, name, file, scope))

    def hands(self, name: str) -> bool:
        """Tell whether anybody hands over something of a name, as a callback, for others to call."""
        return self._handed.knows(name)

    def handing(self, cls: Cls) -> Iterator[Func]:
        """Yield the functions that hand a class over, or read what a decorator keeps it in."""
        yield from self._handed.classes(cls)
        yield from self.registered.readers(cls)

    def users(self, unit: Unit) -> Iterator[Unit]:
        """Yield the units that derive from, hold, make or call a unit."""
        if isinstance(unit, Cls):
            yield from self._class_users(unit)
        else:
            yield from self._callers(unit)

    def makers(self, cls: Cls) -> Iterator[Unit]:
        """Yield the units that make or hold an object of a class."""
        yield from self._makers(cls)
        yield from self._mentioning(cls, self._holders)
        yield from self.asking(cls)

    def asking(self, cls: Cls) -> Iterator[Unit]:
        """Yield the units that ask a class of Python itself for a method which makes objects of it, or hands it on."""
        methods = (each for owner in self.program.ancestry(cls) for each in owner.methods if _uses_own_class(each))
        for call in (call for method in methods for call in self.sites.calls.get(method.fact.name, ())):
            if class_asked(call, self.program) is cls:
                yield call.func.holder or call.func

    def importers(self, func: Func) -> Iterator[Unit]:
        """Yield the bodies of the Python files that import the one whose body a function is, and so run it."""
        yield from self._imported.importers(func)

    def _class_users(self, cls: Cls) -> Iterator[Unit]:
        found = [*self.sites.program.derived(cls), *self.makers(cls)]
        yield from found or self._mentioning(cls, self._mentions)
        for method in dict.fromkeys(self._factories(cls)):
            yield from self._callers(method)

    def _factories(self, cls: Cls) -> Iterator[Func]:
        """Yield the methods that need no object and make one: singletons, factories."""
        for call in self.sites.makers(cls):
            if call.func.cls is cls and call.func.holder is None:
                yield call.func
        yield from (method for method in cls.methods if makes_own_class(method))

    def _makers(self, cls: Cls) -> Iterator[Unit]:
        yield from (call.func.holder or call.func for call in self.sites.makers(cls))
        yield from (func.holder or func for func in self.handing(cls))

    def _mentioning(self, cls: Cls, index: dict[str, list[_Mention]]) -> Iterator[Unit]:
        for unit, name, file, scope in index.get(cls.fact.name, ()):
            if unit is not cls and self.program.class_named(name, file, scope) is cls:
                yield unit

    def _callers(self, func: Func) -> Iterator[Unit]:
        for call in self.sites.callers(func):
            yield call.func.holder or call.func
        for other in self._handed.functions(func):
            yield other.holder or other
        yield from self.importers(func)


def _uses_own_class(method: Func) -> bool:
    """Tell whether a class method of Python makes an object of its class, or hands that on."""
    calls = (call for group in method.calls for call in group)
    return is_of_class(method) and any(THIS in (call.callee, *call.args) for call in calls)


def makes_own_class(method: Func) -> bool:
    """Tell whether a class method of Python makes an object of the class that it is called through."""
    of_class = "classmethod" in method.fact.decorators
    return of_class and any(call.callee == THIS for calls in method.calls for call in calls)
