"""What Debian's roslaunch reads of launch files: run by /usr/bin/python3, files on standard input, one JSON line each.

Commands that launch files name are not run: what they would print is unknown to both sides.
"""

import json
import os
import signal
import sys

import roslaunch.config
import roslaunch.loader
import roslaunch.substitution_args
import roslaunch.xmlloader
from rosgraph.names import resolve_name

COMMAND = "<what a command prints>"
CALLER = "/roslaunch"  # who sets the parameters of launch files, of whom a private one is
LIMIT_S = 20


class Loader(roslaunch.xmlloader.XmlLoader):
    """The loader, but for commands."""

    def param_value(self, verbose, name, ptype, value, textfile, binfile, command):
        if value is None and textfile is None and binfile is None and command is not None:
            return COMMAND
        if value is None and (textfile or binfile):
            # What the file holds is of no use to a contract: both readers name it.
            return f"<content of {os.path.realpath(textfile or binfile)}>"
        return super().param_value(verbose, name, ptype, value, textfile, binfile, command)

    def load_rosparam(self, context, ros_config, cmd, param, file_, text, verbose=True, subst_function=None):
        """`rosparam command="dump"` would write a file when it runs."""
        if cmd != "dump":
            super().load_rosparam(context, ros_config, cmd, param, file_, text, verbose, subst_function)


def anonymous(identity):
    """A name that is the same in each run."""
    return f"{identity}_{{anon}}"


def read(path):
    config = roslaunch.config.ROSLaunchConfig()
    Loader().load(path, config, argv=[], verbose=False)
    nodes = [
        {
            "package": node.package,
            "type": node.type,
            "name": node.namespace + (node.name or ""),
            "remaps": dict(node.remap_args),
        }
        for node in config.nodes
    ]
    params = {resolve_name(name, CALLER): plain(param.value) for name, param in config.params.items()}
    return {"nodes": nodes, "params": params}


def plain(value):
    if isinstance(value, (str, int, float, bool, list, dict)) or value is None:
        return value
    return str(type(value).__name__)


def expired(signum, frame):
    raise TimeoutError


def main():
    roslaunch.substitution_args.rosgraph.names.anonymous_name = anonymous
    signal.signal(signal.SIGALRM, expired)
    for line in sys.stdin:
        path = line.rstrip("\n")
        signal.alarm(LIMIT_S)
        try:
            answer = read(path)
        except BaseException as error:
            answer = {"refused": f"{type(error).__name__}: {error}"[:300]}
        signal.alarm(0)
        print("\x1e" + json.dumps(answer, default=str), flush=True)


if __name__ == "__main__":
    main()
