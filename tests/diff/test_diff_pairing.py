"""Which old entity is which new one."""

from __future__ import annotations

import pytest
from ecm_checker.hub.provision import ALIAS, Form, Provision
from ecm_checker.match.hierarchy import Bases
from pairs_of_sides import entity, paired, shown

from ecm_extract.diff.effects import type_changed
from ecm_extract.diff.model import Pair


def test_a_plural_is_a_rename_with_a_reason() -> None:
    """Gone and new, alike, of one owner: renamed, and the reason says why."""
    pairs = paired(
        [entity("parameter", "checker_plugin", type="string")],
        [entity("parameter", "checker_plugins", type="string_array")],
    )
    assert shown(pairs) == [("checker_plugin", "checker_plugins", "renamed")]
    assert pairs[0].reason
    assert 0.6 < pairs[0].confidence < 1


def test_another_nesting_of_other_words_is_no_rename() -> None:
    """`a.plugin` of an instance is not the list `a_plugins`."""
    pairs = paired([entity("parameter", "checker.plugin")], [entity("parameter", "checker_plugins")])
    assert {pair.how for pair in pairs} == {"same"}
    assert len(pairs) == 2


def test_the_same_last_name_and_type_is_a_rename_across_files() -> None:
    """A topic that moved below another prefix is found by its type and its last name."""
    message = "sensor_msgs/msg/NavSatFix"
    pairs = paired(
        [entity("topic", "~/gps/fix", "gps", type=message, path="src/gps.cpp", facet="published")],
        [entity("topic", "~/global/raw/fix", "global", type=message, path="src/global.cpp", facet="published")],
    )
    assert shown(pairs) == [("~/gps/fix", "~/global/raw/fix", "renamed")]


def test_what_existed_before_is_no_new_name() -> None:
    """A name that both releases have is not what another one was renamed to."""
    kept = entity("parameter", "max_speeds")
    pairs = paired([entity("parameter", "max_speed"), kept], [kept])
    assert (None, None, "renamed") not in [(None, None, pair.how) for pair in pairs]


def test_a_deprecation_names_the_successor() -> None:
    """What the old release told to use instead is the new name, though both lived side by side."""
    text = '"speed" is deprecated, use "max_speed" instead'
    new = entity("parameter", "max_speed")
    pairs = paired([entity("parameter", "speed", deprecated=text), new], [new])
    assert ("speed", "max_speed", "renamed") in shown(pairs)


def test_members_follow_their_message() -> None:
    """One renamed message is one change, not one for each field."""
    old = [entity("message", "pkg/msg/Pose", ""), entity("message_field", "x", "pkg/msg/Pose", type="float64")]
    new = [entity("message", "pkg/msg/Pose3", ""), entity("message_field", "x", "pkg/msg/Pose3", type="float64")]
    assert shown(paired(old, new)) == [("pkg/msg/Pose", "pkg/msg/Pose3", "renamed"), ("x", "x", "same")]


def test_a_method_in_a_base_class_is_still_there() -> None:
    """Moving a method up the hierarchy breaks nobody who calls or overrides it."""
    form = Form(types=("int",), required=1)
    old = [entity("class", "a::B", ""), entity("method", "init", "a::B", forms=(form,))]
    new = [
        entity("class", "a::B", "", bases=("Base",)),
        entity("class", "a::Base", ""),
        entity("method", "init", "a::Base", forms=(form,)),
    ]
    assert ("init", "init", "same") in shown(paired(old, new))


def test_another_owner_of_the_same_file_is_the_same_endpoint() -> None:
    """Which of two modules an endpoint is attributed to does not matter as long as its line stays."""
    old = [entity("topic", "/scan", "a", facet="published"), entity("topic", "/other", "a", facet="published")]
    new = [entity("topic", "/scan", "b", facet="published"), entity("topic", "/other", "a", facet="published")]
    assert {pair.how for pair in paired(old, new)} == {"same"}
    assert all(pair.old and pair.new for pair in paired(old, new))


def test_a_moved_file_carries_its_class() -> None:
    """A class in another namespace is found through the move that git sees."""
    pairs = paired(
        [entity("class", "a::Grid", "", path="include/a/grid.hpp")],
        [entity("class", "b::Grid", "", path="include/b/grid.hpp")],
        {"include/a/grid.hpp": "include/b/grid.hpp"},
    )
    assert shown(pairs) == [("a::Grid", "b::Grid", "moved")]


