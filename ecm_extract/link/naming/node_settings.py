"""What a node is given beside its name: arguments of a command line, which may rename it, and values of parameters.

Sources: rclcpp/node_options.hpp, rclpy/node.py; design.ros2.org, "ROS Command Line Arguments" and "Static Remapping".
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name
from ecm_parsers.source.python_literal import NULL

from ecm_extract.infer.held import Held
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.walk import children
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.values import Value, unknown

_ARGUMENTS: Final = frozenset({"arguments", "cli_args"})
_APPEND: Final = "append_parameter_override"
_SETTING: Final = _ARGUMENTS | {"parameter_overrides", _APPEND}
_CLASS: Final = "NodeOptions"
_FILES: Final = "--params-file"
_OF_PARAMETERS: Final = frozenset({"-p", "--param"})
_RULE: Final = ":="
_PROGRAM: Final = "main"


@dataclass(slots=True)
class Settings:
    """What decides in the place of the source of a node.

    Attributes:
        name, space: what it is called, and its namespace; None for what its source says.
        rules: other names for those of endpoints; None for one that nobody knows.
        parameters: the values that stand for declared defaults; None for one that nobody knows.
        files: whether any other parameter may be given something.
    """

    name: Value | None = None
    space: Value | None = None
    rules: dict[str, Value | None] = field(default_factory=dict)
    parameters: dict[str, Bound | None] = field(default_factory=dict)
    files: bool = False

    def __bool__(self) -> bool:
        """Whether it decides anything."""
        return bool(self.name or self.space or self.rules or self.parameters or self.files)

    def open(self) -> None:
        """Note that anything may be given."""
        self.name, self.space, self.files = unknown("name"), unknown("namespace"), True

    def rename(self, rule: Value, sure: bool) -> None:
        """Note a rule of renaming: `__node:=other`, `demo:__ns:=/below`."""
        known = str(rule.parts[0]).partition(_RULE) if rule.parts else ("", "", "")
        target = Value((known[2], *rule.parts[1:]), rule.confidence)
        what = known[0].rpartition(":")[2]
        if what in {"__node", "__name"}:
            self.name = target if sure else unknown("name")
        elif what == "__ns":
            self.space = target if sure else unknown("namespace")
        else:
            self.rules[what] = target if sure else None

    def of_parameter(self, name: str, default: Bound | None) -> Bound | None:
        """Return what a parameter begins with that is declared with a default."""
        return self.parameters.get(name, None if self.files else default)


class _Told(NamedTuple):
    """One setting, where it is evaluated, and whether it is surely made."""

    name: str
    args: Sequence[Expr]
    env: Env
    sure: bool


class NodeSettings:
    """Reads the options of nodes."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, args: Sequence[Expr], keywords: Iterable[tuple[str, Expr]], env: Env) -> Settings:
        """Return what a node is given behind its name: options in C++, keywords in Python."""
        told = [each for arg in args for each in self._told(arg, env)]
        told += [_Told(name, (value,), env, True) for name, value in keywords if name in _SETTING]
        return self._read(told)

    def _told(self, expr: Expr, env: Env, sure: bool = True) -> Iterator[_Told]:
        if env.depth > MAX_DEPTH:
            return
        if isinstance(expr, Call) and isinstance(expr.callee, Member):
            yield from self._told(expr.callee.base, env, sure)
            yield from self._set_by(expr, env, sure)
        elif isinstance(expr, Call) and isinstance(expr.callee, Name) and last_name(expr.callee.id) == _CLASS:
            for copied in expr.args:
                yield from self._told(copied, env, sure)
        elif isinstance(expr, Name | Member):
            found = self.folder.origins.held(expr, env.deeper(env.depth + 1))
            for held in found:
                yield from self._of_held(held, env, sure and len(found) == 1)

    def _set_by(self, call: Call, env: Env, sure: bool) -> Iterator[_Told]:
        name = call.callee.name if isinstance(call.callee, Member) else ""
        if name in _SETTING and call.args:
            yield _Told(name, call.args, env, sure)

    def _of_held(self, held: Held, env: Env, sure: bool, after: Set[Held] = frozenset()) -> Iterator[_Told]:
        if held in after:
            return  # what a round of a loop leaves is among what the next one begins with
        place = (held.env or env).deeper(env.depth + 1)
        if held.how == "value" and held.expr is not None:
            yield from self._told(held.expr, place, sure)
            return
        before = self.folder.flow.decisions.ways(held.before)
        for each in before:
            yield from self._of_held(each, place, sure and len(before) == 1, after | {held})
        if held.how == "changed" and isinstance(held.expr, Call):
            yield from self._set_by(held.expr, place, sure)
        elif held.how == "lost" and held.expr is not None and _SETTING & set(_members(held.expr)):
            yield _Told("arguments", (held.expr,), place, False)

    # --- what settings say -----------------------------------------------------------------------------------

    def _read(self, told: Iterable[_Told]) -> Settings:
        found = Settings()
        for each in told:
            if each.name == _APPEND:
                self._add(found, Items(tuple(each.args)), each)
                continue
            items = self.folder.lists.items(each.args[0], each.env)
            if items is None:
                self._unlisted(found, each)
            elif each.name in _ARGUMENTS:
                self._line(found, items, each)
            else:
                for item in items:
                    self._add(found, item.expr, each._replace(env=item.env))
        return found

    def _unlisted(self, found: Settings, told: _Told) -> None:
        """What nobody knows the elements of may give anything, but for the command line of the program."""
        if self._is_command_line(told.args[0], told.env) or _is_left_out(told.args[0], told.env):
            return
        if told.name in _ARGUMENTS:
            found.open()
        else:
            found.files = True

    def _add(self, found: Settings, entry: Expr, told: _Told) -> None:
        """A parameter with its value: `{"rate", 5.0}`, `Parameter("rate", 5.0)`, `Parameter("rate", value=5.0)`."""
        parts = entry.items if isinstance(entry, Items) else entry.args if isinstance(entry, Call) else ()
        given = dict(entry.keywords) if isinstance(entry, Call) else {}
        name, value = given.get("name", *parts[:1]) if parts or given else None, given.get("value", *parts[-1:])
        names = self.folder.fold(name, told.env) if name is not None else ()
        if len(names) != 1 or names[0].confidence == "pattern":
            found.files = True
            return
        known = told.sure and value is not None and value is not name
        found.parameters[names[0].text] = Bound(value, told.env) if known and value is not None else None

    def _line(self, found: Settings, items: Sequence[Bound], told: _Told) -> None:
        """Arguments as on a command line."""
        texts = [values[0] if len(values) == 1 else unknown("argument") for values in self._folded(items, told.env)]
        for before, each in pairwise([Value(("",)), *texts]):
            is_rule = bool(each.parts) and isinstance(each.parts[0], str) and _RULE in each.parts[0]
            if each.text == _FILES:
                found.files = True
            elif before.text in _OF_PARAMETERS and is_rule:
                found.parameters[each.text.partition(_RULE)[0].rpartition(":")[2]] = None
            elif is_rule:
                found.rename(each, told.sure)
            elif each.confidence == "pattern" and before.text != _FILES:
                found.open()

    def _folded(self, items: Iterable[Bound], env: Env) -> Iterator[tuple[Value, ...]]:
        return (self.folder.lists.fold(item, env) for item in items)

    def _is_command_line(self, expr: Expr, env: Env) -> bool:
        """Whether something is made of what the program itself was started with, which every node hears of."""
        if env.depth > MAX_DEPTH:
            return False
        if isinstance(expr, Constant):
            return True
        if isinstance(expr, Member) and (expr.base, expr.name) == (Name("sys"), "argv"):
            return True
        if isinstance(expr, Name):
            given = any(each.name == expr.id for each in env.func.fact.params)
            if given and env.func.fact.name == _PROGRAM:
                return True
            held = self.folder.origins.held(expr, env.deeper(env.depth + 1))
            known = [(each.expr, (each.env or env).deeper(env.depth + 1)) for each in held if each.expr is not None]
            return any(self._is_command_line(each, place) for each, place in known if each != expr)
        return any(self._is_command_line(part, env) for part in children(expr) if not isinstance(part, Constant))


def _members(expr: Expr) -> Iterator[str]:
    if isinstance(expr, Member):
        yield expr.name
    for part in children(expr):
        yield from _members(part)


def _is_left_out(given: Expr, env: Env) -> bool:
    """Tell whether something is what only a maker gives that wants it: `def __init__(self, overrides=None)`."""
    return isinstance(given, Name) and (given.id, NULL) in env.func.defaults


def agreed(found: Sequence[Settings]) -> Settings:
    """Return the rules and parameters of a node that is made in several ways: known where all of them agree."""
    whole = Settings(files=any(each.files for each in found))
    for rule in {rule for each in found for rule in each.rules}:
        targets = {each.rules.get(rule) for each in found}
        whole.rules[rule] = targets.pop() if len(targets) == 1 else None
    for name in {name for each in found for name in each.parameters}:
        values = [each.parameters.get(name) for each in found]
        same = all(value is not None and values[0] is not None and value.expr == values[0].expr for value in values)
        whole.parameters[name] = values[0] if same else None
    return whole
