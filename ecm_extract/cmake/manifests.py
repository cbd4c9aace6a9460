"""What a build takes from the package.xml beside its CMakeLists.txt, instead of writing it once more."""

from __future__ import annotations

import posixpath

from ecm_parsers.package_facts import Manifest
from ecm_parsers.package_xml import parse, ros_versions

from ecm_extract.cmake.files import BuildFiles


def manifest_of(files: BuildFiles, folder: str) -> Manifest | None:
    """Return the package.xml of a folder; None where none can be read that names a package."""
    path = posixpath.join(folder, "package.xml")
    data = files.read(path) if files.has(path) else None
    manifest = parse(data).facts if data is not None else None
    return manifest if manifest is not None and manifest.name else None


def project_of(files: BuildFiles, folder: str) -> str | None:
    """The name that the project of a folder must have: catkin and ament refuse one that differs from package.xml.

    Source: catkin cmake/catkin_package_xml.cmake, ament_cmake_core ament_package_xml.cmake.
    """
    manifest = manifest_of(files, folder)
    return manifest.name if manifest is not None and ros_versions(manifest) else None
