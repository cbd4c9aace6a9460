"""A system in words for a person: what runs, who talks to whom, what must come from outside, what could not be read."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

import networkx as nx
from ecm_checker.hub.kinds import Breach
from ecm_checker.hub.roles import channel_kinds, roles
from ecm_checker.match.engine import Match

from ecm_extract.report.terminal import one_line
from ecm_extract.system.connections import connections
from ecm_extract.system.files import TREE
from ecm_extract.system.frames import FrameEdge
from ecm_extract.system.graph import Channel, channels
from ecm_extract.system.model import Instance, LaunchArgument
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.origins import Origin, code_of, origin_of
from ecm_extract.system.system import System

_ORIGINS: Mapping[Origin, str] = {
    "table": "public node, endpoints by table",
    "unknown": "source not in the tree, endpoints not known",
}
_LAUNCH_PROBLEMS = ("launch-", "description-", "params-")
_VARIABLE = re.compile(r"\benv (\w+)")
_BREACHES: Mapping[Breach | None, str] = {
    "type": "another type than of",
    "qos": "more than the QoS that is offered by",
    "claimed": "also claimed by another one; offered by",
}
QUOTES = "''"
MAX_FRAMES = 60
MAX_DEPTH = 40
MAX_ENTRIES = 40


def render(system: System) -> str:
    """Return the text; every name from a file is on one line and free of control characters."""
    found, matches = channels(system.nodes), connections(system)
    lines = [
        *_head(system, found),
        *_arguments(system.launched.arguments),
        *_environment(system),
        *_nodes(system.nodes),
        *_processes(system.launched.instances),
        *_channels(found),
        *_controllers(system),
        *_frames(system.frames),
        *_misfits(matches),
        *_wanted(system.nodes, matches),
        *_problems(system),
    ]
    return "\n".join(one_line(line, 400) for line in lines) + "\n"


def _head(system: System, found: list[Channel]) -> Iterator[str]:
    commit = f" ({system.tree.commit[:12]})" if system.tree.commit else ""
    place = "" if system.tree.label == "." and not commit else f"{system.tree.label}{commit}: "
    yield f"{place}{', '.join(system.launched.files[:1])}"
    kinds = [_counted(sum(1 for entry in found if entry.kind == kind), kind) for kind in channel_kinds()]
    files = _counted(len(system.launched.files), "launch file")
    yield f"{', '.join([_counted(len(system.nodes), 'node'), *kinds])}; {files} read"
    if not system.launched.is_complete:
        yield "INCOMPLETE: a part of the launch was left out, see below"


def _counted(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"


def _arguments(found: list[LaunchArgument]) -> Iterator[str]:
    entries = list({entry.name: entry for entry in found}.values())
    if not entries:
        return
    yield from ("", "arguments (give them as NAME:=VALUE)")
    for entry in entries[:MAX_ENTRIES]:
        value = "has no value" if entry.value is None else f"= {entry.value.removeprefix(TREE) or QUOTES}"
        choices = f"  [{', '.join(entry.choices)}]" if entry.choices else ""
        about = f"  {entry.description}" if entry.description else ""
        yield f"  {entry.name} {value}{choices}{about}"
    yield from _more(len(entries))


def _environment(system: System) -> Iterator[str]:
    """Variables that decide something here, and that nobody gave."""
    texts = [entry.value or "" for entry in system.launched.arguments]
    for instance in system.launched.instances:
        texts += [instance.conditional, instance.name or "", instance.namespace]
        texts += [word.text for word in instance.arguments]
        texts += [entry.value for entry in instance.settings if isinstance(entry.value, str)]
        texts += instance.missing_files
    names = sorted({match[1] for text in texts for match in _VARIABLE.finditer(text)})
    if names:
        yield from ("", f"environment variables that are not given (--env NAME=VALUE): {', '.join(names)}")


def _nodes(nodes: Iterable[SystemNode]) -> Iterator[str]:
    yield from ("", "nodes")
    for node in nodes:
        instance = node.instance
        notes = [
            *([f"in {instance.container}"] if instance.container else []),
            *([f"if {instance.conditional}"] if instance.conditional else []),
            *([note] if (note := _ORIGINS.get(origin_of(node))) else []),
        ]
        yield f"  {node.name}  {code_of(instance)}{'  [' + '; '.join(notes) + ']' if notes else ''}"


def _processes(instances: Iterable[Instance]) -> Iterator[str]:
    found = [entry for entry in instances if entry.kind == "process"]
    if not found:
        return
    yield from ("", "other processes")
    for entry in found[:MAX_ENTRIES]:
        words = " ".join(word.text.removeprefix(TREE) for word in entry.arguments)
        yield f"  {one_line(words, 200)}{f'  [if {entry.conditional}]' if entry.conditional else ''}"
    yield from _more(len(found))


def _channels(found: list[Channel]) -> Iterator[str]:
    for kind in channel_kinds():
        entries = [entry for entry in found if entry.kind == kind]
        if not entries:
            continue
        yield from ("", f"{kind}s")
        source, target = _side(kind, sends=True), _side(kind, sends=False)
        for entry in entries:
            yield f"  {entry.name}  {_types(entry)}"
            yield f"      {source}: {', '.join(entry.sources) or '-'}   {target}: {', '.join(entry.targets) or '-'}"


def _side(kind: str, *, sends: bool) -> str:
    """What those on one side of a channel are called."""
    rows = (row for row in roles().values() if row.channel == kind and row.sends is sends)
    return next((row.short for row in rows if row.short), "")


def _types(entry: Channel) -> str:
    return _joined(entry.types)


def _joined(types: Iterable[str]) -> str:
    return " | ".join(types) or "type not known"


def _controllers(system: System) -> Iterator[str]:
    if not system.controllers:
        return
    yield from ("", "controllers")
    for entry in system.controllers:
        claims = "claims not known" if entry.claims is None else ", ".join(entry.claims) or "claims nothing"
        state = "" if entry.active else " (inactive)"
        yield f"  {entry.name}{state}  {entry.type or 'type not known'}: {claims}"


def _frames(frames: list[FrameEdge]) -> Iterator[str]:
    if not frames:
        return
    yield from ("", "frames")
    tree: nx.DiGraph[str] = nx.DiGraph()
    tree.add_edges_from((edge.parent, edge.child) for edge in frames)
    roots = [name for name in sorted(tree) if tree.in_degree(name) == 0] or sorted(tree)[:1]
    shown = 0
    for root in roots:
        for depth, name in _walk(tree, root):
            if shown == MAX_FRAMES:
                yield f"  and {len(tree) - shown} more: see --format json"
                return
            shown += 1
            yield f"  {'  ' * depth}{name}"


def _walk(tree: nx.DiGraph[str], root: str) -> Iterator[tuple[int, str]]:
    pending, seen = [(0, root)], set()
    while pending:
        depth, name = pending.pop()
        if name in seen or depth > MAX_DEPTH:
            continue
        seen.add(name)
        yield depth, name
        pending.extend((depth + 1, child) for child in sorted(tree.successors(name), reverse=True))


def _misfits(matches: Iterable[Match]) -> Iterator[str]:
    """What meets under one name and does not fit."""
    found = [each for each in matches if each.state == "incompatible"]
    if not found:
        return
    yield from ("", "does not fit")
    for each in found[:MAX_ENTRIES]:
        at = each.requirement.evidence[0]
        who = ", ".join(dict.fromkeys(entry.owner for entry in each.found))
        yield f"  {each.requirement.by} {each.requirement.phrase}: {_BREACHES[each.breach]} {who}  {at.path}:{at.line}"
    yield from _more(len(found))


def _wanted(nodes: Iterable[SystemNode], matches: Iterable[Match]) -> Iterator[str]:
    """What nodes listen to or call, and no node whose endpoints are known offers."""
    wanted: dict[tuple[str, str], list[Match]] = {}
    for each in matches:
        if not each.found and each.requirement.kind in channel_kinds():
            wanted.setdefault((each.requirement.kind, each.requirement.said), []).append(each)
    if not wanted:
        return
    unknown = sum(1 for node in nodes if origin_of(node) == "unknown")
    who = f" (or from the {_counted(unknown, 'node')} whose endpoints are not known)" if unknown else ""
    yield from ("", f"must come from outside{who}")
    order = sorted(wanted, key=lambda key: (channel_kinds().index(key[0]), key[1]))
    for kind, name in order[:MAX_ENTRIES]:
        yield f"  {kind} {name}  {_wanted_by(wanted[kind, name])}"
    yield from _more(len(wanted))


def _wanted_by(matches: Sequence[Match]) -> str:
    asked = [each.requirement for each in matches]
    types = sorted({each.type for each in asked if each.type is not None})
    return f"{_joined(types)}  for {', '.join(sorted({each.by for each in asked}))}"


def _problems(system: System) -> Iterator[str]:
    launches = set(system.launched.files)
    found = list(
        dict.fromkeys(
            f"  {entry.path}:{entry.line}  {entry.message}"
            for entry in system.diagnostics
            if entry.code.startswith(_LAUNCH_PROBLEMS) or entry.path in launches
        )
    )
    if not found:
        return
    yield from ("", "not read")
    yield from found[:MAX_ENTRIES]
    yield from _more(len(found))


def _more(count: int) -> Iterator[str]:
    if count > MAX_ENTRIES:
        yield f"  and {count - MAX_ENTRIES} more: see --format json"
