"""Which calls are forms."""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce

from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Lambda, Member, Name, Number, Op, Opaque

from ecm_extract.link.code.calls import Invocation, invocations, placed_arguments, spreads, unseen_argument
from ecm_extract.link.code.spelling import by_value, last_name, plain, pointee
from ecm_extract.link.code.texts import is_text, text_arguments
from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.client_libraries import is_client_library
from ecm_extract.link.declaring.forms import Form, FormTable
from ecm_extract.link.declaring.signs import Signs
from ecm_extract.link.declaring.undeclared import Undeclared
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.index.module_kinds import is_node_base
from ecm_extract.link.running.env import MAX_DEPTH, Env
from ecm_extract.link.running.other_nodes import asks_another_node

_TRUE = Constant("true")


class Matcher:
    """Finds the rows of the table that a call is."""

    def __init__(self, forms: FormTable, folder: Folder) -> None:
        self.forms = forms
        self.folder = folder
        self.undeclared = Undeclared(folder)
        self.signs = Signs(forms, folder)

    def fitting(self, call: Invocation, env: Env) -> Iterator[Form]:
        """Yield the rows that a call is: the first that fits, and those that hold beside it."""
        found = False
        for form in self.forms.get(call.last, ()):
            if (form.beside or not found) and self._is(form, call, env):
                found = found or not form.beside
                yield form

    def _is(self, form: Form, call: Invocation, env: Env) -> bool:
        file = call.func.file
        if form.language != file.language or _is_short(call, form):
            return False
        if form.ros and file.ros and form.ros != file.ros:
            return False
        if form.flag and next(positions(form.flag, call), None) != _TRUE:
            return False
        if form.undeclared and not self.undeclared.takes_any(call.func):
            return False
        if form.row.value and asks_another_node(call, env, self.folder.objects):
            return False
        return self._fits(form, call, env) and self._named(form, call)

    def _fits(self, form: Form, call: Invocation, env: Env) -> bool:
        if form.match == "method":
            return self._method(form, call, env)
        if call.receiver is not None:
            return False
        if form.match == "function":
            return (
                _qualified(call.path, form.callee)
                or self._is_brought(form, call, env)
                or (_is_within(call, form.callee) and self.folder.objects.callee(call, env) is None)
            )
        return self._constructs(form, call, env) and not self._is_of_tree(form, call, env)

    def _named(self, form: Form, call: Invocation) -> bool:
        if form.items:
            return next(positions(form.items, call), None) is not None
        return bool(form.fixed) or name_argument(form, call) is not None

    def _method(self, form: Form, call: Invocation, env: Env) -> bool:
        if form.receiver:
            return self._receiver(form, call, env)
        if form.fixed:
            return True
        if call.receiver is not None:
            return self._own_method(call, env)
        if not call.simple:
            owner = call.path.rsplit("::", 1)[0]
            known = self.folder.program.class_named(owner, call.func.file, env.scope)
            return known is not None or is_node_base(plain(owner))
        callee = self.folder.objects.callee(call, env)
        return callee is None or callee is call.func or (callee.cls is not None and not _forwards(callee))

    def _own_method(self, call: Invocation, env: Env) -> bool:
        """A method of the tree that passes its name on is a wrapper, and so no form; nor is one without a body."""
        callee = self.folder.objects.callee(call, env)
        if callee is None:
            return not self._is_declared(call, env)
        return callee is call.func or not _forwards(callee) or _is_library(callee, call)

    def _is_declared(self, call: Invocation, env: Env) -> bool:
        """Tell whether the class of a receiver has a method of that name, of which nobody shows what it does."""
        cls = self.folder.objects.class_of(call.receiver, env) if call.receiver is not None else None
        lineage = self.folder.program.ancestry(cls) if cls is not None else ()
        own = (entry for entry in lineage if not is_client_library(entry.file.package))
        return any(method.fact.name == call.last for entry in own for method in entry.methods)

    def _receiver(self, form: Form, call: Invocation, env: Env) -> bool:
        """Whether the object is of a class of the row; of one of unknown type what is done with it tells that."""
        if call.receiver is None or call.receiver == THIS:
            return self._derives(form, call)
        written = self.folder.objects.type_of(call.receiver, env)
        if not written:
            return self.signs.show(form, call, env)
        target = plain(pointee(written))
        for _ in range(MAX_DEPTH):
            alias = self.folder.program.alias(target, call.func.file, env.scope)
            if alias is None:
                break
            target = plain(pointee(alias))
        return any(_is_of(target, entry) for entry in form.receiver) or self._is_derived(form, call, target, env)

    def _is_derived(self, form: Form, call: Invocation, target: str, env: Env) -> bool:
        """Whether the object is of a class of the tree that derives from one of the row, and has no such method."""
        cls = self.folder.program.class_named(target, call.func.file, env.scope)
        lineage = self.folder.program.ancestry(cls) if cls is not None else ()
        bases = [plain(base) for entry in lineage for base in entry.fact.bases]
        if not any(_is_of(base, entry) for base in bases for entry in form.receiver):
            return False
        return not any(method.fact.name == call.last for entry in lineage for method in entry.methods)

    def _derives(self, form: Form, call: Invocation) -> bool:
        """Whether the class of the object at hand derives from one of the row, and has no such method itself."""
        own = self.folder.nesting.object_of(call.func) if call.simple or call.receiver is not None else None
        lineage = self.folder.program.ancestry(own) if own is not None else ()
        bases = (last_name(plain(base)) for cls in lineage for base in cls.fact.bases)
        return any(base in form.receiver for base in bases) and not self._is_own(call)

    def _is_brought(self, form: Form, call: Invocation, env: Env) -> bool:
        """Whether a function is named by what `using` or an alias brings; the methods of a class hide such names."""
        program, file = self.folder.program, call.func.file
        if file.language == "python" or (call.simple and self._is_own(call)):
            return False
        brought = program.alias(call.path, file, env.scope) if call.simple else program.spelled_out(call.path, file)
        return brought is not None and _qualified(plain(brought), form.callee)

    def _is_own(self, call: Invocation) -> bool:
        """Tell whether the object at hand has a method of the name that a call uses."""
        own = self.folder.nesting.object_of(call.func)
        lineage = self.folder.program.ancestry(own) if own is not None else ()
        return any(method.fact.name == call.last for cls in lineage for method in cls.methods)

    def _constructs(self, form: Form, call: Invocation, env: Env) -> bool:
        path = call.path
        if _qualified(path, form.callee) or ("::" not in form.callee and "." not in form.callee):
            return True
        if _is_within(call, form.callee):
            return True
        if "::" in path or call.func.file.language == "python":
            return False
        target = self.folder.program.alias(path, call.func.file, env.scope)
        if target is not None:
            return by_value(target) and _qualified(plain(target), form.callee)
        namespace = form.callee.rsplit("::", 1)[0]
        usings = (using.namespace for using in call.func.file.facts.usings if using.holds_in(call.func.scope))
        return any(using == namespace or using.endswith("::" + namespace) for using in usings)

    def _is_of_tree(self, form: Form, call: Invocation, env: Env) -> bool:
        """Whether the tree has the class of a row, so that its own constructor tells what it makes."""
        if call.func.file.language == "python" or "::" not in form.callee:
            return False
        cls = self.folder.program.class_named(call.path, call.func.file, env.scope)
        if cls is None or is_client_library(cls.file.package):
            return False
        return any(method.is_constructor for method in cls.methods)


