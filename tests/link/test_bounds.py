"""What a source makes of a value is bounded, told, and never ends the run."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.link.declaring import sites
from ecm_extract.link.folding import steps
from ecm_extract.link.running.values import MAX_LENGTH, TOO_LONG, joined, literal
from ecm_extract.tree import open_tree

_HEAD = """
from rclpy.node import Node
class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        x = "a"
"""
_BRANCH = """
        if f("a{0}") == "x":
            x = x + "1"
        else:
            x = x + "2"
"""
_PLACES = {
    "name": "        self.create_publisher(String, x, 1)\n",
    "depth": '        self.create_publisher(String, "t", x)\n',
    "profile": '        self.create_publisher(String, "t", QoSProfile(depth=1, reliability=x))\n',
    "period": "        self.create_timer(x, self.tick)\n",
    "default": '        self.declare_parameter("p", x)\n',
}
_CPP = 'class D : public rclcpp::Node {{ D() : Node("d") {{ {0} }} }};'


def _driver(workspace: Any, body: str) -> Any:
    workspace.package({"pkg/driver.py": _HEAD + body}, name="pkg")
    return extract(open_tree(workspace.root), Options(jobs=1))


@pytest.mark.parametrize("place", _PLACES)
def test_a_value_of_many_branches_is_unknown_and_told(workspace: Any, place: str) -> None:
    """Forty branches one after another have a million million values; the place that asks for them is named."""
    found = _driver(workspace, "".join(_BRANCH.format(index) for index in range(40)) + _PLACES[place])
    lines = (_HEAD + _BRANCH * 40).count("\n") + 1
    told = {(entry.code, entry.line) for entry in found.diagnostics}
    assert told <= {("values-left-out", lines)}
    assert place not in {"name", "depth"} or told


@pytest.mark.parametrize("place", _PLACES)
def test_a_value_that_doubles_ends(workspace: Any, place: str) -> None:
    """Sixty doublings of a text end like forty branches do."""
    found = _driver(workspace, "        x = x + x\n" * 60 + _PLACES[place])
    assert [module.ecm.kind for package in found.packages for module in package.modules] == ["node"]


def test_few_branches_are_all_followed(workspace: Any) -> None:
    """What is within the bounds is computed to the end."""
    found = _driver(workspace, "".join(_BRANCH.format(index) for index in range(3)) + _PLACES["name"])
    module = next(module for package in found.packages for module in package.modules)
    names = {entry.name for entry in module.signature.interfaces if entry.role == "publisher"}
    assert found.diagnostics == ()
    assert "/a111" in names


def test_a_text_longer_than_any_name_is_told_as_such() -> None:
    """Texts are put together up to a length; beyond it the value says why it is unknown."""
    half = (literal("x" * (MAX_LENGTH // 2 + 1)),)
    assert joined([half])[0].text == half[0].text
    assert joined([half, half])[0].parts == joined([half, half, half])[0].parts == (TOO_LONG,)


@pytest.mark.parametrize("number", ["1e999", "-1e999", "1e30", "9" * 5000, "0x" + "f" * 5000, "1" + "'0" * 3000])
@pytest.mark.parametrize(
    "body",
    [
        'create_publisher<std_msgs::msg::String>("t", {0});',
        'create_publisher<std_msgs::msg::String>("t", static_cast<int>({0}));',
        'declare_parameter("max_retries", {0} * 10);',
        'declare_parameter("max_retries", {0} / 3.0);',
        'auto x = {0}; auto y = x * x; declare_parameter("p", y * y); create_publisher<A>("t", y);',
        "timer_ = create_wall_timer(std::chrono::milliseconds({0}), f); rclcpp::Rate r({0});",
    ],
)
def test_a_number_beyond_all_types_is_none(workspace: Any, number: str, body: str) -> None:
    """Numbers that no type holds are no numbers, wherever one stands."""
    workspace.package({"src/d.cpp": _CPP.format(body.format(number))})
    assert workspace.modules()


def test_a_format_with_an_index_beyond_all_counts_stays(workspace: Any) -> None:
    """`{99999}` and digits of other scripts fill nothing."""
    body = "".join(f'        self.create_publisher(String, "a{{{key}}}".format(x), 1)\n' for key in ("9" * 5000, "²"))
    assert _driver(workspace, body).packages


def test_what_loops_within_loops_hand_on_ends(workspace: Any) -> None:
    """A table that two loops and methods change refers to itself in a circle; who asks where it began ends."""
    source = """
