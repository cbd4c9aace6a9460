"""What the actions of a launch file change for those after them: namespace, remaps, parameters, arguments."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from ecm_parsers.launch.model import ParameterSource

from ecm_extract.system.model import Remapping, Setting, Text


@dataclass(slots=True)
class Scope:
    """The state at one action.

    Attributes:
        namespace: absolute. remaps: of the scope, in order. parameters: of the scope (ROS 2), in order.
        private: parameters of each node that starts here (ROS 1), named from the node.
        arguments, environment: values by name.
        conditions: that are known at launch only and under which everything here happens.
        outermost: state outside of all groups; None for that state itself.
    """

    namespace: str = "/"
    remaps: list[Remapping] = field(default_factory=list)
    parameters: list[ParameterSource] = field(default_factory=list)
    arguments: dict[str, Text] = field(default_factory=dict)
    environment: dict[str, Text] = field(default_factory=dict)
    conditions: tuple[str, ...] = ()
    outermost: Scope | None = None
    private: list[Setting] = field(default_factory=list)

    def inner(self) -> Scope:
        """Return a copy that a group changes without changing this one."""
        return Scope(
            self.namespace,
            list(self.remaps),
            list(self.parameters),
            dict(self.arguments),
            dict(self.environment),
            self.conditions,
            self.outermost or self,
            list(self.private),
        )

    def later(self) -> Scope:
        """Return the state for what is taken on an event, when all groups are left: namespace and remaps are gone."""
        outer = self.outermost or self
        kept = (list(outer.remaps), list(outer.parameters))
        return replace(self.inner(), namespace=outer.namespace, remaps=kept[0], parameters=kept[1])

    def under(self, condition: str) -> Scope:
        """Return the same state below a condition; changes of values go to a copy, since they may not happen."""
        return replace(self.inner(), conditions=(*self.conditions, condition))