def test_equal_sides_have_no_difference() -> None:
    """Every state compared with itself is empty."""
    same = [entity("parameter", "a"), entity("topic", "/b", facet="published")]
    assert all(pair.old == pair.new and pair.how == "same" for pair in paired(same, same))


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ("<*>.limits.max", "limits.max", "src/node.cpp"),
        ("<*>_planning.<*>.timeout", "<*>.timeout", "src/node.cpp"),
        ("planning.limits.max", "limits.max", "config/parameters.yaml"),
    ],
)
def test_another_idiom_of_a_computed_prefix_is_no_change(old: str, new: str, path: str) -> None:
    """How a prefix is computed changes between releases; the name that users set does not."""
    pairs = paired([entity("parameter", old)], [entity("parameter", new, path=path)])
    assert [pair.how for pair in pairs] == ["same"]
    assert pairs[0].old is not None
    assert pairs[0].new is not None


def test_a_parameter_of_a_library_outlives_one_of_its_users() -> None:
    """A program that is gone takes along no parameter that a library declares for everybody."""
    line = ("lib/loader.cpp", 7)
    old = [
        entity("parameter", "robot.timeout", "tool", path=line[0], chain=(("src/tool.cpp", 3), line)),
        entity("parameter", "robot.timeout", "server", path=line[0], chain=(("src/server.cpp", 5), line)),
    ]
    assert all(pair.old and pair.new for pair in paired(old, old[1:]))


@pytest.mark.parametrize(
    ("old", "new", "how"),
    [
        ("/gyro/metadata", "/<*>/metadata", "same"),
        ("/clear_except_<*>", "/clear_except_costmap", "same"),
        ("/gyro/metadata", "/<*>/points", "gone"),
        ("/<*>/<*>/metadata", "~/<*>/metadata", "same"),
        ("/<*>/metadata", "/<*>/points", "gone"),
    ],
)
def test_a_name_that_the_other_side_computes_is_still_there(old: str, new: str, how: str) -> None:
    """A pattern that fits a name of its type and module is that name."""
    more = {"type": "std_msgs/msg/String", "facet": "published"}
    pairs = paired([entity("topic", old, **more)], [entity("topic", new, **more)])
    assert [(pair.old is None, pair.new is None) for pair in pairs] == (
        [(False, False)] if how == "same" else [(False, True), (True, False)]
    )
    assert {pair.how for pair in pairs} == {"same"}


def test_parameters_of_a_library_do_not_move_with_its_users() -> None:
    """The file that declares them stands where it stood, whichever module goes by them."""
    more = {"path": "kinematics/src/parameters.yaml", "type": "double"}
    pairs = paired(
        [entity("parameter", "depth", "demo", **more)], [entity("parameter", "depth", "other", package="b", **more)]
    )
    assert shown(pairs) == [("depth", "depth", "same")]


def test_what_only_shares_its_kind_is_no_new_name() -> None:
    """Two filters share the word of their base, two functions of a module its path; neither became the other."""
    more = {"type": "filters::FilterBase", "owner": ""}
    old = [entity("plugin", "maps/MinFilter", **more), entity("function", "tools.utils.get_tools_version", owner="")]
    new = [entity("plugin", "maps/MockFilter", **more), entity("function", "tools.utils.handle_installation", owner="")]
    assert {pair.how for pair in paired(old, new)} == {"same"}


def test_parts_of_classes_do_not_move_to_other_classes() -> None:
    """Each controller has its own `Params`; what a namespace holds may be in another one now."""
    old = [entity("class", "diff::DiffController::Params", owner="", package="diff")]
    new = [entity("class", "tri::TriController::Params", owner="", package="tri", path="other.hpp")]
    whole = entity("class", "diff::DiffController", owner="", package="diff")
    assert {pair.how for pair in paired([*old, whole], [*new, whole])} == {"same"}
    assert {pair.how for pair in paired(old, new)} == {"moved"}


def test_a_node_keeps_its_parameters_under_another_target() -> None:
    """Users write the name of the node."""
    pairs = paired(
        [entity("parameter", "start_id", "player", node="player", path="src/a.cpp")],
        [entity("parameter", "start_id", "own_player", node="player", path="src/b.cpp")],
    )
    assert shown(pairs) == [("start_id", "start_id", "same")]


def test_a_parameter_follows_its_owner_only() -> None:
    """Half alike names of two modules are two parameters, until another parameter went the same way."""
    old = [entity("parameter", "window", "outlier", type="integer", path="src/outlier.cpp")]
    new = [entity("parameter", "filter_window", "speckle", type="integer", path="src/speckle.cpp")]
    assert {pair.how for pair in paired(old, new)} == {"same"}
    old.append(entity("parameter", "max_range", "outlier", type="double", path="src/outlier.cpp"))
    new.append(entity("parameter", "max_range", "speckle", type="double", path="src/speckle.cpp"))
    assert ("window", "filter_window", "renamed") in shown(paired(old, new))


