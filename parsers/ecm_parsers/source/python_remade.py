"""Classes of Python that are not what stands in them: a decorator or a metaclass may change that.

Source: docs.python.org, "Data model", "Customizing class creation".
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files

import msgspec

from ecm_parsers.source.facts import Class
from ecm_parsers.source.python_dataclasses import Imported, fills, spelled


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    decorators: frozenset[str]
    metaclasses: frozenset[str]


@cache
def _table() -> _Table:
    text = files("ecm_parsers").joinpath("source", "python_remade.toml").read_text(encoding="utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)


def is_remade(cls: Class, metaclass: str, imported: Imported) -> bool:
    """Tell whether attributes of a class and its objects may be others than its body gives them.

    Args:
        cls: the class.
        metaclass: what its head names as such, empty for none.
        imported: what the names of its file mean.
    """
    table = _table()
    names = [imported.full(spelled(each)) for each in cls.decorators]
    if any(name not in table.decorators and not fills(name) for name in names):
        return True
    made_by = imported.full(metaclass)
    return bool(made_by) and made_by not in table.metaclasses