def _is_short(call: Invocation, form: Form) -> bool:
    return len(call.args) < form.min_args and not spreads(call)


def _is_library(callee: Func, call: Invocation) -> bool:
    """Tell whether a method is a client library's, of which the rows tell, whoever has its sources."""
    package = callee.file.package
    return package != call.func.file.package and is_client_library(package)


def _forwards(func: Func) -> bool:
    """Tell whether a function calls another of its own name: a helper around the real thing."""
    return any(call.last == func.fact.name for call in invocations(func))


def positions(text: str, call: Invocation) -> Iterator[Expr]:
    """Yield the arguments at the positions of a row, in order of preference."""
    keywords, placed, found = dict(call.keywords), placed_arguments(call), False
    for position in text.split("|") if text else ():
        kind, _, index = position.partition(":")
        if kind == "kw" and index in keywords:
            found = True
            yield keywords[index]
        elif kind == "arg" and int(index) < len(placed):
            found = True
            yield placed[int(index)]
        elif kind == "field":
            base, *names = index.split(".")
            yield from (reduce(Member, names, arg) for arg in call.args[int(base) : int(base) + 1])
        elif kind == "text":
            texts = text_arguments(call)
            if int(index) < len(texts):
                yield texts[int(index)]
    if text and not found and spreads(call):
        yield _unseen(text, call)


