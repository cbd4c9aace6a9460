"""Properties: of the whole build, of folders and of targets, which people use as variables that every scope sees.

They are kept among the variables, under names that no variable can have.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import is_known, unknown

_APPEND: Final = frozenset({"APPEND", "APPEND_STRING"})
_LIBRARIES: Final = ("STATIC", "SHARED", "MODULE", "OBJECT", "INTERFACE")
_WORDS: Final = frozenset({*_LIBRARIES, "EXCLUDE_FROM_ALL", "WIN32", "MACOSX_BUNDLE"})
_NO_SOURCES: Final = frozenset({"IMPORTED", "ALIAS"})


def _held(owner: str, name: str) -> str:
    """Return the name under which a property is kept; the owner is empty, a folder or a target."""
    return f"\x06{owner}\x06{name}"


def _target(name: str) -> str:
    return f"TARGET {name}"


def _folder(look: Look) -> str:
    return look.get("CMAKE_CURRENT_SOURCE_DIR") or ""


def _owners(words: list[str], look: Look) -> list[str]:
    """Owners that the words before PROPERTY name; none of a kind that is not kept."""
    kept = [word for word in words if word not in _APPEND]
    if kept == ["GLOBAL"]:
        return [""]
    if kept == ["DIRECTORY"]:
        return [_folder(look)]
    return [_target(name) for name in kept[1:]] if kept[:1] == ["TARGET"] else []


def set_property(args: list[str], look: Look) -> Sequence[Change]:
    """`set_property(<GLOBAL | DIRECTORY | TARGET names...> [APPEND | APPEND_STRING] PROPERTY name values...)`."""
    if "PROPERTY" not in args[:-1]:
        return []
    at = args.index("PROPERTY")
    how = next((word for word in args[:at] if word in _APPEND), "")
    names = [_held(owner, args[at + 1]) for owner in _owners(args[:at], look)]
    return [Change(name, _set(name, ";".join(args[at + 2 :]), how, look), "everywhere") for name in names]


def _set(name: str, text: str, how: str, look: Look) -> str:
    before = _before(name, look) if how else ""
    return before + text if how == "APPEND_STRING" or not before else f"{before};{text}"


def _before(name: str, look: Look) -> str:
    """What a property held; those of targets have values that nobody set."""
    return look.get(name) or "" if look.has(name) or "\x06TARGET " in name else ""


def get_property(args: list[str], look: Look) -> Sequence[Change]:
    """`get_property(NAME <GLOBAL | DIRECTORY | TARGET name> PROPERTY name [SET])`."""
    at = args.index("PROPERTY") if "PROPERTY" in args[:-1] else 0
    owners = _owners(args[1:at], look)
    name = _held(owners[0], args[at + 1]) if owners else ""
    if not name or not look.has(name):
        return not_known(args[0]) if args else []
    if args[at + 2 :] == ["SET"]:
        return [Change(args[0], "1")]
    return [Change(args[0], look.get(name))] if not args[at + 2 :] else not_known(args[0])


def get_target_property(args: list[str], look: Look) -> Sequence[Change]:
    """`get_target_property(NAME target property)`."""
    return get_property([args[0], "TARGET", args[1], "PROPERTY", args[2]], look) if len(args) == 3 else []


def get_directory_property(args: list[str], look: Look) -> Sequence[Change]:
    """`get_directory_property(NAME property)`; those of other folders are not known."""
    if len(args) != 2:
        return not_known(args[0]) if args else []
    return get_property([args[0], "DIRECTORY", "PROPERTY", args[1]], look)


def set_target_properties(args: list[str], look: Look) -> Sequence[Change]:
    """`set_target_properties(targets... PROPERTIES name value ...)`."""
    del look
    at = args.index("PROPERTIES") if "PROPERTIES" in args else len(args)
    pairs = list(zip(args[at + 1 :: 2], args[at + 2 :: 2], strict=False))
    return [Change(_held(_target(name), key), text, "everywhere") for name in args[:at] for key, text in pairs]


# -- what targets are made of


def add_executable(args: list[str], look: Look) -> Sequence[Change]:
    """`add_executable(name [words] sources...)`."""
    del look
    return _made(args, "EXECUTABLE")


def add_library(args: list[str], look: Look) -> Sequence[Change]:
    """`add_library(name [kind] [words] sources...)`."""
    told = next((word for word in args[1:] if word in _LIBRARIES), "")
    shared = look.get("BUILD_SHARED_LIBS")
    kind = told or ("" if shared is None or not is_known(shared) else "SHARED" if shared == "ON" else "STATIC")
    return _made(args, f"{kind}_LIBRARY" if kind else unknown("TYPE"))


def _made(args: list[str], kind: str) -> Sequence[Change]:
    if not args or not _NO_SOURCES.isdisjoint(args):
        return []
    sources = ";".join(word for word in args[1:] if word not in _WORDS)
    told = {"TYPE": kind, "SOURCES": sources, "NAME": args[0]}
    return [Change(_held(_target(args[0]), name), text, "everywhere") for name, text in told.items()]


def target_sources(args: list[str], look: Look) -> Sequence[Change]:
    """What `target_sources` adds is made absolute by new policies, so that the property is not known any more."""
    del look
    return [Change(_held(_target(args[0]), "SOURCES"), unknown("SOURCES"), "everywhere")] if args else []
