"""Small packages of sources of which one shows something and another nearly does."""

from __future__ import annotations

from near_miss_files import CMAKE, Files, launch, node

SETUP = "setup(name='pkg', packages=['pkg'], package_dir={'': 'src'})\n"


def copied(name: str) -> Files:
    command = f"add_custom_command(OUTPUT ${{CATKIN_DEVEL_PREFIX}}/bin/{name} COMMAND cmake -E copy a b)\n"
    return {"CMakeLists.txt": command + CMAKE.format("a"), "launch/a.launch": launch(node("r", "runner"))}


def view(name: str) -> Files:
    entry = f'<class name="pkg/View" type="{name}" base_class_type="rqt_gui_py::Plugin"/>'
    export = (
        "namespace pkg { class A : public nodelet::Nodelet {}; }\nPLUGINLIB_EXPORT_CLASS(pkg::A, nodelet::Nodelet)\n"
    )
    return {
        "src/a.cpp": export,
        "plugins.xml": f'<library path="src">{entry}</library>',
        "package.xml": '<package format="2"><name>pkg</name><version>1.0.0</version><buildtool_depend>catkin'
        '</buildtool_depend><export><rqt_gui plugin="${prefix}/plugins.xml"/></export></package>',
    }


def filled(target: str) -> Files:
    body = f"sensor_msgs::Image image; sensor_msgs::Image depth; {target} = made(); pub_.publish(image);"
    return {"src/a.cpp": f"void A::send() {{ {body} }}\n", "CMakeLists.txt": CMAKE.format("a")}


def converted(target: str) -> Files:
    declared = "tf::Vector3 transform_frame_ned_enu(const tf::Vector3 &value);\n"
    sent = f"void A::send(const tf::Vector3 &given) {{ {target} = transform_frame_ned_enu(given); use(b); }}\n"
    return {"src/a.cpp": declared + sent, "CMakeLists.txt": CMAKE.format("a")}


def sensor(name: str) -> Files:
    found = f"this->s = sensors::SensorManager::Instance()->GetSensor({name});"
    return {
        "src/a.cpp": f"#include <gazebo/sensors/sensors.hh>\nvoid A::Load(M m, std::string n) {{ {found} }}\n",
        "CMakeLists.txt": CMAKE.format("a"),
    }


def shape(size: str) -> Files:
    corners = ((0, 0, 0), (1, 0, 0), (0, 1, 1))
    facet = "facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in corners)
    mesh = f"solid a\n{facet}endloop\nendfacet\nendsolid a\n"
    drawn = '<visual><geometry><mesh filename="package://pkg/meshes/a.stl"/></geometry></visual>'
    kept = f'<collision><geometry><box size="{size} {size} {size}"/></geometry></collision>'
    return {"meshes/a.stl": mesh, "urdf/a.urdf": f'<robot name="a"><link name="b">{drawn}{kept}</link></robot>'}


def starred(second: str) -> Files:
    head = "#!/usr/bin/env python3\nimport rospy\nfrom one_msgs.msg import *\n"
    named = "#!/usr/bin/env python3\nimport rospy\nfrom two_msgs.msg import Event\n"
    return {
        "scripts/a.py": f"{head}{second}rospy.init_node('a')\nrospy.Publisher('/event', Event, queue_size=1)\n",
        "scripts/b.py": f"{named}rospy.init_node('b')\nrospy.Subscriber('/event', Event, print)\n",
        "launch/a.launch": launch(node("a", "a.py"), node("b", "b.py")),
    }


def goal_of(name: str) -> Files:
    return {"action/Run.action": "int32 a\n---\n---\n", "msg/Stat.msg": f"pkg/{name} goal\n"}


def made_by_build(listed: str) -> Files:
    return {
        "CMakeLists.txt": f"add_message_files(DIRECTORY msg FILES A.msg {listed})\n",
        "msg/A.msg": "int32 a\n",
        "scripts/a.py": "#!/usr/bin/env python3\nfrom pkg.msg import Made\n",
    }


def configured(path: str) -> Files:
    installed = f"install(PROGRAMS ${{CATKIN_DEVEL_PREFIX}}/{path} DESTINATION bin)\n"
    return {"CMakeLists.txt": installed + CMAKE.format("a"), "launch/a.launch": launch(node("r", "runner"))}


def asked_of_build(command: str, set_up: str = "") -> Files:
    """A module that imports another one of its package, which no file holds; the build is given."""
    head = "find_package(catkin REQUIRED)\ncatkin_package()\n"
    return {
        "CMakeLists.txt": f"project(pkg)\n{head}{command}\n",
        "setup.py": f"from setuptools import setup\n{set_up}\n{SETUP}",
        "src/pkg/__init__.py": "",
        "src/pkg/a.py": "from pkg.made import Made\n\nMade()\n",
    }


def in_folder(name: str) -> Files:
    """A module of a folder without an `__init__.py`, and one that imports the folder."""
    return {
        **asked_of_build(""),
        "src/pkg/arms/left.py": "LENGTH = 1\n",
        "src/pkg/a.py": f"from pkg.{name} import left\n\nprint(left.LENGTH)\n",
    }


def made_of_template(name: str) -> Files:
    """A launch file that loads a file, and a macro that makes one of another name of a template."""
    where = "${CMAKE_CURRENT_SOURCE_DIR}/config"
    made = f"configure_file({where}/arm.yaml.in {where}/${{NAME}}_arm.yaml)"
    macro = f'macro(make NAME)\nif("${{NAME}}" STREQUAL "left")\n{made}\nendif()\nendmacro()\nmake(left)\n'
    load = f'<rosparam command="load" file="$(find pkg)/config/{name}_arm.yaml"/>'
    return {
        "CMakeLists.txt": f"project(pkg)\nfind_package(catkin REQUIRED)\ncatkin_package()\n{macro}",
        "config/arm.yaml.in": "a: 1\n",
        "launch/a.launch": launch(load),
    }


def read_twice(between: str) -> Files:
    """A parameter that a function reads into two variables, with something between the two reads."""
    lines = (
        "#include <ros/ros.h>",
        "int main(int argc, char ** argv) {",
        '  ros::init(argc, argv, "base");',
        '  ros::NodeHandle handle("~/limits");',
        "  double speed = 0.0, force = 0.0;",
        "#if WITH_SPEED==2 and not WITH_FORCE",
        '  handle.param("speed", speed, 1.0);',
        between,
        '  handle.param("speed", force, 1.0);',
        "#endif",
        "  return 0;",
        "}",
    )
    return {"src/base.cpp": "\n".join(lines) + "\n", "CMakeLists.txt": CMAKE.format("base")}


def sent(made: str) -> Files:
    head = (
        "geometry_msgs::PoseStamped origin() { geometry_msgs::PoseStamped p; p.header.frame_id = frame; return p; }\n"
    )
    body = f"geometry_msgs::PoseStamped ps = {made}; ps.pose.position.x = 1; pub_.publish(ps);"
    return {"src/a.cpp": f"{head}void A::send() {{ {body} }}\n", "CMakeLists.txt": CMAKE.format("a")}
