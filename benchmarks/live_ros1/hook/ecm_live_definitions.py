"""Definitions of messages and services of trees, as a build would make classes of them."""

import os
import xml.etree.ElementTree as ElementTree
from pathlib import Path

INSTALLED = Path("/usr/share")
KINDS = ("msg", "srv")
# What genaction.py of actionlib_msgs makes of the three parts of an action.
ACTION = {
    "Goal": "{0}",
    "Result": "{1}",
    "Feedback": "{2}",
    "ActionGoal": "Header header\nactionlib_msgs/GoalID goal_id\n{name}Goal goal",
    "ActionResult": "Header header\nactionlib_msgs/GoalStatus status\n{name}Result result",
    "ActionFeedback": "Header header\nactionlib_msgs/GoalStatus status\n{name}Feedback feedback",
    "Action": "{name}ActionGoal action_goal\n{name}ActionResult action_result\n{name}ActionFeedback action_feedback",
}


def package_of(file):
    """Name of the package that holds a file: by its package.xml, else the folder below which an installation has it."""
    described = (each / "package.xml" for each in file.parents)
    found = next((each for each in described if each.exists()), None)
    try:
        return ElementTree.parse(found).getroot().findtext("name").strip()
    except (TypeError, AttributeError, ElementTree.ParseError):
        return file.parent.parent.name


class Definitions:
    """Texts of the trees by package and kind, and those that Debian installs.

    trees: a path list.
    """

    def __init__(self, trees):
        self.texts = {}
        for kind in (*KINDS, "action"):
            self._add(kind, INSTALLED.glob(f"*/{kind}/*.{kind}"))
            for tree in trees.split(os.pathsep):
                self._add(kind, Path(tree).glob(f"**/{kind}/*.{kind}"))

    def _add(self, kind, files):
        for file in files:
            package, text = package_of(file), file.read_text(encoding="utf-8", errors="replace")
            if kind == "action":
                self._add_action(package, file.stem, text)
            else:
                self.texts.setdefault((package, kind), {})[file.stem] = text

    def _add_action(self, package, name, text):
        parts = [*text.split("\n---"), "", ""]
        for part, form in ACTION.items():
            self.texts.setdefault((package, "msg"), {})[name + part] = form.format(*parts[:3], name=name)

    def text(self, package, name):
        """A message with every message that it contains, as a bag holds it."""
        todo, done, parts = [(package, name)], set(), []
        while todo:
            owner, each = todo.pop(0)
            if (owner, each) in done:
                continue
            done.add((owner, each))
            body = self.texts[owner, "msg"][each]
            parts.append(body if not parts else f"{'=' * 80}\nMSG: {owner}/{each}\n{body}")
            todo += self.contained(owner, body)
        return "\n".join(parts)

    def contained(self, owner, body):
        for line in body.splitlines():
            word = (line.partition("#")[0].split() or [""])[0].split("[")[0]
            package, _, name = word.rpartition("/")
            if word == "Header":
                yield "std_msgs", "Header"
            elif name in self.texts.get((package or owner, "msg"), {}):
                yield package or owner, name
