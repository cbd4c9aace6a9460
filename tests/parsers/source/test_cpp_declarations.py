"""Declarations of C++: classes, functions, constants, aliases, macros, and code a compiler would refuse."""

from __future__ import annotations

import msgspec
import pytest
from ecm_parsers.source import cpp_parser
from ecm_parsers.source.cpp import MAX_BYTES, parse_cpp
from ecm_parsers.source.expr import Call, Expr, Items, Name, Number, Op, Text
from ecm_parsers.source.facts import Alias, Import, SourceFile, Using
from hypothesis import given, settings
from hypothesis import strategies as st

HEADER = b"""#include <rclcpp/rclcpp.hpp>
#include "own/names.hpp"
#define TOPIC "odom"
#define CALL(x) something(x)
using namespace std::placeholders;
using sensor_msgs::msg::Imu;
namespace a::b {
namespace { int hidden = 1; }
enum class Mode { OFF = 0, ON };
typedef message_filters::Policy<A, B> Policy;
using Twist = geometry_msgs::msg::Twist;
static constexpr char NAME[] = "name";
template<typename T, class U = int>
class Node : public rclcpp::Node, private Helper<T>
{
public:
  explicit Node(const std::string & name = "n", int * count = nullptr);
  virtual ~Node() = default;
  [[deprecated("use start")]] void run() const;
  virtual int must() = 0;
  std::vector<std::string> list_{"x", "y"};
protected:
  static constexpr double RATE = 2.5;
  void start() override { go(); }
private:
  std::shared_ptr<Thing> thing_;
};
}
template<typename T> void a::b::Node<T>::run() const { step(); }
const std::string a::b::Node::TOPIC_NAME = "t";
PLUGINLIB_EXPORT_CLASS(a::b::Node<int>, base::Base)
"""


@pytest.fixture(scope="module")
def facts() -> SourceFile:
    return parse_cpp(HEADER).facts


def test_includes_and_usings(facts: SourceFile) -> None:
    """Includes keep their path, `using namespace` its namespace."""
    assert facts.imports == (Import("rclcpp/rclcpp.hpp", "", "", 1, angled=True), Import("own/names.hpp", "", "", 2))
    assert facts.usings == (Using("std::placeholders"),)


def test_aliases(facts: SourceFile) -> None:
    """`using`, `typedef` and using-declarations stand for another name in their scope."""
    assert facts.aliases == (
        Alias("Imu", "", "sensor_msgs::msg::Imu", 6),
        Alias("Policy", "a::b", "message_filters::Policy<A, B>", 10),
        Alias("Twist", "a::b", "geometry_msgs::msg::Twist", 11),
    )


def test_class_with_bases_fields_and_template(facts: SourceFile) -> None:
    """A class has its bases as written, its fields with access and initial values."""
    (node,) = facts.classes
    assert (node.name, node.scope, node.bases, node.template) == (
        "Node", "a::b", ("rclcpp::Node", "Helper<T>"), ("T", "U"),
    )  # fmt: skip
    fields = {field.name: field for field in node.fields}
    assert fields["list_"].default == Items((Text("x"), Text("y")))
    assert (fields["thing_"].type, fields["thing_"].traits) == ("std::shared_ptr<Thing>", ("private",))
    assert fields["RATE"].traits == ("protected", "static", "constexpr")


def test_functions_with_traits_and_scope(facts: SourceFile) -> None:
    """Declarations and definitions are told apart, also when a definition stands outside its class."""
    found = {(f.name, f.scope): f.traits for f in facts.functions}
    assert found["Node", "a::b::Node"] == ("declaration",)
    assert found["must", "a::b::Node"] == ("virtual", "pure", "declaration")
    assert found["start", "a::b::Node"] == ("protected", "override")
    runs = [f for f in facts.functions if f.name == "run"]
    assert [("declaration" in f.traits, "deprecated" in f.traits, len(f.body)) for f in runs] == [
        (True, True, 0),
        (False, False, 1),
    ]


def test_parameters_keep_types_and_defaults(facts: SourceFile) -> None:
    """A parameter's type is as written, references and pointers included."""
    maker = next(f for f in facts.functions if f.name == "Node")
    assert [(p.name, p.type) for p in maker.params] == [("name", "const std::string &"), ("count", "int *")]
    assert maker.params[0].default == Text("n")


