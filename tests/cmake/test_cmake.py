"""What a CMakeLists.txt states."""

import time

import pytest
from ecm_parsers.cmake_facts import CmakeFile, Target
from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.cmake import BuildFiles, evaluate, stated

TOP = "CMakeLists.txt"


def run(files: dict[str, bytes]) -> dict[str, CmakeFile]:
    return stated(evaluate(BuildFiles(files, files.get), TOP))


def read(text: str, *paths: str) -> CmakeFile:
    """The facts of a file that lies beside empty files."""
    files = {TOP: text.encode(), **dict.fromkeys(paths, b"")}
    evaluation = evaluate(BuildFiles(files, files.get), TOP)
    assert evaluation.diagnostics == {}
    return stated(evaluation)[TOP]


def target(text: str) -> Target:
    (found,) = read(text, "src/a.cpp", "src/b.cpp", "src/sub/c.cpp").targets
    return found


def test_project() -> None:
    """Name and version of the project are facts."""
    facts = read("cmake_minimum_required(VERSION 3.8)\nproject(robot VERSION 1.2.3 LANGUAGES CXX)\n")
    assert (facts.project, facts.version, facts.line) == ("robot", "1.2.3", 2)


@pytest.mark.parametrize(
    ("text", "name", "kind", "sources"),
    [
        ("add_executable(n src/a.cpp src/b.cpp)", "n", "executable", ("src/a.cpp", "src/b.cpp")),
        ("add_executable(n src/main)", "n", "executable", ("src/main",)),
        ("add_library(n SHARED ./src/a.cpp)", "n", "library", ("src/a.cpp",)),
        ("add_library(n INTERFACE)", "n", "interface", ()),
        ("project(p)\nadd_library(${PROJECT_NAME}_core a.cc)", "p_core", "library", ("a.cc",)),
        ('set(S a.cpp b.cpp)\nadd_library(n "${S}")', "n", "library", ("a.cpp", "b.cpp")),
        (
            "set(S a.cpp b.cpp)\nlist(APPEND S c.cpp)\nadd_executable(n ${S})",
            "n",
            "executable",
            ("a.cpp", "b.cpp", "c.cpp"),
        ),
        (
            "file(GLOB S RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} src/*.cpp)\nadd_executable(n ${S})",
            "n",
            "executable",
            ("src/a.cpp", "src/b.cpp"),
        ),
        (
            "file(GLOB_RECURSE S CONFIGURE_DEPENDS src/*.cpp)\nadd_library(n ${S})",
            "n",
            "library",
            ("src/a.cpp", "src/b.cpp", "src/sub/c.cpp"),
        ),
        ("add_executable(n ${CMAKE_CURRENT_SOURCE_DIR}/a.cpp)", "n", "executable", ("a.cpp",)),
        ("add_executable(n a.cpp ${GENERATED})", "n", "executable", ("a.cpp", "${GENERATED}")),
        ("add_library(n a.cpp $<TARGET_OBJECTS:o>)", "n", "library", ("a.cpp",)),
        ("add_library(n)\ntarget_sources(n PRIVATE a.cpp)", "n", "library", ("a.cpp",)),
        ("ament_auto_add_library(n DIRECTORY src/sub)", "n", "library", ("src/sub/c.cpp",)),
        ("cuda_add_library(n a.cu)", "n", "library", ("a.cu",)),
        ("pybind11_add_module(n MODULE a.cpp)", "n", "library", ("a.cpp",)),
        ("catkin_add_gtest(n test/a.cpp)", "n", "test", ("test/a.cpp",)),
        ("ament_add_pytest_test(n test/a.py TIMEOUT 9)", "n", "test", ("test/a.py",)),
        ("my_add_gmock(n a.cpp)", "n", "test", ("a.cpp",)),
        (
            "if(WIN32)\nset(S w.cpp)\nelse()\nset(S l.cpp)\nendif()\nadd_executable(n ${S})",
            "n",
            "executable",
            ("l.cpp",),
        ),
        (
            "if(NOT WIN32)\nset(S l.cpp)\nelse()\nset(S w.cpp)\nendif()\nadd_executable(n ${S})",
            "n",
            "executable",
            ("l.cpp",),
        ),
        ("set(A S)\nset(S a.cpp)\nadd_executable(n ${${A}})", "n", "executable", ("a.cpp",)),
        ("string(TOLOWER NaMe N)\nadd_executable(${N} a.cpp)", "name", "executable", ("a.cpp",)),
    ],
)
def test_targets(text: str, name: str, kind: str, sources: tuple[str, ...]) -> None:
    """Each way to build something gives its name, kind and folded sources."""
    found = target(text)
    assert (found.name, found.kind, found.sources) == (name, kind, sources)
    assert found.is_test == (kind == "test")


