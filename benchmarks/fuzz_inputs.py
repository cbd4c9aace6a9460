"""Kinds of inputs, what real ones there are, and how they are changed or made up."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Final, NamedTuple

MAX_REAL: Final = 60_000
"""Largest real file that is mutated: what is slow shows in small ones too."""
MAX_PER_KIND: Final = 400
MAX_BOMB: Final = 400_000


class Kind(NamedTuple):
    """A kind of input.

    Attributes:
        place: where such a file lies in its package.
        suffixes: ends of the names of real ones.
        holds: a text that real ones hold, where the suffix does not tell.
        opens, closes: what nests in it.
        repeats: an entry that may stand many times, with a place for its number.
    """

    place: str
    suffixes: tuple[str, ...]
    holds: str
    opens: str
    closes: str
    repeats: str


_ROBOT = '<robot xmlns:xacro="http://ros.org/wiki/xacro" name="r">'
KINDS: Final[Mapping[str, Kind]] = {
    "c++": Kind("src/fuzz.cpp", (".cpp", ".hpp", ".h"), "", "f({", "})", 'create_publisher<A>("t" + n{0}, {0});\n'),
    "python": Kind("fuzz/fuzz.py", (".py",), "", "f([", "])", "if a{0}: x = x + str({0})\nelse: x = y + x\n"),
    "cmake": Kind(
        "CMakeLists.txt", ("CMakeLists.txt",), "", "if(A)\n", "endif()\n", 'set(V{0} "${{V{0}}};${{V}};a{0}")\n'
    ),
    "package.xml": Kind("package.xml", ("package.xml",), "<package", "<export>", "</export>", "<depend>d{0}</depend>"),
    "yaml": Kind("config/fuzz.yaml", (".yaml",), "", "{a: [", "]}", "n{0}: &a{0} [*a, *a]\n"),
    "launch xml": Kind(
        "launch/fuzz.launch.xml",
        (".launch", ".launch.xml"),
        "<launch",
        "<group>",
        "</group>",
        '<let name="a" value="$(var a)$(var a){0}"/><node pkg="p" exec="e" name="$(var a)"/>',
    ),
    "launch py": Kind(
        "launch/fuzz.launch.py",
        ("launch.py",),
        "LaunchDescription",
        "GroupAction([",
        "])",
        'a = PythonExpression([a, "+", a, "{0}"])\nx.add_action(Node(package="p", executable="e", name=a))\n',
    ),
    "xacro": Kind(
        "urdf/fuzz.urdf.xacro",
        (".xacro", ".urdf"),
        "<robot",
        "<xacro:if value='1'>",
        "</xacro:if>",
        '<xacro:macro name="m{0}"><xacro:m/><xacro:m/></xacro:macro><xacro:property name="m" value="${{m+m}}"/>',
    ),
    "msg": Kind("msg/Fuzz.msg", (".msg",), "", "A[", "]", "Fuzz{0}[{0}] f{0}\n"),
    "srv": Kind("srv/Fuzz.srv", (".srv",), "", "---\n", "---\n", "float64[<={0}] f{0} [1, 2]\n"),
    "action": Kind("action/Fuzz.action", (".action",), "", "---\n", "---\n", "string<={0} f{0}\n"),
    "plugin xml": Kind(
        "plugins.xml",
        (".xml",),
        "base_class_type",
        "<library>",
        "</library>",
        '<class name="n{0}" type="fuzz::Fuzz{0}" base_class_type="b::B"/>',
    ),
    "bt xml": Kind(
        "behavior_trees/fuzz.xml",
        (".xml",),
        "<BehaviorTree",
        "<Sequence>",
        "</Sequence>",
        '<RetryUntilSuccessful num_attempts="{0}" a="{{a{0}}}"/><SubTree ID="Fuzz{0}"/>',
    ),
    "patch": Kind("fuzz.patch", (), "", "@@ -1 +1 @@\n", "", "@@ -{0},{0} +{0} @@\n-a\n+b\n"),
    "refs": Kind("packed-refs", (), "", "refs/", "", "{0:040d} refs/tags/1.{0}.0\n"),
}
_NUMBERS: Final = ("1e999", "-1", "0", "9" * 5000, "0x" + "f" * 4000, "1e30", "NaN", "²", "18446744073709551616")
_TOKENS: Final = (
    *("{", "}", "(", ")", "[", "]", "<", ">", '"', "'", '\\"', "\\", "/*", "*/", "//", "#", "\n", "\0", "\r", "\t"),
    *(
        "::",
        "->",
        "...",
        "&",
        "*",
        "%s",
        "{}",
        "{0[0]}",
        "${",
        "$(",
        "$(var a)",
        "$(find p)",
        "<!--",
        "-->",
        "<![CDATA[",
    ),
    *(
        "\ufeff",
        "\u202e",
        "\ud7ff",
        "𝕏",
        "é",
        "template<",
        "class{public::",
        "namespace ",
        "lambda: ",
        "self.",
        "yield ",
    ),
    *(
        "!!python/object:a ",
        "&a ",
        "*a",
        "<<: ",
        "? ",
        "- ",
        "%YAML 9\n",
        "---\n",
        "\n#if A\n",
        "\n#else\n",
        "\n#endif\n",
    ),
)
_NUMBER: Final = re.compile(r"\d+")
_WORD: Final = re.compile(r"\w+")


def real_inputs(clones: Iterable[Path]) -> Mapping[str, list[str]]:
    """Return texts of real files by kind, from work trees of clones."""
    found: dict[str, list[str]] = {kind: [] for kind in KINDS}
    for path in (path for clone in clones for path in sorted(clone.rglob("*")) if ".git" not in path.parts):
        names = [name for name, kind in KINDS.items() if kind.suffixes and path.name.endswith(kind.suffixes)]
        if not names or path.is_symlink() or not path.is_file() or path.stat().st_size > MAX_REAL:
            continue
        text = path.read_text("utf-8", "replace")
        for name in names:
            if KINDS[name].holds in text:
                found[name].append(text)
    return found


def drawn(real: Mapping[str, list[str]], chance: random.Random) -> Mapping[str, list[str]]:
    """Return as many texts of each kind as are mutated; patches and refs are made up of others."""
    texts = {name: chance.sample(found, min(len(found), MAX_PER_KIND)) for name, found in real.items()}
    texts["patch"] = [_patch(text) for text in texts["c++"][:40]]
    texts["refs"] = [_refs(number) for number in range(1, 5)]
    return texts


def _patch(text: str) -> str:
    lines = text.splitlines()[:40]
    removed = [f"-{line}" for line in lines[:3]]
    head = ["--- a/src/fuzz.cpp", "+++ b/src/fuzz.cpp", f"@@ -1,{len(lines)} +1,{len(lines) - len(removed)} @@"]
    return "\n".join([*head, *removed, *(f" {line}" for line in lines[len(removed) :])]) + "\n"


def _refs(count: int) -> str:
    rows = [f"{number:040x} refs/tags/{number}.0.0" for number in range(1, count + 1)]
    return "\n".join(["# pack-refs with: peeled fully-peeled sorted ", *rows]) + "\n"


def mutant(text: str, others: list[str], chance: random.Random) -> str:
    """Return a text after one to four changes."""
    for _ in range(chance.randint(1, 4)):
        text = chance.choice(_CHANGES)(text, others, chance)
    return text[:MAX_BOMB]


def _span(text: str, chance: random.Random) -> tuple[int, int]:
    start = chance.randint(0, len(text))
    return start, min(len(text), start + chance.choice((1, 3, 10, 40, 200, 1000)))


def _delete(text: str, _: list[str], chance: random.Random) -> str:
    start, end = _span(text, chance)
    return text[:start] + text[end:]


def _repeat(text: str, _: list[str], chance: random.Random) -> str:
    start, end = _span(text, chance)
    return text[:start] + text[start:end] * chance.choice((2, 3, 30, 400)) + text[end:]


def _token(text: str, _: list[str], chance: random.Random) -> str:
    start, end = _span(text, chance)
    return text[:start] + chance.choice(_TOKENS) + text[chance.choice((start, end)) :]


def _number(text: str, _: list[str], chance: random.Random) -> str:
    places = list(_NUMBER.finditer(text))
    if not places:
        return text
    place = chance.choice(places)
    return text[: place.start()] + chance.choice(_NUMBERS) + text[place.end() :]


def _word(text: str, _: list[str], chance: random.Random) -> str:
    """One word in the place of another: names that mean each other, types that stand for themselves."""
    words = list(_WORD.finditer(text))
    if not words:
        return text
    place, other = chance.choice(words), chance.choice(words)
    return text[: place.start()] + other[0] * chance.choice((1, 1, 1, 500)) + text[place.end() :]


def _splice(text: str, others: list[str], chance: random.Random) -> str:
    other = chance.choice(others)
    start, end = _span(other, chance)
    at = chance.randint(0, len(text))
    return text[:at] + other[start:end] + text[at:]


def _cut(text: str, _: list[str], chance: random.Random) -> str:
    return text[: chance.randint(0, len(text))]


_CHANGES: Final[tuple[Callable[[str, list[str], random.Random], str], ...]] = (
    *(_delete, _repeat, _token, _token, _number, _word, _splice, _cut),
)


def bomb(kind: Kind, text: str, chance: random.Random) -> str:
    """Return a real text with something made up in it: deep, wide, long or repeated many times."""
    size = chance.choice((50, 1_000, 20_000))
    made = chance.choice(_BOMBS)(kind, size, chance)[:MAX_BOMB]
    at = chance.choice((0, len(text) // 2, text.rfind("</") if "</" in text else len(text)))
    return text[:at] + made + text[at:]


def _deep(kind: Kind, size: int, chance: random.Random) -> str:
    return kind.opens * size + (kind.closes * size if chance.random() < 0.7 else "")


def _wide(kind: Kind, size: int, _: random.Random) -> str:
    return "".join(kind.repeats.format(number) for number in range(min(size, 5_000)))


def _long(_: Kind, size: int, chance: random.Random) -> str:
    return chance.choice(("a", "::a", "9", ".a", " ", "\t", "/a", "<", '\\"', "&amp;", "${a}", "$(var a)", "a,")) * size


def _same(kind: Kind, size: int, chance: random.Random) -> str:
    return kind.repeats.format(chance.randint(0, 9)) * min(size, 5_000)


_BOMBS: Final[tuple[Callable[[Kind, int, random.Random], str], ...]] = (_deep, _wide, _long, _same)
