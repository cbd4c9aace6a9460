"""What stands for template parameters at a call: what it names, else what the types of its arguments show."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Final

from ecm_parsers.source.expr import Call, Constant, Expr, Name, Number

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.containers import is_container
from ecm_extract.link.code.numbers import kind_of_type, type_of_number
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.templates import alike, unified, unqualified
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.interfaces.elements import element_given, spelled_out
from ecm_extract.link.interfaces.message_fields import MessageFields
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env

_REFERRING: Final = frozenset({"std::ref"})
"""en.cppreference.com, std::ref: gives a `std::reference_wrapper` of the type of its argument."""


class TemplateTypes:
    """Finds the types of calls; `folder` and `fields` know the types of their arguments."""

    def __init__(self, folder: Folder, fields: MessageFields) -> None:
        self.folder = folder
        self.fields = fields

    def of_class(self, cls: Cls, call: Invocation, env: Env) -> dict[str, str]:
        """Return what a call that makes an object gives the template parameters of its class."""
        return self._named(cls.fact.template, call, env)

    def of_function(self, func: Func, call: Invocation, env: Env) -> dict[str, str]:
        """Return what a call gives the template parameters of a function."""
        named = self._named(func.fact.template, call, env)
        if len(named) == len(func.fact.template):
            return named
        shown = {name: self.meant(written, env) for name, written in self._shown(func, call, env)}
        return {**shown, **named}

    def meant(self, written: str, env: Env) -> str:
        """Return what a type means at a place: what stands there for a template parameter, or behind an alias."""
        outer = env.types.get(written) or self.folder.objects.class_types(env).get(written)
        return outer or self.folder.program.alias(written, env.func.file, env.scope) or written

    def leads_elsewhere(self, site: Site) -> bool:
        """Tell whether a template on the way calls another specialization, by what its callers make of it."""
        steps = pairwise(site.steps())
        return any(self._means_another(outer, env, inner.func) for (outer, env), (inner, _) in steps)

    def _means_another(self, call: Invocation, env: Env, func: Func) -> bool:
        """Whether a call means another specialization than a function, or the template itself."""
        if call.types:
            return not func.takes([self._known(written, env) for written in call.types])
        general = func.general
        types = self._deduced(general, call, env) if general is not None else ()
        return bool(types) and not func.takes(types)

    def _deduced(self, general: Func, call: Invocation, env: Env) -> Sequence[str]:
        """The types for which a call means a template by its arguments; nothing where one may have another name."""
        shown = self.of_function(general, call, env)
        types = [shown.get(name, "") for name in general.fact.template]
        given = [spelled_out(written) for written in types]
        made = (each for each in general.siblings() if each.fact.specializes is not None) if all(given) else ()
        found = (each.specialized for each in made if alike(given, self._spelled_out(each)))
        own = types if all(self._is_itself(written, env) for written in types) else ()
        return next(filter(all, found), own)

    def _spelled_out(self, special: Func) -> Sequence[str]:
        """The types of a specialization, without other names of them."""
        env = Env(special)
        return [spelled_out(self.meant(written, env)) for written in special.specialized]

    def _is_itself(self, written: str, env: Env) -> bool:
        """Whether a type is no other name of another one: a number, a text, a message or a class of the tree."""
        if not written or written in env.func.fact.template:
            return False
        if kind_of_type(written) or type_of_number(written) or self.fields.has(written, env):
            return True
        return self.folder.objects.class_written(written, env) is not None

    def _known(self, written: str, env: Env) -> str:
        """What a type means at a place; empty of a template parameter of which nothing is known there."""
        found = self.meant(written, env)
        return "" if found in env.func.fact.template else found

    def _named(self, template: Sequence[str], call: Invocation, env: Env) -> dict[str, str]:
        """What a call names; a pack that is given several types is none of them alone ([temp.variadic])."""
        single = template[:-1] if len(call.types) > len(template) else template
        return {name: self.meant(written, env) for name, written in zip(single, call.types, strict=False)}

    def _shown(self, func: Func, call: Invocation, env: Env) -> Iterator[tuple[str, str]]:
        """What the arguments that the call itself gives show of the template parameters."""
        given = bind(func, call, env)
        for parameter in reversed(func.params):
            bound = given.get(parameter.name) if _mentions(parameter.type, func.fact.template) else None
            if bound is not None and bound.env is env:
                yield from self._matched(parameter.type, bound.expr, func, env).items()

    def _matched(self, pattern: str, given: Expr, func: Func, env: Env) -> Mapping[str, str]:
        return unified(pattern, self._written(given, env), func.fact.template)

    def _written(self, expr: Expr, env: Env) -> str:
        """The type of an argument; empty where that is not shown, and of a text, which several types take."""
        if isinstance(expr, Number):
            return "int" if isinstance(expr.value, int) else "double"
        if isinstance(expr, Constant):
            return "bool" if expr.name in {"true", "false"} else ""
        if isinstance(expr, Call) and isinstance(expr.callee, Name) and is_container(expr.callee.id):
            return f"{expr.callee.id}<{', '.join(expr.types)}>" if expr.types else ""
        if isinstance(expr, Call) and isinstance(expr.callee, Name) and expr.callee.id in _REFERRING:
            held = self._written(expr.args[0], env) if len(expr.args) == 1 else ""
            return f"std::reference_wrapper<{held}>" if held else ""
        written = unqualified(self._as_written(expr, env))
        return "" if plain(written) == "auto" else self.meant(written, env)

    def _as_written(self, expr: Expr, env: Env) -> str:
        element = element_given(expr, lambda each: self._as_written(each, env)) if isinstance(expr, Call) else ""
        return element or self.fields.written_type(expr, env)


def _mentions(written: str, template: Sequence[str]) -> bool:
    return any(name and name in written for name in template)
