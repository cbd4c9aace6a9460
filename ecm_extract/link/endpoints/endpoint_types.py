"""Types of endpoints and parameters, and defaults of parameters, at one site."""

from __future__ import annotations

from typing import Any

from ecm_checker.hub.roles import Role, roles
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op, Text

from ecm_extract.link.code.numbers import as_number
from ecm_extract.link.code.spelling import last_name, plain, template_arguments
from ecm_extract.link.code.templates import unqualified
from ecm_extract.link.declaring.match import name_argument, positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.endpoints.asked_types import AskedElsewhere, asked_type
from ecm_extract.link.folding.data import UNKNOWN, data_of, declared_type, plain_type, stated_type, type_of_data
from ecm_extract.link.folding.declared_numbers import as_spelled
from ecm_extract.link.folding.durations import counted
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.interfaces.types import Types
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.values import Hole, data_in
from ecm_extract.shipped import shipped_names

_ENVIRONMENT = shipped_names("link/code/library_values.toml", "environment")
_NO_TEXT = frozenset({"bool", "double", "integer"})
"""Types whose default is no text: what folds to one comes from a call that gives something else when it runs."""
_SINGLE = _NO_TEXT | {"string"}


class EndpointTypes:
    """Finds the type of what a site declares."""

    def __init__(self, folder: Folder, types: Types) -> None:
        self.folder = folder
        self.types = types
        self._asked = AskedElsewhere(folder, self._out_type)

    def of(self, site: Site, default: Expr | None) -> tuple[str | None, Any]:
        """Return the type of a site, and the default of a parameter as data, `UNKNOWN` when nothing shows it."""
        if not site.form.row.value:
            return self.types.at(site.form.type, site.call, site.env, site.form.role).name, UNKNOWN
        if default is None and site.form.given:
            return self._given(site), UNKNOWN  # what a parameter is set to is no default of it
        stated = stated_type(default) or self._bound_stated(default, site.env) or self._held_stated(default, site.env)
        data = UNKNOWN if stated else self._data(default, site.env)
        written = site.call.types[0] if site.form.type == "template:0" and site.call.types else ""
        written = site.env.types.get(written, written)
        out = next(positions(site.form.out, site.call), None)
        declared = self._declared(written, site.env) or stated or self._out_type(out, site.env)
        own = self._default_type(default, site.env)
        held = own if site.env.func.file.language == "cpp" and _is_listed(own, data) else None
        known = declared or held or (type_of_data(data) if data is not UNKNOWN else None) or own
        known = known or self._target_type(site)
        known = known or self._read_type(site) or self._described(site) or asked_type(site.call)
        known = known or self._partly_text(default, site.env) or self._of_environment(default, site.env)
        if known is None and default is None:
            known = self._asked.type_of(name_argument(site.form, site.call), site.call)
        data = as_spelled(data) if site.env.func.file.language == "cpp" else data
        return known, UNKNOWN if known in _NO_TEXT and isinstance(data, str) else held_default(data, known)

    def _given(self, site: Site) -> str | None:
        """The type of what a parameter is set to, unless the class reads it for another one; of names in quotes."""
        name, given = name_argument(site.form, site.call), next(positions(site.form.given, site.call), None)
        if given is None or not isinstance(name, Text):
            return None
        return self._asked.type_of(name, site.call) or self.of(site, given)[0]

    def _data(self, default: Expr | None, env: Env) -> Any:
        data = data_of(default, env, self.folder)
        number = counted(default, env, self.folder) if data is UNKNOWN else None
        return data if number is None else number

    def _target_type(self, site: Site) -> str | None:
        """The type of the variable that takes the value: `int qos = declare_parameter("qos", (int)given)`."""
        statement = site.call.statement
        value, target = statement.value, statement.target
        if site.env.func.file.language == "python":
            return _cast(value, site.call.line)
        if site.chain or target is None or not isinstance(value, Call) or value.line != site.call.line:
            return None
        called = value.callee.name if isinstance(value.callee, Member) else getattr(value.callee, "id", "")
        if called != site.call.last:
            return None
        return declared_type(plain_type(statement.type or self.folder.objects.type_of(target, site.env)))

    def _read_type(self, site: Site) -> str | None:
        """The type of the variable that the same function reads the parameter into: `get_parameter("port", port)`."""
        name = name_argument(site.form, site.call)
        if name is None or site.env.func.file.language != "cpp":
            return None
        targets = self.folder.reads.read_into(site.call.func, name)
        types = (self._out_type(Name(target), site.env) for target in targets)
        return next((found for found in types if found is not None), None)

    def _described(self, site: Site) -> str | None:
        """The type that the descriptor of a Python parameter names: `ParameterDescriptor(type=...)`."""
        described = next(positions(site.form.type, site.call), None)
        if site.env.func.file.language != "python" or described is None:
            return None
        if isinstance(described, Call):
            return _descriptor_type(described)
        made = [held.expr if held.how == "value" else None for held in self.folder.origins.of(described, site.env)]
        found = {_descriptor_type(value) if isinstance(value, Call) else None for value in made}
        return found.pop() if len(found) == 1 else None

    def _bound_stated(self, default: Expr | None, env: Env) -> str | None:
        bound = env.args.get(getattr(default, "id", "")) if default is not None else None
        return stated_type(bound.expr) if bound is not None else None

    def _held_stated(self, default: Expr | None, env: Env) -> str | None:
        """The type that a variable holds instead of a default: `PARAMETER_DOUBLE`, which no source gives a value."""
        if not isinstance(default, Name | Member):
            return None
        holes = [value.parts[0] for value in self.folder.fold(default, env) if len(value.parts) == 1]
        found = {stated_type(Name(hole.label)) if isinstance(hole, Hole) else None for hole in holes}
        return found.pop() if len(found) == 1 else None

    def _default_type(self, default: Expr | None, env: Env) -> str | None:
        """The type of the variable or construction that a default is."""
        if isinstance(default, Name) and default.id in env.args:
            bound = env.args[default.id]
            return self._default_type(bound.expr, bound.env) or self._parameter_type(default.id, env)
        if isinstance(default, Op) and default.op == "+" and any(isinstance(part, Text) for part in default.operands):
            return "string"
        if isinstance(default, Call) and isinstance(default.callee, Name):
            inner = default.args[0] if default.callee.id.endswith("ParameterValue") and default.args else None
            if inner is not None:
                return self._default_type(inner, env)
            arguments = f"<{', '.join(default.types)}>" if default.types else ""
            return self._declared(default.callee.id + arguments, env)
        shown = self.folder.objects.type_of(default, env) if default is not None else ""
        found = self._declared(_referred(shown, env), env)
        return found or (self._wrapped_type(default, env) if isinstance(default, Name) else None)

    def _parameter_type(self, name: str, env: Env) -> str | None:
        """The type that a function of C++ declares its parameter with, a template by what it was called with."""
        written = next((plain(each.type) for each in env.func.fact.params if each.name == name), "")
        return self._declared(env.types.get(written, written), env) if env.func.file.language == "cpp" else None

    def _wrapped_type(self, default: Name, env: Env) -> str | None:
        """The type of what a variable of C++ wraps: `const rclcpp::ParameterValue value(given);`."""
        if not self.folder.objects.type_of(default, env).endswith("ParameterValue"):
            return None
        made = [(held.expr, held.env or env) for held in self.folder.origins.of(default, env) if held.how == "value"]
        found = {self._default_type(expr, place) if isinstance(expr, Call) else None for expr, place in made}
        return found.pop() if len(found) == 1 else None

    def _partly_text(self, default: Expr | None, env: Env) -> str | None:
        """What is put together of a text and something unknown is a text: `os.path.join(folder, "a.yaml")`."""
        values = self.folder.fold(default, env) if default is not None else ()
        written = [
            value.data is None and any(isinstance(part, str) and part for part in value.parts) for value in values
        ]
        return "string" if written and all(written) else None

    def _of_environment(self, default: Expr | None, env: Env) -> str | None:
        """What the environment gives is a text, where a text stands for what is not set."""
        if default is None or env.func.file.language != "python":
            return None
        made = [held.expr for held in self.folder.origins.of(default, env)] if isinstance(default, Name) else [default]
        calls = [invocation_of(each, env) for each in made if isinstance(each, Call)]
        read = [call for call in calls if call.path in _ENVIRONMENT and len(call.args) > 1]
        texts = [isinstance(data_in(value), str) for call in read for value in self.folder.fold(call.args[1], env)]
        return "string" if read and len(read) == len(made) and all(texts) else None

    def _declared(self, written: str, env: Env) -> str | None:
        if "." in written:
            return None  # a class of a module of Python, however its last part is called
        found = declared_type(plain_type(written))
        if found is not None or not written:
            return found
        alias = self._meant(plain(written), env) or written
        held = [self._meant(each, env) or each for each in template_arguments(alias)]
        return declared_type(plain_type(f"{plain(alias)}<{', '.join(held)}>" if held else alias))

    def _meant(self, written: str, env: Env) -> str | None:
        return self.folder.program.alias(written, env.func.file, env.scope)

    def _out_type(self, out: Expr | None, env: Env) -> str | None:
        written = self.types.fields.written_type(out, env) if out is not None else ""
        bound = env.args.get(out.id) if isinstance(out, Name) else None
        if bound is not None and plain(written) == "auto":  # a template without a head, or a generic lambda
            return self._out_type(bound.expr, bound.env)
        if isinstance(out, Name) and plain(written) in {"", "auto"}:
            written = env.func.written_types.get(out.id, "")
        if written and plain(written) in env.func.fact.template:
            return self._deduced(plain(written), env)
        return declared_type(plain_type(written)) if written else None

    def _deduced(self, template: str, env: Env) -> str | None:
        """What a template parameter is at a call: given, or the type of an argument that is declared with it."""
        if template in env.types:
            return self._declared(env.types[template], env)
        for parameter in env.func.params:
            bound = env.args.get(parameter.name) if plain(parameter.type) == template else None
            if bound is not None:
                data = data_of(bound.expr, bound.env, self.folder)
                known = type_of_data(data) if data is not UNKNOWN else None
                return known or self._default_type(bound.expr, bound.env)
        return None


