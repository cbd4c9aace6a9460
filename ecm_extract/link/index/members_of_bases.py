"""Members that C++ writes with their class, as the object has them by a base: `A::topic = "x"` means `this->topic`.

Where an object has two of that name, each by another class, it is that of a part of the object which is called like the
class: `this->#A.topic`. Who changes that is none of the methods of that class.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op
from ecm_parsers.source.facts import Field
from ecm_parsers.source.rewriting import rewritten
from msgspec.structs import replace

from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.program import Program

_MARK = "::"


def settle_members_of_bases(program: Program) -> None:
    """Read such members as those of the object at hand, in all functions of a tree."""
    for file in program.files:
        lines = set(_lines(file, program)) if file.language == "cpp" else set()
        for func in program.functions_in(file) if lines else ():
            if any(func.fact.line <= line <= func.fact.end_line for line in lines):
                func.fact = rewritten(func.fact, _Members(func, program).meant)


def _lines(file: File, program: Program) -> Iterator[int]:
    """Where a file names what may be a member of a class."""
    for mention in file.facts.mentions:
        owner, _, name = mention.name.rpartition(_MARK)
        classes = program.classes.get(owner.rpartition(_MARK)[2], ()) if mention.arguments < 0 else ()
        if any(name in each.fields for cls in classes for each in program.ancestry(cls)):
            yield mention.line


class _Members:
    """Tells what qualified names mean in one function."""

    def __init__(self, func: Func, program: Program) -> None:
        self.func = func
        self.program = program

    def meant(self, part: Any) -> Any:
        """Return what stands for a part of facts; None of what stays. What is called or pointed to is no member."""
        if isinstance(part, Op) and part.op == "&" and isinstance(part.operands[0], Name):
            return part
        if isinstance(part, Call) and isinstance(part.callee, Name):
            args, keywords = rewritten((part.args, part.keywords), self.meant)
            return replace(part, args=args, keywords=keywords)
        return self._read(part) if isinstance(part, Name | Member) else None

    def _read(self, part: Name | Member) -> Expr | None:
        written = part.name if isinstance(part, Member) else part.id
        owner, _, name = written.rpartition(_MARK)
        named = self.program.class_named(owner, self.func.file, self.func.scope) if owner else None
        lineage = self.program.ancestry(named) if named is not None else ()
        cls = next((each for each in lineage if name in each.fields), None)
        field = cls.fields.get(name) if cls is not None else None
        if cls is None or field is None or "static" in field.traits or not (cls is named or self._is_once(cls)):
            return None
        base = rewritten(part.base, self.meant) if isinstance(part, Member) else THIS
        return Member(base if self._is_alone(name, cls) else Member(base, self._part(cls)), name)

    def _part(self, cls: Cls) -> str:
        """The part of an object that it has by a class; whose objects have it are given it."""
        name = f"#{cls.qualified}"
        for derived in self.program.derived(cls):
            derived.fields.setdefault(name, Field(name, f"{cls.qualified} &", derived.fact.line))
        return name

    def _is_once(self, cls: Cls) -> bool:
        """Whether no object may have two parts by a class, of which the one by another class is meant."""
        bases = (self.program.bases(each) for each in self.program.derived(cls))
        return all(sum(cls in self.program.ancestry(base) for base in each) <= 1 for each in bases)

    def _is_alone(self, name: str, cls: Cls) -> bool:
        """Whether no object that has a member by a class has another one of its name."""
        objects = (cls, *self.program.derived(cls))
        return all(sum(name in base.fields for base in self.program.ancestry(each)) == 1 for each in objects)