def test_constants_of_every_kind(facts: SourceFile) -> None:
    """Macros with a value, namespace constants, static members, enum values and out-of-class definitions."""
    found = {(c.scope, c.name): c.value for c in facts.constants}
    assert found["", "TOPIC"] == Text("odom")
    assert found["a::b", "NAME"] == Text("name")
    assert found["a::b::Node", "RATE"] == Number(2.5)
    assert found["a::b::Mode", "OFF"] == Number(0)
    assert found["a::b::Node", "TOPIC_NAME"] == Text("t")
    assert "anonymous" in next(c.traits for c in facts.constants if c.name == "hidden")
    assert ("", "CALL") not in found


def test_registration_macros(facts: SourceFile) -> None:
    """A registration macro is found without a semicolon, its arguments split at the top level."""
    assert [(m.name, m.args, m.line) for m in facts.macros] == [
        ("PLUGINLIB_EXPORT_CLASS", ("a::b::Node<int>", "base::Base"), 31)
    ]


DAMAGE = [b"{", b"}", b"(", b"<", b'"', b"#if 1\n", b"\x00", b"\xff", b"template<"]
ODD = [
    b"class PKG_PUBLIC Widget : public Base { public: Widget(); EIGEN_MAKE_ALIGNED_OPERATOR_NEW\n void go(); };",
    b"class Widget : public Base {\npublic:\n MAKE_ALIGNED\n\n /** made */\n Widget() : a_(1) { b(); }\n void go(); };",
    b"class Widget : public Base {\n Q_OBJECT\n public: Widget(); void go(); };",
    b"struct Widget : Base { Widget(const M & m = {}); void go(typename T::Goal g = typename T::Goal()); };",
    b"class Widget : public Base { public:\n#if A\n void go(int);\n#else\n void go();\n#endif\n};",
    b'extern "C" { class Widget : public Base { void go(); }; }',
]


@pytest.mark.parametrize("text", ODD, ids=range(len(ODD)))
def test_macro_laden_code_is_read(text: bytes) -> None:
    """Export words, macro lines, `typename` in expressions and conditionals do not hide a class or its methods."""
    facts = parse_cpp(text).facts
    assert [(cls.name, cls.bases) for cls in facts.classes] == [("Widget", ("Base",))]
    assert "go" in {function.name for function in facts.functions}


def test_members_in_capitals_are_no_macros() -> None:
    """Only macros stand alone on a line; an initialiser whose member ends in an underscore stays."""
    text = b"int broken = [ ;\nDemo::Demo()\n: WIDTH_(read(1)),\n  NAME_(read(2))\n{\n}\n"
    assert [len(f.body) for f in parse_cpp(text).facts.functions] == [2]


def test_texts_of_macros_side_by_side_are_joined() -> None:
    """`ANGULAR_SCALE X_PART` is one argument, as the compiler joins two literals."""
    found = parse_cpp(b"void f() { declare(ANGULAR_SCALE X_PART, 1); }").facts.functions[0].body[0].value
    assert found == Call(Name("declare"), (Op("+", (Name("ANGULAR_SCALE"), Name("X_PART"))), Number(1)), line=1)


def test_a_broken_file_gives_what_can_be_read() -> None:
    """A syntax error costs its surroundings only, and says its line."""
    parsed = parse_cpp(b"void good() { call(1); }\nvoid bad( { ] ;\n}}}\nint x = 1;\nvoid also() { call(2); }\n")
    assert "good" in {function.name for function in parsed.facts.functions}
    assert [d.code for d in parsed.diagnostics] == ["cpp-syntax"]


def test_too_large_files_are_not_read() -> None:
    """A generated file above the bound is a diagnostic."""
    parsed = parse_cpp(b" " * (MAX_BYTES + 1))
    assert [d.code for d in parsed.diagnostics] == ["cpp-too-large"]


def test_facts_survive_the_wire(facts: SourceFile) -> None:
    """What a worker sends is what the linker gets."""
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(facts), type=SourceFile) == facts


@pytest.mark.parametrize("text", [b"{" * 10_000, b"namespace a {" * 3000, b"if(x){" * 5000, b"f(" * 10_000])
def test_deep_nesting_ends(text: bytes) -> None:
    """Nesting without end neither raises nor hangs."""
    assert parse_cpp(b"void g() {" + text).facts.language == "cpp"


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=400))
def test_no_bytes_raise(data: bytes) -> None:
    """Any bytes give facts."""
    assert parse_cpp(data).facts.language == "cpp"


