"""Small packages of which one shows something and another nearly does."""

from __future__ import annotations

from collections.abc import Mapping

Files = Mapping[str, str]

CMAKE = "add_executable({0} src/{0}.cpp)\ninstall(TARGETS {0} RUNTIME DESTINATION lib)\n"
WHEELS = '<?xml version="1.0"?><robot name="a" xmlns:xacro="http://ros.org/wiki/xacro">{}</robot>'
JOINT = (
    '<link name="{ns}base"/><link name="{ns}wheel"/><joint name="turn" type="revolute"><parent link="{ns}base"/>'
    '<child link="{ns}wheel"/><limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/></joint>'
)


def script(node: str, *lines: str) -> str:
    """A program of ROS 1."""
    head = "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import Bool, String\n"
    return head + f"rospy.init_node('{node}')\n" + "\n".join(lines) + "\n"


def node(name: str, program: str, *inner: str) -> str:
    return f'<node name="{name}" pkg="pkg" type="{program}">{"".join(inner)}</node>'


def launch(*nodes: str) -> str:
    return "<launch>" + "\n".join(nodes) + "</launch>"


def cpp(callback: str) -> str:
    both = (
        "void update(const std_msgs::String::ConstPtr &msg) {}\n"
        "bool update(pkg::Update::Request &a, pkg::Update::Response &b) { return true; }\n"
    )
    served = f'ros::ServiceServer s = n.advertiseService(std::string("list"), {callback});'
    return f'{both}int main(int c, char **v) {{ ros::init(c, v, "server"); ros::NodeHandle n; {served} }}\n'


def wildcard(taken: str) -> Files:
    return {
        "scripts/a.py": script("a", "rospy.Publisher('/stop', Bool, queue_size=1)"),
        "scripts/b.py": script("b", f"rospy.Subscriber('/stop', {taken}, print)"),
        "launch/a.launch": launch(node("a", "a.py"), node("b", "b.py")),
    }


def overload(service: str) -> Files:
    main = 'int main(int c, char **v) { ros::init(c, v, "b"); ros::NodeHandle n; '
    client = main + f'ros::ServiceClient s = n.serviceClient<{service}>("list"); }}\n'
    return {
        "src/server.cpp": cpp("update"),
        "src/b.cpp": client,
        "CMakeLists.txt": CMAKE.format("server") + CMAKE.format("b"),
        "launch/a.launch": launch(node("server", "server"), node("b", "b")),
    }


def own_name(prefix: str) -> Files:
    main = 'int main(int c, char **v) { ros::init(c, v, "gps_base"); ros::NodeHandle n; double a; '
    read = f'n.getParam({prefix} + "/primary_port/serial_stop_bits", a); }}\n'
    given = '<param name="primary_port/serial_stop_bits" value="1"/>'
    return {
        "src/gps.cpp": main + read,
        "CMakeLists.txt": CMAKE.format("gps"),
        "launch/a.launch": launch(node("gps_rover", "gps", given)),
    }


def whole_map(key: str) -> Files:
    return {
        "scripts/a.py": script("a", "rospy.get_param('~axis_linear', {})", "rospy.get_param('~scale', 1)"),
        "launch/a.launch": launch(node("a", "a.py", f'<param name="{key}" value="1"/>')),
    }


def remapped(source: str) -> Files:
    lines = ("rospy.Publisher('~out', Bool, queue_size=1)", "rospy.get_param('hand_description', '')")
    return {
        "scripts/a.py": script("a", *lines),
        "launch/a.launch": launch(node("a", "a.py", f'<remap from="{source}" to="robot"/>')),
    }


def given_to_port(topic: str) -> Files:
    """A remap of a name that a behaviour tree may give to the node."""
    action = f'<Action ID="Go" topic="{topic}"/>'
    return {
        **remapped("goal_pose"),
        "trees/a.xml": f'<root BTCPP_format="4"><BehaviorTree ID="A">{action}</BehaviorTree></root>',
    }


def pair(namespace: str, lower: str = "-1") -> Files:
    name = '<xacro:arg name="ns" default="rover/"/><xacro:property name="ns" value="$(arg ns)"/>'
    made = WHEELS.format(name + JOINT.format(ns="${ns}" if namespace else "", lower=-1, upper=1))
    return {"urdf/a.xacro": made, "urdf/a.urdf": WHEELS.format(JOINT.format(ns="", lower=lower, upper=1))}


