"""Words that a CMake file hands to commands of other packages, which may make programs of these names."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_parsers.cmake_run import Call
from ecm_parsers.cmake_targets import makes_target

_CMAKE = frozenset(
    """
    add_compile_definitions add_compile_options add_custom_command add_custom_target add_definitions add_dependencies
    add_link_options add_subdirectory add_test aux_source_directory build_command cmake_dependent_option
    cmake_host_system_information cmake_language cmake_minimum_required cmake_parse_arguments cmake_path cmake_policy
    configure_file configure_package_config_file cuda_include_directories define_property enable_language enable_testing
    execute_process export fetchcontent_declare fetchcontent_makeavailable file find_file find_library find_package
    find_package_handle_standard_args find_path find_program fltk_wrap_ui get_cmake_property get_directory_property
    get_filename_component get_property get_source_file_property get_target_property get_test_property include
    include_directories include_external_msproject include_guard install link_directories link_libraries list load_cache
    mark_as_advanced math message option pkg_check_modules pkg_search_module project qt5_add_resources qt5_wrap_cpp
    qt5_wrap_ui qt_wrap_cpp remove_definitions return separate_arguments set set_directory_properties set_property
    set_source_files_properties set_target_properties set_tests_properties site_name source_group string
    target_compile_definitions target_compile_features target_compile_options target_include_directories
    target_link_directories target_link_libraries target_link_options target_precompile_headers target_sources try_compile
    try_run unset variable_watch write_basic_package_version_file
    """.split()
)
_ROS = re.compile(
    r"(?:ament|catkin|rosidl|rosbuild|pluginlib|rclcpp|generate|add_(?:message|service|action|rostest|roslaunch|launch))_?\w*"
)
_NAME = re.compile(r"\w[\w.+-]*")


def foreign_words(calls: tuple[Call, ...]) -> Iterator[str]:
    """Yield plain words given to commands that neither CMake nor the build tools of ROS define."""
    for call in calls:
        if call.name not in _CMAKE and not _ROS.fullmatch(call.name) and not makes_target(call.name):
            yield from (word for word in call.args if _NAME.fullmatch(word))