import rospy
from std_srvs.srv import Empty
class Chat:
    def __init__(self):
        rospy.init_node("chat")
        self.service = rospy.get_param("~service", "/upload")
        self.wait = rospy.get_param("~wait", 3)
    def rows(self, rows):
        for row in rows:
            for part in row.parts:
                self.one(part)
    def one(self, part):
        if part.image:
            self.upload(part.path)
    def upload(self, path):
        rospy.wait_for_service(self.service, timeout=self.wait)
        rospy.ServiceProxy(self.service, Empty)()
if __name__ == "__main__":
    chat = Chat()
    chat.rows(rospy.get_param("~rows"))
"""
    workspace.package({"scripts/chat.py": source}, ros=1)
    assert "/upload" in {entry.name for entry in workspace.interfaces()}


_ENDLESS = """
import rospy
from std_msgs.msg import String
def main():
    rospy.init_node("n")
    count = 0
    while True:
        count += 1
        {body}
        rospy.Publisher("topic%d" % count, String, queue_size=1)
main()
"""


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("rospy.sleep(1)", {"/topic1", "/topic{count}"}),
        ("if rospy.get_time() > 3: break", {"/topic1", "/topic2", "/topic{count}"}),
        ("if count == 3: break", {"/topic1", "/topic2"}),
    ],
)
def test_an_endless_loop_is_run_while_it_is_known_what_ends_it(workspace: Any, body: str, told: set[str]) -> None:
    """Rounds of `while True` tell nothing new when nothing ends the loop, or nobody knows when that happens."""
    workspace.package({"scripts/n.py": _ENDLESS.format(body=body)}, ros=1)
    assert {entry.name for entry in workspace.interfaces() if entry.role == "publisher"} == told


@pytest.mark.parametrize(
    "loop",
    [
        "do { ++i; name += std::to_string(i); } while (0);",
        "do { ++i; name += std::to_string(i); } while (false);",
        'while (false) { name = "never"; } name += "1";',
        'while (0) { name = "never"; } name += "1";',
    ],
)
def test_a_loop_that_asks_what_never_holds_ends_at_once(workspace: Any, loop: str) -> None:
    """`do ... while (0)` is run once, and `while (false)` never: neither is a loop without an end."""
    body = f'std::string name = "t"; int i = 0; {loop} create_publisher<std_msgs::msg::String>(name, 1);'
    workspace.package({"src/d.cpp": _CPP.format(body)})
    assert [entry.name for entry in workspace.interfaces() if entry.role == "publisher"] == ["/t1"]


_DATA = """
import rospy
from std_msgs.msg import String
class Data:
    def work(self, size):
        found = []
        for i in range(60):
            for k in range(60):
                found.append(i * k + size + len(found))
        return found
    def ask(self):
{asked}
    def __init__(self):
        rospy.init_node("n")
        rospy.Publisher("a" + "b", String, queue_size=1)
        self.ask()
Data()
"""


def test_a_function_that_works_on_data_costs_the_others_nothing(
    workspace: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What one function may take is bounded and told, whatever it is handed; names elsewhere are computed as before."""
    monkeypatch.setattr(steps, "MAX_FUNCTION", 1_500)
    asked = "".join(
        f'        if self.work({size})[3] == 4:\n            rospy.Publisher("s{size}", String)\n' for size in range(20)
    )
    workspace.package({"scripts/n.py": _DATA.format(asked=asked)}, ros=1)
    found = extract(open_tree(workspace.root), Options(jobs=1))
    interfaces = [
        each for package in found.packages for module in package.modules for each in module.signature.interfaces
    ]
    assert {"/ab", "/s0", "/s19"} <= {entry.name for entry in interfaces}
    [told] = [entry for entry in found.diagnostics if entry.code == "function-left-out"]
    assert (told.line, told.message.split(",")[0]) == (5, "work takes too many steps to be followed to its end: values")
    assert [entry.reason for entry in found.unread] == ["unfollowed"]