def plugin(suffix: str) -> Files:
    export = (
        "namespace pkg { class %s : public nodelet::Nodelet {}; }\nPLUGINLIB_EXPORT_CLASS(pkg::%s, nodelet::Nodelet)\n"
    )
    entry = '<class name="pkg/{0}" type="pkg::{0}" base_class_type="nodelet::Nodelet"/>'
    listed = f'<library path="lib/libpkg">{entry.format("Plain")}{entry.format("Fast")}</library>'
    return {
        "src/plain.cpp": export % ("Plain", "Plain"),
        f"src/fast{suffix}": export % ("Fast", "Fast"),
        "plugins.xml": listed,
        "package.xml": '<package format="2"><name>pkg</name><version>1.0.0</version><buildtool_depend>catkin'
        '</buildtool_depend><export><nodelet plugin="${prefix}/plugins.xml"/></export></package>',
    }


def described(path: str) -> Files:
    return {"urdf/a.urdf.xacro": WHEELS.format(f'<xacro:include filename="{path}"/><link name="base"/>')}


def included(path: str) -> Files:
    return {"launch/a.launch.xml": f'<launch><include file="$(find-pkg-share pkg)/launch/{path}"/></launch>'}


def part(includes: str) -> Files:
    inner = WHEELS.format("<xacro:wheel/>").replace('name="a"', 'name="inner"')
    macro = '<xacro:macro name="wheel"><link name="wheel"/></xacro:macro>'
    outer = f'{macro}<xacro:include filename="{includes}"/><link name="base"/>'
    return {
        "urdf/inner.xacro": inner,
        "urdf/other.xacro": WHEELS.format('<link name="x"/>'),
        "urdf/macro.xacro": WHEELS.format(macro),
        "urdf/a.urdf.xacro": WHEELS.format(f'<xacro:include filename="macro.xacro"/>{outer.removeprefix(macro)}'),
    }


def chosen(default: str) -> Files:
    argument = (
        f'<arg name="robot" default="{default}"/><arg name="file" default="$(find pkg)/param/$(arg robot)_a.yaml"/>'
    )
    return {"launch/a.launch": launch(argument, '<rosparam command="load" file="$(arg file)"/>')}


def pipeline(name: str) -> Files:
    reads = ("rospy.get_param('~pipeline_of_filters_name', 'x')", "rospy.get_param('~rate', 1)")
    given = '<param name="pipeline_of_filters" value="1"/>'
    named = f'<param name="chosen" value="{name}"/>'
    return {
        "scripts/a.py": script("a", *reads),
        "launch/a.launch": launch(node("a", "a.py", given, named)),
    }


def self_named(read: str) -> Files:
    return {"scripts/plane.py": script("plane", f"rospy.get_param('~{read}', 1)")}


def lidar(own: str) -> Files:
    front = node("lidar", "a.py", f'<remap from="scan" to="{own}"/>')
    inner = launch(front, node("b", "b.py", '<remap from="scan" to="/lidar/scan"/>'))
    return {
        "scripts/a.py": script("a", "rospy.Publisher('scan', Bool, queue_size=1)"),
        "scripts/b.py": script("b", "rospy.Subscriber('scan', Bool, print)"),
        "launch/inner.launch": inner,
        "launch/a.launch": launch('<include file="$(find pkg)/launch/inner.launch"/>'),
    }


def bridge(topic: str) -> Files:
    words = f'"{topic}@geometry_msgs/msg/Twist@gz.msgs.Twist"'
    other = '<node pkg="teleop_twist_keyboard" exec="teleop_twist_keyboard"/><node pkg="joy" exec="joy_node"/>'
    teleop = '<node pkg="teleop_twist_joy" exec="teleop_node"/>' if topic == "/cmd" else ""
    bridged = f"<node pkg='ros_gz_bridge' exec='parameter_bridge' args={words}/>"
    return {"launch/a.launch.xml": f"<launch>{other}{teleop}{bridged}</launch>"}


