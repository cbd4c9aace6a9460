"""Functions of the tree that a call means, and what they give back."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Op

from ecm_extract.infer.held import all_ways
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.containers import makes_tuple
from ecm_extract.link.code.decorators import are_known, is_overload
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.overloads import score
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.spelling import by_value, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.folding.fold_closures import ClosureFolder
from ecm_extract.link.folding.handed_objects import HandedObjects
from ecm_extract.link.folding.names_of_nodes import told_by_node
from ecm_extract.link.folding.raises import Raises
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.early_binding import is_virtual
from ecm_extract.link.running.env import Bound, Env, Instance, invocation_of
from ecm_extract.link.running.object_states import is_own
from ecm_extract.link.running.own_names import below_namespace
from ecm_extract.link.running.values import (
    TOO_DEEP,
    Value,
    alternatives,
    demoted,
    unknown,
    without_defaults,
)

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TOUCHED: Final = frozenset({"handed", "reached", "lost", "out"})
"""What becomes of an object that somebody has who is not followed."""
MAX_RETURNS = 12
"""Returns of one call that are looked at."""


class ReturnFolder:
    """Folds what functions return."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.closures = ClosureFolder(folder)
        self.raises = Raises(folder)
        self.handed = HandedObjects(folder)

    def values(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """Return what a call can give: of each return that is reached, and of what may be called instead."""
        callee = self.meant(call, env) or self._of_part(call, env)
        if callee is None or "generator" in callee.fact.traits:
            return (told_by_node(call, env, self.folder) or unknown(call.last),)
        refused = self.folder.flow.refused
        found = self.returned(callee, call, env)
        if not found or len(found) > MAX_RETURNS:
            return (unknown(call.last) if refused == self.folder.flow.refused and found == [] else TOO_DEEP,)
        folded = [(value, at) for expr, at in found for value in self.folder.fold(expr, at)]
        values = [each for value, at in _beside_joined(folded) for each in self.folder.asked.by_asked((value,), at)]
        if call.receiver is not None and not is_own(call.receiver):
            values = [without_defaults(value) for value in values]  # who made that object may have said otherwise
            if self._made(callee, call, env) is None:
                values = [self.handed.known_by_callers(value, call.receiver, env) for value in values]
        other = self.folder.redefined.rest(callee, call, env)
        open_ = self._has_given_fields(callee, call, env) or (
            any(value.confidence != "pattern" for value in values) and self._is_of_touched(callee, call, env)
        )
        rest = [other] if other is not None else [unknown(call.last)] if open_ else []
        return alternatives(demoted((*values, *rest)))

    def _has_given_fields(self, callee: Func, call: Invocation, env: Env) -> bool:
        """Whether the function at hand gives fields of an object something, which its method is not followed with."""
        if env.func.file.language != "python" or self.folder.methods.depends(callee, callee.cls):
            return False
        key = self.folder.flow.effects(env.func).key(_receiver(call))
        return bool(key) and any(
            changed.startswith(f"{key}.") for changed in self.folder.flow.outline(env.func).changes
        )

    def _is_of_touched(self, callee: Func, call: Invocation, env: Env) -> bool:
        """Whether a method of Python asks an object for its members that somebody may have changed who is not seen."""
        if env.func.file.language != "python" or callee.cls is None or is_own(call.receiver):
            return False
        asks = any(is_own_member(expr) for entry in callee.fact.body for expr, _ in expressions(entry))
        ways = self.folder.flow.ways(_receiver(call), env) if asks else []
        return any(held.how in _TOUCHED for way in ways for held in all_ways(way))

    def meant(self, call: Invocation, env: Env) -> Func | None:
        """Return the one function that a call means by what is known of its arguments; None where several fit."""
        handed = self.closures.function(call, env)
        if handed is not None:
            return handed[0] if are_known(handed[0]) else None
        fitting = self._of_pointed(self.folder.objects.callees(call, env), call, env)
        if len(fitting) > 1 and env.func.file.language == "cpp":
            fitting = self._taking(fitting, call, env)
        if env.func.file.language == "python":
            fitting = [func for func in fitting if not is_overload(func)]
            if not all(are_known(func) for func in fitting):
                return None
        return fitting[0] if len(fitting) == 1 else None  # of two in one place, who knows which was declared last

    def _taking(self, fitting: Sequence[Func], call: Invocation, env: Env) -> Sequence[Func]:
        """Those of several functions that take texts and numbers where a call gives them; the best where that is told.

        An argument that all of them want alike tells none apart, and is not looked at.
        """
        for at, arg in enumerate(call.args):
            if len({_wanted(func, at) for func in fitting}) > 1:
                kind = self._kind(arg, env)
                fitting = [func for func in fitting if _wanted(func, at) in {"", kind or _wanted(func, at)}]
        scores = [score(call, func) for func in fitting]
        is_best = bool(scores[1:]) and scores[0] > scores[1] and all(self._kind(arg, env) for arg in call.args)
        return fitting[:1] if is_best else fitting

    def _of_pointed(self, found: Sequence[Func], call: Invocation, env: Env) -> Sequence[Func]:
        """The methods of the class of the object that a pointer points to, where those that are found are virtual."""
        if is_own(call.receiver) or not any(is_virtual(each, self.folder.program) for each in found):
            return found
        cls = self.folder.redefined.of_pointed(call.receiver, env)
        return self.folder.objects.methods(call, cls) or found

    def _of_part(self, call: Invocation, env: Env) -> Func | None:
        """The method of Python of an object in a list or table, in a field, or that a call gives, by who made it."""
        receiver = _receiver(call)
        part = isinstance(receiver, Op | Member | Call | Name) and env.func.file.language == "python"
        if not part or not any(each.cls for each in self.folder.program.seen_functions(call.last, env.func.file)):
            return None
        fitting = self.folder.objects.methods(call, self.folder.structures.class_at(receiver, env))
        known = len(fitting) == 1 and not is_overload(fitting[0]) and are_known(fitting[0])
        return fitting[0] if known else None

    def _kind(self, arg: Expr, env: Env) -> str:
        """`text`, `number`, or nothing where that is not known."""
        declared = kind_of_type(self.folder.objects.type_of(arg, env))
        if declared:
            return declared
        values = self.folder.fold(arg, env)
        if all(value.data is not None for value in values):
            return "number"
        texts = all(value.data is None and any(isinstance(part, str) for part in value.parts) for value in values)
        return "text" if texts else ""

    def returned(self, callee: Func, call: Invocation, env: Env) -> list[tuple[Expr, Env]]:
        """Return what a call of a function gives back: an expression for each reached return, with its place."""
        inner = self.entered(callee, call, bind(callee, call, env), env)
        run = self.folder.flow.run(inner)
        body = callee.fact.body
        found = [(body[at].value, inner.within(state, at)) for at, state in self.folder.flow.returned(run)]
        return [(value, place) for value, place in found if value is not None]

    def expected(self, callee: Func, call: Invocation, env: Env) -> list[tuple[Expr, Env]]:
        """Return what a call of a function gives back as long as nobody sets a parameter, as `returned` does."""
        found = self.returned(callee, call, env)
        likely = self.folder.flow.decisions.is_likely
        return [each for each in found if each[1].state is None or likely(each[1].state.route)] or found

    def shown(self, made: Bound) -> Bound:
        """Return what a function of C++ makes in braces or as a tuple, where one is called; anything else as it is."""
        if not isinstance(made.expr, Call) or made.env.func.file.language != "cpp" or makes_tuple(made.expr):
            return made
        call = invocation_of(made.expr, made.env)
        callee = self.meant(call, made.env)
        found = self.returned(callee, call, made.env) if callee is not None else []
        return Bound(*found[0]) if len(found) == 1 and isinstance(found[0][0], Items | Call) else made

    def given_back(self, made: Bound) -> Bound:
        """Return the variable that a function gives back, of C++ a copy of it; what is no call of one as it is."""
        if not isinstance(made.expr, Call):
            return made
        call = invocation_of(made.expr, made.env)
        callee = self.meant(call, made.env)
        copied = callee is not None and by_value(callee.fact.returns) and "reference" not in callee.fact.traits
        if callee is None or not (callee.file.language == "python" or copied):
            return made
        found = self.returned(callee, call, made.env)
        return Bound(*found[0]) if len(found) == 1 and isinstance(found[0][0], Name) else made

    def entered(self, callee: Func, call: Invocation, args: Mapping[str, Bound], env: Env) -> Env:
        """Return the place of evaluation at the entry of a called function."""
        handed = self.closures.function(call, env)
        around = self.folder.nesting.enclosing(callee)
        lent = self.folder.lent.place(callee, handed[1], env) if handed is not None and around is not None else None
        outer = env if around is env.func else lent
        led = self.folder.lasting_states.led(callee, call, env)
        if callee.cls is None and "lambda" not in callee.fact.traits:
            return Env(callee, 0, args, depth=env.depth + 1, outer=outer, call=led)
        made = self._made(callee, call, env)
        this = self._class_of(made, callee, call, env)
        written = made is not None or self.folder.object_fields.reads(callee, this)
        python = env.func.file.language == "python"
        other = made is None and (python or isinstance(call.receiver, Call)) and not is_own(call.receiver)
        caller = THIS if is_own(call.receiver) else call.receiver if written or other else None
        follows = caller is not None and (other or self.folder.methods.depends(callee, this))
        within = Bound(caller, env) if follows and caller is not None else None
        return Env(callee, 0, args, this=this, made=made, depth=env.depth + 1, outer=outer, caller=within, call=led)

    def object_at(self, callee: Func, call: Invocation, env: Env) -> Cls | None:
        """Return the class of the object that a called method has at hand."""
        return self._class_of(self._made(callee, call, env), callee, call, env)

    def _class_of(self, made: Instance | None, callee: Func, call: Invocation, env: Env) -> Cls | None:
        """The class of the object that a method is called on, by how that is made, or of C++ by its type."""
        if is_own(call.receiver):
            return env.this or env.func.cls or callee.cls
        if made is not None or call.receiver is None or callee.cls is None or env.func.file.language == "python":
            return made.cls if made is not None else callee.cls
        cls = self.folder.objects.class_of(call.receiver, env)
        derives = cls is not None and callee.cls in self.folder.program.ancestry(cls)
        return cls if derives else callee.cls

    def _made(self, callee: Func, call: Invocation, env: Env) -> Instance | None:
        """How the object is made that a method is called on, where that is known."""
        if is_own(call.receiver):
            return env.made
        if call.receiver is None:
            return None
        made = self.folder.states.instance(call.receiver, env)
        return made or self.handed.instance(call.receiver, callee, env)


def _receiver(call: Invocation) -> Expr:
    """The object that a method is called on; in Python a path may begin with it."""
    return call.receiver if call.receiver is not None else Name(call.path.split(".")[0])


def _wanted(func: Func, at: int) -> str:
    """Whether a function wants a text or a number in the place of an argument, nothing for others.

    A `bool` can be made of either.
    """
    written = func.fact.params[at].type if at < len(func.fact.params) else ""
    return kind_of_type(written) if plain(written) != "bool" else ""


def _beside_joined(values: Sequence[tuple[Value, Env]]) -> Iterator[tuple[Value, Env]]:
    """Drop `x` beside `namespace + "/x"`: what a helper joins when it is relative it hands back when it is absolute."""
    joined_texts = {text for value, _ in values if (text := below_namespace(value)) is not None}
    return ((value, at) for value, at in values if value.text not in joined_texts or value.text.startswith("/"))