def test_an_endpoint_of_two_types_keeps_both() -> None:
    """A node that uses one type or another by a condition still has the old one."""
    old = entity("topic", "/origin", type="geometry_msgs/msg/PoseStamped", facet="published")
    new = entity("topic", "/origin", type="gps_msgs/msg/GPSFix", facet="published", others=(old.type,))
    assert not list(type_changed(old, new, Pair(old, new)))
    assert list(type_changed(old, entity("topic", "/origin", type="gps_msgs/msg/GPSFix"), Pair(old, new)))


@pytest.mark.parametrize(
    "aliases",
    [
        pytest.param({"a::Arm": "Arm"}, id="of its own name"),
        pytest.param({"a::Arm": "Hand", "a::Hand": "Arm"}, id="of each other"),
        pytest.param({"a::Arm": "Hand", "a::Hand": "Leg", "a::Leg": "Hand"}, id="of each other behind a third"),
    ],
)
def test_aliases_that_stand_for_each_other_have_no_constructor(aliases: dict[str, str]) -> None:
    """Two packages, or two branches of one header, may name a class after each other: nothing is what they mean."""
    listed = [entity("class", name, "", type=ALIAS, bases=(target,)) for name, target in aliases.items()]
    assert Bases({entry.key: entry for entry in listed}).constructor("a::Arm") is None


def test_an_alias_of_an_alias_has_the_constructor_of_the_class() -> None:
    made = entity("method", "Leg", "a::Leg")
    listed = [
        entity("class", "a::Arm", "", type=ALIAS, bases=("Hand",)),
        entity("class", "a::Hand", "", type=ALIAS, bases=("Leg",)),
        entity("class", "a::Leg", ""),
        made,
    ]
    assert Bases({entry.key: entry for entry in listed}).constructor("a::Arm") == made


@pytest.mark.parametrize(("place", "how"), [("common/package.xml", "renamed"), ("other/package.xml", "same")])
def test_a_manifest_that_names_its_package_anew_renames_it(place: str, how: str) -> None:
    """Where the manifest lies where it lay, the package has another name, however little the two are alike."""
    before = entity("package", "serdp", owner="", package="serdp", path="common/package.xml")
    after = entity("package", "proc", owner="", package="proc", path=place)
    old = entity("class", "serdp::Ping", owner="", package="serdp", path="common/include/serdp/ping.hpp")
    new = entity("class", "proc::Ping", owner="", package="proc", path=place.replace("package.xml", "include/a.hpp"))
    pairs = paired([before, old], [after, new])
    assert next(pair.how for pair in pairs if (pair.old or pair.new or old).kind == "package") == how
    assert ("serdp", "proc", "renamed") in shown(pairs) or how == "same"


def test_a_topic_of_another_module_is_it_by_its_last_name_only() -> None:
    """Two nodes of a package that have a service of one type each, and share a word, are two nodes."""
    of_one = {"type": "std_srvs/srv/Trigger", "facet": "served"}
    old = [entity("service", "/actuators/dropper/drop", "dropper", path="dropper.py", **of_one)]
    new = [entity("service", "/actuators/gripper/open", "gripper", path="gripper.py", **of_one)]
    assert {pair.how for pair in paired(old, new)} == {"same"}
    assert len(paired(old, new)) == 2


@pytest.mark.parametrize(
    ("kind", "old", "new", "how"),
    [
        ("executable", "pose_estimator.py", "bbox_node.py", "same"),
        ("executable", "pose_estimator.py", "pose_estimator_node.py", "renamed"),
        ("launch_file", "planner.launch.py", "camera.launch.py", "same"),
        ("launch_file", "mission.launch", "missions.launch", "renamed"),
    ],
)
def test_the_ending_of_a_file_makes_no_names_alike(kind: str, old: str, new: str, how: str) -> None:
    """Half of all programs and all launch files of a package end alike."""
    pairs = paired([entity(kind, old, "", path="CMakeLists.txt")], [entity(kind, new, "", path="CMakeLists.txt")])
    assert {pair.how for pair in pairs} == {how}


