"""The regular-expression oracle finds API call sites and nothing else."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import msgspec
import pytest
from extracted import Extraction, Index
from site_oracle import EXCLUSIONS, Site, load_rows, scan
from sites import judge, missing, oracle, share, table
from source_files import Source, generations, walk

CPP2 = [
    ('pub_ = create_publisher<std_msgs::msg::String>("a", 10);', "create_publisher"),
    ("pub_ = node->template create_publisher<T>(name, qos);", "create_publisher"),
    ('this->create_subscription<A<B, C>>(\n  "x",\n  10, cb);', "create_subscription"),
    ("return rclcpp::create_service<T>(base, name, cb);", "create_service"),
    ('c = rclcpp_action::create_client<Fibonacci>(this, "f");', "create_client"),
    ('s = rclcpp_action::create_server<F>(this, "f", a, b, c);', "action server"),
    ('if (ok && declare_parameter<bool>("x", true)) {}', "declare_parameter"),
    ('sub_.subscribe(node, "scan", qos);', "subscribe, advertise"),
    ('auto s = std::make_shared<message_filters::Subscriber<M>>(n, "t");', "message_filters"),
    ("tf_->sendTransform(msg);", "tf broadcast"),
    ("b_ = std::make_unique<tf2_ros::TransformBroadcaster>(*this);", "tf broadcaster object"),
    ("tf2_ros::TransformListener listener(buffer);", "tf listener object"),
    ("buffer.lookupTransform(a, b, tf2::TimePointZero);", "tf lookup"),
]
CPP1 = [
    ('p = nh.advertise<std_msgs::String>("a", 1);', "advertise"),
    ('s = nh->subscribe("a", 1, &C::cb, this);', "subscribe"),
    ('nh.param<int>("rate", rate, 10);', "param, getParam"),
    ('ros::param::get("/rate", rate);', "param, getParam"),
    ('v = nh.advertiseService("s", cb);', "advertiseService"),
    ('v = nh.serviceClient<S>("s");', "serviceClient"),
    ('actionlib::SimpleActionServer<A> as(nh, "go", cb, false);', "SimpleActionServer"),
    ('c_ = new actionlib::SimpleActionClient<A>("go", true);', "SimpleActionClient"),
    ("tf::TransformListener listener_;", "tf listener object"),
]
PYTHON2 = [
    ("self.p = self.create_publisher(String, 'a', 10)", "py create_publisher"),
    ("self.c = ActionClient(self, Fibonacci, 'f')", "py ActionClient"),
    ("self.declare_parameter('x', 1)", "py declare_parameter"),
    ("buf.lookup_transform('a', 'b', t)", "py tf lookup"),
]
PYTHON1 = [
    ("p = rospy.Publisher('a', String)", "rospy.Publisher"),
    ("r = rospy.get_param('~rate', 10)", "rospy.get_param"),
    ("s = rospy.ServiceProxy(\n    'a',\n    Empty)", "rospy.ServiceProxy"),
]
LEFT_OUT = [
    ("cpp", '// pub_ = create_publisher<A>("a", 10);', "comment_or_string"),
    ("cpp", 'log("create_publisher(x) failed");', "comment_or_string"),
    ("cpp", 'auto s = R"(create_publisher(x))";', "comment_or_string"),
    ("cpp", "std::shared_ptr<P>\nFoo<T>::create_publisher(int a) {}", "definition"),
    ("cpp", "virtual Pub & create_publisher(int a);", "definition"),
    ("cpp", "using Base::create_publisher;", "no_call"),
    ("cpp", "sub_.subscribe();", "too_few_arguments"),
    ("cpp", "subscribe(a, b);", "not_a_method"),
    ("cpp", "std::shared_ptr<tf2_ros::TransformListener> l_;", "type_mention"),
    ("python", "def create_publisher(self, a, b):", "definition"),
    ("python", "# self.create_publisher(A, 'a', 1)", "comment_or_string"),
    ("python", "'''self.create_publisher(A, 'a', 1)'''", "comment_or_string"),
]


def _scan(text: str, lang: str = "cpp", ros: int = 2) -> tuple[list[Site], Counter[str]]:
    excluded: Counter[str] = Counter()
    return list(scan(Source("a", lang, frozenset({ros}), text), load_rows(), excluded)), excluded


@pytest.mark.parametrize(
    ("text", "form", "lang", "ros"),
    [(*case, "cpp", 2) for case in CPP2]
    + [(*case, "cpp", 1) for case in CPP1]
    + [(*case, "python", 2) for case in PYTHON2]
    + [(*case, "python", 1) for case in PYTHON1],
)
def test_a_call_is_one_site_of_its_form(text: str, form: str, lang: str, ros: int) -> None:
    """Every form of the table is seen once in the way that real code writes it."""
    sites, _ = _scan(text, lang, ros)
    assert [site.row.form for site in sites] == [form]


@pytest.mark.parametrize(("lang", "text", "reason"), LEFT_OUT)
def test_a_lookalike_is_left_out_for_a_named_reason(lang: str, text: str, reason: str) -> None:
    """Whatever is not a call is counted under the rule that left it out."""
    sites, excluded = _scan(text, lang)
    assert sites == []
    assert set(excluded) == {reason}
    assert reason in EXCLUSIONS


def test_a_site_spans_its_receiver_and_its_arguments() -> None:
    """Evidence may point at the first line of the statement's call chain or at any line of the call."""
    sites, _ = _scan('int a; // x\npub_ = node_\n  ->create_publisher<A>(\n    "a",\n    10);\n')
    assert [(site.line, site.end_line) for site in sites] == [(2, 5)]
    assert sites[0].text == "->create_publisher<A>("


