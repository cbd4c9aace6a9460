"""LNT062: a simulated camera publishes an image and the camera info of it in different namespaces."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.xml_tree import children, line_of, text_of
from lxml import etree

from ecm_extract.lint.robot_files import root_of
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT062",
    name="camera_info_apart",
    dimension="signature",
    severity="warning",
    who="graph",
    consequence="programs look for the camera info beside the image and wait for ever",
    resolution="give both topics the same namespace",
)
_FILES: Final = (".urdf", ".xacro", ".gazebo", ".sdf", ".world")
_PAIRS: Final = (
    ("imageTopicName", "cameraInfoTopicName"),
    ("depthImageTopicName", "depthImageCameraInfoTopicName"),
)
"""Parameters of the camera plugins of gazebo_ros: the topic of an image, and that of its camera info."""
_NAMESPACES: Final = ("robotNamespace", "cameraName")
"""Parameters below which such a plugin puts relative topics, outermost first."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Compare the namespaces of both topics of each camera plugin, as far as they are written."""
    for package in workspace.packages:
        for entry in package.root.files:
            if entry.path.endswith(_FILES) and not is_test_path(entry.path, package.root.path):
                root = root_of(entry.path, workspace)
                for plugin in root.iter("plugin") if root is not None else ():
                    yield from _of(plugin, entry.path, package.name)


def _of(plugin: etree._Element, path: str, package: str) -> Iterator[Finding]:
    topics = dict(children(plugin))
    for image_tag, info_tag in _PAIRS:
        if image_tag in topics and info_tag in topics:
            image, info = text_of(topics[image_tag]), text_of(topics[info_tag])
            if _are_apart(*_placed((image, info), topics)):
                text = f"the camera publishes images on {image} and their camera info on {info}"
                lines = [Evidence(path, line_of(topics[tag])) for tag in (image_tag, info_tag)]
                yield RULE.finding(text, Entity("topic", image, info), package, lines, certainty="likely")


def _placed(names: tuple[str, str], parameters: dict[str, etree._Element]) -> tuple[str, str]:
    """Both topics where the plugin puts them: a relative one below the namespace of its camera.

    Without such a namespace nothing tells where a relative topic lies beside an absolute one: both are empty then.
    """
    if len({name.startswith("/") for name in names}) == 1:
        return names
    around = [text_of(parameters[tag]).strip("/") for tag in _NAMESPACES if tag in parameters]
    base = "/".join(filter(None, around))
    image, info = (name if name.startswith("/") else f"/{base}/{name}" for name in names)
    return (image, info) if base else ("", "")


def _are_apart(image: str, info: str) -> bool:
    """Whether two topics lie in different namespaces; one that xacro computes may be any."""
    spaces = {topic.strip("/").rpartition("/")[0] for topic in (image, info)}
    return bool(image and info) and len(spaces) > 1 and not any("$" in space for space in spaces)
