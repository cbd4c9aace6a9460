"""What a build would have made of the trees that are run, made in memory.

Messages and services of packages that Debian lacks, and configurations of dynamic_reconfigure. Python imports this by
itself when its folder is on the path. ECM_LIVE_TREE names the trees, as a path list; the lines of them that run are
noted in the file ECM_LIVE_LINES.
"""

import importlib.abc
import importlib.machinery
import os
import sys
import types

from ecm_live_definitions import KINDS, Definitions
from ecm_live_lines import note_lines
from ecm_live_reconfigured import Configurations


class Maker(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Makes `package`, `package.msg` and `package.cfg` for packages of the trees that are not installed."""

    def __init__(self, trees):
        self.trees = trees
        self.definitions = self.configurations = None

    def find_spec(self, name, path=None, target=None):
        package, _, rest = name.partition(".")
        kind, _, configuration = rest.partition(".")
        if kind and kind not in (*KINDS, "cfg"):
            return None
        if self.definitions is None:
            self.definitions, self.configurations = Definitions(self.trees), Configurations(self.trees)
        if self._is_made(package, kind, configuration):
            return importlib.machinery.ModuleSpec(
                name, self, is_package=not kind or (kind == "cfg" and not configuration)
            )
        return None

    def _is_made(self, package, kind, configuration):
        if configuration:
            return kind == "cfg" and (package, configuration) in self.configurations.files
        configured = any(package == each for each, _ in self.configurations.files)
        if kind == "cfg":
            return configured
        return any((package, each) in self.definitions.texts for each in KINDS) or (configured and not kind)

    def create_module(self, spec):
        module = types.ModuleType(spec.name)
        if spec.submodule_search_locations is not None:
            module.__path__ = []
        return module

    def exec_module(self, module):
        package, _, kind = module.__name__.partition(".")
        if ".cfg." in module.__name__:
            self.configurations.fill(module)
        if kind == "msg":
            for name in self.definitions.texts.get((package, "msg"), {}):
                self.add_message(module, package, name)
        if kind == "srv":
            for name, text in self.definitions.texts.get((package, "srv"), {}).items():
                self.add_service(module, package, name, text)

    def add_message(self, module, package, name):
        from genpy.dynamic import generate_dynamic

        try:
            made = generate_dynamic(f"{package}/{name}", self.definitions.text(package, name))
            setattr(module, name, made[f"{package}/{name}"])
        except Exception:
            pass  # a definition that is none is missing, as it would be after a build

    def add_service(self, module, package, name, text):
        from genpy.dynamic import generate_dynamic

        request, _, response = text.partition("---")
        try:
            halves = []
            for part, body in (("Request", request), ("Response", response)):
                full = f"{package}/{name}{part}"
                contained = dict.fromkeys(self.definitions.contained(package, body))
                texts = [f"{'=' * 80}\nMSG: {o}/{n}\n{self.definitions.text(o, n)}" for o, n in contained]
                halves.append(generate_dynamic(full, "\n".join([body, *texts]))[full])
        except Exception:
            return
        fields = {
            "_type": f"{package}/{name}",
            "_md5sum": "*",
            "_request_class": halves[0],
            "_response_class": halves[1],
        }
        setattr(module, name, type(name, (), fields))
        setattr(module, f"{name}Request", halves[0])
        setattr(module, f"{name}Response", halves[1])


if os.environ.get("ECM_LIVE_TREE"):
    sys.meta_path.append(Maker(os.environ["ECM_LIVE_TREE"]))
    if os.environ.get("ECM_LIVE_LINES"):
        note_lines(os.environ["ECM_LIVE_TREE"], os.environ["ECM_LIVE_LINES"])
