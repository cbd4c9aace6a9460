"""What a Python launch file may call."""

from __future__ import annotations

from ecm_parsers.launch.actions import ACTIONS
from ecm_parsers.launch.substitutions import SUBSTITUTIONS
from ecm_parsers.python.library import CONSTANTS, LIBRARY, LOADERS, TABLES
from ecm_parsers.python.models import Models
from ecm_parsers.python.values import as_str

LAUNCH = Models(
    calls={**LIBRARY, **SUBSTITUTIONS, **ACTIONS},
    tables={
        **TABLES,
        "launch_configurations": lambda given: as_str(SUBSTITUTIONS["LaunchConfiguration"](given)),
    },
    loaders={**LOADERS, "load_python_launch_file_as_module": 0},
    constants=CONSTANTS,
    outside=frozenset({"launch", "launch_ros", "launch_xml", "launch_yaml", "launch_testing", "ament_index_python"}),
)