def test_ros_1_forms_are_not_sought_in_ros_2_packages() -> None:
    """`param(` means nothing in ROS 2."""
    assert _scan('nh.param("a", b, 1);', ros=2)[0] == []


def test_the_generation_comes_from_the_manifest(tmp_path: Path) -> None:
    """A package may be of ROS 1, of ROS 2 or of both."""
    manifest = tmp_path / "package.xml"
    for text, expected in (
        ("<buildtool_depend>catkin</buildtool_depend>", {1}),
        ("<!-- <depend>catkin</depend> --><depend>rclcpp</depend>", {2}),
        ("<depend>roscpp</depend><depend>rclcpp</depend>", {1, 2}),
        ("<name>x</name>", {1, 2}),
    ):
        manifest.write_text(text)
        assert generations(manifest) == expected


def _is_test(path: str, root: str) -> bool:
    return path.startswith(f"{root}/test/")


def _package(root: Path) -> None:
    (root / "src").mkdir()
    (root / "test").mkdir()
    (root / "package.xml").write_text("<depend>rclcpp</depend>")
    (root / "src" / "a.cpp").write_text('\np = create_publisher<A>("a", 1);\nq = create_publisher<A>(b, 1);\n')
    (root / "test" / "a.cpp").write_text('create_publisher<A>("a", 1);')


def test_files_left_out_are_counted(tmp_path: Path) -> None:
    """Test code and files outside any package are not sites, and the reader is told how many."""
    (tmp_path / "pkg").mkdir()
    _package(tmp_path / "pkg")
    (tmp_path / "loose.py").write_text("")
    skipped: Counter[str] = Counter()
    found = [source.path for source in walk(tmp_path, _is_test, skipped)]
    assert found == ["pkg/src/a.cpp"]
    assert skipped == {"test_code": 1, "in_no_package": 1}


def test_sites_are_compared_with_the_json_of_an_extraction(tmp_path: Path) -> None:
    """Found, typed and named are counted apart, whether paths are of the tree or of the package."""
    (tmp_path / "pkg").mkdir()
    _package(tmp_path / "pkg")
    interface = {
        "role": "publisher",
        "name": "/a",
        "type": None,
        "confidence": "literal",
        "evidence": [{"path": "pkg/src/a.cpp", "line": 2}],
    }
    module = {"ecm": {"module_id": "ecm.pkg.a"}, "signature": {"interfaces": [interface]}}
    document = {
        "schema": "ecm-extract/extract/1",
        "packages": [{"name": "pkg", "path": "pkg", "modules": [module]}],
    }
    index = Index(msgspec.convert(document, Extraction))
    sites, _, _ = oracle(tmp_path, _is_test)
    results = [judge(site, index) for site in sites]
    assert [missing(one) for one in results] == [["typed"], ["found"]]
    assert msgspec.to_builtins(share(results)) == {
        "sites": 2,
        "found": 1,
        "typed": 0,
        "typable": 2,
        "named": 1,
    }
    assert dict(table(results))["TOTAL"] == share(results)
