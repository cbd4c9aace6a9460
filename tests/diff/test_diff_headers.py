"""Headers, their classes and what announces their end, over two releases."""

from __future__ import annotations

import pytest

Files = dict[str, str | None]
PRAGMA = "#pragma message( \\\n  \"This header is deprecated. Please use 'gripper.hpp' header.\")  //NOLINT\n"
BOX = "template <class T> class SafeBox { public: explicit SafeBox(const T & value); T get() const; };"
OLD_BOX = "template <class T> class BoxBase { public: explicit BoxBase(const T & value); T get() const; };"


def _header(*lines: str, name: str = "driver.hpp") -> Files:
    return {f"arm/include/arm/{name}": "\n".join(("#pragma once", "namespace arm {", *lines, "}")) + "\n"}


def _class(*lines: str) -> Files:
    return _header("class Driver {", "public:", *lines, "};")


def _headers(names: str, ending: str) -> Files:
    return {f"arm/include/arm/{name}.{ending}": f"#pragma once\n// {name}\n" for name in names.split()}


TOLD = {
    "each header goes to its own name": (
        _headers("Or And When Not Oneof Task Type", "h"),
        {
            **dict.fromkeys(_headers("Or And When Not Oneof Task Type", "h")),
            **_headers("Or And When Not Oneof Task Type Imply", "hpp"),
        },
        {
            *(
                ("file", "renamed", f"arm/{each}.h", f"arm/{each}.hpp")
                for each in ["Or", "And", "When", "Not", "Oneof", "Task", "Type"]
            ),
            ("file", "added", None, "arm/Imply.hpp"),
        },
    ),
    "the other ending stood there before": (
        {**_headers("tool", "h"), **_headers("tool", "hpp")},
        dict.fromkeys(_headers("tool", "h")),
        {("file", "renamed", "arm/tool.h", "arm/tool.hpp")},
    ),
    "a folder in common makes no rename": (
        _headers("tool", "hpp"),
        {**dict.fromkeys(_headers("tool", "hpp")), **_headers("wheels", "hpp")},
        {("file", "removed", "arm/tool.hpp", None), ("file", "added", None, "arm/wheels.hpp")},
    ),
    "a directive of several lines names the successor": (
        {"arm/include/arm/gripper.h": "#pragma once\n", **_headers("gripper", "hpp")},
        {"arm/include/arm/gripper.h": f"#pragma once\n#ifdef _WIN32\n{PRAGMA}#else\n{PRAGMA}#endif\n"},
        {("file", "deprecated", "arm/gripper.h", "arm/gripper.hpp")},
    ),
    "a header names the class that goes": (
        _header(OLD_BOX, "template <class T> using Box = BoxBase<T>;"),
        _header(BOX, "template <class T> using BoxBase = SafeBox<T>;", "template <class T> using Box = BoxBase<T>;")
        | {
            "arm/include/arm/driver.hpp": "#pragma once\n"
            "#pragma message(\"'Box' is deprecated, use 'SafeBox' instead\")\n"
            f"namespace arm {{\n{BOX}\ntemplate <class T> using BoxBase = SafeBox<T>;\n"
            "template <class T> using Box = BoxBase<T>;\n}\n"
        },
        {
            ("file", "deprecated", "arm/driver.hpp", "arm/driver.hpp"),
            ("class", "deprecated", "arm::Box", "arm::SafeBox"),
            ("class", "added", None, "arm::SafeBox"),
        },
    ),
    "attributes of a class and of a member": (
        _header("class Clock { public: int now; };", "struct Pose { int x; };"),
        _header(
            'class [[deprecated("use Timer")]] Clock { public: int now; };',
            "struct Pose {",
            "[[deprecated(",
            '"y")]]',
            "int x; };",
        ),
        {("class", "deprecated", "arm::Clock", "arm::Clock"), ("member", "deprecated", "x", "x")},
    ),
    "an attribute of an alias names the successor": (
        _header("class Box { public: int size; };", "using BestBox = Box;"),
        _header("class Box { public: int size; };", 'using BestBox [[deprecated("Use Box instead")]] = Box;'),
        {("class", "deprecated", "arm::BestBox", "arm::Box")},
    ),
    "a comment above a template": (
        _header("// Keeps one.", "template <class T>", "class Latched {", "public:", "T get();", "};"),
        _header("// THIS CLASS IS DEPRECATED.", "template <class T>", "class Latched {", "public:", "T get();", "};"),
        {("class", "deprecated", "arm::Latched", "arm::Latched")},
    ),
    "a class that is an instance of a template for another type now": (
        _header("class Reader { public: void read(const vector<int> & row); };"),
        _header(
            "template <class T> class AnyReader { public: void read(const vector<T> & row); };",
            "using Reader = AnyReader<bool>;",
        ),
        {
            ("class", "added", None, "arm::AnyReader"),
            ("method", "signature_changed", "read", "read"),
        },
    ),
    "a template whose parameter is another class by default": (
        _class("static std::shared_ptr<Driver> make(int id);"),
        _class("template <class T = Other> static std::shared_ptr<T> make(int id);"),
        {("method", "signature_changed", "make", "make")},
    ),
    "a method that nobody may override now": (
        _class("virtual void start(int id);", "virtual void stop();"),
        _class("void start(int id);", "void stop();", "virtual void stop(bool hard);"),
        {
            ("method", "signature_changed", "start", "start"),
            ("method", "signature_changed", "stop", "stop"),
        },
    ),
    "a method that is final now": (
        _header("class Base { public: virtual void a(); };", "class Arm : public Base { public: void a() override; };"),
        _header("class Base { public: virtual void a(); };", "class Arm : public Base { public: void a() final; };"),
        {("method", "signature_changed", "a", "a")},
    ),
    "an alias of another class": (
        _header("class Box { public: int a; };", "class Bag { public: int a; };", "using Best = Box;"),
        _header("class Box { public: int a; };", "class Bag { public: int a; };", "using Best = Bag;"),
        {("class", "type_changed", "arm::Best", "arm::Best")},
    ),
    "an alias of a template with another argument": (
        _header("template <class T> class Box { public: int a; };", "typedef Box<int> Best;"),
        _header("template <class T> class Box { public: int a; };", "typedef Box<double> Best;"),
        {("class", "type_changed", "arm::Best", "arm::Best")},
    ),
    "a class behind a macro with comments": (
        _header(
            "#define BOTH() \\",
            "  int a() { \\",
            "  }  /* NOLINT */ \\",
            "  int b() { }",
            "class Rule { public: Rule(int id); };",
        ),
        _header(
            "#define BOTH() \\",
            "  int a() { \\",
            "  }  /* NOLINT */ \\",
            "  int b() { }",
            "class Rule { public: Rule(char * name, int id); };",
        ),
        {("method", "signature_changed", "Rule", "Rule")},
    ),
}
QUIET = {
    "a parameter of a template has another name": (
        _header("template <class Msg> class Publisher { public: Msg msg_; void send(const Msg & msg); };"),
        _header(
            "template <class MessageT> class Publisher { public: MessageT msg_; void send(const MessageT & msg); };"
        ),
    ),
    "a method that is defined in another header": (
        _class("template <class T> T get(int name) const;")
        | _header("template <class T> T Driver::get(int name) const { return T(); }", name="driver_impl.hpp"),
        _class("template <class T> T get(int name) const;") | {"arm/include/arm/driver_impl.hpp": "#pragma once\n"},
    ),
    "a body in another header, of a class that a using directive names": (
        _class("template <class T> T get(int name) const;", "void stop();")
        | {
            "arm/include/arm/driver_impl.hpp": "#pragma once\nusing namespace arm;\n"
            "template <class T> T Driver::get(int name) const { return T(); }\n"
            "inline void Driver::stop() {}\n"
        },
        _class("template <class T> T get(int name, bool strict = false) const;", "void stop(bool now = false);")
        | {
            "arm/include/arm/driver_impl.hpp": "#pragma once\nusing namespace arm;\n"
            "template <class T> T Driver::get(int name, bool strict) const { return T(); }\n"
            "inline void Driver::stop(bool now) {}\n"
        },
    ),
    "a class that is an instance of a template now": (
        _header("class Reader { public: explicit Reader(Grid<int> & grid); void read(const vector<int> & row); };"),
        _header(
            "template <class T> class AnyReader {",
            "public: explicit AnyReader(Grid<T> & grid); void read(const vector<T> & row); };",
            "using Reader = AnyReader<int>;",
        ),
    ),
    "a method that is in a base with template arguments now": (
        _header("class Reader { public: void read(const vector<int> & row); };"),
        _header(
            "template <class A, class T> class AnyReader { public: void read(const vector<T> & row); };",
            "template <class T> class Middle : public AnyReader<bool, T> {};",
            "class Reader : public Middle<int> {};",
        ),
    ),
    "a template whose parameter is the class by default": (
        _class("static std::shared_ptr<Driver> make(int id);"),
        _class("template <class T = Driver> static std::shared_ptr<T> make(int id);"),
    ),
    "a method that a base says to be virtual": (
        _header(
            "class Base { public: virtual void a(); };",
            "class Arm : public Base, public other::Base { public: virtual void a(); virtual void b(); };",
        ),
        _header(
            "class Base { public: virtual void a(); };",
            "class Arm : public Base, public other::Base { public: void a(); void b(); };",
        ),
    ),
    "a method that was and is final": (
        _header("class Arm : public Base { public: virtual void a() final; void b() final; };"),
        _header("class Arm : public Base { public: void a() final; virtual void b() final; };"),
    ),
    "an alias of a class that derives from the one before": (
        _header("class Box { public: int a; };", "using Best = Box;"),
        _header("class Box { public: int a; };", "class Crate : public Box {};", "using Best = Crate;"),
    ),
    "an alias of a class that has another name as well": (
        _header("class Box { public: int a; };", "using Best = Box;"),
        _header("class Crate { public: int a; };", "using Box = Crate;", "using Best = arm::Crate;"),
    ),
    "an empty body with a stray semicolon": (
        _class("void stop();"),
        _class("void stop();", "virtual void run(int & a) {};"),
    ),
    "what a foreign base asked for": (
        _header(
            "class Shape : public ceres::Shape { public: virtual bool minus(int a) = 0; };",
            "class Ball : public Shape { public: bool plus(int a) override; bool minus(int a) override; };",
        ),
        _header(
            "class Shape { public: virtual bool minus(int a) = 0; virtual bool plus(int a) = 0; };",
            "class Ball : public Shape { public: bool plus(int a) override; bool minus(int a) override; };",
        ),
    ),
    "a macro that is called in a class": (_class("ALIASES_ONLY_OF(Driver);"), _class("FUSE_ALIASES_ONLY_OF(Driver);")),
}


