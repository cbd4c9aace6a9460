"""The facts of a tree, by package."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from ecm_parsers.behavior_tree import BehaviorTreeFile
from ecm_parsers.cmake_facts import CmakeFile
from ecm_parsers.controllers_yaml import ControllerFile
from ecm_parsers.diagnostics_yaml import DiagnosticsFile
from ecm_parsers.dynamic_reconfigure import ReconfigureFile
from ecm_parsers.interface_facts import Definition
from ecm_parsers.overlay_yaml import Overlay
from ecm_parsers.package_facts import Manifest
from ecm_parsers.parameter_library import ParameterNamespace
from ecm_parsers.plugin_xml import PluginClass
from ecm_parsers.python_setup_facts import PythonSetup
from ecm_parsers.recorder_topics import Recorder
from ecm_parsers.source.facts import SourceFile
from ecm_parsers.sros_policy import Grant

from ecm_extract.discover import PackageRoot


@dataclass(slots=True)
class PackageFacts:
    """What the files of one package declare, each by its path in the tree.

    Attributes:
        root: the package's folder and files.
        manifest: of `package.xml`; None when there is none or it cannot be read.
        ros: 1 or 2; None when no artefact tells.
        controllers: what YAML files say of ros2_control. aggregators: of diagnostics. recorders: of bags.
        trees: behaviour trees. grants: of SROS 2 policies.
        overlay: path and content of `ecm.yaml`; None without one.
    """

    root: PackageRoot
    manifest: Manifest | None = None
    ros: int | None = None
    cmake: dict[str, CmakeFile] = field(default_factory=dict)
    setups: dict[str, PythonSetup] = field(default_factory=dict)
    interfaces: dict[str, Definition] = field(default_factory=dict)
    plugins: dict[str, tuple[PluginClass, ...]] = field(default_factory=dict)
    parameters: dict[str, tuple[ParameterNamespace, ...]] = field(default_factory=dict)
    reconfigure: dict[str, ReconfigureFile] = field(default_factory=dict)
    sources: dict[str, SourceFile] = field(default_factory=dict)
    controllers: dict[str, ControllerFile] = field(default_factory=dict)
    aggregators: dict[str, DiagnosticsFile] = field(default_factory=dict)
    recorders: dict[str, tuple[Recorder, ...]] = field(default_factory=dict)
    trees: dict[str, BehaviorTreeFile] = field(default_factory=dict)
    grants: dict[str, tuple[Grant, ...]] = field(default_factory=dict)
    overlay: tuple[str, Overlay] | None = None

    @property
    def name(self) -> str:
        """Name of the package: of its manifest, else of its build, else of its folder as the tree gives it."""
        if self.manifest is not None and self.manifest.name:
            return self.manifest.name
        project = next((file.project for file in self.cmake.values() if file.project), None)
        return project or self.root.folder or "package"


def function_count(packages: Iterable[PackageFacts]) -> int:
    """How many functions the sources of packages define, which says how long linking them takes."""
    return sum(len(source.functions) for facts in packages for source in facts.sources.values())
