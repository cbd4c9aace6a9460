"""Classes by whose name a method is called: `Class.method(x)` of Python, `Base::method(x)`, `object.Class::method(x)`.

Source: Python language reference, "staticmethod" and "classmethod"; [class.qual] of the C++ standard.
"""

from __future__ import annotations

from ecm_parsers.source.expr import THIS, Name

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.scope import Scope


def class_asked(call: Invocation, program: Program) -> Cls | None:
    """Return the class of which a call asks one of its own methods; None of other calls."""
    if call.func.file.language != "python":
        owner = call.path.rpartition("::")[0] if call.receiver is not None else ""
        return program.class_named(owner, call.func.file, call.func.scope) if owner else None
    path = _written(call) if call.receiver is not None else call.path.rpartition(".")[0]
    named = program.class_named(path, call.func.file, call.func.fact.scope) if path else None
    owners = program.ancestry(named) if named is not None else ()
    return named if any(call.last in owner.statics for owner in owners) else None


def class_at_hand(call: Invocation, env: Env, program: Program) -> Cls | None:
    """Return the class of the object at hand: `Base::name()` means that of the base, whatever a derived class has."""
    owner = env.this or env.func.cls
    qualifier = last_name(call.path.rpartition("::")[0])
    if env.func.file.language == "python" and env.func.fact.name != "<module>":
        return None  # a bare name in a function of Python means no method, whatever the class has
    if not qualifier or owner is None:
        return owner
    return next((entry for entry in program.ancestry(owner) if entry.fact.name == qualifier), None)


def is_cast(call: Invocation) -> bool:
    """Tell whether a call of C++ is one on the object at hand by a class that is written in front of the method."""
    return call.receiver == THIS and "::" in call.path


def class_cast_to(call: Invocation, env: Env, scope: Scope) -> Cls | None:
    """Return the class that a template casts the object at hand to: what the class of that gives it for a parameter."""
    template, own = env.func.cls, env.this
    written = call.path.rpartition("::")[0]
    if template is None or own is None or own is template:
        return None
    written = scope.program.alias(written, env.func.file, env.scope) or written
    given = plain(scope.base_types.within(written, template, own)) if written in template.fact.template else ""
    return scope.program.class_named(given, env.func.file, env.scope) if given else None


def _written(call: Invocation) -> str:
    """What stands before the method, where that is no variable."""
    written = dotted_name(call.receiver) if call.receiver is not None else ""
    bare = Name(written.partition(".")[0])
    if bare.id in call.func.given or any(each.target == bare for each in call.func.fact.body):
        return ""
    return written.replace(".", "::")
