"""Every form that declares an endpoint, in the way that real code writes it."""

from __future__ import annotations

from typing import Any

import pytest

CPP2 = """
#include <rclcpp/rclcpp.hpp>
class Demo : public rclcpp::Node {{
 public:
  Demo() : rclcpp::Node("demo") {{
    {body}
  }}
  void on_scan(const sensor_msgs::msg::LaserScan::SharedPtr msg);
  message_filters::Subscriber<sensor_msgs::msg::Image> held_;
}};
"""
CPP1 = """
#include <ros/ros.h>
typedef actionlib::ActionServer<move_base_msgs::MoveBaseAction> Server;
bool on_set(std_srvs::SetBool::Request & request, std_srvs::SetBool::Response & response);
void on_scan(const sensor_msgs::LaserScanConstPtr & msg);
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  ros::NodeHandle pnh("~");
  {body}
}}
"""
PY2 = """
import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool
from nav2_msgs.action import Wait

class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        {body}
"""
PY1 = """#!/usr/bin/env python
import rospy
import actionlib
import smach_ros
from std_msgs.msg import String
from std_srvs.srv import SetBool
from move_base_msgs.msg import MoveBaseAction

def main():
    rospy.init_node('demo')
    {body}

if __name__ == '__main__':
    main()
"""
WRAPS = {
    "cpp2": (CPP2, "src/demo.cpp", 2),
    "cpp1": (CPP1, "src/demo.cpp", 1),
    "py2": (PY2, "pkg/demo.py", 2),
    "py1": (PY1, "scripts/demo.py", 1),
}

