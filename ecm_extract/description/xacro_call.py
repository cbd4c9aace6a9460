"""The parameters of a macro bound to what a call gives: texts, elements, and values from around the call."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from ecm_extract.description.macros import Macro, MacroParameter
from ecm_extract.description.symbols import Block, Symbols, Unknown
from ecm_extract.description.xacro_tags import elements


def bind(macro: Macro, element: etree._Element, path: str, inner: Symbols, around: Symbols) -> list[str]:
    """Set the parameters of one call.

    Args:
        macro: that is called.
        element: the call.
        path: file of the call.
        inner: symbols of the macro's body, which this fills.
        around: symbols of the place of the call.

    Returns:
        The names that the call should have given; texts of these stay unknown.
    """
    blocks = iter(elements(element))
    missing: list[str] = []
    for parameter in macro.parameters:
        if parameter.block:
            block = next(blocks, None)
            if block is None:
                missing.append(parameter.block + parameter.name)
            else:
                content = list(_content(parameter, block))
                inner.own[parameter.block + parameter.name] = Block(content, path, around)
        elif not _bind_text(parameter, element, inner, around):
            missing.append(parameter.name)
            inner.own[parameter.name] = Unknown("{" + parameter.name + "}")
    return missing


def _bind_text(parameter: MacroParameter, element: etree._Element, inner: Symbols, around: Symbols) -> bool:
    given = element.get(parameter.name)
    if given is not None:
        inner.own[parameter.name] = around.evaluated(str(given))
    elif parameter.forward and parameter.name in around:
        inner.own[parameter.name] = around[parameter.name]
    elif parameter.default is not None:
        inner.own[parameter.name] = around.evaluated(parameter.default)
    else:
        return False
    return True


def _content(parameter: MacroParameter, block: etree._Element) -> Iterator[etree._Element]:
    if parameter.block == "*":
        yield block
    else:
        yield from elements(block)
