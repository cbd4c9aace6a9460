"""Base classes of plugins as macros and descriptions write them (LNT009)."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

ROWS = [
    ("core::Base", "core::Base", False),
    ("core::Base", "::core::Base", False),
    ("core::Base", "Base", False),
    ("core::Base", "core::Other", True),
    ("core::Base", "other::Base", True),
    ("core::Base<a::B>", "core::Base< a::B >", False),
    ("core::Base&lt;a::B&gt;", "core::Base<a::B>", False),
    ("core::Base<a::B>", "core::Base<a::msg::B>", True),
    ("core::Base<a::B>", "BaseOfB", False),
    ("core::Base", "Alias", False),
]


@pytest.mark.parametrize(("described", "exported", "expected"), ROWS)
def test_base_classes(workspace: Workspace, described: str, exported: str, expected: bool) -> None:
    """A loader asks for one base class; a plugin that is exported for another one cannot be made."""
    macro = (
        f"using Alias = core::Base;\nnamespace pkg {{ class A {{}}; }}\nPLUGINLIB_EXPORT_CLASS(pkg::A, {exported})\n"
    )
    plugins = f'<library path="pkg"><class type="pkg::A" base_class_type="{described}"/></library>'
    build = "add_library(pkg a.cpp)\npluginlib_export_plugin_description_file(core plugins.xml)\n"
    files = {"a.cpp": macro, "plugins.xml": plugins, "CMakeLists.txt": build}
    found = [finding.rule for finding in lint(workspace.package(files).root)]
    assert ("LNT009" in found) is expected
