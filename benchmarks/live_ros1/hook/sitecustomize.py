"""Messages that Debian does not package, made in memory from the .msg and .srv files of the tree that is run.

Python imports this by itself when its folder is on the path. ECM_LIVE_TREE names the tree.
"""

import importlib.abc
import importlib.machinery
import os
import sys
import types
from pathlib import Path

KINDS = ("msg", "srv")


class Definitions:
    """Files of the tree by package and kind, and those that Debian installs."""

    def __init__(self, tree):
        self.files = {}
        for root in (Path("/usr/share"), Path(tree)):
            for kind in KINDS:
                pattern = f"*/{kind}/*.{kind}" if root == Path("/usr/share") else f"**/{kind}/*.{kind}"
                for file in root.glob(pattern):
                    self.files.setdefault((file.parent.parent.name, kind), {})[file.stem] = file

    def text(self, package, name):
        """A message with every message that it contains, as a bag holds it."""
        todo, done, parts = [(package, name)], set(), []
        while todo:
            owner, each = todo.pop(0)
            if (owner, each) in done:
                continue
            done.add((owner, each))
            body = self.files[owner, "msg"][each].read_text(encoding="utf-8", errors="replace")
            parts.append(body if not parts else f"{'=' * 80}\nMSG: {owner}/{each}\n{body}")
            todo += self.contained(owner, body)
        return "\n".join(parts)

    def contained(self, owner, body):
        for line in body.splitlines():
            word = line.partition("#")[0].split(" ")[0].split("[")[0].strip()
            package, _, name = word.rpartition("/")
            if word == "Header":
                yield "std_msgs", "Header"
            elif (package or owner, "msg") in self.files and name in self.files[package or owner, "msg"]:
                yield package or owner, name


class Maker(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Makes `package` and `package.msg` for packages of the tree that are not installed."""

    def __init__(self, tree):
        self.tree = tree
        self.definitions = None

    def find_spec(self, name, path=None, target=None):
        package, _, kind = name.partition(".")
        if kind and kind not in KINDS:
            return None
        if self.definitions is None:
            self.definitions = Definitions(self.tree)
        if any((package, each) in self.definitions.files for each in KINDS):
            return importlib.machinery.ModuleSpec(name, self, is_package=not kind)
        return None

    def create_module(self, spec):
        module = types.ModuleType(spec.name)
        if not spec.name.partition(".")[2]:
            module.__path__ = []
        return module

    def exec_module(self, module):
        package, _, kind = module.__name__.partition(".")
        if kind == "msg":
            for name in self.definitions.files.get((package, "msg"), {}):
                self.add_message(module, package, name)
        if kind == "srv":
            for name, file in self.definitions.files.get((package, "srv"), {}).items():
                self.add_service(module, package, name, file)

    def add_message(self, module, package, name):
        from genpy.dynamic import generate_dynamic

        try:
            made = generate_dynamic(f"{package}/{name}", self.definitions.text(package, name))
            setattr(module, name, made[f"{package}/{name}"])
        except Exception:
            pass  # a definition that is none is missing, as it would be after a build

    def add_service(self, module, package, name, file):
        from genpy.dynamic import generate_dynamic

        request, _, response = file.read_text(encoding="utf-8", errors="replace").partition("---")
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