def pose(name: str) -> Files:
    head = "#!/usr/bin/env python3\nimport rospy\nfrom geometry_msgs.msg import PoseStamped\n"
    return {
        "scripts/a.py": f"{head}rospy.init_node('a')\nrospy.Publisher('/initialpose3d', PoseStamped, queue_size=1)\n",
        "scripts/b.py": f"{head}rospy.init_node('b')\nrospy.Subscriber('{name}', PoseStamped, print)\n",
        "launch/a.launch": launch(node("a", "a.py"), node("b", "b.py")),
    }


def limited(lower: str) -> Files:
    return {"urdf/a.urdf": WHEELS.format(JOINT.format(ns="", lower=lower, upper="3.142"))}


def read_below(space: str) -> Files:
    reads = [f"rospy.get_param('{space}/{leaf}', 1)" for leaf in ("low", "high")]
    started = '<node pkg="pkg" type="monitor.py" name="watch"/>'
    return {"scripts/monitor.py": script("battery_monitor", *reads), "launch/a.launch": f"<launch>{started}</launch>"}


def manifest(*asked: str, extra: str = "") -> str:
    wanted = "".join(f"<exec_depend>{name}</exec_depend>" for name in asked)
    head = '<package format="2"><name>{}</name><version>1.0.0</version><buildtool_depend>catkin</buildtool_depend>'
    return f"{head.format('pkg')}{wanted}<export>{extra}</export></package>"


def deprecated(extra: str) -> Files:
    old = manifest(extra="<deprecated/>").replace("<name>pkg", "<name>old_plugins")
    return {"package.xml": manifest("old_plugins", extra=extra), "../old_plugins/package.xml": old}


def fetched(name: str) -> Files:
    listed = f"- git:\n    local-name: {name}\n    uri: https://example.org/{name}.git\n"
    own = manifest("nodelet", extra="<build_type>ament_cmake</build_type>").replace("catkin", "ament_cmake")
    return {"package.xml": own, "deps.rosinstall": listed}


def from_source(started: str) -> Files:
    """A package of ROS 2 that asks for one that was released for ROS 1, and the package that its launch file starts."""
    return {**fetched("other"), "launch/a.launch.xml": f'<launch><node pkg="{started}" exec="a" name="a"/></launch>'}


def misspelled(started: str) -> Files:
    """A name of package.xml that a list of sources has, and a package that a launch file starts."""
    return {
        "package.xml": manifest("micro-arm-agent"),
        "deps.rosinstall": "- git:\n    local-name: micro-arm-agent\n    uri: https://example.org/setup.git\n",
        "launch/a.launch": launch(f'<node name="a" pkg="{started}" type="a"/>'),
    }


def turned(module: str) -> Files:
    """A name of package.xml whose letters are those of a package, and code that imports one."""
    return {"package.xml": manifest("rcply"), "scripts/a.py": f"#!/usr/bin/env python3\nimport {module}\n"}


def given(target: str) -> Files:
    inner = launch(
        '<arg name="labels" default="/decomposer/label"/>',
        node("decomposer", "a.py"),
        node("b", "b.py", f'<remap from="~labels" to="{target}"/>'),
    )
    return {
        "scripts/a.py": script("a", "rospy.Publisher('~label', Bool, queue_size=1)"),
        "scripts/b.py": script("b", "rospy.Subscriber('~labels', Bool, print)"),
        "launch/inner.launch": inner,
        "launch/a.launch": launch('<include file="$(find pkg)/launch/inner.launch"/>'),
    }


def analyzed(package: str, prefix: str = "gone") -> Files:
    analyzer = (
        f"analyzers:\n  a:\n    type: diagnostic_aggregator/GenericAnalyzer\n    path: A\n    remove_prefix: {prefix}\n"
    )
    load = '<rosparam command="load" file="$(find pkg)/param/d.yaml"/>'
    aggregator = f'<node name="drives" pkg="diagnostic_aggregator" type="aggregator_node">{load}</node>'
    return {
        "param/d.yaml": analyzer,
        "launch/b.launch": launch(node("b", "b.py")),
        "scripts/b.py": script("b"),
        "launch/a.launch": launch(f'<include file="$(find {package})/launch/b.launch"/>', aggregator),
    }


def states(updater: str) -> Files:
    """What publishes diagnostics, and a package.xml that names what it does so with."""
    taken = "diagnostic_msgs.msg.DiagnosticArray, queue_size=1"
    line = f"import diagnostic_msgs.msg\nrospy.Publisher('/diagnostics', {taken})"
    return {**analyzed("pkg"), "scripts/b.py": script("b", line), "package.xml": manifest(updater)}


