"""Parameters that a launch file sets: values, files, and values that replace those of a file.

Sources: wiki.ros.org/roslaunch/XML/rosparam; `launch_ros.parameter_descriptions`; `nav2_common.launch.RewrittenYaml`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fnmatch import fnmatchcase
from typing import Any

from ecm_parsers.launch.model import Data, ParameterFile, ParameterSource, ParameterValue, Typing
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.parameter_yaml import ParameterFile as Sets
from ecm_parsers.parameter_yaml import ParameterSet, parse_parameter_yaml, parse_rosparam_yaml
from ecm_parsers.result import Parsed
from ecm_parsers.template import Substitution, Template
from ecm_parsers.yaml_tree import parse_yaml, plain

from ecm_extract.read.cuts import located
from ecm_extract.system.files import Files
from ecm_extract.system.model import Place, Setting, Text, join
from ecm_extract.system.parameter_types import rewritten, value_of
from ecm_extract.system.substitute import Substituter
from ecm_extract.system.yaml_holes import filled, marked
from ecm_extract.tree import FileDiagnostic, Tree

MAX_DEPTH = 20
EVERY_NODE = "/**"


class Settings:
    """Reads parameter sources of one launch file."""

    def __init__(self, tree: Tree, files: Files, path: str, substituter: Substituter) -> None:
        self.tree = tree
        self.files = files
        self.path = path
        self.substituter = substituter
        self.missing: list[str] = []

    def ros2(self, sources: Sequence[ParameterSource], namespace: str) -> Iterator[Setting]:
        """Yield what sources give a node, in the order in which they apply.

        Args:
            sources: of the scope and of the node.
            namespace: of the node, below which relative sections of parameter files stand.
        """
        for source in sources:
            if self.substituter.truth(source.condition) is False:
                continue
            if isinstance(source, ParameterValue):
                name = self.substituter.text(source.name).text
                yield Setting(name, self.value(source.value, source.typing), Place(self.path, source.line))
            else:
                yield from self._file(source, namespace)

    def _file(self, source: ParameterFile, namespace: str) -> Iterator[Setting]:
        path = self._found(source)
        if path is None:
            return
        root = self.substituter.text(source.namespace).text
        rewrites = [(self.substituter.text(key).text, self.substituter.text(value)) for key, value in source.rewrites]
        prefix = self.substituter.text(source.prefix).text
        for entry in self._sets(path, parse_parameter_yaml):
            if source.plain:
                yield Setting(_dotted(prefix, entry), entry.value, Place(path, entry.line))
                continue
            value = self._substituted(entry.value) if source.substitutes else entry.value
            name = (
                entry.name if entry.node is not None else _dotted("", entry)
            )  # without a node it is read as ROS 1 does
            value = _rewritten(Setting(name, value, Place(path, entry.line)), rewrites, source.converts)
            node = entry.node if entry.node is None or not root else _below(root, entry.node)
            yield Setting(name, value, Place(path, entry.line), node or EVERY_NODE)

    def is_private(self, source: ParameterValue) -> bool:
        """Tell whether a value of ROS 1 is one of each node that starts after it: `~name` outside of a node."""
        return self.substituter.text(source.name).text.startswith("~")

    def ros1(self, source: ParameterSource, namespace: str, in_node: bool = False) -> Iterator[Setting]:
        """Yield what a source puts on the parameter server, with absolute names below a namespace.

        Args:
            source: of the parameters.
            namespace: of the scope, or the name of the node.
            in_node: whether it stands in a node, where roslaunch takes `<param name="/x">` for one of the node.
        """
        if self.substituter.truth(source.condition) is False:
            return
        if isinstance(source, ParameterFile):
            yield from self._loaded(source, join(namespace, self.substituter.text(source.namespace).text))
            return
        name = self.substituter.text(source.name).text.removeprefix("~")
        if source.typing != "yaml":
            value = self.value(source.value, source.typing)
            name = name.lstrip("/") if in_node else name
            yield Setting(join(namespace, name), value, Place(self.path, source.line))
            return
        template = source.value if isinstance(source.value, tuple) else ()
        yield from self._written(template, join(namespace, name), Place(self.path, source.line))

    def _loaded(self, source: ParameterFile, base: str) -> Iterator[Setting]:
        """A file as rosparam loads it; where it substitutes, that is before it is YAML."""
        path = self._found(source)
        if path is None:
            return
        if source.substitutes:
            text = (self.files.read(path) or b"").decode("utf-8", "replace")
            yield from self._written(parse_template(text), base, Place(path, 1))
            return
        sets = self._sets(path, parse_rosparam_yaml)
        yield from (Setting(join(base, entry.name), entry.value, Place(path, entry.line)) for entry in _given(sets))
        yield from self._whole(path, base) if not sets else ()

    def _written(self, template: Template, base: str, begin: Place) -> Iterator[Setting]:
        """YAML whose text is evaluated first."""
        text, holes = marked(template, self.substituter)
        found = parse_rosparam_yaml(text.encode()).facts.sets
        for entry in _given(found):
            place = Place(begin.path, begin.line + max(entry.line - 1, 0))
            yield Setting(join(base, filled(entry.name, holes)), filled(entry.value, holes), place)
        if not found and text.strip():
            yield Setting(base, filled(value_of(text, "yaml"), holes), begin)

    def _whole(self, path: str, base: str) -> Iterator[Setting]:
        """A file that holds no map is one value, of the name that it is loaded to."""
        parsed = self.files.parsed(path, parse_yaml)
        value = plain(parsed.facts[0]) if parsed is not None and parsed.facts else None
        if isinstance(value, list):
            yield Setting(base, value, Place(path, 1))

    def _found(self, source: ParameterFile) -> str | None:
        text = self.substituter.text(source.path)
        path = self.files.find(text.text) if text.known else None
        if path is None or self.files.read(path) is None:
            self._not_found(source, text)
            return None
        return path

    def _sets(self, path: str, parser: Callable[[bytes], Parsed[Sets]]) -> tuple[ParameterSet, ...]:
        parsed = self.files.parsed(path, parser)
        if parsed is None:
            return ()
        for entry in parsed.diagnostics:
            self.tree.report(located(path, entry))
        return parsed.facts.sets

    def _not_found(self, source: ParameterFile, text: Text) -> None:
        shown = text.text.removeprefix("tree:")
        if not shown:
            return
        self.missing.append(shown)
        if text.known and not text.emptied and not self.files.is_elsewhere(text.text):
            message = f"Parameter file `{shown}` is not in the tree. Correct the path or add the file."
            self.tree.report(
                FileDiagnostic("warning", "launch-file-missing", self.path, source.line, message, about=shown)
            )

    def value(self, data: Data, typing: Typing, depth: int = 0) -> Any:
        """Return a parameter's value as plain data; `typing` tells what a text means."""
        if isinstance(data, list):
            return [self.value(item, typing, depth + 1) for item in data] if depth < MAX_DEPTH else []
        if not isinstance(data, tuple):
            return data
        text = self.substituter.text(data)
        if any(isinstance(part, Substitution) and part.kind in {"command", "unknown"} for part in data):
            return text.text
        return value_of(text.text, typing) if text.known else text.text

    def _substituted(self, value: Any, depth: int = 0) -> Any:
        """Evaluate `$(var x)` that stands in a parameter file."""
        if isinstance(value, str) and "$(" in value:
            text = self.substituter.text(parse_template(value))
            return value_of(text.text, "yaml") if text.known else text.text
        if isinstance(value, list) and depth < MAX_DEPTH:
            return [self._substituted(item, depth + 1) for item in value]
        return value


