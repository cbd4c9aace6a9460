"""Which module a node is an instance of, where several have its name."""

from __future__ import annotations

from collections.abc import Iterable, Set

from ecm_checker.view import View

from ecm_extract.observe.expected import Key, graph_keys, is_exact, is_node_of, on_node


def instances(node: str, modules: Iterable[View], ends: Set[Key], visible: Set[str]) -> tuple[View, ...]:
    """Modules with the name of a node; of several, those that what the node has fits best.

    Args:
        node: its full name.
        modules: those that can run.
        ends: what it has, and what libraries have for it.
        visible: roles that can be seen at all.
    """
    named = tuple(module for module in modules if is_node_of(node, module))
    if len(named) < 2:
        return named
    fits = [_fit(module, node, ends, visible) for module in named]
    return tuple(module for module, fit in zip(named, fits, strict=True) if fit == max(fits))


def _fit(module: View, node: str, ends: Set[Key], visible: Set[str]) -> int:
    """Fixed promises that are kept, less those that are not."""
    keys = [graph_keys(each) for each in on_node(module, node) if is_exact(each)]
    judged = [each for each in keys if any(role in visible for role, _ in each)]
    kept = sum(not ends.isdisjoint(each) for each in judged)
    return kept - (len(judged) - kept)
