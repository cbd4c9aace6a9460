"""Variables that others have a way to: what they do by it is told, or nothing is told of what they may have changed."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Cfg {{
  std::string n = "n"; std::vector<std::string> l{{"l0"}};
  std::string & ref() {{ return n; }} std::string & at(size_t i) {{ return l[i]; }} Cfg & self() {{ return *this; }}
}};
struct Ref {{ std::string & s; void set(const std::string & v) {{ s = v; }} }};
class Kept {{ public: explicit Kept(std::string & s) : s_(s) {{}} void set() {{ s_ = "k"; }} std::string & s_; }};
class Tuner {{ public: explicit Tuner(Cfg & c) : c_(c) {{}} void go() {{ c_.n = "t"; }} Cfg & c_; }};
class Reader {{ public: explicit Reader(const Cfg & c) : c_(c) {{}} std::string n() const {{ return c_.n; }} const Cfg & c_; }};
class All {{
public: void add(Cfg * c, Cfg * other = nullptr) {{ all_.push_back(c); all_.push_back(other); }} void rename() {{ for (auto * c : all_) c->n = "r"; }} std::vector<Cfg *> all_;
}};
struct Own {{
  std::string n = "o"; Own() = default; explicit Own(std::string x) : n(x) {{}}
  Own(const Own & other) : n(other.n + "_copy") {{}}
}};
struct Given {{
  std::string n = "g"; Given & operator=(const Given & other) {{ n = other.n + "_given"; return *this; }}
}};
inline std::string name_of(Own own) {{ return own.n; }}
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{ start(); }}
  void start() {{ {body} }}
  void pub(const std::string & name) {{ create_publisher<std_msgs::msg::String>(name, 10); }}
}};
int main() {{ auto node = std::make_shared<Demo>(); }}
"""
OPEN = "{}"
ROWS = [
    ("a reference that braces give", 'std::string s = "a"; Ref r{s}; r.set("b"); pub(s);', OPEN),
    ("a reference that an object keeps", 'std::string s = "a"; Kept k(s); k.set(); pub(s);', OPEN),
    ("an object behind a reference", "Cfg c; Tuner t(c); t.go(); pub(c.n);", OPEN),
    ("who only reads", "Cfg c; Reader r(c); pub(c.n);", "n"),
    ("who reads what changes later", 'Cfg c; Reader r(c); c.n = "z"; pub(r.n());', OPEN),
    ("what a method shows", 'Cfg c; c.ref() = "w"; c.ref() += "x"; pub(c.n);', "wx"),
    ("what a method shows by another name", 'Cfg c; auto & r = c.ref(); r = "w"; pub(c.n);', "w"),
    ("the object that a method gives", 'Cfg c; c.self().self().n = "w"; pub(c.n);', "w"),
    ("what a method shows perhaps", 'Cfg c; c.at(0) = "w"; pub(c.l[0]);', OPEN),
    ("an address in a list", 'Cfg c; std::vector<Cfg *> v{&c}; v[0]->n = "w"; pub(c.n);', OPEN),
    ("addresses that a loop is over", 'Cfg c; for (auto * p : {&c}) p->n = "w"; pub(c.n);', OPEN),
    ("a pointer in a list", 'auto c = std::make_shared<Cfg>(); c->n = "a"; std::vector<std::shared_ptr<Cfg>> v{c}; v[0]->n = "w"; pub(c->n);', OPEN),
    ("a pointer in a list that is a part", 'auto c = std::make_shared<Cfg>(); c->n = "a"; auto * r = c.get(); r->n = "w"; pub(c->n);', OPEN),
    ("a reference that a lambda gives", 'std::string s; auto f = [&s]() -> std::string & { return s += "a"; }; f() += "b"; pub(s);', OPEN),
    ("an address that a method keeps in a list", "Cfg c; All all; all.add(&c); all.rename(); pub(c.n);", OPEN),
    ("a default that a constructor leaves", "Own a; pub(a.n);", OPEN),
    ("a copy as the class makes it", 'Own a("x"); Own b = a; pub(b.n);', "x_copy"),
    ("an argument as the class copies it", 'Own a("x"); pub(name_of(a));', "x_copy"),
    ("a text that a list copies", 'std::string s = "a"; std::vector<std::string> v; v.push_back(s); report(); pub(s);', "a"),
    ("a text that a set copies", 'std::string s = "a"; std::set<std::string> v; v.insert(s); report(); pub(s);', "a"),
    ("a key that a table copies", 'std::string s = "a"; std::map<std::string, int> v; v.emplace(s, 1); report(); pub(s);', "a"),
    ("a text that a text copies", 'std::string s = "a", t; t.append(s); report(); pub(s);', "a"),
    ("a text that a list refers to", 'std::string s = "a"; std::vector<std::reference_wrapper<std::string>> v; v.push_back(s); v[0].get() = "w"; pub(s);', OPEN),
    ("a field behind a block that hides it", 'Cfg c; c.n = "a"; { Cfg c; c.n = "b"; } pub(c.n);', "a"),
    ("a field behind a loop that hides it", 'Cfg c; c.n = "a"; for (Cfg c : {Cfg{"b", {}}}) { report(c.n); } pub(c.n);', "a"),
    ("a reference in an element of rounds", 'std::vector<Cfg> v; load(v); for (auto c : v) { pub("e"); auto & t = c.n; }', "e"),
    ("a field of what hides another", 'Cfg c; c.n = "a"; { Cfg c; pub(c.n); }', "n"),
    ("a field of a new round", 'for (int i = 0; i < 3; ++i) { Cfg c; pub(c.n); c.n = "a"; }', "n"),
    ("a field of an element that hides", 'std::vector<Cfg> v; Cfg c; c.n = "a"; v.push_back(c); for (const auto & c : v) { pub(c.n); }', "a"),
    ("a field that only a hidden one has", 'Cfg c; { Cfg c; c.n = "a"; } pub(c.n);', "n"),
    ("an element as the class copies it", 'Own a("x"); std::vector<Own> v; v.push_back(a); pub(v[0].n);', "x_copy"),
    ("what a class makes of an assignment", 'Given a; Given b; b = a; pub(b.n);', OPEN),
]  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_others_may_have_changed_is_not_told_as_it_was(workspace: Any, body: str, expected: str) -> None:
    """What is told as folded is what a run makes; beside what is perhaps so stands a hole."""
    package = workspace.package({"src/d.cpp": NODE.format(body=body), "CMakeLists.txt": "add_executable(d src/d.cpp)"})
    found = {(entry.name, entry.confidence) for entry in package.interfaces() if entry.role == "publisher"}
    if expected == OPEN:
        assert any("{" in name for name, _ in found)
        assert all(how != "folded" for _, how in found)
    else:
        assert found == {(f"/{expected}", "folded")}


def test_rounds_behind_one_that_raises_are_not_told(workspace: Any) -> None:
    """A call that raises ends the loop, though nobody handles that."""
    body = 'for (int i = 0; i < 4; ++i) { pub("n" + std::to_string(i)); failing(i); }'
    failing = 'inline int failing(int n) { if (n == 1) { throw std::runtime_error("x"); } return n; }\nclass Demo'
    source = NODE.format(body=body).replace("class Demo", failing)
    package = workspace.package({"src/d.cpp": source, "CMakeLists.txt": "add_executable(d src/d.cpp)"})
    assert sorted(entry.name for entry in package.interfaces() if entry.role == "publisher") == ["/n0", "/n1"]