def test_a_run_that_has_no_steps_left_is_a_gap(workspace: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing behind the bound of all is computed: which endpoints are missing nobody knows."""
    monkeypatch.setattr(steps, "LEAST_RUN", 20)
    monkeypatch.setattr(steps, "MAX_PER_STATEMENT", 0)
    found = _driver(workspace, _PLACES["name"] * 40)
    assert [entry.reason for entry in found.unread] == ["unfollowed"]
    assert [entry.code for entry in found.diagnostics if "all steps" in entry.message] == ["function-left-out"]


@pytest.mark.parametrize(("count", "is_told"), [(4, False), (40, True)])
def test_a_name_behind_too_many_functions_is_told(workspace: Any, count: int, is_told: bool) -> None:
    """A bound that ends the search for a name is a gap on its line: nobody knows which endpoint it is."""
    helpers = [f'std::string f{at}(std::string x) {{ return f{at + 1}(x + "a"); }}\n' for at in reversed(range(count))]
    made = _CPP.format('create_publisher<std_msgs::msg::String>(f0("n"), 1);')
    source = f"std::string f{count}(std::string x) {{ return x; }}\n" + "".join(helpers) + made
    workspace.package({"src/d.cpp": source})
    found = extract(open_tree(workspace.root), Options(jobs=1))
    told = [(entry.code, entry.line) for entry in found.diagnostics]
    assert told == [("values-left-out", count + 2)] * is_told
    assert [entry.reason for entry in found.unread] == ["unfollowed"] * is_told


@pytest.mark.parametrize(("calls", "is_told"), [(3, False), (4, True)])
def test_callers_that_are_too_far_out_are_told(
    workspace: Any, monkeypatch: pytest.MonkeyPatch, calls: int, is_told: bool
) -> None:
    """A name that comes through more calls than are followed is open, and its place is a gap."""
    monkeypatch.setattr(sites, "MAX_CHAIN", 3)
    head = "void f0(rclcpp::Node & n, std::string t) { n.create_publisher<std_msgs::msg::String>(t, 1); }\n"
    chain = "".join(f"void f{n}(rclcpp::Node & n, std::string t) {{ f{n - 1}(n, t); }}\n" for n in range(1, calls))
    body = _CPP.format(f'f{calls - 1}(*this, "name");')
    workspace.package({"src/d.cpp": head + chain + body})
    found = extract(open_tree(workspace.root), Options(jobs=1))
    assert [(each.code, each.line) for each in found.diagnostics] == [("values-left-out", 1)] * is_told
    assert ("/name" in {entry.name for entry in workspace.interfaces()}) is not is_told


def test_tests_behind_tests_that_nothing_passes_end(workspace: Any) -> None:
    """What a variable holds where no run comes has no way left of it: asking for that went on until the stack ended."""
    body = """
        if f() == 1:
            x = "b"
        if x == "c":
            if f() == 2:
                if x == "d":
                    return
            self.create_publisher(String, x + "/never", 1)
        self.create_publisher(String, x + "/live", 1)
"""
    found = _driver(workspace, body)
    names = {
        entry.name for package in found.packages for each in package.modules for entry in each.signature.interfaces
    }
    assert found.diagnostics == ()
    assert {"/a/live", "/b/live"} <= names


def test_classes_that_chains_of_functions_give_end(workspace: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """What each of eleven functions gives is what the next one gives, by any of six calls: a class that ends as open."""
    monkeypatch.setattr(steps, "MAX_QUESTION", 300)
    calls = "".join(f"    if f({index}):\n        return kind{{0}}({index})\n" for index in range(6))
    chain = "".join(
        f"def kind{index}(at):\n{calls.format(index + 1)}    return kind{index + 1}(6)\n" for index in range(11)
    )
    ask = "        self.create_publisher(kind0(x), 'a', 1)\n"
    source = f"from std_msgs.msg import String\n{chain}def kind11(at):\n    return String\n{_HEAD}{ask}"
    workspace.package({"pkg/driver.py": source})
    assert "/a" in {entry.name for entry in workspace.interfaces()}


def test_names_of_all_rounds_are_told_without_a_doubt(workspace: Any) -> None:
    """Eighteen names of nine rounds are all told, though no one state has so many: nothing of them is left out."""
    body = """
        mode = self.get_parameter("mode").value
        for each in ["a", "b", "c", "d", "e", "f", "g", "h", "i"]:
            if mode == "deep":
                name = "deep_" + each
            else:
                name = each
            self.create_publisher(String, name, 1)
"""
    found = _driver(workspace, body)
    names = {
        entry.name for package in found.packages for each in package.modules for entry in each.signature.interfaces
    }
    assert {f"/{prefix}{each}" for prefix in ("", "deep_") for each in "abcdefghi"} <= names
    assert found.diagnostics == ()