def _unseen(text: str, call: Invocation) -> Expr:
    """What stands for an argument that a call of Python may spread, called as its keyword unless callers know it."""
    positions = dict(reversed([position.partition(":")[::2] for position in text.split("|")]))
    found = unseen_argument(call, "arg" not in positions)
    return found if isinstance(found, Name) else Opaque(positions.get("kw", "value"))


def handle_argument(form: Form, call: Invocation) -> Expr | None:
    """Return the node or node handle that a call names its endpoint below; None for that of its own object.

    Where the name is the first text, an overload without a handle has that text in the place of one.
    """
    if not form.node:
        return call.receiver
    found = next(positions(form.node, call), None)
    named = next(positions(form.name, call), None) if "text:" in form.name else None
    is_name = named is not None and found is not None and (found is named or is_text(found, call.func))
    return None if is_name else found


def name_argument(form: Form, call: Invocation) -> Expr | None:
    """Return the argument that holds the ROS name; None when the call cannot have one."""
    found = next(positions(form.name, call), None)
    return None if isinstance(found, Number | Constant | Lambda) else found


def latch_argument(form: Form, call: Invocation) -> Expr | None:
    """Return the flag that keeps the last message: in C++ the last argument of its overload, behind callbacks."""
    positioned = form.latch
    if call.func.file.language != "python":
        last = f"arg:{len(placed_arguments(call)) - 1}"
        positioned = last if last in form.latch.split("|") else ""
    return next((flag for flag in positions(positioned, call) if not is_callback(flag)), None)


def is_callback(expr: Expr) -> bool:
    """Tell whether an argument is a function: some overloads take the profile after it."""
    if isinstance(expr, Call) and isinstance(expr.callee, Name):
        return last_name(expr.callee.id) in {"bind", "bind_front", "mem_fn"}
    return isinstance(expr, Lambda) or (isinstance(expr, Op) and expr.op == "&")


def _is_of(written: str, entry: str) -> bool:
    """Tell whether a class, or a pointer to it by the name that libraries give such, is the one of a row."""
    if "::" in entry:
        return _qualified(written, entry)
    return last_name(written) in {entry, entry + "Ptr"}


def _is_within(call: Invocation, callee: str) -> bool:
    """Tell whether a call stands in a namespace of a library, whose names the tree then has without a prefix."""
    namespace = callee.removesuffix(f"::{call.path}")
    scope = call.func.scope
    return namespace != callee and (scope == namespace or scope.startswith(f"{namespace}::"))


def _qualified(path: str, callee: str) -> bool:
    if "." in callee:
        parts = path.split(".")
        return parts[0] == callee.split(".")[0] and parts[-1] == last_name(callee)
    separator = "::"
    return path == callee or path.endswith(separator + callee)
