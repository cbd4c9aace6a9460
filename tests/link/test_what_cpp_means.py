"""Names as the language makes them, where that is not what the text of the code suggests."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
namespace names {{
const std::string ROOT = "root";
const std::string BELOW = ROOT + "/below";
const std::string LIST[] = {{ROOT, BELOW}};
}}
const std::string ROOT = "other";
inline std::string operator"" _t(const char * text, size_t) {{ return std::string("t_") + text; }}
struct Rate {{ double hz = 1; }};
inline double half(double whole) {{ return whole / 2; }}
inline void spoil(char * text) {{ text[0] = 'q'; }}
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{ start(); }}
  void start() {{ {body} }}
  void pub(const std::string & name) {{ create_publisher<std_msgs::msg::String>(name, 10); }}
  std::string own_ = "own";
}};
int main() {{ auto node = std::make_shared<Demo>(); }}
"""
OPEN = "pattern"
ROWS = [
    ("a copy of a variable in a lambda", 's = "a"; auto f = [s]() { return s; }; s = "b"; pub(f());', "a"),
    ("copies of all variables in a lambda", 's = "a"; auto f = [=]() { return s; }; s = "b"; pub(f());', "a"),
    ("a member in a lambda that copies", 'auto f = [=]() { return own_; }; own_ = "new"; pub(f());', "new"),
    ("a reference in a lambda", 's = "a"; auto f = [=, &s]() { return s; }; s = "b"; pub(f());', "b"),
    ("an octal number", "pub(\"n\" + std::to_string(010 + 0x1F + 0b11 + 1'000));", "n1042"),
    ("escapes", r'pub("\x41" "\101" "\u0042");', "AAB"),
    ("a loop's variable hides another", 'int i = 7; for (int i = 0; i < 2; ++i) {} pub("n" + std::to_string(i));', "n7"),
    ("a loop sets a variable", 'int i = 7; for (i = 0; i < 2; ++i) {} pub("n" + std::to_string(i));', "n2"),
    ("an element hides a variable", 's = "x"; for (std::string s : {"p", "q"}) { s += "y"; } pub(s);', "x"),
    ("a condition's variable hides another", 's = "x"; if (std::string s = "y"; !s.empty()) {} pub(s);', "x"),
    ("a small number wraps", 'uint8_t n = 250; n += 10; pub("n" + std::to_string(n));', "n4"),
    ("a number with a sign wraps", 'int8_t n = 127; n++; pub("n" + std::to_string(n));', "n-128"),
    ("no number below zero", 'unsigned int n = 0; n--; pub("n" + std::to_string(n));', "n4294967295"),
    ("a truth value of a number", 'bool n = 5; pub("n" + std::to_string(n));', "n1"),
    ("a short fraction", 'float n = 0.1; double m = n; pub("n" + std::to_string(m * 10000000));', "n1000000.014901"),
    ("names of parts that change", 'std::pair<std::string, int> p{"a", 1}; auto & [x, y] = p; x = "b"; pub(p.first);', OPEN),
    ("names of parts of a copy", 'std::pair<std::string, int> p{"a", 1}; auto [x, y] = p; x = "b"; pub(p.first);', "a"),
    ("counted in an argument", 'int i = 0; use(std::to_string(i++)); pub("n" + std::to_string(i));', "n1"),
    ("counted before it is used", 'int i = 0; pub("n" + std::to_string(++i));', "n1"),
    ("used before it is counted", 'int i = 0; pub("n" + std::to_string(i++));', "n0"),
    ("counted in an index", 'std::vector<std::string> v{"a", "b"}; int n = 0; std::string w = v[n++]; pub(w + v[n]);', "ab"),
    ("counted in a condition", 'int n = 3; while (n-- > 1) {} pub("n" + std::to_string(n));', "n0"),
    ("counted behind a body", 'int n = 2; do { s += "x"; } while (--n); pub(s);', "xx"),
    ("counted by a lambda", 'int k = 0; auto next = [&k]() { return ++k; }; next(); pub("k" + std::to_string(k));', "k1"),
    ("given in an expression", 'int b = 1; int c = (b = 7) + 1; pub("n" + std::to_string(b) + std::to_string(c));', "n78"),
    ("perhaps counted", 'int n = 1; if (other() && n++) {} pub("n" + std::to_string(n));', OPEN),
    ("counted beside a use", 'int n = 1; pub("n" + std::to_string(n++) + std::to_string(n));', OPEN),
    ("a constant of a namespace", "pub(names::BELOW);", "root/below"),
    ("a list of a namespace", "pub(names::LIST[1]);", "root/below"),
    ("a literal of a type of its own", 'pub("a"_t);', OPEN),
    ("the object by another name", 'auto me = this; me->own_ = "new"; pub(own_);', "new"),
    ("a pack", 'auto add = [&s](auto... more) { ((s += more), ...); }; s = "a"; add("b"); pub(s);', OPEN),
    ("the code of a character", "pub(\"n\" + std::to_string('a'));", OPEN),
    ("a cast", 'int n = -1; pub("n" + std::to_string(static_cast<unsigned>(n)));', "n4294967295"),
    ("a map has an order", 'std::map<std::string, int> m{{"b", 1}, {"a", 2}}; for (auto & p : m) s += p.first; pub("m" + s);', "mab"),
    ("a set has an order", 'std::set<std::string> m{"b", "a", "b"}; for (const auto & p : m) s += p; pub("m" + s);', "mab"),
    ("a list has its own", 'std::vector<std::string> m{"b", "a", "b"}; for (const auto & p : m) s += p; pub("m" + s);', "mbab"),
    ("a text is copied to a buffer", 'char b[20] = "abc"; strcpy(b, "de"); strcat(b, "f"); pub(b);', "def"),
    ("a part is copied to a buffer", 'char b[20]; strncpy(b, "abcdef", 2); pub(b);', "ab"),
    ("a character of a number", 'pub(std::string("n") + static_cast<char>(\'a\' + 1));', OPEN),
    ("a pointer into a text", 'const char * p = "hello"; pub(p + 1);', OPEN),
    ("behind a pointer into a text", 's = "hello"; pub(std::string(&s[2]));', OPEN),
    ("a byte in a stream", 'uint8_t n = 65; std::ostringstream o; o << "n" << n; pub(o.str());', OPEN),
    ("a function of a buffer", 'char b[20] = "abc"; spoil(b); pub(b);', OPEN),
    ("a library writes to a buffer", 'char b[20] = "abc"; gethostname(b, 20); pub(b);', OPEN),
    ("an iterator writes", 'std::vector<std::string> v{"a"}; auto it = v.begin(); *it = "z"; pub(v[0]);', OPEN),
    ("an iterator reads", 'std::vector<std::string> v{"a"}; auto it = v.begin(); ++it; pub(v[0]);', "a"),
    ("a pointer writes to a text", 's = "abc"; char * p = &s[0]; *p = \'z\'; pub(s);', OPEN),
    ("a pointer of a text writes to it", 's = "abc"; char * p = s.data(); p[0] = \'z\'; pub(s);', OPEN),
    ("an element of fractions", 'std::vector<double> v{1}; pub("n" + std::to_string(v[0]));', "n1.000000"),
    ("each of fractions", 'std::vector<double> v{2}; for (auto d : v) pub("n" + std::to_string(d));', "n2.000000"),
    ("each as a fraction", 'for (double d : {2}) pub("n" + std::to_string(d));', "n2.000000"),
    ("an element that is added", 'std::vector<float> v; v.push_back(3); pub("n" + std::to_string(v.back()));', "n3.000000"),
    ("a value of a table", 'std::map<std::string, double> m{{"a", 1}}; pub(std::to_string(m["a"]));', "1.000000"),
    ("a part of a table", 'std::map<std::string, double> m{{"a", 1}}; for (const auto & [k, v] : m) pub(k + std::to_string(v));', "a1.000000"),
    ("a part of a pair", 'std::pair<double, int> p{1, 2}; pub("n" + std::to_string(p.first));', "n1.000000"),
    ("a part of a tuple", 'std::tuple<int, double> p{1, 2}; pub("n" + std::to_string(std::get<1>(p)));', "n2.000000"),
    ("a small number in a list", 'std::vector<uint8_t> v{255}; v[0]++; pub("n" + std::to_string(v[0]));', "n0"),
    ("a value that is perhaps there", 'std::optional<double> o = 2; pub(std::to_string(o.value_or(1)));', "2.000000"),
    ("a field", 'Rate q; q.hz = 5; pub("n" + std::to_string(q.hz));', "n5.000000"),
    ("a type by another name", 'using Real = double; Real r = 3; pub("n" + std::to_string(r));', "n3.000000"),
    ("what a function gives and gets", 'pub(std::to_string(half(3)));', "1.500000"),
    ("two variables of a name", 'int i = 1; for (double i : {2}) { use(std::to_string(i)); } pub("n" + std::to_string(i));', "n1"),
]  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_names_are_what_the_program_makes(workspace: Any, body: str, expected: str) -> None:
    """What is told as folded is what a run makes; what is not followed has a hole."""
    declared = "std::string s; " if "s = " in body or "s +=" in body else ""
    package = workspace.package(
        {"src/d.cpp": NODE.format(body=declared + body), "CMakeLists.txt": "add_executable(d src/d.cpp)"}
    )
    found = {(entry.name, entry.confidence) for entry in package.interfaces() if entry.role == "publisher"}
    if expected == OPEN:
        assert found
        assert {("{" in name, how) for name, how in found} == {(True, OPEN)}
    else:
        assert found == {(f"/{expected}", "folded")}
