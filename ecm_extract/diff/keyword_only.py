"""Parameters of Python that stand after `*`: callers give them by name, so where among them one stands says nothing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ecm_checker.hub.provision import Form

from ecm_extract.diff.conversions import takes


def has_keyword_only(form: Form) -> bool:
    """Whether a form has `*args` or `*`."""
    return any(name.startswith("*") and not name.startswith("**") for name in form.names)


def takes_keywords(new: Form, old: Form) -> bool:
    """Whether what callers gave to the old form, by place or by name, is right with the new one."""
    before, after = _star(old.names), _star(new.names)
    fewer = new.names[:before] != old.names[:before] or (_any_number(old) and (after != before or not _any_number(new)))
    if fewer or not _typed_alike(new, old):
        return False
    if _any_name(new):
        return True
    return not _any_name(old) and _given_by_name(old).keys() <= _given_by_name(new).keys()


def _any_name(form: Form) -> bool:
    return any(name.startswith("**") for name in form.names)


def _star(names: Sequence[str]) -> int:
    """Where the first parameter stands that nobody gives by its place."""
    return next((at for at, name in enumerate(names) if name.startswith("*")), len(names))


def _any_number(form: Form) -> bool:
    """Whether `*args` takes any number of arguments; `*` alone takes none, and `**kwargs` only names."""
    star = _star(form.names)
    return star < len(form.names) and form.names[star].lstrip("*") != "" and not form.names[star].startswith("**")


def _given_by_name(form: Form) -> Mapping[str, str]:
    pairs = zip(form.names, form.types, strict=False)
    return {name: written for name, written in pairs if not name.startswith("*")}


def _typed_alike(new: Form, old: Form) -> bool:
    before, after = _given_by_name(old), _given_by_name(new)
    return all(takes(after[name], before[name]) for name in before.keys() & after.keys())
