"""Folding: the text an expression has, as far as the tree shows it.

Follows DESIGN §4: constants, concatenation, formats, members set in constructors, parameters with their
defaults, functions that return a value. Every result has a confidence; unknown parts stay as holes.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import Any

from ecm_parsers.source.expr import (
    Call,
    Constant,
    Expr,
    Items,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Template,
    Text,
)

from ecm_extract.infer.compute import NULL, UNKNOWN, shown
from ecm_extract.link.folding.behind_calls import BehindCalls
from ecm_extract.link.folding.class_names import ClassNames
from ecm_extract.link.folding.combining import combined
from ecm_extract.link.folding.comprehended import Comprehended
from ecm_extract.link.folding.data_classes import DataClasses
from ecm_extract.link.folding.enums import EnumFolder
from ecm_extract.link.folding.fold_calls import CallFolder
from ecm_extract.link.folding.fold_fields import FieldFolder
from ecm_extract.link.folding.fold_held import HeldFolder
from ecm_extract.link.folding.fold_lists import ListFolder
from ecm_extract.link.folding.fold_members import MemberFolder
from ecm_extract.link.folding.fold_names import NameFolder
from ecm_extract.link.folding.fold_operators import OperatorFolder
from ecm_extract.link.folding.fold_parameters import ParameterFolder
from ecm_extract.link.folding.fold_returns import ReturnFolder
from ecm_extract.link.folding.fold_streams import StreamFolder
from ecm_extract.link.folding.fold_tables import TableFolder
from ecm_extract.link.folding.fold_texts import TextFolder
from ecm_extract.link.folding.iterators import Iterators
from ecm_extract.link.folding.kept_objects import KeptObjects
from ecm_extract.link.folding.list_changes import ListChanges
from ecm_extract.link.folding.list_defaults import ListDefaults
from ecm_extract.link.folding.member_fields import MemberFields
from ecm_extract.link.folding.messages import MessageFolder
from ecm_extract.link.folding.module_objects import ModuleObjects
from ecm_extract.link.folding.optionals import OptionalFolder
from ecm_extract.link.folding.own_copies import OwnCopies
from ecm_extract.link.folding.perhaps import PerhapsFolder
from ecm_extract.link.folding.popped import Popped
from ecm_extract.link.folding.properties import PropertyFolder
from ecm_extract.link.folding.redefined import Redefined
from ecm_extract.link.folding.searches import SearchFolder
from ecm_extract.link.folding.spreading import Spreading
from ecm_extract.link.folding.steps import Steps, is_left_out
from ecm_extract.link.folding.structures import StructureFolder
from ecm_extract.link.folding.typed_numbers import TypedNumbers
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.asked import AskedParameters
from ecm_extract.link.running.begun_objects import BegunObjects
from ecm_extract.link.running.changed_meanwhile import ChangedMeanwhile
from ecm_extract.link.running.changed_outside import ChangedOutside
from ecm_extract.link.running.ending_objects import EndingObjects
from ecm_extract.link.running.env import MAX_DEPTH, Env
from ecm_extract.link.running.faults import Faults
from ecm_extract.link.running.first_methods import FirstMethods
from ecm_extract.link.running.flow import Flow
from ecm_extract.link.running.given_fields import GivenFields
from ecm_extract.link.running.kept_parts import KeptParts
from ecm_extract.link.running.kept_references import KeptReferences
from ecm_extract.link.running.lasting import LastingVariables
from ecm_extract.link.running.lasting_states import LastingStates
from ecm_extract.link.running.lent import Lent
from ecm_extract.link.running.method_effects import MethodEffects
from ecm_extract.link.running.object_fields import ObjectFields
from ecm_extract.link.running.object_makers import ObjectMakers
from ecm_extract.link.running.object_states import ObjectStates
from ecm_extract.link.running.objects import Objects
from ecm_extract.link.running.origins import Origins
from ecm_extract.link.running.outside_variables import OutsideVariables
from ecm_extract.link.running.parameter_reads import ParameterReads
from ecm_extract.link.running.part_objects import PartObjects
from ecm_extract.link.running.python_fields import PythonFields
from ecm_extract.link.running.replaced_calls import ReplacedCalls
from ecm_extract.link.running.runs_once import RunsOnce
from ecm_extract.link.running.scope import Scope
from ecm_extract.link.running.shifting import Shifting
from ecm_extract.link.running.surely_made import SurelyMade
from ecm_extract.link.running.unset_variables import UnsetVariables
from ecm_extract.link.running.untold import Untold
from ecm_extract.link.running.values import (
    TOO_DEEP,
    Value,
    constant,
    joined,
    literal,
    unknown,
)
from ecm_extract.tree import FileDiagnostic

MAX_NESTED = 60
"""Questions within questions."""
_Asked = tuple[Hashable, ...]
"""A name with what its value depends on, beside what its function is called with."""


def _no_prefix(_handle: Expr, _env: Env) -> None:
    """Before anybody knows what node handles put before names."""


class Folder:
    """Evaluates expressions of a program."""

    def __init__(self, program: Program, scope: Scope, reads: ParameterReads) -> None:
        self.program = program
        self.scope = scope
        self.objects = Objects(program, scope)
        self.reads = reads
        self.prefixes: Callable[[Expr, Env], Value | None] = _no_prefix
        self.names = NameFolder(self)
        self.members = MemberFolder(self)
        self.fields = FieldFolder(self)
        self.calls = CallFolder(self)
        self.parameters = ParameterFolder(self)
        self.origins = Origins(self)
        self.lists = ListFolder(self)
        self.comprehended = Comprehended(self)
        self.returns = ReturnFolder(self)
        self.texts = TextFolder(self)
        self.list_changes = ListChanges(self)
        self.structures = StructureFolder(self)
        self.kept = KeptObjects(self)
        self.own_copies = OwnCopies(self)
        self.tables = TableFolder(self)
        self.popped = Popped(self)
        self.spreading = Spreading(self)
        self.optionals = OptionalFolder(self)
        self.surely_made = SurelyMade(self)
        self.list_defaults = ListDefaults(self)
        self.searches = SearchFolder(self)
        self.operators = OperatorFolder(self)
        self.numbers = TypedNumbers(self)
        self.streams = StreamFolder(self)
        self.held = HeldFolder(self)
        self.messages = MessageFolder(self)
        self.cuts = self.cycles = 0
        self.faults = Faults()
        self.steps = Steps(sum(len(func.fact.body) for group in program.functions.values() for func in group))
        self._active: set[Hashable] = set()
        self._meanwhile: dict[Hashable, tuple[Value, ...]] = {}
        self._answers: dict[_Asked, tuple[Env, tuple[Value, ...]]] = {}
        self._begin_classes()
        self._begin_runs()

    def _begin_classes(self) -> None:
        """Make those who know what Python makes of classes, and what objects give when they are asked."""
        self.behind_calls = BehindCalls(self)
        self.member_fields = MemberFields(self)
        self.redefined = Redefined(self)
        self.replaced = ReplacedCalls(self)
        self.class_names = ClassNames(self)
        self.enums = EnumFolder(self)
        self.iterators = Iterators(self)
        self.properties = PropertyFolder(self)
        self.data_classes = DataClasses(self)
        self.module_objects = ModuleObjects(self)

    def _begin_runs(self) -> None:
        """Make those who know what runs of functions leave variables with."""
        self.perhaps = PerhapsFolder(self)
        self.nesting = self.scope.nesting
        self.flow = Flow(self)
        self.begun_objects = BegunObjects(self)
        self.asked = AskedParameters(self)
        self.unset = UnsetVariables(self)
        self.states = ObjectStates(self)
        self.parts = PartObjects(self)
        self.makers = ObjectMakers(self)
        self.changed_outside = ChangedOutside(self)
        self.changed_meanwhile = ChangedMeanwhile(self)
        self.given_fields = GivenFields(self)
        self.first_methods = FirstMethods(self)
        self.object_fields = ObjectFields(self)
        self.shifting = Shifting(self)
        self.runs_once = RunsOnce(self)
        self.outside = OutsideVariables(self)
        self.lasting = LastingVariables(self)
        self.lasting_states = LastingStates(self)
        self.lent = Lent(self)
        self.kept_references = KeptReferences(self)
        self.ending = EndingObjects(self)
        self.kept_parts = KeptParts(self)
        self.python_fields = PythonFields(self)
        self.methods = MethodEffects(self)
        self.untold = Untold(self)
        self.scope.ways = self.flow.ways

    def fold(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the possible values of an expression, at least one."""
        if not self.steps.depth:
            self._answers.clear()  # more may be known of parameters by now
        if expr is None or env.depth > MAX_DEPTH or not self.steps.take(env):
            self.cuts += 1
            return (TOO_DEEP if expr is not None and env.depth > MAX_DEPTH else unknown("value"),)
        with self.steps:
            values = self.numbers.held(self._by_kind(expr, env), expr, env)
        if any(map(is_left_out, values)):
            self.steps.leave_out(env)
        return values

    def _by_kind(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        match expr:
            case Name():
                return self.names.name(expr, env)
            case Member():
                return self.members.member(expr, env)
            case Call():
                return self.calls.call(expr, env)
            case Op():
                return self.operators.op(expr, env)
            case Template():
                return joined(self._in_text(part, env.before(env.at)) for part in expr.parts)
            case Text() | Number() | Constant():
                return (_stated(expr),)
            case Items(items=(only,)) if env.func.file.language == "cpp":  # `{"x"}` in the place of a text is that text
                return self.fold(only, env.before(env.at))
            case Opaque() if expr.text.isidentifier():
                return (unknown(expr.text),)
        return (unknown("value"),)

    def _in_text(self, part: Expr, env: Env) -> tuple[Value, ...]:
        return self.enums.text(part, env, formats=True) or self.shown(self.fold(part, env), env)

    @property
    def marks(self) -> tuple[int, int]:
        """What changes when a bound or a circle has a part in an answer, which is then not for everybody."""
        return self.cuts, self.cycles

    @property
    def is_asking(self) -> bool:
        """Whether a question is being answered."""
        return bool(self._active)

    def guarded(
        self, asked: Hashable, label: str, work: Callable[[], tuple[Value, ...]], circle: Value | None = None
    ) -> tuple[Value, ...]:
        """Break cycles such as `x = f(x)` in a loop or members that are set from each other.

        Args:
            asked: the question; who comes to it again while it is answered is told `circle`, or that it is unknown.
            label: what the value is called.
            work: gives the answer.
            circle: what a question is answered with that comes from itself.
        """
        if asked in self._active or len(self._active) > MAX_NESTED:
            self.cuts += 1
            self.cycles += 1
            return (circle or unknown(label) if asked in self._active else TOO_DEEP,)
        known = self._meanwhile.get(asked)
        if known is not None:
            self.cycles += 1  # whoever uses it has a part in the cycle
            return known
        cycles = self.cycles
        self._active.add(asked)
        try:
            values = work()
        finally:
            self._active.discard(asked)
        if not self._active:
            self._meanwhile.clear()
        elif cycles != self.cycles:
            self._meanwhile[asked] = values
        return values

    def once(self, label: str, env: Env, work: Callable[[], tuple[Value, ...]]) -> tuple[Value, ...]:
        """Answer a question that several branches ask once, as long as no cycle had a part in the answer."""
        key = (env.func, label, env.at, env.depth, env.this, env.made, env.state)
        known = self._answers.get(key)
        if known is not None and known[0].args is env.args:
            return known[1]
        cycles = self.cycles
        asked: tuple[Hashable, ...] = ("name", label, env.func, env.at, env.state)
        if asked in self._active:  # of a function that calls itself another parameter of that name
            asked = (*asked, *env.args.values())
        values = self.guarded(asked, label, work)
        if self.steps.depth and cycles == self.cycles:
            self._answers[key] = (env, values)
        return values

    def forget(self) -> None:
        """Drop remembered members, since more of the parameters is known now."""
        self.members.forget()
        self.names.variables.forget()
        self.reads.forget()
        self.flow.forget()
        self.asked.forget()
        self.states.forget()
        self.untold.forget()

    def left_out(self) -> tuple[FileDiagnostic, ...]:
        """Return what is to be told of values that were not computed, and of functions not run to the end."""
        return (*self.steps.left_out(), *self.faults.told())

    def combined(
        self, options: Sequence[tuple[Value, ...]], work: Callable[[list[Any]], Any], label: str
    ) -> tuple[Value, ...]:
        """Compute with each combination of known values; what is not known or not computed stays a pattern."""
        return combined(options, work, label)

    def shown(self, values: tuple[Value, ...], env: Env) -> tuple[Value, ...]:
        """Return values as texts: numbers and truth values as the language writes them."""
        python = env.func.file.language == "python"
        return tuple([_shown(value, python) for value in values])


def _stated(expr: Text | Number | Constant) -> Value:
    if isinstance(expr, Text):
        return literal(expr.value)
    known = {"true": True, "false": False}
    return constant(expr.value if isinstance(expr, Number) else known.get(expr.name, NULL))


def _shown(value: Value, python: bool) -> Value:
    if value.data is None:
        return value
    text = shown(value.data, python)
    return unknown("value") if text is UNKNOWN else value._replace(parts=(text,), data=None)
