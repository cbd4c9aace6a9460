"""Draws Python programs that build names and hand them to `create_publisher`."""

from __future__ import annotations

from collections.abc import Callable

from executed.draw import Draw, Names

STUBS = {
    "rclpy/__init__.py": "def init(args=None):\n    pass\n",
    "rclpy/node.py": (
        "import os, sys\n"
        "def _lines(frame):\n"
        "    lines = []\n"
        "    while frame is not None:\n"
        "        lines.insert(0, frame.f_lineno)\n"
        "        frame = frame.f_back\n"
        "    return lines\n"
        "class Node:\n"
        "    def __init__(self, name):\n"
        "        self._made = [str(line) for line in _lines(sys._getframe(1))]\n"
        "    def create_publisher(self, kind, name, qos):\n"
        "        frame = sys._getframe(1)\n"
        "        path = os.path.basename(frame.f_code.co_filename)\n"
        "        print(path, ','.join([*self._made, *map(str, _lines(frame))]), name, sep='\\t')\n"
    ),
    "std_msgs/__init__.py": "",
    "std_msgs/msg.py": "class String:\n    pass\n",
}


class PythonProgram(Draw):
    """One program: constants, functions, a base class, a node, a main."""

    def source(self) -> str:
        self.add("import os")
        self.add("import sys")
        self.add("from rclpy.node import Node")
        self.add("from std_msgs.msg import String")
        self.constants = [self._constant() for _ in range(2)]
        self.helpers = [self._helper(index) for index in range(3)]
        self._classes()
        self.add("def main():")
        self.add(f"    node = Program({self._argument()})")
        self.add("    node.start()")
        self.add("if __name__ == '__main__':")
        self.add("    main()")
        return "\n".join(self.lines) + "\n"

    def _argument(self) -> str:
        return f'"{self.word()}", {self.small()}'

    def _constant(self) -> str:
        name = self.fresh("CONST")
        self.add(f'{name} = "{self.word()}"')
        if self.chance(0.2):
            self.add(f'{name} = "{self.word()}_2"')
        return name

    def _helper(self, index: int) -> str:
        name = f"helper{index}"
        default = f'="{self.word()}"' if self.chance(0.4) else ""
        self.add(f"def {name}(given, number, extra{default}):")
        with self.block():
            self.names = Names(["given", "extra"], ["number"])
            keep, self.left = self.left, 3
            self.this = False
            self.one((self._early, self._chosen, self._mapped, self._built, self._changed_argument))()
            self.add(f"return {self.text(2)}")
            self.left = keep
        return name

    def _early(self) -> None:
        self.add(f"if {self.test()}:")
        self.add(f"    return {self.text(1)}")

    def _chosen(self) -> None:
        for number in range(self.random.randint(1, 3)):
            self.add(f"{'if' if not number else 'elif'} number == {number}:")
            self.add(f"    return {self.text(1)}")

    def _mapped(self) -> None:
        self.add(f'names = {{"{self.word()}": "one", "{self.word()}": "two"}}')
        self.add(f"extra = names.get(given, {self.text(0)})")

    def _built(self) -> None:
        self.add('result = ""')
        self.add("for index in range(number):")
        self.add('    result += f"{given}{index}"')
        self.names.texts.append("result")

    def _changed_argument(self) -> None:
        self.add(f'given = given + "/" + {self.text(1)}')

    def _classes(self) -> None:
        self.add("class Base(Node):")
        self.add(f'    LABEL = "{self.word()}"')
        self.add(f'    def __init__(self, name, prefix="{self.word()}"):')
        self.add('        super().__init__("node")')
        self.add(f"        self.base = {self.one(('name', 'prefix', 'prefix + name', 'self.LABEL'))}")
        self.add("    def leaf(self):")
        self.add(f'        return "{self.word()}"')
        self.add("    def full(self):")
        self.add('        return self.base + "/" + self.leaf()')
        self.add("class Program(Base):")
        if self.chance(0.4):
            self.add(f'    LABEL = "{self.word()}"')
        self.add("    def __init__(self, name, count):")
        self.indent = 2
        more = f', prefix="{self.word()}"' if self.chance(0.5) else ""
        self.add(f"super().__init__(name{more})")
        self.add(f"self.own = {self.one(('name', 'name.upper()', 'str(count)'))}")
        self.add(f'self.items = ["{self.word()}", name]')
        if self.chance(0.5):
            self.add("self.items.append(self.own)")
        self.add("self.table = {}")
        self.add(f'self.table["a"] = "{self.word()}"')
        self.indent = 1
        if self.chance(0.5):
            self.add("def leaf(self):")
            self.add(f'    return "{self.word()}"')
        self.add("def again(self, topic, many=1):")
        self.add('    self.create_publisher(String, topic + "/" + str(many), 10)')
        self.add("def fill(self, names):")
        self.add(f'    names.append("{self.word()}")')
        self.add("def rename(self):")
        self.add(f'    self.own = self.own + "_{self.word()}"' if self.chance(0.5) else "    pass")
        self.add("def start(self):")
        self.indent = 2
        self.this = True
        self.names = Names()
        if self.chance(0.3):
            self.add("global " + self.constants[0])
        self.statements(self._forms(), 14)
        self.publish()
        self.indent = 0

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
            self._add_to,
            self._change_list,
            self._change_list,
            self._change_table,
            self._if,
            self._if,
            self._for,
            self._for_range,
            self._for_pairs,
            self._while,
            self._try,
            self._swap,
            self._nested,
            self._lambda,
            self._alias,
            self._comprehension,
            self._call_method,
            self._set_member,
            self._set_constant,
        )

    def _body(self) -> None:
        with self.block():
            before = len(self.lines)
            if self.nested < 3:
                self.statements(self._forms(), 3)
            if len(self.lines) == before:
                self.publish()

    # --- expressions ---------------------------------------------------------------------------------------

    def text(self, depth: int = 3) -> str:
        simple = [f'"{self.word()}"', *self.names.texts, *self.names.texts, *self.constants]
        if self.this:
            simple += ["self.own", "self.base", "self.LABEL", "self.items[0]", 'self.table["a"]']
        if depth <= 0 or self.chance(0.25):
            return self.one(simple)
        number = self.number

        def inner() -> str:
            return self.text(depth - 1)

        forms = [
            lambda: f'{inner()} + "/" + {inner()}',
            lambda: f'f"{{{self.one([*simple, "x"]) if False else self._plain(simple)}}}/{{{number()}}}"',
            lambda: f'f"{{{self._plain(simple)}}}_{{{self._plain_number()}:02d}}"',
            lambda: f'"%s_%d" % ({inner()}, {number()})',
            lambda: f'"%s_%02d" % ({inner()}, {number()})',
            lambda: f'"{{}}/{{}}".format({inner()}, {number()})',
            lambda: f'"{{1}}_{{0}}".format({inner()}, {number()})',
            lambda: f"({inner()}).upper()",
            lambda: f'({inner()}).replace("a", "o")',
            lambda: f'("/" + {inner()}).strip("/")',
            lambda: f'({inner()}).split("/")[-1]',
            lambda: f"({inner()})[1:]",
            lambda: f"str({number()})",
            lambda: f"({inner()} if {self.test()} else {inner()})",
            lambda: f'(({inner()}) or "{self.word()}")',
            lambda: f"os.path.join({inner()}, {inner()})",
            lambda: f"helper{self.small() % 3}({inner()}, {number()}, {inner()})" if self._callable() else inner(),
            lambda: f"str({self.test()})",
        ]
        if self.names.lists:
            name = self.one(self.names.lists)
            forms += [
                lambda: f"{name}[0]",
                lambda: f"{name}[-1]",
                lambda: f'"_".join({name})',
                lambda: f'"_".join([x + "1" for x in {name}])',
                lambda: f'"_".join(sorted({name}))',
            ]
        if self.names.tables:
            table = self.one(self.names.tables)
            forms += [
                lambda: f'{table}["{self.one("ab")}"]',
                lambda: f'{table}.get("{self.one("abc")}", "none")',
                lambda: f'"_".join({table}.values())',
            ]
        if self.this:
            forms += [
                lambda: "self.full()",
                lambda: "self.leaf()",
                lambda: "self.items[-1]",
                lambda: '"_".join(self.items)',
            ]
        return self.one(forms)()

    def _callable(self) -> bool:
        return getattr(self, "this", False)

    def _plain(self, simple: list[str]) -> str:
        return self.one([entry for entry in simple if '"' not in entry] or ["1"])

    def _plain_number(self) -> str:
        return self.one([str(self.small()), *self.names.numbers])

    def number(self) -> str:
        base = [str(self.small()), *self.names.numbers, *self.names.numbers]
        if self.chance(0.7):
            return self.one(base)
        left, right = self.one(base), self.one(base)
        forms = [
            f"({left} + {right})",
            f"({left} * {right})",
            f"({left} - {right})",
            f"({left} // ({right} + 1))",
            f"({left} % 3)",
        ]
        forms += [f"len({name})" for name in [*self.names.lists, *self.names.texts]]
        return self.one(forms)

    def test(self) -> str:
        if self.chance(0.15):
            return "len(sys.argv) > 1"
        forms = [
            f"{self.number()} {self.one(('<', '==', '>=', '!='))} {self.number()}",
            f"{self._simple()} == {self._simple()}",
            f'{self._simple()}.startswith("{self.one("abcdeflmors")}")',
            f"not {self._simple()}",
            f"{self.number()} > 1 and {self._simple()} != {self._simple()}",
        ]
        forms += [f"{self._simple()} in {name}" for name in self.names.lists]
        forms += [f'"{self.one("abc")}" in {name}' for name in self.names.tables]
        return self.one(forms)

    def _simple(self) -> str:
        return self.text(0)

    # --- statements ----------------------------------------------------------------------------------------

    def publish(self) -> None:
        if self.chance(0.12):
            self.add(f"self.again({self.text()}{', many=' + self.number() if self.chance(0.5) else ''})")
        else:
            self.add(f"self.create_publisher(String, {self.text()}, 10)")

    def _let(self) -> None:
        name = self.one(self.names.texts) if self.names.texts and self.chance(0.5) else self.fresh("text")
        self.add(f"{name} = {self.text()}")
        self._declare(self.names.texts, name)

    def _declare(self, group: list[str], name: str) -> None:
        if name not in group:
            group.append(name)

    def _let_number(self) -> None:
        name = self.one(self.names.numbers) if self.names.numbers and self.chance(0.4) else self.fresh("number")
        self.add(f"{name} = {self.number()}")
        self._declare(self.names.numbers, name)

    def _let_list(self) -> None:
        name = self.fresh("list")
        self.add(f"{name} = [{self.text(1)}, {self.text(1)}]")
        self.names.lists.append(name)

    def _let_table(self) -> None:
        name = self.fresh("table")
        self.add(f'{name} = {{"a": {self.text(1)}, "b": {self.text(1)}}}')
        self.names.tables.append(name)

    def _add_to(self) -> None:
        if not self.names.texts:
            return self._let()
        self.add(f"{self.one(self.names.texts)} += {self.text(1)}")
        return None

    def _change_list(self) -> None:
        if not self.names.lists:
            return self._let_list()
        name = self.one(self.names.lists)
        self.add(
            self.one(
                (
                    f"{name}.append({self.text(1)})",
                    f"{name}.insert(0, {self.text(1)})",
                    f"{name}.extend([{self.text(1)}])",
                    f"{name}.reverse()",
                    f"{name}.sort()",
                    f"{name}[0] = {self.text(1)}",
                    f"{name} += [{self.text(1)}]",
                    f"self.fill({name})",
                    f"{name}.pop(0) if len({name}) > 1 else None",
                    f"del {name}[2:]",
                    f"{name} = {name}[:2] + [{self.text(1)}]",
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
                    f'{name}["{self.one("abc")}"] = {self.text(1)}',
                    f'{name}.update({{"b": {self.text(1)}}})',
                    f'{name}.setdefault("c", {self.text(1)})',
                    f'{name}["a"] += {self.text(0)}',
                )
            )
        )
        return None

    def _if(self) -> None:
        if self.nested >= 3:
            return self.publish()
        self.add(f"if {self.test()}:")
        self._body()
        if self.chance(0.3):
            self.add(f"elif {self.test()}:")
            self._body()
        if self.chance(0.5):
            self.add("else:")
            self._body()
        if self.chance(0.15) and self.nested == 0:
            self.add(f"if {self.test()}:")
            with self.block():
                self._let()
                self.add("return")
        return None

    def _for(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("item")
        over = self.one([f'["{self.word()}", "{self.word()}_b"]', *self.names.lists, "self.items"])
        self.add(f"for {name} in list({over}):" if over[0] != "[" else f"for {name} in {over}:")
        with self.block():
            self.names.texts.append(name)
            self.statements(self._forms(), 2)
            self.publish()
            if self.chance(0.2):
                self.add(f"if {self.test()}:")
                self.add(f"    {self.one(('break', 'continue'))}")
                self.publish()
        return None

    def _for_range(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("index")
        self.add(f"for {name} in range({self.one((2, 3, 'len(self.items)'))}):")
        with self.block():
            self.names.numbers.append(name)
            self.statements(self._forms(), 2)
            self.publish()
        return None

    def _for_pairs(self) -> None:
        if self.nested >= 3:
            return self.publish()
        key, value = self.fresh("key"), self.fresh("value")
        tables = [f"{name}.items()" for name in self.names.tables]
        lists = [f"zip({name}, ['x', 'y'])" for name in self.names.lists]
        rows = f'[("{self.word()}", "{self.word()}"), ("{self.word()}2", "b")]'
        self.add(f"for {key}, {value} in {self.one([rows, *tables, *lists])}:")
        with self.block():
            self.names.texts += [key, value]
            self.publish()
        return None

    def _while(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("count")
        self.add(f"{name} = 0")
        self.add(f"while {name} < {self.small()}:")
        with self.block():
            self.names.numbers.append(name)
            self.publish()
            self.add(f"{name} += 1")
        return None

    def _try(self) -> None:
        if self.nested >= 3:
            return self.publish()
        name = self.fresh("text")
        self.add("try:")
        self.add(f"    {name} = {self.text(1)}")
        if self.chance(0.5):
            self.add(f"    {name} = {{}}[{name}]")
        self.add("except KeyError:")
        self.add(f"    {name} = {self.text(1)}")
        self.names.texts.append(name)
        return None

    def _swap(self) -> None:
        if len(self.names.texts) < 2:
            return self._let()
        first, second = self.random.sample(self.names.texts, 2)
        self.add(f"{first}, {second} = {second}, {first}")
        return None

    def _nested(self) -> None:
        if not self.names.texts:
            return self._let()
        name, text = self.fresh("inner"), self.one(self.names.texts)
        self.add(f"def {name}(more):")
        if self.chance(0.4):
            self.add(f"    nonlocal {text}")
            self.add(f'    {text} = {text} + "_" + more')
        self.add(f"    return {text} + more")
        self.add(f'self.create_publisher(String, {name}("{self.word()}"), 10)')
        self.add(f"self.create_publisher(String, {text}, 10)")
        return None

    def _lambda(self) -> None:
        name = self.fresh("make")
        self.add(f"{name} = lambda x: x + {self.text(1)}")
        if self.chance(0.5):
            self._let()
        self.add(f"self.create_publisher(String, {name}({self.text(0)}), 10)")

    def _alias(self) -> None:
        if not self.names.lists:
            return self._let_list()
        name, other = self.fresh("list"), self.one(self.names.lists)
        self.add(f"{name} = {other}")
        self.add(f"{name}.append({self.text(1)})")
        self.names.lists.append(name)
        return None

    def _comprehension(self) -> None:
        name = self.fresh("list")
        over = self.one([f'["{self.word()}", "{self.word()}"]', *self.names.lists])
        test = f' if x != "{self.word()}"' if self.chance(0.3) else ""
        self.add(f'{name} = [x + "/" + {self.text(0)} for x in {over}{test}] + ["last"]')
        self.names.lists.append(name)

    def _call_method(self) -> None:
        self.add("self.rename()")

    def _set_member(self) -> None:
        self.add(
            self.one(
                (
                    f"self.own = {self.text(1)}",
                    f"self.own += {self.text(0)}",
                    f"self.items.append({self.text(0)})",
                    f'self.table["a"] = {self.text(0)}',
                )
            )
        )

    def _set_constant(self) -> None:
        if any("global" in line for line in self.lines):
            self.add(f"{self.constants[0]} = {self.text(1)}")
        else:
            self.publish()