def _referred(written: str, env: Env) -> str:
    """The type of what a `std::reference_wrapper<T>` refers to, by the call of a template; other types as they are."""
    held = template_arguments(written) if last_name(plain(written)) == "reference_wrapper" else ()
    return env.types.get(unqualified(held[0]), held[0]) if held else written


def _is_listed(own: str | None, data: Any) -> bool:
    """Whether a default is a list or a number, of which its own type says what it holds: `vector<double>{1}`."""
    numbers = isinstance(data, int) and not isinstance(data, bool) and own == "double"
    return numbers or (isinstance(data, list) and own is not None and own.endswith("_array"))


def held_default(data: Any, known: str | None) -> Any:
    """Return a default as the type of its parameter holds it: `declare_parameter<double>("rate", 0)` is 0.0."""
    if known in _SINGLE and isinstance(data, list):
        return held_default(data[0], known) if len(data) == 1 and not isinstance(data[0], list) else UNKNOWN
    if known in _ARRAYS and isinstance(data, list):
        return [as_number(each, _ARRAYS[known]) for each in data]
    if known == "bool_array" and isinstance(data, list):
        return [bool(each) if isinstance(each, int) else each for each in data]
    return as_number(data, _HELD.get(known or "", ""))


def _descriptor_type(descriptor: Call) -> str | None:
    """The type that a descriptor is made with; `.value` of a type is its number."""
    given = dict(descriptor.keywords).get("type")
    return stated_type(given.base if isinstance(given, Member) and given.name == "value" else given)


def _cast(value: Expr | None, line: int) -> str | None:
    """The type that Python makes of a parameter at once: `int(rospy.get_param("~port"))`."""
    if not isinstance(value, Call) or not isinstance(value.callee, Name) or len(value.args) != 1:
        return None
    inner = value.args[0]
    return _CASTS.get(value.callee.id) if isinstance(inner, Call) and inner.line == line else None


_HELD = {"double": "double", "integer": "int"}
_ARRAYS = {"double_array": "double"}
"""Parameter type -> a type of C++ that holds its numbers."""
_CASTS = {"bool": "bool", "float": "double", "int": "integer", "str": "string"}


def role_of(role: Role, kind: str | None) -> Role:
    """Return the role of an endpoint by its type.

    A client that a template makes for an action type is an action client, whatever the helper is called.
    """
    asking = ((name, row) for name, row in roles().items() if row.calls and row.behind == role)
    return next((name for name, row in asking if kind is not None and f"/{row.shape}/" in kind), role)
