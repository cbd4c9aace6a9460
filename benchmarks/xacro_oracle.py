"""What xacro makes of descriptions: `xacro_oracle.py PACKAGES.json`, files on standard input, one JSON line each.

PACKAGES.json maps the packages of a tree to their folders; others are not there, as for our reader.
"""

from __future__ import annotations

import io
import json
import signal
import sys
import types
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any
from xml.dom.minidom import Element

LIMIT_S = 30


def main() -> None:
    packages = json.loads(Path(sys.argv[1]).read_text())
    _stand_in(packages)
    import xacro

    signal.signal(signal.SIGALRM, _expired)
    for line in sys.stdin:
        path = line.rstrip("\n")
        signal.alarm(LIMIT_S)
        try:
            with redirect_stdout(io.StringIO()):
                document = xacro.process_file(path)
            answer: dict[str, Any] = _facts(document.documentElement)
        except BaseException as error:
            answer = {"refused": f"{type(error).__name__}: {error}"[:300]}
        signal.alarm(0)
        print("\x1e" + json.dumps(answer), flush=True)


def _stand_in(packages: dict[str, str]) -> None:
    """What xacro asks for the folder of a package."""
    outer, inner = types.ModuleType("ament_index_python"), types.ModuleType("ament_index_python.packages")

    def get_package_share_directory(name: str) -> str:
        return packages[name]

    inner.get_package_share_directory = get_package_share_directory  # type: ignore[attr-defined]
    inner.PackageNotFoundError = KeyError  # type: ignore[attr-defined]
    sys.modules |= {"ament_index_python": outer, "ament_index_python.packages": inner}


def _expired(signum: int, frame: object) -> None:
    raise TimeoutError


def _facts(root: Element) -> dict[str, Any]:
    return {
        "links": sorted(child.getAttribute("name") for child in _children(root, "link")),
        "joints": sorted(_joint(child) for child in _children(root, "joint")),
        "control": sorted(_control(child) for child in _children(root, "ros2_control")),
    }


def _children(element: Element, tag: str) -> list[Element]:
    return [child for child in element.childNodes if isinstance(child, Element) and child.tagName == tag]


def _joint(element: Element) -> list[str]:
    ends = [_children(element, tag) for tag in ("parent", "child")]
    return [element.getAttribute("name"), element.getAttribute("type"), *(_link(each) for each in ends)]


def _link(found: list[Element]) -> str:
    return found[0].getAttribute("link") if found else ""


def _control(element: Element) -> list[Any]:
    plugins = [plugin for hardware in _children(element, "hardware") for plugin in _children(hardware, "plugin")]
    plugin = "".join(node.data for node in plugins[0].childNodes if node.nodeType == node.TEXT_NODE) if plugins else ""
    parts = [
        [kind, part.getAttribute("name"), _names(part, "command_interface"), _names(part, "state_interface")]
        for kind in ("joint", "sensor", "gpio")
        for part in _children(element, kind)
    ]
    return [element.getAttribute("name"), element.getAttribute("type"), plugin.strip(), sorted(parts)]


def _names(part: Element, tag: str) -> list[str]:
    return sorted(child.getAttribute("name") for child in _children(part, tag))


if __name__ == "__main__":
    main()