@pytest.mark.parametrize(
    "text",
    [
        "add_library(n IMPORTED)",
        "add_library(a::n ALIAS n)",
        "ament_add_gtest_test(n)",
        "qt5_wrap_cpp(m a.hpp)",
    ],
)
def test_what_builds_nothing(text: str) -> None:
    """Imported and alias targets, runs of tests and Qt wrappers are no targets."""
    assert read(text).targets == ()


def test_links() -> None:
    """Links of both kinds are collected without their visibility."""
    text = "add_library(n a.cpp)\ntarget_link_libraries(n PUBLIC x::x PRIVATE y)\nament_target_dependencies(n z)"
    assert target(text).links == ("x::x", "y", "z")


@pytest.mark.parametrize(
    "condition", ["BUILD_TESTING", "CATKIN_ENABLE_TESTING", "A AND BUILD_TESTING", "NOT (NOT BUILD_TESTING)"]
)
def test_test_blocks(condition: str) -> None:
    """What is built only with tests is marked, what stands beside it is not."""
    facts = read(f"if({condition})\n  add_executable(t t.cpp)\nelse()\n  add_executable(a a.cpp)\nendif()\n")
    assert [(t.name, t.is_test) for t in facts.targets] == [("t", True), ("a", False)]


@pytest.mark.parametrize(
    "header", ["foreach(p one two)", "set(L one two)\nforeach(p IN LISTS L)", "foreach(p IN ITEMS one two)"]
)
def test_loops_are_unrolled(header: str) -> None:
    """A loop over known values makes a target for each."""
    facts = read(f"{header}\n  add_library(${{p}}_plugin src/${{p}}.cpp)\nendforeach()\n")
    assert [(t.name, t.sources) for t in facts.targets] == [
        ("one_plugin", ("src/one.cpp",)),
        ("two_plugin", ("src/two.cpp",)),
    ]


def test_loop_over_unknown_values_is_a_pattern() -> None:
    """What a loop runs over may be unknown: the reference stays."""
    assert target("foreach(p IN LISTS UNKNOWN)\nadd_library(${p}_x ${p}.cpp)\nendforeach()").name == "${p}_x"


def test_functions_are_expanded_where_they_are_called() -> None:
    """Functions and macros of the file run with their arguments; facts have the line of the call."""
    text = """function(plugin name)
  cmake_parse_arguments(ARG "QUIET" "BASE" "SOURCES" ${ARGN})
  add_library(${name} SHARED ${ARG_SOURCES})
  pluginlib_export_plugin_description_file(${ARG_BASE} ${name}.xml)
endfunction()
plugin(grid BASE nav SOURCES a.cpp b.cpp)
"""
    facts = read(text)
    assert [(t.name, t.sources, t.line) for t in facts.targets] == [("grid", ("a.cpp", "b.cpp"), 6)]
    assert [(p.base_package, p.path, p.line) for p in facts.plugin_descriptions] == [("nav", "grid.xml", 6)]


def test_components() -> None:
    """Components are known by class, library and executable."""
    text = """rclcpp_components_register_nodes(lib "a::B" "a::C")
rclcpp_components_register_node(lib PLUGIN "a::D" EXECUTABLE d)
"""
    assert [(c.plugin_class, c.library, c.executable, c.line) for c in read(text).components] == [
        ("a::B", "lib", None, 1),
        ("a::C", "lib", None, 1),
        ("a::D", "lib", "d", 2),
    ]


def test_generated_parameters() -> None:
    """YAML of generate_parameter_library and `.cfg` of dynamic_reconfigure are named."""
    text = """generate_parameter_library(params src/p.yaml include/v.hpp)
generate_parameter_module(py_params p.yaml)
generate_dynamic_reconfigure_options(cfg/A.cfg cfg/B.cfg)
"""
    facts = read(text)
    assert [(p.target, p.path, p.is_python) for p in facts.parameter_libraries] == [
        ("params", "src/p.yaml", False),
        ("py_params", "p.yaml", True),
    ]
    assert [f.path for f in facts.reconfigure_files] == ["cfg/A.cfg", "cfg/B.cfg"]


def test_interfaces() -> None:
    """Interface files of both ROS versions are named with their kind."""
    text = """set(M "msg/A.msg" "srv/B.srv")
rosidl_generate_interfaces(${PROJECT_NAME} ${M} action/C.action DEPENDENCIES std_msgs)
add_message_files(FILES D.msg)
add_service_files(DIRECTORY services FILES E.srv)
add_action_files()
"""
    assert [(i.path, i.kind) for i in read(text).interfaces] == [
        ("msg/A.msg", "msg"),
        ("srv/B.srv", "srv"),
        ("action/C.action", "action"),
        ("msg/D.msg", "msg"),
        ("services/E.srv", "srv"),
        ("action/*.action", "action"),
    ]