@settings(max_examples=50, deadline=None)
@given(
    st.integers(0, len(HEADER)),
    st.sampled_from([b"{", b"}", b"(", b"<", b'"', b"#if 1\n", b"\x00", b"\xff", b"template<"]),
)
def test_no_damage_raises(at: int, inserted: bytes) -> None:
    """A real-looking file damaged anywhere still gives facts."""
    assert parse_cpp(HEADER[:at] + inserted + HEADER[at:]).facts.language == "cpp"


def test_a_file_that_takes_too_long_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """Past its time a file is a diagnostic, and the next file is read as if nothing had been."""
    monkeypatch.setattr(cpp_parser, "MAX_SECONDS", -1.0)
    slow = parse_cpp(b"void f() { g(1); }\n" * 20_000)
    assert [d.code for d in slow.diagnostics] == ["cpp-too-slow"]
    monkeypatch.undo()
    assert len(parse_cpp(b"void f() { g(1); }\n" * 2_000).facts.functions) == 2_000


def test_a_macro_before_a_qualified_return_type_is_no_scope() -> None:
    """`EXPORT std::vector<T> f();` declares f where it stands, although the grammar takes the type for its scope."""
    text = b"namespace a {\nA_PUBLIC\nstd::vector<int> parse(int urdf);\n}"
    found = parse_cpp(text).facts.functions
    assert [(each.scope, each.name, each.returns) for each in found] == [("a", "parse", "std::vector<int>")]


def test_values_of_an_enum_with_notes_stay_in_it() -> None:
    """A note on one value does not end the enum."""
    text = b'namespace a { enum class E : std::uint8_t { NEW = 0, OLD [[deprecated("use NEW")]] = 0, LAST = 1 }; }'
    assert [(each.scope, each.name) for each in parse_cpp(text).facts.constants] == [
        ("a::E", "NEW"),
        ("a::E", "OLD"),
        ("a::E", "LAST"),
    ]


def test_a_template_with_a_nameless_parameter_hides_nothing() -> None:
    """The default of a parameter without a name, by custom that of `enable_if`, does not tear its namespace."""
    text = b"""namespace a {
template<typename T, typename std::enable_if<is<T>::value>::type * = nullptr>
class Timer { public: void call(); };
struct Info { int at; };
}"""
    assert {(each.scope, each.name) for each in parse_cpp(text).facts.classes} == {("a", "Timer"), ("a", "Info")}


def test_a_torn_namespace_still_holds_what_follows() -> None:
    """Where conditionals leave a brace without its peer, declarations keep the namespaces that are open, each once."""
    text = b"""namespace outer { namespace inner {
struct Before {};
#if A
struct Torn {
#endif
namespace inner {
struct After {};
"""
    found = {(each.scope, each.name) for each in parse_cpp(text).facts.classes}
    assert found == {("outer::inner", "Before"), ("outer::inner", "After")}


def test_conditionals_that_open_one_brace_twice_hide_nothing() -> None:
    """Of `#if` / `if (a) {` / `#else` / `if (b) {` a compiler sees one; what follows stays where it is."""
    text = b"""void Node::start() {
#if A >= 5
  if (a || b) {
#else
  if (a) {
#endif
    open(1);
  }
}
void Node::stop() { close(2); }
"""
    parsed = parse_cpp(text)
    assert [(each.scope, each.name) for each in parsed.facts.functions] == [("Node", "start"), ("Node", "stop")]
    assert parsed.diagnostics == ()


def test_only_a_zero_makes_a_method_pure() -> None:
    """An empty body with a stray `;` behind it looks like a default value."""
    text = b"class A { virtual void run(int & a) {}; virtual void stop() = 0; };"
    found = {each.name: "pure" in each.traits for each in parse_cpp(text).facts.functions}
    assert found == {"run": False, "stop": True}


def test_a_comment_in_a_macro_of_several_lines_hides_nothing() -> None:
    """The grammar ends the macro at the comment, and its unbalanced rest would hide the class below."""
    macro = b"#define BOTH() \\\n  int a() { \\\n  }  /* NOLINT */ \\\n  int b() { \\\n  }\n"
    facts = parse_cpp(macro + b"\nclass A { public: void go(); };\n").facts
    assert [cls.name for cls in facts.classes] == ["A"]
    assert "go" in {function.name for function in facts.functions}


