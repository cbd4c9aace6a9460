"""Python imports and attributes, C++ includes and base classes that name what is gone."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Certainty
from ecm_parsers.source.facts import Import

from ecm_extract.diff.model import Located
from ecm_extract.entities.side import Workspace
from ecm_extract.link.spelling import plain, snake
from ecm_extract.link.units import File
from ecm_extract.link.walk import dotted, expressions
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_SYMBOLS = ("function", "class", "constant", "file")
_GOING = GONE | {"deprecated"}
_GENERATED = ("Request", "Response", "Goal", "Result", "Feedback", "Action")


def symbol_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines of sources that import, include or name what a change takes away."""
    messages = _message_names(index)
    headers = _headers(index)
    symbols = _python_symbols(index)
    for file in workspace.program.files:
        if file.language == "python":
            yield from _imports(file, messages, index)
            yield from _attributes(file, symbols)
        else:
            yield from _includes(file, headers)
            yield from _bases(file, index)


Names = dict[str, list[int]]


def _message_names(index: ChangeIndex) -> dict[str, list[int]]:
    found: Names = {}
    for number, located in enumerate(index.of_kind("message")):
        entity = located.pair.old
        if entity is not None and located.change.change in GONE:
            package, shape, name = entity.name.split("/")
            for suffix in ("", *_GENERATED):
                found.setdefault(f"{package}.{shape}.{name}{suffix}", []).append(number)
                if shape == "action":
                    found.setdefault(f"{package}.msg.{name}{suffix}", []).append(number)
    return found


def _imports(file: File, messages: Names, index: ChangeIndex) -> Iterator[Use]:
    changes = index.of_kind("message")
    for entry in file.facts.imports:
        for number in messages.get(f"{entry.module}.{entry.name}", ()):
            place = Place(file.package, file.path, entry.line)
            yield use_at(changes[number], place, f"imports {entry.name} from {entry.module}")
        for kind in ("function", "class", "file"):
            for located in _named(kind, _absolute(entry, file), index):
                if located.change.change in _GOING and _is_python(located.pair.old):
                    place = Place(file.package, file.path, entry.line)
                    yield use_at(located, place, f"imports {entry.name or entry.module}")


def _named(kind: str, name: str, index: ChangeIndex) -> Iterator[Located]:
    """Changes of a name, also where a module above the one that declared it no longer offers it."""
    yield from index.named(kind, name)
    module, _, last = name.rpartition(".")
    if module and name in index.old.bound and name not in index.new.bound:
        for located in index.of_kind(kind):
            old = located.pair.old
            if old is not None and old.name.startswith(f"{module}.") and old.name.rpartition(".")[2] == last:
                yield located


def _absolute(entry: Import, file: File) -> str:
    """The dotted name that an import binds; a leading dot stands for the file's own folder."""
    module = entry.module
    if module.startswith("."):
        folders = file.path.split("/")[:-1]
        module = f"{folders[-1] if folders else ''}.{module.lstrip('.')}".strip(".")
    return f"{module}.{entry.name}" if entry.name else module


def _is_python(entity: object) -> bool:
    return str(getattr(entity, "path", "")).endswith(".py")


def _python_symbols(index: ChangeIndex) -> dict[str, Located]:
    found: dict[str, Located] = {}
    for kind in ("function", "class", "constant"):
        for located in index.of_kind(kind):
            entity = located.pair.old
            if entity is not None and _is_python(entity) and located.change.change in GONE:
                name = f"{entity.owner}.{entity.name}" if entity.kind == "constant" else entity.name
                found[name] = located
    return found


def _attributes(file: File, symbols: dict[str, Located]) -> Iterator[Use]:
    """`module.name` where the module is still there and the name is not."""
    if not symbols or not file.imported:
        return
    seen: set[tuple[str, int]] = set()
    for function in file.facts.functions:
        for statement in function.body:
            for expr, line in expressions(statement):
                written = dotted(expr)
                if written is None or "." not in written:
                    continue
                head, _, rest = written.partition(".")
                full = f"{file.imported.get(head, head)}.{rest}"
                located = symbols.get(full)
                if located is not None and (full, line) not in seen:
                    seen.add((full, line))
                    yield use_at(located, Place(file.package, file.path, line), f"uses {written}")


def _headers(index: ChangeIndex) -> dict[str, list[Located]]:
    """What an include line may say for each header and generated header that is gone."""
    found: dict[str, list[Located]] = {}
    for located in index.of_kind("file"):
        entity = located.pair.old
        if entity is not None and located.change.change in _GOING and not _is_python(entity):
            found.setdefault(entity.name, []).append(located)
    for located in index.of_kind("message"):
        entity = located.pair.old
        if entity is not None and located.change.change in GONE:
            package, shape, name = entity.name.split("/")
            for written in (f"{package}/{name}.h", f"{package}/{shape}/{snake(name)}.hpp"):
                found.setdefault(written, []).append(located)
    return found


def _certainty(located: Located, written: str) -> Certainty:
    """An include that another package answers now still needs that package as a dependency."""
    after = located.pair.new
    return "likely" if after is not None and after.name == written else "proved"


def _includes(file: File, headers: dict[str, list[Located]]) -> Iterator[Use]:
    """Includes of headers that are gone or going; a file that includes the successor too chooses by condition."""
    written = {entry.module for entry in file.facts.imports}
    for entry in file.facts.imports:
        for located in headers.get(entry.module, ()):
            if located.change.new != entry.module and located.change.new in written:
                continue
            yield use_at(
                located,
                Place(file.package, file.path, entry.line),
                f"includes {entry.module}",
                _certainty(located, entry.module),
            )


def _bases(file: File, index: ChangeIndex) -> Iterator[Use]:
    for cls in file.facts.classes:
        for base in cls.bases:
            name = plain(base)
            for located in index.named("class", name):
                entity = located.pair.old
                if located.change.change in _GOING and entity is not None and entity.package != file.package:
                    yield use_at(located, Place(file.package, file.path, cls.line), f"derives from {name}")
