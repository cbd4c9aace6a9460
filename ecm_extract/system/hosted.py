"""What runs in the process of a controller manager: its controllers and its hardware, under its remaps.

Sources: control.ros.org "Controller Manager" and the pages of gz_ros2_control and gazebo_ros2_control.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ecm_extract.description.model import Description
from ecm_extract.system.controllers import Controller
from ecm_extract.system.model import Instance, Launched, Place, Remapping
from ecm_extract.system.names import absolute
from ecm_extract.system.programs import programs


class Hosts:
    """The controller managers of a launch: programs of their own, or plugins of a simulator."""

    def __init__(self, launched: Launched, robots: Sequence[Description]) -> None:
        manager = programs().manager
        started = launched.instances
        self._managers = [entry for entry in started if entry.executable in manager.executables and entry.ros == 2]
        self._simulators = [entry for entry in started if entry.ros == 1 and entry.package == manager.simulator]
        self._robots = robots
        self._settings = tuple(entry for instance in launched.instances for entry in instance.settings)

    def controller(self, controller: Controller) -> Instance:
        """Return a controller as an instance of its manager's process."""
        return Instance(
            kind="controller",
            package=controller.type.partition("/")[0],
            executable="",
            plugin=controller.type,
            name=controller.name,
            namespace=controller.namespace,
            ros=controller.ros,
            place=controller.place,
            remaps=self._remaps(controller.namespace),
            settings=self._settings,
            container="controller_manager",
            conditional=controller.conditional,
        )

    def hardware(self) -> Iterator[Instance]:
        """Yield the hardware of the robots, each once, as instances of the process that holds it."""
        found: set[tuple[str, str]] = set()
        for manager in self._managers:
            for entry in (entry for robot in self._robots for entry in robot.hardware):
                if (entry.plugin, manager.namespace) not in found:
                    found.add((entry.plugin, manager.namespace))
                    yield Instance(
                        kind="hardware",
                        package=entry.plugin.partition("/")[0],
                        executable="",
                        plugin=entry.plugin,
                        name=None,
                        namespace=manager.namespace,
                        ros=2,
                        place=Place(*entry.where),
                        remaps=manager.remaps,
                        container="controller_manager",
                        conditional=manager.conditional,
                    )

    def _remaps(self, namespace: str) -> tuple[Remapping, ...]:
        own: Iterable[tuple[Remapping, ...]] = (each.remaps for each in self._managers if each.namespace == namespace)
        return next(iter(own), None) or (*self._of_plugins(), *self._of_simulators())

    def _of_simulators(self) -> Iterator[Remapping]:
        """Remaps of a simulator of ROS 1, whose process holds the controllers, as seen from anywhere."""
        for entry in self._simulators:
            for remap in entry.remaps:
                source, target = (absolute(name, entry.namespace, "") for name in (remap.source, remap.target))
                yield Remapping(source, target, remap.place)

    def _of_plugins(self) -> Iterator[Remapping]:
        for robot in self._robots:
            for plugin in robot.plugins:
                if programs().manager.library in plugin.library:
                    for source, target in plugin.remaps:
                        yield Remapping(source, target, Place(*plugin.where))