def test_installs() -> None:
    """Installed targets, scripts and folders have their destination; programs count before libraries."""
    text = """project(p)
install(TARGETS a b EXPORT e LIBRARY DESTINATION lib RUNTIME DESTINATION lib/${PROJECT_NAME})
install(PROGRAMS scripts/run.py DESTINATION lib/p)
install(DIRECTORY launch config/ DESTINATION share/p PATTERN "*.in" EXCLUDE)
catkin_install_python(PROGRAMS nodes/talk DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
"""
    assert [(i.kind, i.items, i.destination) for i in read(text).installs] == [
        ("targets", ("a", "b"), "lib/p"),
        ("programs", ("scripts/run.py",), "lib/p"),
        ("directory", ("launch", "config/"), "share/p"),
        ("python", ("nodes/talk",), "${CATKIN_PACKAGE_BIN_DESTINATION}"),
    ]


def test_dependencies_options_python_and_gpu() -> None:
    """Searched packages, options, Python packages and CUDA are facts."""
    text = """project(p LANGUAGES CXX CUDA)
find_package(catkin REQUIRED COMPONENTS roscpp tf)
find_package(TensorRT QUIET)
option(WITH_X "text" ON)
ament_python_install_package(${PROJECT_NAME})
catkin_python_setup()
"""
    facts = read(text)
    assert [d.name for d in facts.dependencies] == ["catkin", "roscpp", "tf", "TensorRT"]
    assert [(o.name, o.default) for o in facts.options] == [("WITH_X", "ON")]
    assert [p.path for p in facts.python_packages] == ["p", "."]
    assert [(g.path, g.line) for g in facts.gpu] == [("CUDA", 1), ("TensorRT", 3)]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("robot_binary(arm SRCS src/arm_main.cc)", ("arm", "SRCS")),
        ('macro(m n)\n  robot_nodelet(${n}.cpp "p/${n}" ${n})\nendmacro()\nm(arm)', ("arm.cpp", "arm")),
        ("add_executable(a a.cc)\ninstall(TARGETS a)\ncatkin_package(LIBRARIES a)\nmessage(STATUS b)", ()),
    ],
)
def test_words_for_foreign_commands(text: str, words: tuple[str, ...]) -> None:
    """What a command of another package is given may be the name of a program."""
    assert read(text).foreign == words


def test_subdirectories_inherit_variables() -> None:
    """A subdirectory's file sees the project, with source folders relative to itself."""
    outer = b"project(p)\nset(S ${PROJECT_SOURCE_DIR}/src/a.cpp)\nadd_subdirectory(test/unit)\ninclude(x.cmake)\n"
    inner = b"add_executable(${PROJECT_NAME}_t ${S} ${PROJECT_SOURCE_DIR}/b.cpp c.cpp)"
    files = run({TOP: outer, "test/unit/CMakeLists.txt": inner})
    assert [(s.path, s.is_include) for s in files[TOP].subdirectories] == [("test/unit", False), ("x.cmake", True)]
    (found,) = files["test/unit/CMakeLists.txt"].targets
    assert (found.name, found.sources) == ("p_t", ("../../src/a.cpp", "../../b.cpp", "c.cpp"))


@pytest.mark.parametrize(
    "data",
    [
        b"set(a x x)\n" + b"set(a ${a} ${a})\n" * 5000,
        b"set(l " + b"x " * 2000 + b")\n" + b"foreach(i ${l})\n" * 5 + b"message(${i})\n" + b"endforeach()\n" * 5,
        b"function(f)\n" + b"f()\n" * 20 + b"endfunction()\nf()\n",
        b"if(A)\n" * 5000,
        b"add_library(" * 100_000,
        b"set(a " + b"${" * 100_000,
        b"\0" * 1_000_000,
        b" " * 50_000_000,
    ],
    ids=["doubling", "loops", "recursion", "blocks", "unclosed", "references", "nul", "large"],
)
def test_hostile_files_end_quickly(data: bytes) -> None:
    """Expansion, loops and recursion are bounded."""
    start = time.process_time()
    run({TOP: data})
    assert time.process_time() - start < 3


_WORDS = [
    "if(",
    "foreach(a ",
    "function(f ",
    "endif()",
    "set(x ",
    "f(",
    "add_library(",
    "${x}",
    ")",
    "\n",
    '"',
    "IN LISTS ",
]


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(_WORDS), max_size=30).map(lambda words: "".join(words).encode()))
def test_cmake_never_raises(data: bytes) -> None:
    """Any sequence of CMake text gives facts or diagnostics."""
    assert isinstance(run({TOP: data})[TOP], CmakeFile)
