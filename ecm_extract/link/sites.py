"""Call sites of forms, direct and through wrappers, to a fixed point.

A function that passes its own parameter to a form is itself a form: its call sites are the sites. The same holds
for a class that passes a constructor argument or template argument on: each place that makes an object is a site.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ecm_parsers.source.expr import Call, Items, Name, Op

from ecm_extract.link.calls import Invocation, invocations, last_name, template_arguments
from ecm_extract.link.env import Env, Instance, bind
from ecm_extract.link.fold import Folder
from ecm_extract.link.forms import Form
from ecm_extract.link.match import Matcher, name_argument
from ecm_extract.link.parameters import Parameters
from ecm_extract.link.program import Cls, Func, Program
from ecm_extract.link.types import Types

MAX_CHAIN = 5
MAX_EXPANSIONS = 400


@dataclass(frozen=True, slots=True, eq=False)
class Site:
    """A call that is a form, seen from the outermost call that fixes its name.

    Attributes:
        form: the row.
        call: the innermost call, the form itself.
        env: where its arguments are evaluated.
        chain: the calls it came through, outermost first; empty for a direct call.
        owner: class whose objects have the endpoint; None for a free function's.
        root: outermost function.
    """

    form: Form
    call: Invocation
    env: Env
    chain: tuple[Invocation, ...]
    owner: Cls | None
    root: Func

    def lines(self) -> Iterator[tuple[str, int]]:
        """Yield (path, line), outermost call first."""
        for call in (*self.chain, self.call):
            yield call.func.file.path, call.line


class Sites:
    """Finds all sites of a program."""

    def __init__(self, program: Program, matcher: Matcher, types: Types, parameters: Parameters) -> None:
        self.program = program
        self.matcher = matcher
        self.types = types
        self.folder: Folder = matcher.folder
        self.parameters = parameters
        self.calls: dict[str, list[Invocation]] = defaultdict(list)
        self._positions: dict[int, dict[int, int]] = {}
        self._derived: dict[int, list[Cls]] | None = None
        for functions in program.functions.values():
            for func in functions:
                for call in invocations(func):
                    self.calls[call.last].append(call)

    def find(self, parameters: bool) -> list[Site]:
        """Return the sites of parameters, or of everything else."""
        found: list[Site] = []
        for last in self.matcher.forms:
            for call in self.calls.get(last, ()):
                site = self._direct(call, parameters)
                if site is not None:
                    found.extend(self._closed(site))
        return found

    def _direct(self, call: Invocation, parameters: bool) -> Site | None:
        func = call.func
        env = self.root_env(func, self.position(call))
        form = self.matcher.form(call, env)
        if form is None or (form.role == "parameter") is not parameters:
            return None
        return Site(form, call, env, (), func.cls, func)

    def root_env(self, func: Func, at: int) -> Env:
        """Return the place of a statement of a function about whose callers nothing is assumed."""
        made = Instance(func.cls, {}, {}) if func.cls is not None else None
        return Env(func, at, this=func.cls, made=made)

    def position(self, call: Invocation) -> int:
        """Return the index of a call's statement."""
        known = self._positions.get(id(call.func))
        if known is None:
            known = {id(statement): at for at, statement in enumerate(call.func.fact.body)}
            self._positions[id(call.func)] = known
        return known[id(call.statement)]

    # --- wrappers --------------------------------------------------------------------------------------

    def _closed(self, site: Site) -> Iterable[Site]:
        """Expand a site over its callers until nothing more is known; without callers it stands as it is."""
        pending, closed = [site], []
        while pending and len(closed) < MAX_EXPANSIONS:
            current = pending.pop(0)
            wider = list(self._wider(current)) if len(current.chain) < MAX_CHAIN else []
            if wider:
                pending.extend(wider)
            else:
                closed.append(current)
        return closed

    def _wider(self, site: Site) -> Iterator[Site]:
        params, made = self._open(site)
        own = {parameter.name for parameter in site.root.fact.params} | set(site.root.fact.template)
        if params & own:
            if site.form.role == "parameter" and not site.chain:
                self._remember_wrapper(site)
            yield from self._callers(site)
        elif made and site.owner is not None:
            yield from self._makers(site, site.owner)

    def _open(self, site: Site) -> tuple[frozenset[str], frozenset[str]]:
        """Return the parameters and the constructor parameters that name and type depend on."""
        params: frozenset[str] = frozenset()
        made: frozenset[str] = frozenset()
        name = name_argument(site.form, site.call)
        for value in self.folder.fold(name, site.env) if name is not None else ():
            params |= value.open("param")
            made |= value.open("made")
        found = (
            self.types.at(site.form.type, site.call, site.env, site.form.role)
            if site.form.role != "parameter"
            else None
        )
        if found is not None and found.open:
            params |= found.open
            made |= found.open
        return params, made

    def _remember_wrapper(self, site: Site) -> None:
        name = name_argument(site.form, site.call)
        labels = self.folder.fold(name, site.env)[0].open("param") if name is not None else frozenset()
        params = [parameter.name for parameter in site.root.fact.params if parameter.name in labels]
        given = next((arg for arg in site.call.args[1:] if _mentions(arg, site.root)), None)
        default = given.id if isinstance(given, Name) else ""
        if params:
            self.parameters.add_wrapper(site.root, params[-1], default)

    def _callers(self, site: Site) -> Iterator[Site]:
        root = site.root
        if root.is_constructor:
            yield from self._makers(site, site.owner) if site.owner is not None else ()
            return
        for call in self.calls.get(root.fact.name, ()):
            if call.func is root or any(call is link for link in site.chain) or not self._means(call, root):
                continue
            outer = self.root_env(call.func, self.position(call))
            yield self._through(site, call, outer)

    def _means(self, call: Invocation, func: Func) -> bool:
        """Tell whether a call can be of this function: arity, language, class of the receiver, visibility."""
        count = len(call.args) + len(call.keywords)
        required = sum(
            parameter.default is None and not parameter.name.startswith("*") for parameter in func.fact.params
        )
        variadic = any(parameter.name.startswith("*") for parameter in func.fact.params)
        if call.func.file.language != func.file.language or (
            not variadic and not required <= count <= len(func.fact.params)
        ):
            return False
        if "lambda" in func.fact.traits:
            return (
                call.func.file is func.file
                and call.receiver is None
                and (
                    f"{call.func.fact.scope}::{call.func.fact.name}".endswith(func.fact.scope)
                    or call.func.fact.scope.endswith(func.fact.scope)
                )
            )
        if func.cls is not None:
            return self._method_means(call, func.cls)
        return call.receiver is None and self.program._nearness(func.file, call.func.file) >= (
            0 if "::" in call.path else 1
        )

    def _method_means(self, call: Invocation, cls: Cls) -> bool:
        if call.receiver is None and "::" not in call.path:
            own = call.func.cls
            return own is not None and cls in self.program.ancestry(own)
        if call.receiver is None:
            return cls.fact.name in call.path.split("::")
        env = self.root_env(call.func, self.position(call))
        owner = self.folder.class_of(call.receiver, env)
        if owner is not None:
            return cls in self.program.ancestry(owner)
        return not self.folder.type_of(call.receiver, env)

    def _through(self, site: Site, call: Invocation, outer: Env) -> Site:
        """Rebuild the chain of environments from a new outermost call."""
        env = outer
        for link, following in zip((call, *site.chain), (*site.chain, site.call), strict=True):
            env = self._enter(link, following, env)
        owner = call.func.cls
        return Site(site.form, site.call, env, (call, *site.chain), owner, call.func)

    def _enter(self, link: Invocation, following: Invocation, env: Env) -> Env:
        func, at = following.func, self.position(following)
        args = bind(func, link, env)
        types = self._template(func, link, env, args)
        if func.cls is None:
            return Env(func, at, args, types)
        if func.is_constructor or self._makes(link, func.cls):
            made = Instance(func.cls, args, self._class_types(func.cls, link, env))
            return Env(func, at, args if func.is_constructor else {}, types, func.cls, made)
        same = (
            env.this is not None
            and func.cls in self.program.ancestry(env.this)
            and link.receiver in {None, Name("this")}
        )
        this = env.this if same else func.cls
        made = env.made if same else Instance(func.cls, {}, {})
        return Env(func, at, args, types, this, made)

    def _template(self, func: Func, link: Invocation, env: Env, args: object) -> dict[str, str]:
        types = dict(zip(func.fact.template, link.types, strict=False))
        return {name: self._bound_type(written, env) for name, written in types.items()}

    def _bound_type(self, written: str, env: Env) -> str:
        outer = env.types.get(written) or (env.made.types.get(written) if env.made is not None else None)
        if outer is not None:
            return outer
        return self.program.alias(written, env.func.file, env.scope) or written

    def _class_types(self, cls: Cls, link: Invocation, env: Env) -> dict[str, str]:
        types = dict(zip(cls.fact.template, link.types, strict=False))
        return {name: self._bound_type(written, env) for name, written in types.items()}

    # --- objects -----------------------------------------------------------------------------------------

    def _makers(self, site: Site, cls: Cls) -> Iterator[Site]:
        """One site for each class that derives from `cls`, and for each place that makes one."""
        for derived in self.derived(cls):
            made = Instance(derived, {}, {})
            env = Env(site.env.func, site.env.at, site.env.args, site.env.types, derived, made)
            if site.chain or (site.env.made is not None and site.env.made.cls is not cls):
                continue
            if self._base_types(derived, cls) or self._calls_base(derived, cls):
                part = self.folder.part(made, cls)
                types = {**site.env.types, **(dict(part.types) if part is not None else {})}
                env = Env(site.env.func, site.env.at, site.env.args, types, derived, made)
                yield Site(site.form, site.call, env, site.chain, derived, site.root)
        for call in self.calls.get(cls.fact.name, ()):
            if not self._makes(call, cls) or any(call is link for link in site.chain) or call.func.cls is cls:
                continue
            yield self._made_at(site, cls, call)

    def _calls_base(self, derived: Cls, cls: Cls) -> bool:
        return cls in self.program.ancestry(derived)

    def _base_types(self, derived: Cls, cls: Cls) -> bool:
        return any(template_arguments(base) for base in derived.fact.bases)

    def _made_at(self, site: Site, cls: Cls, call: Invocation) -> Site:
        outer = self.root_env(call.func, self.position(call))
        constructor = self.folder.constructor(cls, len(call.args))
        args = bind(constructor, call, outer) if constructor is not None else {}
        made = Instance(cls, args, self._class_types(cls, call, outer))
        inner = site.env
        own = args if inner.func.is_constructor and inner.func.cls is cls else inner.args
        env = Env(inner.func, inner.at, own, {**inner.types, **made.types}, cls, made)
        owner = call.func.cls
        return Site(site.form, site.call, env, (call, *site.chain), owner, call.func)

    def _makes(self, call: Invocation, cls: Cls) -> bool:
        if last_name(call.path) != cls.fact.name or call.receiver is not None:
            return False
        scope = f"{call.func.fact.scope}::{call.func.fact.name}"
        path = call.path.replace(".", "::") if call.func.file.language == "cpp" else call.path
        return self.program.class_named(path, call.func.file, scope) is cls or self._imported_as(call, cls)

    def _imported_as(self, call: Invocation, cls: Cls) -> bool:
        if cls.file.language != "python" or call.func.file.language != "python":
            return False
        return self.program.class_named(call.path.rsplit(".", 1)[-1], call.func.file) is cls

    def derived(self, cls: Cls) -> list[Cls]:
        """Return the classes of the tree that derive from a class, at any distance."""
        if self._derived is None:
            self._derived = defaultdict(list)
            for group in self.program.classes.values():
                for entry in group:
                    for base in self.program.ancestry(entry)[1:]:
                        self._derived[id(base)].append(entry)
        return self._derived.get(id(cls), [])


def _mentions(expr: object, func: Func) -> bool:
    names = {parameter.name for parameter in func.fact.params}
    if isinstance(expr, Name):
        return expr.id in names
    if isinstance(expr, Call | Op | Items):
        return False
    return False