@pytest.mark.parametrize(("path", "how"), [("arm/a.py", "same"), ("arm/b.py", "moved")])
def test_what_is_taken_in_by_the_same_words_does_not_move_with_its_package(path: str, how: str) -> None:
    """Whoever imports or includes it writes what was written before; the name of the package is told by itself."""
    old, new = ([entity("package", name, "", package=name, path="package.xml")] for name in ("arm", "arm_core"))
    for side, package, place in ((old, "arm", "arm/a.py"), (new, "arm_core", path)):
        side += [
            entity("file", place.replace("/", ".").removesuffix(".py"), "", package=package, path=place),
            entity("class", "arm.a.Arm", "", package=package, path=place),
            entity("method", "move", "arm.a.Arm", package=package, path=place),
        ]
    found = {(pair.old.kind, pair.how) for pair in paired(old, new) if pair.old is not None and pair.new is not None}
    assert {("package", "renamed"), ("class", how), ("method", "same")} <= found


def test_parts_of_a_message_are_told_by_it() -> None:
    """A message whose package has another name is one change, however many fields it has."""
    sides: list[list[Provision]] = []
    for name in ("arm", "arm_core"):
        message = f"{name}/msg/State"
        sides.append(
            [
                entity("package", name, "", package=name, path="package.xml"),
                entity("message", message, "", package=name, path="msg/State.msg"),
                entity("message_field", "speed", message, package=name, path="msg/State.msg"),
            ]
        )
    assert ("speed", "speed", "same") in shown(paired(*sides))


@pytest.mark.parametrize(("stays", "how"), [(True, "same"), (False, "renamed")])
def test_a_copy_that_is_taken_away_renames_no_class(stays: bool, how: str) -> None:
    """A file that git sees go to another package took its class with it, unless the package still has that class."""
    old = entity("class", "sweep.sweep_tmp.Sweep", "", package="sweep", path="sweep/tmp.py")
    kept = entity("class", "sweep.sweep.Sweep", "", package="sweep", path="sweep/sweep.py")
    new = entity("class", "search.search.Search", "", package="search", path="search/search.py")
    rest = [kept] if stays else []
    pairs = paired([old, *rest], [new, *rest], {"sweep/tmp.py": "search/search.py"})
    assert next(pair.how for pair in pairs if pair.old == old) == how


def test_a_node_in_another_package_offers_what_it_offered() -> None:
    """Names in the graph know of no package: a program of that name which has most of them is it."""
    sides = []
    for package, names in (("controls", "/x /y /z /turn"), ("planner", "/y /z /turn")):
        place = {"package": package, "path": f"{package}/joy.py"}
        topics = [entity("topic", name, "joy", facet="published", **place) for name in names.split()]
        sides.append([entity("node", "joystick", "joy", **place), *topics])
    assert [pair.old.name for pair in paired(*sides) if pair.old is not None and pair.new is None] == ["/x"]


def test_a_line_of_two_programs_is_still_that_of_each() -> None:
    """Where both are called otherwise now, the one entity that stands for their line is the successor of both."""
    names = ("/x", "/y")
    old = [entity("topic", name, owner, facet="published") for name in names for owner in ("joy", "mission")]
    new = [entity("topic", name, "pad", facet="published", sharers=("missions",)) for name in names]
    new += [entity("topic", "/z", "missions", facet="published", path="missions.py")]
    old += [entity("topic", "/z", "mission", facet="published", path="mission.py")]
    assert not [pair.old.name for pair in paired(old, new) if pair.old is not None and pair.new is None]


@pytest.mark.parametrize(("after", "how"), [("vision.chevron.main", "same"), ("arm_core.trajectory.main", "moved")])
def test_a_function_of_another_package_has_more_in_common_than_its_name(after: str, how: str) -> None:
    """Each program has its `main`: one that went and one that came elsewhere are two."""
    form = (Form(types=(), required=0),)
    old = entity("function", "arm.trajectory.main", "", package="arm", path="arm/trajectory.py", forms=form)
    new = entity("function", after, "", package="other", path="other/it.py", forms=form)
    assert {pair.how for pair in paired([old], [new])} == {how}


@pytest.mark.parametrize(("new", "files", "lost"), [("b.urdf.xacro", True, False), ("b.urdf.xacro", False, True)])
def test_an_argument_goes_with_the_file_of_its_description(new: str, files: bool, lost: bool) -> None:
    """A description under another name takes the same arguments: who gives one gives it there."""
    old, after = (
        entity("xacro_argument", "lidar", f"urdf/{name}", path=f"pkg/urdf/{name}") for name in ("a.urdf.xacro", new)
    )
    moved = {"pkg/urdf/a.urdf.xacro": f"pkg/urdf/{new}"} if files else {}
    assert any(pair.new is None for pair in paired([old], [after], moved)) == lost