def test_an_access_that_the_grammar_mends_is_none() -> None:
    """`class{public::` has an access without a word, which changes nothing."""
    assert parse_cpp(b"class{public::// c\n}").facts.classes


@pytest.mark.parametrize(
    ("parameter", "written"),
    [
        ("void (*done)(int, int)", "void (*)(int, int)"),
        ("void (Arm::*done)(const Goal &)", "void (Arm::*)(const Goal &)"),
        ("void done(int)", "void (*)(int)"),
    ],
)
def test_a_pointer_to_a_function_is_a_parameter_like_any(parameter: str, written: str) -> None:
    (function,) = parse_cpp(f"void start(const char *name, {parameter}) {{}}".encode()).facts.functions
    assert [entry.type for entry in function.params] == ["const char *", written]


def test_what_is_declared_with_the_name_of_its_class_is_inside_it() -> None:
    """`class Outer::Inner` is a member of `Outer`, and a directive stands in the namespace that has it."""
    text = b"namespace a { using namespace b; class Outer::Inner { Inner(int x) {} }; }"
    facts = parse_cpp(text).facts
    assert [(entry.scope, entry.name) for entry in facts.classes] == [("a::Outer", "Inner")]
    assert [(entry.scope, entry.name) for entry in facts.functions] == [("a::Outer::Inner", "Inner")]
    assert facts.usings == (Using("b", "a"),)


def test_a_registration_stands_in_its_namespace() -> None:
    """The macro may name a class of the namespace around it."""
    text = b"namespace a {\nnamespace b {\n}\nPLUGINLIB_EXPORT_CLASS(C, D)\n}\nPLUGINLIB_EXPORT_CLASS(E, F)\n"
    assert [entry.scope for entry in parse_cpp(text).facts.macros] == ["a", ""]


def test_a_macro_with_arguments_is_no_function() -> None:
    """Only what makes, ends or converts an object is declared without a type; a macro reads alike."""
    text = (
        "namespace n {\ntemplate <class T> class A {\n  TYPES_OF(T);\n  A(int);\n  explicit A(T, int = 1);\n  ~A();\n"
        "  A & operator=(A const &) = delete;\n  void f();\n};\nREGISTER(A);\n}\nn::A<int>::A(int) {}\n"
    )
    names = [function.name for function in parse_cpp(text.encode()).facts.functions]
    assert names == ["A", "A", "~A", "operator=", "f", "A"]


SPECIALIZED = [
    ("template<typename T> T get(int at);", None),
    ("template<> int get(int at) { return at; }", ()),
    ("template<> std::vector<int> a::get<std::vector<int>>(int at);", ("std::vector<int>",)),
    ("template<> void Box<int>::get(int at) {}", ()),
    ("int get(int at) { return at; }", None),
]


@pytest.mark.parametrize(("text", "expected"), SPECIALIZED, ids=[row[0] for row in SPECIALIZED])
def test_explicit_specializations_say_for_what_they_are(text: str, expected: tuple[str, ...] | None) -> None:
    """The arguments behind the own name of a function; what its class is given is none of its own."""
    (function,) = parse_cpp(text.encode()).facts.functions
    assert (function.name, function.specializes) == ("get", expected)


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("low = 1, high = 2, rest", [Number(1), Number(2), None]),
        ("low, high = 2", [None, Number(2)]),
        ("low{1}, high{2}", [Number(1), Number(2)]),
        ("*low{}, high{2}", [None, Number(2)]),
        ("low{}, high{2}", [Call(Name("int"), (), line=1), Number(2)]),
        ("*low = &other, high = 2", [Op("&", (Name("other"),)), Number(2)]),
    ],
)
def test_each_of_several_fields_has_its_own_value(written: str, expected: list[Expr | None]) -> None:
    """What one of them begins with is none of what the others do."""
    facts = parse_cpp(f"class A {{ int {written}; static constexpr int {written}; }};".encode()).facts
    assert [field.default for field in facts.classes[0].fields] == [*expected, *expected]
    assert [constant.value for constant in facts.constants] == expected
