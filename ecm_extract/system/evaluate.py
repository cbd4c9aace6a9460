"""Launch files evaluated over a tree: which nodes they start, with which names, remaps and parameters.

Sources: roslaunch `xmlloader` and `loader` (ROS 1); `launch` and `launch_ros` actions (ROS 2). In ROS 2 an included
file shares the arguments of the file that includes it, in ROS 1 it sees only what it is given.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ecm_parsers.launch.model import (
    Action,
    Argument,
    Group,
    Include,
    LaunchFile,
    Node,
    ParameterFile,
    ParameterValue,
    PushNamespace,
    Remap,
    SetConfiguration,
    Unread,
)
from ecm_parsers.result import Parsed

from ecm_extract.read.cuts import located
from ecm_extract.system.budget import FILE_STEPS, Budget, BudgetError
from ecm_extract.system.files import Files
from ecm_extract.system.instances import InstanceMaker
from ecm_extract.system.launch_files import read_launch
from ecm_extract.system.launch_sources import LaunchSources
from ecm_extract.system.model import Given, LaunchArgument, Launched, Place, Remapping, Text, join
from ecm_extract.system.scope import Scope
from ecm_extract.system.settings import Settings
from ecm_extract.system.substitute import Substituter, bare, hole
from ecm_extract.tree import FileDiagnostic, Tree

MAX_DEPTH = 25
MAX_SAME_FILE = 3
MAX_CANDIDATES = 8


def launched(tree: Tree, files: Files, paths: Sequence[str], given: Given) -> Launched:
    """Return what launch files start together.

    Args:
        tree: gets the diagnostics.
        files: of the tree.
        paths: of the launch files, in the order in which they are started.
        given: arguments, which override the defaults of the files, and environment.
    """
    evaluator = Evaluator(tree, files)
    for path in paths:
        scope = Scope(
            arguments={name: Text(value) for name, value in given.arguments.items()},
            environment={name: Text(value) for name, value in given.environment.items()},
        )
        evaluator.started(path, scope)
    return evaluator.result


class Evaluator:
    """Walks launch files in the order of their actions."""

    def __init__(self, tree: Tree, files: Files) -> None:
        self.tree = tree
        self.files = files
        self.result = Launched()
        self.budget = Budget()
        self._markup: dict[str, Parsed[LaunchFile | None]] = {}
        self._handlers: dict[type[Action], Callable[[_File, Action, Scope], None]] = {
            Argument: self._argument,
            SetConfiguration: self._configuration,
            PushNamespace: self._push,
            Remap: self._remap,
            ParameterValue: self._parameters,
            ParameterFile: self._parameters,
            Node: self._node,
            Include: self._include,
            Group: self._group,
            Unread: self._unread_action,
        }

    def started(self, path: str, scope: Scope) -> None:
        """Evaluate a launch file that is started by itself; what is left out for its size is told."""
        try:
            self.file(path, scope, ())
        except BudgetError as error:
            message = f"The launch takes {error}; what {path} starts from here on is left out. Launch its parts alone."
            self._incomplete("launch-too-large", self.budget.place, message)
        for place in self.budget.cut:
            message = "A text of this action is longer than is read and stays unknown. Shorten it."
            self._incomplete("launch-text-cut", place, message)
        self.budget.cut.clear()

    def _incomplete(self, code: str, place: Place, message: str) -> None:
        self.result.is_complete = False
        self.tree.report(FileDiagnostic("error", code, place.path, place.line, message))

    def file(self, path: str, scope: Scope, stack: tuple[str, ...]) -> None:
        """Evaluate one file in a scope.

        Raises:
            BudgetError: the launch takes too much in all.
        """
        place = self.budget.place if stack else Place(path, 0)
        if self._is_endless(path, stack, place):
            return
        self.budget.place = place
        self.budget.spend(FILE_STEPS)
        parsed = self._parsed(path, scope)
        if parsed is None:
            return
        for entry in parsed.diagnostics:
            self.tree.report(located(path, entry))
            self.result.is_complete &= entry.severity != "error"
        if parsed.facts is not None:
            self.result.files.append(path)
            self._run(_File(path, parsed.facts, (*stack, path)), parsed.facts.actions, scope)

    def _is_endless(self, path: str, stack: tuple[str, ...], place: Place) -> bool:
        """Tell whether a file is included inside itself once too often, or too deep."""
        cyclic = stack.count(path) >= MAX_SAME_FILE
        if cyclic:
            self.report(place.path, place.line, "launch-cycle", f"{path} includes itself without end. Break the cycle.")
        elif len(stack) >= MAX_DEPTH:
            message = f"{path} is included below {MAX_DEPTH} other files; what it starts is left out. Flatten them."
            self._incomplete("launch-too-deep", place, message)
        return cyclic or len(stack) >= MAX_DEPTH

    def _parsed(self, path: str, scope: Scope) -> Parsed[LaunchFile | None] | None:
        """A file of markup is the same wherever it is included, one in Python may look at its arguments."""
        if path in self._markup:
            return self._markup[path]
        data = self.files.read(path)
        if data is None:
            self._incomplete("launch-unread", Place(path, 0), "The launch file cannot be read. Fetch or restore it.")
            return None
        sources = LaunchSources(self.files, path, scope, self.budget)
        parsed = read_launch(path, data, self.files.ros_of(path), sources)
        if not path.endswith(".py"):
            self._markup[path] = parsed
        return parsed

    def _run(self, file: _File, actions: Sequence[Action], scope: Scope) -> None:
        for action in actions:
            self.budget.place = Place(file.path, action.line)
            self.budget.spend(1)
            holds = self._substituter(file, scope).truth(action.condition)
            if holds is False:
                continue
            taken = scope if holds else scope.under(self._condition_text(file, action, scope))
            self._handlers[type(action)](file, action, taken)
            if not holds:
                _keep_declared(scope, taken)

    def _condition_text(self, file: _File, action: Action, scope: Scope) -> str:
        return bare(self._substituter(file, scope).text(action.condition).text)

    # --- actions that change the scope -------------------------------------------------------------------------

    def _argument(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, Argument)
        substituter = self._substituter(file, scope)
        if action.value is not None:
            scope.arguments[action.name] = substituter.text(action.value)
        elif action.name not in scope.arguments:
            default = action.default
            scope.arguments[action.name] = hole(action.name) if default is None else substituter.text(default)
        if len(file.stack) == 1:
            value = scope.arguments[action.name]
            known = value.text if value.known else None
            place = Place(file.path, action.line)
            made = LaunchArgument(action.name, known, action.description, action.choices, place)
            self.result.arguments.append(made)

    def _configuration(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, SetConfiguration)
        if action.environment and file.facts.ros == 1:
            return  # roslaunch sets it for nodes alone: `$(env x)` is what the shell has
        substituter = self._substituter(file, scope)
        target = scope.environment if action.environment else scope.arguments
        target[substituter.text(action.name).text] = substituter.text(action.value)

    def _push(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, PushNamespace)
        scope.namespace = join(scope.namespace, self._substituter(file, scope).text(action.namespace).text)

    def _remap(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, Remap)
        substituter = self._substituter(file, scope)
        source, target = substituter.text(action.source).text, substituter.text(action.target).text
        scope.remaps.append(Remapping(source, target, Place(file.path, action.line)))

    def _parameters(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, ParameterValue | ParameterFile)
        if file.facts.ros == 2:
            scope.parameters.append(action)
            return
        settings = Settings(self.tree, self.files, file.path, self._substituter(file, scope))
        if isinstance(action, ParameterValue) and settings.is_private(action):
            scope.private += settings.ros1(action, "/")
        else:
            self.result.globals += settings.ros1(action, scope.namespace)

    # --- actions that start something --------------------------------------------------------------------------

    def _node(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, Node)
        self.budget.spend(len(scope.remaps))
        substituter = self._substituter(file, scope)
        settings = Settings(self.tree, self.files, file.path, substituter)
        for instance in InstanceMaker(file.path, file.facts.ros, substituter, settings).make(action, scope):
            self.budget.node()
            self.result.instances.append(instance)

    def _group(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, Group)
        taken = scope.later() if action.later else scope.inner() if action.scoped else scope
        self._run(file, action.actions, taken)

    def _include(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, Include)
        substituter = self._substituter(file, scope)
        path = substituter.text(action.path)
        found = self.files.find(path.text) if path.known else None
        if found is None:
            self._open_include(file, action, scope, path)
            return
        self._included(file, action, scope, found)

    def _included(self, file: _File, action: Include, scope: Scope, found: str) -> None:
        substituter = self._substituter(file, scope)
        given = _given(action, substituter)
        inner = scope
        if file.facts.ros == 1:
            inner = scope.inner()
            inner.arguments = {**(scope.arguments if action.pass_all else {}), **given}
        else:
            scope.arguments.update(given)
        if action.namespace:
            inner.namespace = join(scope.namespace, substituter.text(action.namespace).text)
        self.file(found, inner, file.stack)

    def _open_include(self, file: _File, action: Include, scope: Scope, path: Text) -> None:
        """A file that only the launch knows: every file of the tree that it can be is taken, under that condition."""
        found = [] if path.known else self.files.candidates(path.text)
        if not 0 < len(found) <= MAX_CANDIDATES:
            self._unread(file, action, path)
            return
        for candidate in found:
            self._included(file, action, scope.under(f"{path.text.removeprefix('tree:')} is {candidate}"), candidate)

    def _unread(self, file: _File, action: Include, path: Text) -> None:
        self.result.is_closed = False
        shown = path.text.removeprefix("tree:")
        if path.known and self.files.is_beside(file.path, path.text):
            message = f"Included file `{shown}` is looked for in the folder that the launch is started from."
            self.report(file.path, action.line, "launch-include-relative", message, shown)
            return
        if path.known and not path.emptied and not self.files.is_elsewhere(path.text):
            message = f"Included file `{shown}` is not in the tree. Correct the path or add the file."
            self.report(file.path, action.line, "launch-include-missing", message, shown)
            return
        message = f"Included file `{shown}` is outside the tree or known at launch only; what it starts is left out."
        self.tree.report(FileDiagnostic("info", "launch-include-outside", file.path, action.line, message))

    def _unread_action(self, file: _File, action: Action, scope: Scope) -> None:
        assert isinstance(action, Unread)
        self.result.is_closed = False
        message = f"`{action.text}` cannot be read without running it; what it starts is left out."
        self.tree.report(FileDiagnostic("info", "launch-action-unread", file.path, action.line, message))

    def _substituter(self, file: _File, scope: Scope) -> Substituter:
        """Return what evaluates templates of a file in a scope."""
        return Substituter(self.files, file.path, scope, self.budget)

    def report(self, path: str, line: int, code: str, message: str, about: str = "") -> None:
        """Add a warning to the tree's diagnostics; `about` is the file that it is about."""
        self.tree.report(FileDiagnostic("warning", code, path, line, message, about=about))


class _File:
    """A launch file that is being evaluated, and those that include it."""

    def __init__(self, path: str, facts: LaunchFile, stack: tuple[str, ...]) -> None:
        self.path = path
        self.facts = facts
        self.stack = stack


def _given(action: Include, substituter: Substituter) -> dict[str, Text]:
    """Return the arguments that a file is given; one with a condition that is not decided is not known."""
    found: dict[str, Text] = {}
    conditions = action.argument_conditions or (None,) * len(action.arguments)
    for (name, value), condition in zip(action.arguments, conditions, strict=True):
        holds = substituter.truth(condition)
        if holds is not False:
            found[name] = substituter.text(value) if holds else hole(name)
    return found


def _keep_declared(scope: Scope, taken: Scope) -> None:
    """Arguments that were set under an unknown condition are known to exist, not what they are."""
    for name, value in taken.arguments.items():
        if name not in scope.arguments:
            scope.arguments[name] = value
        elif scope.arguments[name] != value:
            scope.arguments[name] = hole(f"{scope.arguments[name].text} or {value.text}")
