"""Objects whose fields others may have changed since they were seen to be given something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Expr, Member, Name

from ecm_extract.infer.held import Held, all_ways
from ecm_extract.infer.places import whole_of
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def may_be_another(expr: Member, env: Env, folder: Folder) -> bool:
    """Tell whether a field may hold something else than what the statements at hand give it."""
    return _is_of_changed_variable(expr, env, folder) or _is_of_lost(expr.base, env, folder)


def is_lost(variable: Expr, env: Env, folder: Folder) -> bool:
    """Tell whether nobody knows what somebody made of an object of C++ who has it."""
    if env.func.file.language != "cpp" or not isinstance(variable, Name | Member):
        return False
    return any(held.how == "lost" for way in folder.flow.ways(variable, env) for held in way)


def _is_of_changed_variable(expr: Member, env: Env, folder: Folder) -> bool:
    """Tell whether an object is in a variable of a namespace that functions change, or others have a member."""
    if env.func.file.language == "python":
        return folder.states.kept_members.is_had_by_others(expr, env)
    root: Expr | None = expr
    while root is not None and not isinstance(root, Name):
        root = whole_of(root)
    if root is None or folder.scope.declared_type(root.id, env):
        return False
    file_scope = folder.objects.file_scope
    return bool(file_scope.type_of(root.id, env)) and file_scope.is_changed(root.id, env)


def _is_of_lost(expr: Expr | None, env: Env, folder: Folder) -> bool:
    """Tell whether an object is, or is in, a variable that somebody may have changed who is not followed."""
    while expr is not None:
        if isinstance(expr, Name | Member) and expr != THIS:
            helds = {held for way in folder.flow.ways(expr, env) for held in way}
            if any(map(_may_be_changed, all_ways(helds))):
                return True
        expr = whole_of(expr)
    return False


def _may_be_changed(held: Held) -> bool:
    """Tell whether somebody may have changed what a variable consists of, or an element, whatever came after that."""
    pending, seen = [held], {held}
    while pending:
        each = pending.pop()
        if each.how in {"lost", "reached"}:
            return True
        before = set(all_ways(each.before)) - seen
        pending += before
        seen |= before
    return False
