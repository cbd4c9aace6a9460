"""Configurations of dynamic_reconfigure, from the .cfg files of trees, which are programs: they are run."""

import os
import runpy
import sys
import types
from pathlib import Path

from ecm_live_definitions import package_of


class Configurations:
    """Files by the package that holds them and the name of what they describe."""

    def __init__(self, trees):
        files = (file for tree in trees.split(os.pathsep) for file in Path(tree).glob("**/*.cfg"))
        self.files = {(package_of(file), file.stem + "Config"): file for file in files}

    def fill(self, module):
        """Give a module what the installed one of that name would hold."""
        package, _, name = module.__name__.partition(".cfg.")
        made = described(self.files[package, name])
        vars(module).update(vars(made))


def described(file):
    """What a .cfg file describes, by the generator of dynamic_reconfigure without the files that it would write."""
    from dynamic_reconfigure import parameter_generator_catkin as generator
    from dynamic_reconfigure.encoding import extract_params

    found = types.SimpleNamespace(min={}, max={}, defaults={}, level={}, type={}, all_level=0)

    def generate(self, _package, _node, name):
        found.config_description = self.replace_infinity(self.group.to_dict())
        for each in self.constants:
            setattr(found, f"{name}_{each['name']}", each["value"])

    kept, line = generator.ParameterGenerator.generate, sys.argv
    generator.ParameterGenerator.generate, sys.argv = generate, [str(file), "", "", "", ""]
    try:
        runpy.run_path(str(file), run_name="__main__")
    except SystemExit:
        pass  # these files end so
    finally:
        generator.ParameterGenerator.generate, sys.argv = kept, line
    for each in extract_params(found.config_description):
        for key, column in (
            ("min", "min"),
            ("max", "max"),
            ("defaults", "default"),
            ("level", "level"),
            ("type", "type"),
        ):
            getattr(found, key)[each["name"]] = each[column]
        found.all_level |= each["level"]
    return found
