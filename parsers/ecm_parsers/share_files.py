"""Files in the share folders of packages that attributes of a launch file of XML name: maps, configurations, pictures.

Source: roslaunch XML (`value`, `default`, `args`: `$(find PKG)/path`), launch_xml (`$(find-pkg-share PKG)/path`).
"""

from __future__ import annotations

import re
from typing import Final

import msgspec

from ecm_parsers.result import Parsed
from ecm_parsers.xml_tree import line_of, local_name, parse_xml

_NAMED: Final = re.compile(
    r"\$\(find(?:-pkg-share)?\s+(\w+)\s*\)/+"
    r"([\w./-]+\.(?:ya?ml|rviz|launch|xml|urdf|xacro|srdf|world|pgm|png|jpe?g|stl|dae|lua|json|perspective))"
    r"(?![\w$({.])"
)
_EVALUATED: Final = frozenset({"include", "rosparam"})
"""Elements whose files the launch itself opens."""
_ATTRIBUTES: Final = ("value", "default", "args")
_URL: Final = "file://"


class ShareFile(msgspec.Struct, frozen=True):
    """A file that a line names.

    Attributes:
        package: its name. path: below its share folder.
        line: of the element, 1-based.
        is_url: it is named as `file://`, as calibrations of cameras are.
    """

    package: str
    path: str
    line: int
    is_url: bool


def parse_share_files(data: bytes) -> Parsed[tuple[ShareFile, ...]]:
    """Return the files that attributes name whole, in order; what the launch itself opens is left out."""
    found: list[ShareFile] = []
    for root in parse_xml(data).roots:
        for element in root.iter():
            if isinstance(element.tag, str) and local_name(element) not in _EVALUATED:
                for attribute in _ATTRIBUTES:
                    found += _in_text(element.get(attribute) or "", line_of(element))
    return Parsed(tuple(found))


def _in_text(text: str, line: int) -> list[ShareFile]:
    return [
        ShareFile(match[1], match[2].replace("//", "/"), line, text[: match.start()].endswith(_URL))
        for match in _NAMED.finditer(text)
    ]