def named_alike(kind: str) -> Files:
    spawner = '<node name="s" pkg="controller_manager" type="spawner" args="arm"/>'
    other = {"controller": spawner, "node": '<node name="arm" pkg="somebody" type="arm"/>'}[kind]
    remap = '<remap from="out" to="/arm/limb/left"/>'
    front = f'<group ns="front"><rosparam file="$(find pkg)/config/c.yaml" command="load"/>{other}</group>'
    return {
        "config/c.yaml": "arm:\n  type: effort_controllers/JointTrajectoryController\n  joints: [a]\n",
        "scripts/a.py": script("a", "rospy.Publisher('out', Bool, queue_size=1)"),
        "launch/a.launch": launch(front, node("a", "a.py", remap)),
    }


def meeting(second: str) -> Files:
    """A node is started in a namespace; another remaps to its name, and a third one to `second`."""
    remap, other = (f'<remap from="out" to="{name}"/>' for name in ("/arm/limb/left", second))
    front = '<group ns="front"><node name="arm" pkg="somebody" type="arm"/></group>'
    source = script("a", "rospy.Publisher('out', Bool, queue_size=1)")
    files = {"scripts/a.py": source, "scripts/b.py": source}
    return {**files, "launch/a.launch": launch(front, node("a", "a.py", remap), node("b", "b.py", other))}


def simulated(source: str) -> Files:
    name = "arm/follow_joint_trajectory"
    head = "#!/usr/bin/env python3\nimport rospy\nimport actionlib\n"
    head += "from control_msgs.msg import FollowJointTrajectoryAction\n"
    client = f"actionlib.SimpleActionClient('/{name}_action', FollowJointTrajectoryAction)\n"
    gazebo = f'<node name="gazebo" pkg="gazebo_ros" type="gzserver"><remap from="{source}" to="{name}_action"/></node>'
    return {
        "config/c.yaml": "arm:\n  type: effort_controllers/JointTrajectoryController\n  joints: [a]\n",
        "scripts/a.py": f"{head}rospy.init_node('a')\n{client}",
        "launch/a.launch": launch(
            gazebo,
            '<rosparam file="$(find pkg)/config/c.yaml" command="load"/>',
            '<node name="s" pkg="controller_manager" type="spawner" args="arm"/>',
            node("a", "a.py"),
        ),
    }


def joined(name: str) -> Files:
    share = "get_package_share_directory('pkg')"
    path = f"os.path.join({share}, {share} + '/config/{name}.yaml')"
    head = "import os\nfrom launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    head += "from ament_index_python.packages import get_package_share_directory\n\n\n"
    run = f"Node(package='other', executable='a', parameters=[{path}])"
    text = f"{head}def generate_launch_description():\n    return LaunchDescription([{run}])\n"
    return {"launch/a.launch.py": text, "config/a.yaml": "a:\n  ros__parameters:\n    x: 1\n"}


def generated(body: str) -> Files:
    return {
        "CMakeLists.txt": "include(cmake/gen.cmake)\ngenerate_all_bridges()\nadd_executable(a src/a.cpp)\n",
        "cmake/gen.cmake": f"macro(bridges_of)\n{body}\nendmacro()\nbridges_of()\n",
        "src/a.cpp": "int main() {}\n",
        "../other/CMakeLists.txt": "bridges_of()\n",
        "../other/package.xml": manifest().replace("<name>pkg", "<name>other"),
        "launch/a.launch": launch('<node name="b" pkg="other" type="b_bridge"/>'),
    }


def filled_in(template: str) -> Files:
    return {f"urdf/{template}": WHEELS.format("<link name='b'/>"), **described("b.xacro")}


def moved(depends: str) -> Files:
    fields = ("rospy.Publisher('/robot/global/fix', Bool, queue_size=1)",)
    return {
        "package.xml": manifest(*depends.split()),
        "scripts/a.py": script("a", "rospy.Subscriber('/robot/gps/fix', Bool, print)"),
        "../driver/scripts/b.py": script("b", *fields),
        "../driver/package.xml": manifest().replace("<name>pkg", "<name>driver"),
    }
