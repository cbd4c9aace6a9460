"""Types and names as they are written: their parts, what qualifies them, what stands behind a pointer."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Final

MAX_SPELLINGS: Final = 4096
"""How many spellings of types and names are remembered: the same few hundred come by the ten thousand."""
_NODE_INTERFACE = re.compile(r"\bNode\w+Interface\b")
_QUALIFIERS = frozenset({"const", "typename", "class", "struct", "volatile", "public", "virtual", "static"})
_POINTERS = frozenset(
    {"shared_ptr", "unique_ptr", "scoped_ptr", "optional", "SharedPtr", "UniquePtr", "Ptr", "weak_ptr"}
    | {"reference_wrapper"}
)
_MARKS = str.maketrans("&*[]", "    ")
_WITHIN_TEMPLATE = re.compile(r">\s*::\s*\w+$")
_ALIASED = re.compile(r"::(?:Const)?(?:SharedPtr|UniquePtr|Ptr|WeakPtr|SharedConstPtr)$")


@lru_cache(maxsize=MAX_SPELLINGS)
def plain(text: str) -> str:
    """Return a type name without template arguments, qualifiers and marks."""
    head = text.split("<", 1)[0] if "<" in text else text
    words = [word for word in head.translate(_MARKS).split() if word not in _QUALIFIERS]
    return words[-1] if words else ""


@lru_cache(maxsize=MAX_SPELLINGS)
def is_node_interface(written: str) -> bool:
    """Tell whether a type is one of the interfaces that a node consists of, such as `NodeTopicsInterface`."""
    return "Interface" in written and _NODE_INTERFACE.search(written) is not None


@lru_cache(maxsize=MAX_SPELLINGS)
def last_name(path: str) -> str:
    """Return the last part of a qualified name of either language."""
    return path.replace("::", ".").rsplit(".", 1)[-1]


@lru_cache(maxsize=MAX_SPELLINGS)
def by_value(written: str) -> bool:
    """Tell whether a variable of a type is an object itself, not a pointer or reference to one.

    Of what a template calls a type, as `Server<T>::CallbackType`, that is not known.
    """
    text = written.removeprefix("const ").removeprefix("::").rstrip("[]")
    named = text[:1].isalpha() and text != "auto" and not text.endswith(("*", "&"))
    return named and pointee(text) == text and _WITHIN_TEMPLATE.search(text) is None


@lru_cache(maxsize=MAX_SPELLINGS)
def may_be_written(written: str) -> bool:
    """Tell whether who gets a parameter of a type of C++ can change what it refers or points to."""
    return written.rstrip().endswith(("&", "*")) and "const" not in written.split()


def is_pointer(last: str) -> bool:
    """Tell whether the last name of a type is that of a smart pointer, or of what may be none."""
    return last in _POINTERS


@lru_cache(maxsize=MAX_SPELLINGS)
def is_constant_value(written: str) -> bool:
    """Tell whether a type is stated as that of a constant that is no pointer: who gets one cannot change it."""
    words = written.split()
    value = written.strip().removeprefix("const ").rstrip("& ")
    return "const" in words and "auto" not in words and "*" not in written and pointee(written) == value


def pointee(written: str) -> str:
    """Return the class that a type's objects are of: through smart pointers and `::SharedPtr` aliases."""
    text = written.strip().removeprefix("const ").rstrip("&*[] ")
    for _ in range(4):
        name = plain(text)
        last = name.rsplit("::", 1)[-1]
        inner = template_arguments(text)
        if last in _POINTERS and inner and not text.rstrip().endswith(last):
            text = inner[0].removeprefix("const ").rstrip("&* ")
        elif _ALIASED.search(text):
            text = _ALIASED.sub("", text)
        else:
            return text
    return text


@lru_cache(maxsize=MAX_SPELLINGS)
def template_arguments(written: str) -> tuple[str, ...]:
    """Split the template arguments of a type as written; empty without any."""
    start = written.find("<")
    if start < 0:
        return ()
    depth, begin, found = 0, start + 1, []
    for index in range(start, len(written)):
        char = written[index]
        if char in "<([":
            depth += 1
        elif char in ">)]":
            depth -= 1
            if depth == 0:
                found.append(written[begin:index].strip())
                break
        elif char == "," and depth == 1:
            found.append(written[begin:index].strip())
            begin = index + 1
    return tuple(entry for entry in found if entry)
