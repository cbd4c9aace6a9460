"""Draws C++ programs that build names and hand them to `create_publisher`."""

from __future__ import annotations

from collections.abc import Callable

from executed.draw import Draw, Names

STUBS = {
    "rclcpp/rclcpp.hpp": """#pragma once
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>
namespace rclcpp {
struct Publisher {};
inline std::vector<int> & lines() { static std::vector<int> all; return all; }
struct Called {
  explicit Called(int line) { lines().push_back(line); }
  ~Called() { lines().pop_back(); }
};
class Node {
 public:
  explicit Node(const std::string &) {}
  virtual ~Node() = default;
  template <class T>
  std::shared_ptr<Publisher> create_publisher(
      const std::string & name, int, const char * file = __builtin_FILE(), int line = __builtin_LINE()) {
    std::string path(file);
    std::cout << path.substr(path.rfind('/') + 1) << '\\t';
    for (int called : lines()) { std::cout << called << ','; }
    std::cout << line << '\\t' << name << '\\n';
    return nullptr;
  }
};
}
""",
    "std_msgs/msg/string.hpp": "#pragma once\nnamespace std_msgs { namespace msg { struct String {}; } }\n",
}
_PUBLISH = "create_publisher<std_msgs::msg::String>"


class CppProgram(Draw):
    """One program: constants, functions, a base class, a node, a main, all in a namespace of its own."""

    def __init__(self, seed: str, space: str) -> None:
        super().__init__(seed)
        self.space = space
        self.this = False
        self.reads: list[str] = []
        self.global_name = ""

    def source(self) -> str:
        self.add('#include "rclcpp/rclcpp.hpp"')
        self.add('#include "std_msgs/msg/string.hpp"')
        self.add(f"namespace {self.space} {{")
        self.constants = [self._constant() for _ in range(3)]
        self.add("enum class Kind { FIRST, SECOND, THIRD };")
        self.add("struct Row { std::string name; std::string type; int count; };")
        self._kind()
        for index in range(3):
            self._helper(index)
        self._overloads()
        self._classes()
        self.add("inline void run(int argc) {")
        self.add("    rclcpp::Called here(__LINE__ + 1);")
        self.add(f'    Program node("{self.word()}", {self.small()});')
        self.add("    node.start(argc);")
        self.add("}")
        self.add("}")
        self.add("#ifndef BATCH")
        self.add(f"int main(int argc, char ** argv) {{ {self.space}::run(argc); return 0; }}")
        self.add("#endif")
        return "\n".join(self.lines) + "\n"

    def _constant(self) -> str:
        name = self.fresh("CONST")
        kind = self.one(("const std::string", "static const char * const", "static std::string"))
        self.add(f'{kind} {name} = "{self.word()}";')
        if kind == "static std::string":
            self.global_name = name
        return name

    def _helper(self, index: int) -> None:
        more = f' = "{self.word()}"' if self.chance(0.4) else ""
        self.add(f"inline std::string helper{index}(std::string given, int number, const std::string & extra{more}) {{")
        with self.block():
            self.names = Names(["given"], ["number"])
            self.reads = ["extra"]
            keep, self.left = self.left, 3
            self.one((self._early, self._chosen, self._switched, self._built, self._changed_argument))()
            self.add(f"return {self.text(2)};")
            self.left = keep
        self.reads = []
        self.add("}")

    def _early(self) -> None:
        self.add(f"if ({self.test()}) {{ return {self.text(1)}; }}")

    def _chosen(self) -> None:
        for number in range(self.random.randint(1, 3)):
            self.add(f"{'if' if not number else 'else if'} (number == {number}) {{ return {self.text(1)}; }}")

    def _switched(self) -> None:
        self.add("switch (number) {")
        for number in range(self.random.randint(1, 3)):
            self.add(
                f"    case {number}: {self.one(('return ' + self.text(1) + ';', 'given = ' + self.text(1) + '; break;', 'given += ' + self.text(0) + ';'))}"  # noqa: E501
            )
        if self.chance(0.5):
            self.add(f"    default: return {self.text(1)};")
        self.add("}")

    def _built(self) -> None:
        self.add("std::string result;")
        self.add("for (int index = 0; index < number; ++index) { result += given + std::to_string(index); }")
        self.names.texts.append("result")

    def _changed_argument(self) -> None:
        self.add(
            self.one(
                (f"given += {self.text(1)};", f"given.append({self.text(1)});", f"given.insert(0, {self.text(1)});")
            )
        )

    def _kind(self) -> None:
        self.add("inline std::string label(Kind kind) {")
        self.add("    switch (kind) {")
        self.add(f'        case Kind::FIRST: return "{self.word()}";')
        self.add(f'        case Kind::SECOND: return "{self.word()}_2";')
        self.add(f'        default: return "{self.word()}_3";')
        self.add("    }")
        self.add("}")
        self.add("inline void fill(std::string & out, const std::string & key) {")
        self.add(
            f"    {self.one(('out = key;', 'out += key;', 'out.append(key);', 'if (out.empty()) { out = key; }'))}"
        )
        self.add("}")
        self.add("inline void extend(std::vector<std::string> & out) {")
        self.add(f'    out.push_back("{self.word()}");')
        self.add("}")

    def _overloads(self) -> None:
        self.add(f'inline std::string named(int number) {{ return "{self.word()}" + std::to_string(number); }}')
        self.add(f'inline std::string named(const std::string & text) {{ return text + "_{self.word()}"; }}')
        self.add("template <class T> std::string twice(T value) { return named(value) + named(value); }")

    def _classes(self) -> None:
        self.add("class Base : public rclcpp::Node {")
        self.add(" public:")
        self.add(f'    explicit Base(const std::string & name, const std::string & prefix = "{self.word()}")')
        self.add(f'        : Node("node"), base_({self.one(("name", "prefix", "prefix + name"))}) {{}}')
        self.add(f'    virtual std::string leaf() const {{ return "{self.word()}"; }}')
        self.add('    std::string full() const { return base_ + "/" + leaf(); }')
        self.add(" protected:")
        self.add("    std::string base_;")
        self.add(f'    std::string label_ = "{self.word()}";')
        self.add("};")
        self.add("class Program : public Base {")
        self.add(" public:")
        more = f', "{self.word()}"' if self.chance(0.5) else ""
        self.add("    Program(const std::string & name, int count)")
        self.add(f"        : Base(name{more}), own_({self.one(('name', 'std::to_string(count)'))}) {{")
        self.indent = 2
        self.add(f'items_.push_back("{self.word()}");')
        if self.chance(0.5):
            self.add("items_.push_back(own_);")
        self.add(f'table_["a"] = "{self.word()}";')
        if self.chance(0.3):
            self.add('label_ += "_x";')
        self.indent = 1
        self.add("}")
        if self.chance(0.5):
            self.add(f'std::string leaf() const override {{ return "{self.word()}"; }}')
        self.add("void again(const std::string & topic, int many = 1, int line = __builtin_LINE()) {")
        self.add("    rclcpp::Called here(line);")
        self.add(f'    {_PUBLISH}(topic + "/" + std::to_string(many), 10);')
        self.add("}")
        self.add("void rename() {")
        self.add(f"    {self.one(('own_ += ' + chr(34) + '_r' + chr(34) + ';', ''))}")
        self.add("}")
        self.add("void start(int argc) {")
        self.indent = 2
        self.this = True
        self.names = Names()
        self.statements(self._forms(), 14)
        self.publish()
        self.indent = 1
        self.add("}")
        self.indent = 0
        self.add(" private:")
        self.add("    std::string own_;")
        self.add("    std::vector<std::string> items_;")
        self.add("    std::map<std::string, std::string> table_;")
        self.add("};")

    def _forms(self) -> tuple[Callable[[], None], ...]:
        return (
            self.publish,
            self.publish,
            self.publish,
            self._let,
            self._let,
            self._let_number,
            self._let_list,
            self._let_table,
            self._change_text,
            self._change_text,
            self._change_list,
            self._change_table,
            self._if,
            self._if,
            self._for,
            self._for_range,
            self._rows,
            self._while,
            self._switch,
            self._swap,
            self._lambda,
            self._reference,
            self._stream,
            self._call_method,
            self._set_member,
            self._fill,
            self._print,
            self._kinds,
            self._set_global,
        )

    def _body(self) -> None:
        with self.block():
            before = len(self.lines)
            if self.nested < 3:
                self.statements(self._forms(), 3)
            if len(self.lines) == before:
                self.publish()

    # --- expressions ---------------------------------------------------------------------------------------

    def _simple(self) -> str:
        simple = [f'std::string("{self.word()}")', *self.names.texts, *self.names.texts, *self.reads]
        simple += [f"std::string({name})" for name in self.constants]
        if self.this:
            simple += ["own_", "base_", "label_", "items_[0]", 'table_["a"]']
        return self.one(simple)

    def text(self, depth: int = 3) -> str:
        if depth <= 0 or self.chance(0.25):
            return self._simple()
        number = self.number

        def inner() -> str:
            return self.text(depth - 1)

        forms = [
            lambda: f'{inner()} + "/" + {inner()}',
            lambda: f'({inner()} + "_" + std::to_string({number()}))',
            lambda: f"std::string({inner()}).append({inner()})",
            lambda: f"({self.test()} ? {inner()} : {inner()})",
            lambda: f"({inner()}).substr(1)",
            lambda: f"({inner()}).substr(0, 2)",
            lambda: f"std::to_string({number()})",
            lambda: f"std::to_string({self.small()}.5)",
            lambda: f"label(Kind::{self.one(('FIRST', 'SECOND', 'THIRD'))})",
        ]
        if self.this:
            forms += [
                lambda: f"helper{self.small() % 3}({inner()}, {number()}, {inner()})",
                lambda: "full()",
                lambda: "leaf()",
                lambda: "items_.back()",
                lambda: f"named({number()})",
                lambda: f"named({inner()})",
                lambda: f"twice({inner()})",
                lambda: f"twice({number()})",
                lambda: "items_.at(0)",
                lambda: 'table_.at("a")',
            ]
        if self.names.lists:
            name = self.one(self.names.lists)
            forms += [lambda: f"{name}[0]", lambda: f"{name}.back()", lambda: f"{name}.at(0)"]
        if self.names.tables:
            table = self.one(self.names.tables)
            forms += [lambda: f'{table}["{self.one("ab")}"]', lambda: f'{table}.at("a")']
        return self.one(forms)()

    def number(self) -> str:
        base = [str(self.small()), *self.names.numbers, *self.names.numbers]
        if self.chance(0.7):
            return self.one(base)
        left, right = self.one(base), self.one(base)
        forms = [
            f"({left} + {right})",
            f"({left} * {right})",
            f"({left} - {right})",
            f"({left} / ({right} * {right} + 1))",
        ]
        forms += [f"static_cast<int>({name}.size())" for name in [*self.names.lists, *self.names.texts]]
        return self.one(forms)

    def test(self) -> str:
        if self.this and self.chance(0.15):
            return "argc > 1"
        return self.one(
            [
                f"{self.number()} {self.one(('<', '==', '>=', '!='))} {self.number()}",
                f"{self._simple()} == {self._simple()}",
                f'{self._simple()} != "{self.word()}"',
                f"{self._simple()}.empty()",
                f"!({self.number()} > 1) && {self._simple()} != {self._simple()}",
                f'{self._simple()}.find("{self.one("abcde")}") != std::string::npos',
            ]
        )

    # --- statements ----------------------------------------------------------------------------------------

    def publish(self) -> None:
        if self.chance(0.12):
            self.add(f"again({self.text()}{', ' + self.number() if self.chance(0.5) else ''});")
        else:
            self.add(f"{_PUBLISH}({self.text()}, 10);")

    def _let(self) -> None:
        if self.names.texts and self.chance(0.5):
            self.add(f"{self.one(self.names.texts)} = {self.text()};")
            return
        name = self.fresh("text")
        kind = self.one(("std::string", "std::string", "auto"))
        value = self.text()
        self.add(f"{kind} {name} = {value};" if kind != "auto" else f"auto {name} = std::string({value});")
        self.names.texts.append(name)

    def _let_number(self) -> None:
        if self.names.numbers and self.chance(0.4):
            name = self.one([entry for entry in self.names.numbers if not entry.startswith("index")] or [""])
            self.add(f"{name} = {self.number()};" if name else "")
            return
        name = self.fresh("number")
        self.add(f"int {name} = {self.number()};")
        self.names.numbers.append(name)

    def _let_list(self) -> None:
        name = self.fresh("list")
        self.add(
            self.one(
                (
                    f"std::vector<std::string> {name}{{{self.text(1)}, {self.text(1)}}};",
                    f"std::vector<std::string> {name} = {{{self.text(1)}, {self.text(1)}}};",
                    f"std::vector<std::string> {name}(2, {self.text(1)});",
                )
            )
        )
        self.names.lists.append(name)

    def _let_table(self) -> None:
        name = self.fresh("table")
        self.add(f'std::map<std::string, std::string> {name}{{{{"a", {self.text(1)}}}, {{"b", {self.text(1)}}}}};')
        self.names.tables.append(name)

    def _change_text(self) -> None:
        if not self.names.texts:
            return self._let()
        name = self.one(self.names.texts)
        self.add(
            self.one(
                (
                    f"{name} += {self.text(1)};",
                    f"{name}.append({self.text(1)});",
                    f"{name}.insert(0, {self.text(1)});",
                    f"{name}.replace(0, 1, {self.text(1)});",
                    f"{name}.erase(0, 1);",
                    f"{name}.push_back('x');",
                    f"if (!{name}.empty()) {{ {name}.pop_back(); }}",
                    f"{name}.clear();",
                    f"{name}.assign({self.text(1)});",
                    f"std::transform({name}.begin(), {name}.end(), {name}.begin(), ::toupper);",
                    f"{name}.resize(2, 'y');",
                    f"std::replace({name}.begin(), {name}.end(), 'a', 'o');",
                    f"if (!{name}.empty()) {{ {name}[0] = 'z'; }}",
                )
            )
        )
        return None

    def _change_list(self) -> None:
        if not self.names.lists:
            return self._let_list()
        name = self.one(self.names.lists)
        self.add(
            self.one(
                (
                    f"{name}.push_back({self.text(1)});",
                    f"{name}.emplace_back({self.text(1)});",
                    f"{name}.insert({name}.begin(), {self.text(1)});",
                    f"{name}[0] = {self.text(1)};",
                    f"extend({name});",
                    f"std::sort({name}.begin(), {name}.end());",
                    f"std::reverse({name}.begin(), {name}.end());",
                    f"if ({name}.size() > 1) {{ {name}.pop_back(); }}",
                    f"{name}.back() += {self.text(0)};",
                    f'for (auto & entry : {name}) {{ entry += "_e"; }}',
                )
            )
        )
        return None

    def _change_table(self) -> None:
        if not self.names.tables:
            return self._let_table()
        name = self.one(self.names.tables)
        self.add(
            self.one(
                (
                    f'{name}["{self.one("abc")}"] = {self.text(1)};',
                    f'{name}.insert({{"c", {self.text(1)}}});',
                    f'{name}.emplace("b", {self.text(1)});',
                    f'{name}["a"] += {self.text(0)};',
                )
            )
        )
        return None

    def _if(self) -> None:
        if self.nested >= 3:
            return self.publish()
        self.add(f"if ({self.test()}) {{")
        self._body()
        if self.chance(0.3):
            self.add(f"}} else if ({self.test()}) {{")
            self._body()
        if self.chance(0.5):
            self.add("} else {")
            self._body()
        self.add("}")
        if self.chance(0.15) and self.nested == 0:
            self.add(f"if ({self.test()}) {{")
            with self.block():
                self._let()
                self.add("return;")
            self.add("}")
        return None

    def _for(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("item")
        kind = self.one(("const auto &", "auto", "const std::string &", "std::string"))
        literal = f'std::vector<std::string>{{"{self.word()}", "{self.word()}_b"}}'
        copies = [f"std::vector<std::string>({entry})" for entry in self.names.lists]
        self.add(f"for ({kind} {name} : {self.one([literal, *copies, 'items_'])}) {{")
        with self.block():
            group = self.reads if kind.startswith("const") else self.names.texts
            keep = list(self.reads)
            if group is self.reads:
                self.reads = [*self.reads, name]
            else:
                self.names.texts.append(name)
            self.statements(self._forms(), 2)
            self.publish()
            if self.chance(0.2):
                self.add(f"if ({self.test()}) {{ {self.one(('break;', 'continue;'))} }}")
                self.publish()
            self.reads = keep
        self.add("}")
        return None

    def _for_range(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("index")
        step = self.one((f"++{name}", f"{name}++", f"{name} += 2"))
        self.add(f"for (int {name} = {self.small()}; {name} < 4; {step}) {{")
        with self.block():
            self.names.numbers.append(name)
            self.statements(self._forms(), 2)
            self.publish()
        self.add("}")
        return None

    def _rows(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("rows")
        self.add(f'const std::vector<Row> {name}{{{{"{self.word()}", "t", 1}}, {{"{self.word()}_2", "u", 2}}}};')
        self.add(f"for (const auto & row : {name}) {{")
        with self.block():
            self.reads = [*self.reads, "row.name", "row.type"]
            self.names.numbers.append("row.count")
            self.publish()
            self.reads = self.reads[:-2]
        self.add("}")
        return None

    def _while(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("index")
        self.add(f"int {name} = 0;")
        self.add(f"while ({name} < {self.small()}) {{")
        with self.block():
            self.names.numbers.append(name)
            self.publish()
            self.add(f"{name}++;")
        self.add("}")
        return None

    def _switch(self) -> None:
        if self.nested >= 3:
            return self.publish()
        self.add(f"switch ({self.number()}) {{")
        for number in range(self.random.randint(1, 3)):
            self.add(f"    case {number}: {{")
            self.indent += 1
            with self.block():
                self.statements(self._forms(), 2)
                if self.chance(0.7):
                    self.add("break;")
            self.indent -= 1
            self.add("    }")
        if self.chance(0.5):
            self.add("    default:")
            self.indent += 1
            with self.block():
                self.publish()
            self.indent -= 1
        self.add("}")
        return None

    def _swap(self) -> None:
        if len(self.names.texts) < 2:
            return self._let()
        first, second = self.random.sample(self.names.texts, 2)
        self.add(f"std::swap({first}, {second});")
        return None

    def _lambda(self) -> None:
        name = self.fresh("make")
        texts = self.names.texts
        if texts and self.chance(0.4):
            self.add(f"auto {name} = [&](const std::string & more) {{ {self.one(texts)} += more; return more; }};")
        else:
            self.add(
                f"auto {name} = [{self.one('&=')}, this](const std::string & more) mutable {{ return more + {self.text(1)}; }};"  # noqa: E501
            )
        if self.chance(0.5):
            self._let()
        self.add(f"{_PUBLISH}({name}({self.text(0)}), 10);")

    def _reference(self) -> None:
        if not self.names.texts:
            return self._let()
        name, other = self.fresh("text"), self.one(self.names.texts)
        self.add(
            self.one(
                (
                    f"std::string & {name} = {other};",
                    f"auto & {name} = {other};",
                    f'std::string * pointer_{name} = &{other}; std::string {name} = *pointer_{name}; *pointer_{name} += "_p";',  # noqa: E501
                )
            )
        )
        self.names.texts.append(name)
        return None

    def _stream(self) -> None:
        name = self.fresh("stream")
        self.add(f"std::stringstream {name};")
        self.add(f'{name} << {self.text(1)} << "/" << {self.number()};')
        self.add(f"{_PUBLISH}({name}.str(), 10);")

    def _call_method(self) -> None:
        self.add("rename();")

    def _set_member(self) -> None:
        self.add(
            self.one(
                (
                    f"own_ = {self.text(1)};",
                    f"own_ += {self.text(0)};",
                    f"own_.append({self.text(0)});",
                    f"items_.push_back({self.text(0)});",
                    f'table_["a"] = {self.text(0)};',
                    f"this->own_ = {self.text(1)};",
                )
            )
        )

    def _fill(self) -> None:
        if not self.names.texts:
            return self._let()
        self.add(f"fill({self.one(self.names.texts)}, {self.text(0)});")
        return None

    def _print(self) -> None:
        name = self.fresh("buffer")
        self.add(f"char {name}[64];")
        self.add(
            f'snprintf({name}, sizeof({name}), "{self.one(("%s_%d", "%s/%02d", "%s%i"))}", ({self.text(0)}).c_str(), {self.number()});'  # noqa: E501
        )
        self.add(f"{_PUBLISH}({name}, 10);")

    def _kinds(self) -> None:
        if self.nested >= 3:
            return self.publish()
        self.add("for (auto kind : {Kind::FIRST, Kind::SECOND}) {")
        with self.block():
            self.add("if (kind == Kind::FIRST) {")
            self._body()
            self.add("} else {")
            self.add(f"    {_PUBLISH}(label(kind), 10);")
            self.add("}")
        self.add("}")
        return None

    def _set_global(self) -> None:
        if not self.global_name:
            return self.publish()
        self.add(f"{self.global_name} {self.one(('=', '+='))} {self.text(1)};")
        return None
