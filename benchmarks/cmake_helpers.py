"""Functions and macros that make targets, as people write them, and calls of them."""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Protocol

STEMS = ("alpha", "beta", "gamma", "delta", "epsilon", "zeta")


class Shape(Protocol):
    """A function or macro that makes targets, and how it is called; `either` is false where only a function does."""

    either: bool

    def body(self, name: str, kind: str) -> Iterator[str]: ...

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]: ...


class _Positional:
    either = True

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} target source)", "  add_executable(${target} ${source} ${ARGN})")
        yield from ("  install(TARGETS ${target} DESTINATION lib/${PROJECT_NAME})", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        yield f"{name}({target} {root}/{rng.choice(STEMS)}.cpp {root}/zeta.cpp)"


class _Keywords:
    either = True

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield f"{kind}({name})"
        yield '  cmake_parse_arguments(ARG "SHARED;QUIET" "NAME" "SOURCES;DEPS" ${ARGN})'
        yield from ("  if(ARG_SHARED)", "    add_library(${ARG_NAME} SHARED ${ARG_SOURCES})", "  else()")
        yield from ("    add_executable(${ARG_NAME} ${ARG_SOURCES})", "  endif()")
        yield from ("  if(ARG_DEPS)", "    target_link_libraries(${ARG_NAME} ${ARG_DEPS})", "  endif()", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        shared = " SHARED" if rng.random() < 0.5 else ""
        yield f"{name}(NAME {target}{shared} SOURCES {root}/{rng.choice(STEMS)}.cpp {root}/beta.cpp DEPS m)"


class _Parsed:
    either = False

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield f"{kind}({name} target)"
        yield '  cmake_parse_arguments(PARSE_ARGV 1 P "" "ONE" "MANY")'
        yield from ("  add_executable(${target} ${P_ONE} ${P_MANY} ${P_UNPARSED_ARGUMENTS})", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        yield f"{name}({target} {root}/alpha.cpp ONE {root}/beta.cpp MANY {root}/{rng.choice(STEMS[2:])}.cpp)"


class _Returning:
    either = False

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} out folder)", "  set(result)", "  foreach(stem ${ARGN})")
        yield from ("    list(APPEND result ${folder}/${stem}.cpp)", "  endforeach()")
        yield from ("  set(${out} ${result} PARENT_SCOPE)", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        stems = " ".join(rng.sample(STEMS, 2))
        yield from (f"{name}({target}_SOURCES {root} {stems})", f"add_library({target} ${{{target}_SOURCES}})")


class _Counting:
    either = True

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} target)", "  if(${ARGC} GREATER 2)", "    add_library(${target} ${ARGV1} ${ARGV2})")
        yield from ("  else()", "    add_library(${target} ${ARGN})", "  endif()", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        more = f" {root}/gamma.cpp" if rng.random() < 0.5 else ""
        yield f"{name}({target} {root}/alpha.cpp{more})"


class _Shadowing:
    """What a function sets is gone after it; what a macro sets stays."""

    either = True

    def body(self, name: str, kind: str) -> Iterator[str]:
        yield from (f"{kind}({name} target folder)", "  set(picked ${folder}/delta.cpp)")
        yield from ("  add_library(${target} ${picked})", f"end{kind}()")

    def call(self, name: str, target: str, root: str, rng: random.Random) -> Iterator[str]:
        yield from (f"set(picked {root}/{rng.choice(STEMS)}.cpp)", f"{name}({target} {root})")
        yield f"add_executable({target}_after ${{picked}})"


SHAPES: tuple[Shape, ...] = (_Positional(), _Keywords(), _Parsed(), _Returning(), _Counting(), _Shadowing())
