"""Substitutions of launch files evaluated: text where all is known, `{name}` where only the launch knows.

Sources: wiki.ros.org/roslaunch/XML "substitution args"; `launch.substitutions`, `launch_ros.substitutions`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.expression import ExpressionError, evaluate
from ecm_parsers.template import Substitution, Template

from ecm_extract.system.budget import Budget
from ecm_extract.system.eval_functions import EvalNames, launch_functions
from ecm_extract.system.files import Files
from ecm_extract.system.model import Text
from ecm_extract.system.scope import Scope

MAX_DEPTH = 40
MAX_TEXT = 100_000
MAX_SHOWN = 60
_TRUE = frozenset({"true", "1", "on", "yes"})
_FALSE = frozenset({"false", "0", "", "off", "no"})

_REPLACED = re.compile(r"^tree:\S*/(?=tree:)")
"""What a join drops before a path that is absolute itself."""


class Substituter:
    """Evaluates the templates of one launch file.

    Attributes:
        files: of the tree. path: of the launch file. scope: with the arguments and the environment.
        budget: that all launch files share.
    """

    def __init__(self, files: Files, path: str, scope: Scope, budget: Budget) -> None:
        self.files = files
        self.path = path
        self.arguments = scope.arguments
        self.environment = scope.environment
        self.budget = budget

    def text(self, template: Template | None, depth: int = 0) -> Text:
        """Return the text of a template; one that grows too long is not known.

        Raises:
            BudgetError: the launch files take too much in all.
        """
        self.budget.spend(len(template or ()))
        parts = [self._part(part, depth) for part in template or ()]
        length = sum(len(part.text) for part in parts)
        self.budget.spend(0, length)
        if length > MAX_TEXT:
            return self._cut()
        joined = _REPLACED.sub("", "".join(part.text for part in parts))
        emptied = any(
            part.emptied or not (part.text or isinstance(source, str))
            for part, source in zip(parts, template or (), strict=True)
        )
        return Text(joined, all(part.known for part in parts), emptied)

    def truth(self, template: Template | None) -> bool | None:
        """Return whether a condition holds, None when only the launch knows."""
        if template is None:
            return True
        return truth_of(self.text(template))

    def _part(self, part: str | Substitution, depth: int) -> Text:
        if isinstance(part, str):
            return Text(part)
        if part.kind == "too_large":
            return self._cut()
        kind = _KINDS.get(part.kind)
        if kind is None or depth > MAX_DEPTH:
            return hole(self._shown(part))
        return kind(self, part, depth + 1)

    def _cut(self) -> Text:
        self.budget.cut_here()
        return hole("more text than is read")

    def _shown(self, part: Substitution) -> str:
        words = [entry if isinstance(entry, str) else entry.kind for arg in part.args for entry in arg]
        return " ".join(words)[:MAX_SHOWN] or part.kind

    def _args(self, part: Substitution, depth: int) -> list[Text]:
        return [self.text(arg, depth) for arg in part.args]

    def _argument(self, part: Substitution, depth: int) -> Text:
        name = self.text(part.args[0], depth).text if part.args else ""
        if name in self.arguments:
            return self.arguments[name]
        return self.text(part.args[1], depth) if len(part.args) > 1 else hole(name)

    def _variable(self, part: Substitution, depth: int) -> Text:
        name = self.text(part.args[0], depth).text if part.args else ""
        if name in self.environment:
            return self.environment[name]
        return self.text(part.args[1], depth) if len(part.args) > 1 else hole(f"env {name}")

    def _find(self, part: Substitution, depth: int) -> Text:
        package = self.text(part.args[0], depth) if part.args else hole("package")
        share = self.files.share(package.text)
        return hole(f"find {package.text}") if share is None else Text(share)

    def _folder(self, part: Substitution, depth: int) -> Text:
        return Text(self.files.folder(self.path))

    def _anonymous(self, part: Substitution, depth: int) -> Text:
        name = self._args(part, depth)
        return Text(f"{name[0].text if name else ''}_{{anon}}", known=False)

    def _unknown_command(self, part: Substitution, depth: int) -> Text:
        words = " ".join(entry.text for entry in self._args(part, depth))
        return Text(f"{{command {words}}}", known=False)

    def _file(self, part: Substitution, depth: int) -> Text:
        """What a file holds is named by its path, which is what readers of descriptions look for."""
        path = self._args(part, depth)
        return path[0] if path else hole("file")

    def _content(self, part: Substitution, depth: int) -> Text:
        """What a file holds is not read here; the path tells which one."""
        path = self._file(part, depth)
        return hole(f"content of {path.text}")

    def _expression(self, part: Substitution, depth: int) -> Text:
        text = self.text(part.args[0] if part.args else (), depth)
        if not text.known:
            return Text(f"{{{text.text.strip()}}}", known=False)
        names = EvalNames(self.arguments, typed)
        try:
            return Text(plain_text(evaluate(text.text.strip(), names, functions=launch_functions(self, typed))))
        except ExpressionError:
            return hole(text.text.strip())

    def _not(self, part: Substitution, depth: int) -> Text:
        given = self._args(part, depth)[0] if part.args else hole("value")
        value = truth_of(given)
        return hole(f"not ({bare(given.text)})") if value is None else Text(str(not value).lower())

    def _and(self, part: Substitution, depth: int) -> Text:
        return _all(self._args(part, depth), part.kind, stop=False)

    def _or(self, part: Substitution, depth: int) -> Text:
        return _all(self._args(part, depth), part.kind, stop=True)

    def _equals(self, part: Substitution, depth: int) -> Text:
        first, second = (self._args(part, depth) + [hole("value")] * 2)[:2]
        if first.known and second.known:
            return Text(str(_same(first.text, second.text)).lower())
        return hole(f"{first.text} == {second.text}")

    def _in(self, part: Substitution, depth: int) -> Text:
        item, items = (self._args(part, depth) + [hole("value")] * 2)[:2]
        return (
            Text(str(item.text in items.text).lower())
            if item.known and items.known
            else hole(f"{item.text} in {items.text}")
        )

    def _lower(self, part: Substitution, depth: int) -> Text:
        text = self._args(part, depth)[0]
        return Text(text.text.lower(), text.known) if text.known else text

    def _if(self, part: Substitution, depth: int) -> Text:
        condition, first, second = (self._args(part, depth) + [Text("")] * 3)[:3]
        value = truth_of(condition)
        if value is None:
            return first if first == second else Text(f"{{{first.text} or {second.text}}}", known=False)
        return first if value else second

    def _has_parameters(self, part: Substitution, depth: int) -> Text:
        path, node = (self._args(part, depth) + [hole("value")] * 2)[:2]
        found = self.files.find(path.text)
        data = self.files.read(found) if found is not None else None
        if data is None:
            return hole(f"parameters of {node.text}")
        return Text(str(any(line.split(b":")[0].strip() == node.text.encode() for line in data.splitlines())).lower())


def hole(label: str) -> Text:
    """A part that only the launch knows; braces inside it would end it too early."""
    return Text("{" + label.replace("{", "").replace("}", "").strip() + "}", known=False)


def bare(text: str) -> str:
    """Return what stands in the braces around a text, the text itself where none enclose it as a whole."""
    inner = text.strip()
    while inner.startswith("{") and inner.endswith("}") and _is_balanced(inner[1:-1]):
        inner = inner[1:-1].strip()
    return inner


def _is_balanced(text: str) -> bool:
    """Tell whether braces are balanced."""
    depth = 0
    for char in text:
        depth += (char == "{") - (char == "}")
        if depth < 0:
            return False
    return depth == 0


def truth_of(text: Text) -> bool | None:
    """Return what a text means as a condition, None when it is no truth value."""
    if not text.known:
        return None
    bare = text.text.strip().lower()
    return True if bare in _TRUE else False if bare in _FALSE else None


def typed(text: str) -> Any:
    """Return the value that a text has as YAML would read a scalar: truth value, number or text."""
    bare = text.strip()
    if bare.lower() in {"true", "false"}:
        return bare.lower() == "true"
    for kind in (int, float):
        try:
            return kind(bare)
        except ValueError:
            continue
    return text


def plain_text(value: Any) -> str:
    """Return a value as launch writes it."""
    return str(value)


def _same(first: str, second: str) -> bool:
    return first == second or (first.lower() in _TRUE | _FALSE and first.lower() == second.lower())


def _all(given: list[Text], word: str, *, stop: bool) -> Text:
    """Join conditions by `and` or `or`: one that equals `stop` decides, unknown ones leave it open."""
    values = [truth_of(text) for text in given]
    if stop in values:
        return Text(str(stop).lower())
    unknown = [bare(text.text) for text, value in zip(given, values, strict=True) if value is None]
    return hole(f" {word} ".join(unknown)) if unknown else Text(str(not stop).lower())


_KINDS: Mapping[str, Callable[[Substituter, Substitution, int], Text]] = MappingProxyType(
    {
        "arg": Substituter._argument,
        "env": Substituter._variable,
        "find": Substituter._find,
        "find_prefix": Substituter._find,
        "dirname": Substituter._folder,
        "anon": Substituter._anonymous,
        "command": Substituter._unknown_command,
        "file": Substituter._file,
        "yaml": Substituter._file,
        "content": Substituter._content,
        "eval": Substituter._expression,
        "not": Substituter._not,
        "and": Substituter._and,
        "or": Substituter._or,
        "equals": Substituter._equals,
        "in": Substituter._in,
        "lower": Substituter._lower,
        "if": Substituter._if,
        "has_parameters": Substituter._has_parameters,
    }
)