ROWS = [
    ("cpp2", 'create_publisher<std_msgs::msg::String>("chatter", 10);', "publisher", "/chatter", "std_msgs/msg/String"),
    ("cpp2", 'this->create_publisher<std_msgs::msg::String>("~/chatter", 10);', "publisher", "/demo/chatter", "std_msgs/msg/String"),
    ("cpp2", 'auto p = rclcpp::create_publisher<std_msgs::msg::String>(this, "/abs", 10);', "publisher", "/abs", "std_msgs/msg/String"),
    ("cpp2", 'auto p = std::make_shared<rclcpp::Publisher<std_msgs::msg::String>>(get_node_base_interface().get(), "made", rclcpp::QoS(1), options);', "publisher", "/made", "std_msgs/msg/String"),
    ("cpp2", 'auto p = std::make_shared<rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::String>>(get_node_base_interface().get(), "kept", rclcpp::QoS(1), options);', "publisher", "/kept", "std_msgs/msg/String"),
    ("cpp2", 'create_generic_publisher("raw", "std_msgs/msg/String", rclcpp::QoS(10));', "publisher", "/raw", "std_msgs/msg/String"),
    ("cpp2", 'create_subscription<sensor_msgs::msg::LaserScan>("scan", 10, std::bind(&Demo::on_scan, this, std::placeholders::_1));', "subscriber", "/scan", "sensor_msgs/msg/LaserScan"),
    ("cpp2", 'create_service<std_srvs::srv::SetBool>("set", [](auto a, auto b) {});', "service_server", "/set", "std_srvs/srv/SetBool"),
    ("cpp2", 'create_client<std_srvs::srv::SetBool>("set");', "service_client", "/set", "std_srvs/srv/SetBool"),
    ("cpp2", 'rclcpp_action::create_server<nav2_msgs::action::Wait>(this, "wait", a, b, c);', "action_server", "/wait", "nav2_msgs/action/Wait"),
    ("cpp2", 'rclcpp_action::create_client<nav2_msgs::action::Wait>(get_node_base_interface(), get_node_graph_interface(), get_node_logging_interface(), get_node_waitables_interface(), "wait");', "action_client", "/wait", "nav2_msgs/action/Wait"),
    ("cpp2", 'declare_parameter<double>("rate", 2.5);', "parameter", "rate", "double"),
    ("cpp2", 'declare_parameter("frame", "map");', "parameter", "frame", "string"),
    ("cpp2", 'declare_parameter("names", std::vector<std::string>{});', "parameter", "names", "string_array"),
    ("cpp2", 'declare_parameter("must", rclcpp::PARAMETER_INTEGER);', "parameter", "must", "integer"),
    ("cpp2", 'held_.subscribe(this, "image", rmw_qos_profile_sensor_data);', "subscriber", "/image", "sensor_msgs/msg/Image"),
    ("cpp2", 'auto s = std::make_shared<message_filters::Subscriber<sensor_msgs::msg::Image>>(this, "left");', "subscriber", "/left", "sensor_msgs/msg/Image"),
    ("cpp2", 'auto p = image_transport::create_publisher(this, "out");', "publisher", "/out", "sensor_msgs/msg/Image"),
    ("cpp2", "tf2_ros::TransformBroadcaster broadcaster{this};", "tf_broadcast", "/tf", "tf2_msgs/msg/TFMessage"),
    ("cpp2", 'auto t = buffer_->lookupTransform("map", "base_link", tf2::TimePointZero);', "tf_lookup", "/tf", "tf2_msgs/msg/TFMessage"),
    ("cpp1", 'ros::Publisher p = nh.advertise<std_msgs::String>("chatter", 5);', "publisher", "/chatter", "std_msgs/msg/String"),
    ("cpp1", 'ros::Publisher p = pnh.advertise<std_msgs::String>("chatter", 5, true);', "publisher", "/demo/chatter", "std_msgs/msg/String"),
    ("cpp1", 'ros::Publisher p = getNodeHandle().advertise<std_msgs::String>("chatter", 5);', "publisher", "/chatter", "std_msgs/msg/String"),
    ("cpp1", 'ros::Publisher p = getPrivateNodeHandle().advertise<std_msgs::String>("chatter", 5);', "publisher", "/demo/chatter", "std_msgs/msg/String"),
    ("cpp1", 'ros::Subscriber s = nh.subscribe("scan", 1, on_scan);', "subscriber", "/scan", "sensor_msgs/msg/LaserScan"),
    ("cpp1", 'ros::Subscriber s = nh.subscribe<sensor_msgs::LaserScan>("scan", 1, on_scan);', "subscriber", "/scan", "sensor_msgs/msg/LaserScan"),
    ("cpp1", 'auto base = boost::make_shared<ros::NodeHandle>("~"); base->advertise<std_msgs::String>("chatter", 5);', "publisher", "/demo/chatter", "std_msgs/msg/String"),
    ("cpp1", 'image_transport::ImageTransport it(pnh); auto p = it.advertise("image", 1);', "publisher", "/demo/image", "sensor_msgs/msg/Image"),
    ("cpp1", 'image_transport::ImageTransport it(pnh); image_transport::SubscriberFilter f(it, "image", 4);', "subscriber", "/demo/image", "sensor_msgs/msg/Image"),
    ("cpp1", 'image_transport::ImageTransport it(pnh); image_transport::SubscriberFilter f; f.subscribe(it, "image", 4);', "subscriber", "/demo/image", "sensor_msgs/msg/Image"),
    ("cpp1", 'ros::ServiceServer s = nh.advertiseService("set", on_set);', "service_server", "/set", "std_srvs/srv/SetBool"),
    ("cpp1", 'ros::ServiceClient c = nh.serviceClient<std_srvs::SetBool>("set");', "service_client", "/set", "std_srvs/srv/SetBool"),
    ("cpp1", 'actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server(nh, "move", false);', "action_server", "/move", "move_base_msgs/action/MoveBase"),
    ("cpp1", 'actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client("move", true);', "action_client", "/move", "move_base_msgs/action/MoveBase"),
    ("cpp1", 'actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client(pnh, "move", true);', "action_client", "/demo/move", "move_base_msgs/action/MoveBase"),
    ("cpp1", 'typedef_server = new Server(pnh, "move", false);', "action_server", "/demo/move", "move_base_msgs/action/MoveBase"),
    ("cpp1", 'typedef actionlib::ActionClient<move_base_msgs::MoveBaseAction> Client; Client client("move");', "action_client", "/move", "move_base_msgs/action/MoveBase"),
    ("cpp1", 'using Text = std_msgs::String; auto p = nh.advertise<Text>("chatter", 1);', "publisher", "/chatter", "std_msgs/msg/String"),
    ("cpp1", 'Server server(nh, "move", false);', "action_server", "/move", "move_base_msgs/action/MoveBase"),
    ("cpp1", 'pcl_ros::Publisher<pcl::PointXYZ> p(pnh, "cloud", 4);', "publisher", "/demo/cloud", "sensor_msgs/msg/PointCloud2"),
    ("cpp1", 'pcl_ros::Publisher<pcl::PointXYZ> p; p.advertise(pnh, "cloud", 4);', "publisher", "/demo/cloud", "sensor_msgs/msg/PointCloud2"),
    ("cpp1", 'BOOST_FOREACH(const Item & item, items) { item.pub = nh.advertise<std_msgs::String>("chatter", 5); }', "publisher", "/chatter", "std_msgs/msg/String"),
    ("cpp1", 'camera_info_manager::CameraInfoManager m(nh, "left");', "service_server", "/set_camera_info", "sensor_msgs/srv/SetCameraInfo"),
    ("cpp1", 'auto m = boost::make_shared<camera_info_manager::CameraInfoManager>(pnh);', "service_server", "/demo/set_camera_info", "sensor_msgs/srv/SetCameraInfo"),
    ("cpp1", 'double rate; pnh.param("rate", rate, 10.0);', "parameter", "/demo/rate", "double"),
    ("cpp1", 'std::string frame; nh.getParam("frame", frame);', "parameter", "/frame", "string"),
    ("cpp2", 'auto c = std::make_shared<nav2_util::ServiceClient<std_srvs::srv::SetBool>>("set", shared_from_this());', "service_client", "/set", "std_srvs/srv/SetBool"),
    ("cpp2", 'nav2_util::ServiceClient<std_srvs::srv::SetBool> c("set", shared_from_this());', "service_client", "/set", "std_srvs/srv/SetBool"),
    ("cpp2", 'auto a = std::make_unique<nav2_util::SimpleActionServer<nav2_msgs::action::Wait>>(shared_from_this(), "wait", on);', "action_server", "/wait", "nav2_msgs/action/Wait"),
    ("py2", "self.pub = self.create_publisher(String, 'chatter', 10)", "publisher", "/chatter", "std_msgs/msg/String"),
    ("py2", "self.pub = self.create_lifecycle_publisher(String, 'chatter', 10)", "publisher", "/chatter", "std_msgs/msg/String"),
    ("py2", "self.sub = self.create_subscription(String, 'chatter', self.on, qos_profile=10)", "subscriber", "/chatter", "std_msgs/msg/String"),
    ("py2", "self.srv = self.create_service(SetBool, 'set', self.on)", "service_server", "/set", "std_srvs/srv/SetBool"),
    ("py2", "self.cli = self.create_client(SetBool, 'set')", "service_client", "/set", "std_srvs/srv/SetBool"),
    ("py2", "self.act = ActionServer(self, Wait, 'wait', self.on)", "action_server", "/wait", "nav2_msgs/action/Wait"),
    ("py2", "self.act = ActionClient(self, Wait, 'wait')", "action_client", "/wait", "nav2_msgs/action/Wait"),
    ("py2", "self.declare_parameter('rate', 2.5)", "parameter", "rate", "double"),
    ("py2", "self.declare_parameters('', [('rate', 2.5)])", "parameter", "rate", "double"),
    ("py1", "pub = rospy.Publisher('chatter', String, queue_size=5)", "publisher", "/chatter", "std_msgs/msg/String"),
    ("py1", "sub = rospy.Subscriber('~chatter', String, print)", "subscriber", "/demo/chatter", "std_msgs/msg/String"),
    ("py1", "srv = rospy.Service('set', SetBool, print)", "service_server", "/set", "std_srvs/srv/SetBool"),
    ("py1", "cli = rospy.ServiceProxy('set', SetBool)", "service_client", "/set", "std_srvs/srv/SetBool"),
    ("py1", "act = actionlib.SimpleActionServer('move', MoveBaseAction, auto_start=False)", "action_server", "/move", "move_base_msgs/action/MoveBase"),
    ("py1", "act = actionlib.SimpleActionClient('move', MoveBaseAction)", "action_client", "/move", "move_base_msgs/action/MoveBase"),
    ("py1", "rate = rospy.get_param('~rate', 10)", "parameter", "/demo/rate", "integer"),
    ("py1", "w = smach_ros.ActionServerWrapper('move', MoveBaseAction, wrapped_container=sm)", "action_server", "/move", "move_base_msgs/action/MoveBase"),
    ("py1", "s = smach_ros.SimpleActionState('move', MoveBaseAction, goal_slots=['x'])", "action_client", "/move", "move_base_msgs/action/MoveBase"),
    ("py1", "s = smach_ros.ServiceState('set', SetBool, request=True)", "service_client", "/set", "std_srvs/srv/SetBool"),
    ("py1", "s = smach_ros.MonitorState('~chatter', String, print)", "subscriber", "/demo/chatter", "std_msgs/msg/String"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("wrap", "body", "role", "name", "kind"), ROWS, ids=[f"{row[0]}-{row[1][:40]}" for row in ROWS]
)
def test_a_form_is_found_with_name_type_and_line(
    workspace: Any, wrap: str, body: str, role: str, name: str, kind: str
) -> None:
    """Each row of the table of forms reads one declaration and says where it stands."""
    text, path, ros = WRAPS[wrap]
    source = text.format(body=body)
    entry = workspace.package({path: source}, ros).only(role)
    line = next(number for number, content in enumerate(source.splitlines(), 1) if body[:30] in content)
    assert (entry.name, entry.type, entry.confidence) == (name, kind, "literal")
    assert (entry.evidence[0].path, entry.evidence[0].line) == (f"pkg/{path}", line)


def test_a_client_of_the_lifecycle_of_a_node_has_two_services(workspace: Any) -> None:
    """nav2_util/src/lifecycle_service_client.cpp: one changes the state of the node, the other asks for it."""
    source = CPP2.format(body='auto l = nav2_util::LifecycleServiceClient("map", shared_from_this());')
    found = workspace.package({"src/demo.cpp": source}, 2).interfaces()
    assert {(each.name, each.type) for each in found if each.role == "service_client"} == {
        ("/map/change_state", "lifecycle_msgs/srv/ChangeState"),
        ("/map/get_state", "lifecycle_msgs/srv/GetState"),
    }


def test_a_tree_that_has_the_class_of_a_row_tells_itself_what_it_makes(workspace: Any) -> None:
    """The constructor that is there says more than the row, as the QoS that its release asks for."""
    helper = """
namespace nav2_util {
template<typename ServiceT> class ServiceClient {
 public:
  ServiceClient(const std::string & name, const rclcpp::Node::SharedPtr & node) {
    client_ = node->create_client<ServiceT>(name, rclcpp::SystemDefaultsQoS());
  }
};
}
"""
    source = helper + CPP2.format(body='nav2_util::ServiceClient<std_srvs::srv::SetBool> c("set", shared_from_this());')
    entry = workspace.package({"src/demo.cpp": source}, 2).only("service_client")
    assert (entry.name, entry.type) == ("/set", "std_srvs/srv/SetBool")
    assert entry.qos is not None
    assert entry.qos.profile == "system_default"


QUEUES = [
    ('pcl_ros::Publisher<pcl::PointXYZ> p; p.advertise(nh, "x", 4);', 4, None),
    ('image_transport::SubscriberFilter f; f.subscribe(it, "x", 5);', 5, None),
    ('image_transport::SubscriberFilter f(it, "x", 6);', 6, None),
    ('auto p = it.advertiseCamera("x", 2, true);', 2, "transient_local"),
    ('auto p = it.advertise("x", 2, on, off);', 2, None),
    ('auto p = it.advertise("x", 2, on, off, ros::VoidPtr(), true);', 2, "transient_local"),
    ('auto p = nh.advertise<std_msgs::Bool>("x", 2, on, off, ros::VoidConstPtr(), latch);', 2, "unknown"),
    ('auto p = nh.advertise<std_msgs::Bool>("x", 2, boost::bind(&go, _1), off, ros::VoidConstPtr(), false);', 2, None),
]  # fmt: skip


@pytest.mark.parametrize(("body", "depth", "durability"), QUEUES, ids=[row[0] for row in QUEUES])
def test_a_queue_of_ros_1_and_what_comes_behind_callbacks(
    workspace: Any, body: str, depth: int, durability: str | None
) -> None:
    """The flag of a latch is the last argument of each overload; a callback before it is none."""
    taken = f"image_transport::ImageTransport it(nh); bool latch = nh.hasParam(name); {body}"
    found = workspace.package({"src/demo.cpp": CPP1.format(body=taken)}, 1).interfaces()
    assert {(one.qos.depth, one.qos.durability) for one in found if one.qos is not None} == {(depth, durability)}


def test_a_map_declares_a_parameter_for_each_entry(workspace: Any) -> None:
    """`declare_parameters(namespace, map)` declares each key below the namespace, with its value."""
    body = 'std::map<std::string, int64_t> axes{{"x", 5L}, {"yaw", -1L}}; declare_parameters("axis", axes);'
    found = workspace.package({"src/demo.cpp": CPP2.format(body="@").replace("@", body)}).interfaces()
    assert [(one.name, one.type, one.default) for one in found if one.role == "parameter"] == [
        ("axis.x", "integer", 5),
        ("axis.yaw", "integer", -1),
    ]


NOT_FORMS = [
    ("cpp2", 'widget_->subscribe("click");'),
    ("cpp2", 'logger.publish("x");'),
    ("cpp1", 'config.param("x", 1);'),
    ("cpp1", 'mine::Publisher p; p.advertise(nh, "cloud", 4);'),
    ("py2", "self.create_timer(0.1, self.on)"),
    ("py1", "thing.subscribe('x')"),
]


@pytest.mark.parametrize(("wrap", "body"), NOT_FORMS, ids=[row[1] for row in NOT_FORMS])
def test_a_method_of_the_same_name_elsewhere_is_no_form(workspace: Any, wrap: str, body: str) -> None:
    """A call that only looks alike is not an endpoint."""
    text, path, ros = WRAPS[wrap]
    assert workspace.package({path: text.format(body=body)}, ros).interfaces() == []


def test_rows_of_ecm_toml_are_forms(workspace: Any) -> None:
    """A project's own wrapper without source in the tree is read by a row of its ecm.toml."""
    row = (
        '[[form]]\ncallee = "open_topic"\nrole = "publisher"\nmatch = "function"\nname = "arg:0"\ntype = "template:0"\n'
    )
    workspace.package({"src/demo.cpp": CPP2.format(body='open_topic<std_msgs::msg::String>("own");')})
    (workspace.root / "ecm.toml").write_text(row)
    assert workspace.only("publisher").name == "/own"


def test_a_macro_of_the_file_is_what_it_stands_for(workspace: Any) -> None:
    """Endpoints that a macro with parameters makes are told, each at the line of its call."""
    macro = """#define PUB(var, type, topic, ...) \\
  do { RCLCPP_INFO(get_logger(), "Advertise %s (" #type ")", (topic).c_str()); \\
       var = this->create_publisher<type>(topic, __VA_ARGS__); } while (0)
"""
    body = 'PUB(one_, std_msgs::msg::String, ns_ + "/one", 10);\n    PUB(two_, std_msgs::msg::Bool, ns_ + "/two", 5);'
    text = CPP2.format(body=body).replace("held_;", 'held_; std::string ns_ = "own";')
    found = workspace.package({"src/demo.cpp": macro + text}).interfaces()
    assert [(one.name, one.type, one.qos.depth, one.evidence[0].line) for one in found] == [
        ("/own/one", "std_msgs/msg/String", 10, 9),
        ("/own/two", "std_msgs/msg/Bool", 5, 10),
    ]