def _given(sets: Sequence[ParameterSet]) -> Iterator[ParameterSet]:
    """What a ROS 1 launch sets: an empty map has nothing in it, and is no value."""
    return (entry for entry in sets if entry.value != {})


def _rewritten(setting: Setting, rewrites: Sequence[tuple[str, Text]], converts: bool) -> Any:
    for key, replacement in rewrites:
        if setting.name == key or setting.name.endswith(f".{key}"):
            return rewritten(replacement.text, converts=converts) if replacement.known else replacement.text
    return setting.value


def _below(root: str, node: str) -> str:
    return join("/" + root.strip("/"), node.lstrip("/")) if root.strip("/") else node


def _dotted(prefix: str, entry: ParameterSet) -> str:
    """Name of a value of a plain YAML file that is given as a map."""
    parts = (prefix, (entry.node or "").strip("/"), entry.name)
    return ".".join(part.replace("/", ".") for part in parts if part)


def all_given(pattern: str, settings: Sequence[Setting]) -> Iterator[str]:
    """Yield the texts of all parameters `before.*.last`; ROS 1 writes them as a list of maps `before`."""
    before, _, last = pattern.partition(".*.")
    for setting in settings:
        if fnmatchcase(setting.name.replace("/", "."), pattern) and isinstance(setting.value, str):
            yield setting.value
        elif setting.name == before and isinstance(setting.value, list):
            yield from (str(item[last]) for item in setting.value if isinstance(item, dict) and last in item)