@pytest.mark.parametrize("case", TOLD)
def test_headers(told, case: str) -> None:  # type: ignore[no-untyped-def]
    """Each way in which a header or what it declares changes, and nothing beside it."""
    old, new, expected = TOLD[case]
    assert told(old, new) == expected


@pytest.mark.parametrize("case", QUIET)
def test_nobody_breaks(told, case: str) -> None:  # type: ignore[no-untyped-def]
    """What neither callers nor derived classes need to notice is at most an addition."""
    old, new = QUIET[case]
    words = {word for kind, word, _, _ in told(old, new) if kind != "file"}
    assert words <= {"added"}


def test_a_duty_that_is_new_breaks(changes) -> None:  # type: ignore[no-untyped-def]
    """A class of the old release that has no such method shows that nobody asked for it."""
    old = _header("class Shape : public ceres::Shape {};", "class Ball : public Shape {};")
    new = _header("class Shape { public: virtual bool plus(int a) = 0; };", "class Ball : public Shape {};")
    assert [each["new"] for each in changes(old, new) if each["breaking"]] == ["plus"]


def test_an_interface_announces_its_end(told) -> None:  # type: ignore[no-untyped-def]
    """Above its fields; a field that speaks of something deprecated says nothing of the whole."""
    old: Files = {"arm/msg/Tool.msg": "int32 data\n", "arm/msg/Joint.msg": "# Note\n\nint32 data\n"}
    new: Files = {
        "arm/msg/Tool.msg": "# Once an example.\n# It is deprecated as of Foxy\n\nint32 data\n",
        "arm/msg/Joint.msg": "# Not for the deprecated tools\n\nint32 data\n",
    }
    assert told(old, new) == {("message", "deprecated", "arm/msg/Tool", "arm/msg/Tool")}
