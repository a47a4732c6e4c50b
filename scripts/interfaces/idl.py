"""Reads the part of IDL that idl/graspd.idl uses into plain values.

Known are modules, `@final` structs, constants in modules named X__Constants, `///` comments before a
declaration and `///<` comments behind one, which may go on in `///<` lines below. Other comments are
skipped. Every other word is an IdlError that names its line.
"""

import re
from dataclasses import dataclass, field

TOKEN = re.compile(r"///<(?P<behind>[^\n]*)|///(?P<before>[^\n]*)|//[^\n]*|(?P<newline>\n)|[ \t\r]+"
                   r"|(?P<word>@?[A-Za-z_][A-Za-z0-9_]*(?:::[A-Za-z_][A-Za-z0-9_]*)*|[0-9]+"
                   r"|[{}<>\[\];,=-])")
BASIC_TYPES = ("boolean", "octet", "float", "double", "string", "long", "long long", "unsigned long",
               "unsigned long long")
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


class IdlError(Exception):
    """What cannot be read, with its line."""


@dataclass
class Constant:
    type: str
    name: str
    value: int
    comment: str


@dataclass
class Member:
    """One member of a struct.

    `shape` is "one", "array", "bounded" or "unbounded"; `size` the length of an array or the bound of a
    sequence, else 0; `string_bound` 0 for a string without bound.
    """

    name: str
    type: str  # one of BASIC_TYPES or the full name of a struct
    shape: str = "one"
    size: int = 0
    string_bound: int = 0
    comment: str = ""
    line: int = 0


@dataclass
class Struct:
    scope: str  # such as "graspd_msgs::msg::dds_"
    name: str
    comment: str
    members: list = field(default_factory=list)


@dataclass
class Idl:
    structs: dict = field(default_factory=dict)  # full name -> Struct, in the order of the text
    constants: dict = field(default_factory=dict)  # full name of what X__Constants is for -> list


def split(text):
    """Yields (kind, text, line); kind is "word", "before" or "behind"."""
    at = 0
    line = 1
    while at < len(text):
        match = TOKEN.match(text, at)
        if not match:
            raise IdlError(f"line {line}: unknown character '{text[at]}'")
        at = match.end()
        if match.lastgroup == "newline":
            line += 1
        elif match.lastgroup:
            yield match.lastgroup, match[match.lastgroup], line


class Parser:
    """A recursive-descent parser over the words and comments of one text."""

    def __init__(self, text):
        self.tokens = list(split(text)) + [("end", "end of file", text.count("\n") + 1)]
        self.at = 0
        self.idl = Idl()

    def parse(self):
        while self.tokens[self.at][0] != "end":
            self.definition([])
        self.check_references()
        return self.idl

    def fail(self, wanted):
        _, text, line = self.tokens[self.at]
        raise IdlError(f"line {line}: expected {wanted}, found '{text.strip()}'")

    def accept(self, word):
        if self.tokens[self.at][:2] != ("word", word):
            return False
        self.at += 1
        return True

    def expect(self, word):
        if not self.accept(word):
            self.fail(f"'{word}'")

    def matching(self, pattern, wanted):
        kind, text, _ = self.tokens[self.at]
        if kind != "word" or not pattern.fullmatch(text):
            self.fail(wanted)
        self.at += 1
        return text

    def name(self):
        return self.matching(NAME, "a name")

    def number(self):
        return int(self.matching(re.compile("[0-9]+"), "a number"))

    def comments(self, kind):
        lines = []
        while self.tokens[self.at][0] == kind:
            lines.append(self.tokens[self.at][1].strip())
            self.at += 1
        return "\n".join(lines)

    def definition(self, scope):
        comment = self.comments("before")
        if self.accept("module"):
            self.module(scope)
        elif self.accept("@final"):
            self.expect("struct")
            self.struct(scope, comment)
        else:
            self.fail("'module' or '@final struct'")

    def module(self, scope):
        name = self.name()
        self.expect("{")
        if name.endswith("__Constants"):
            owner = "::".join(scope + [name.removesuffix("_Constants")])
            self.idl.constants[owner] = self.members_until_brace(self.constant)
        else:
            while not self.accept("}"):
                self.definition(scope + [name])
        self.expect(";")

    def struct(self, scope, comment):
        name = self.name()
        full_name = "::".join(scope + [name])
        if full_name in self.idl.structs:
            self.fail(f"no second struct {full_name}")
        self.expect("{")
        members = self.members_until_brace(self.member)
        self.expect(";")
        self.idl.structs[full_name] = Struct("::".join(scope), name, comment, members)

    def members_until_brace(self, read_one):
        members = []
        while not self.accept("}"):
            before = self.comments("before")
            members.append(read_one())
            self.expect(";")
            behind = self.comments("behind")
            members[-1].comment = "\n".join(part for part in (before, behind) if part)
        return members

    def constant(self):
        self.expect("const")
        type_name = self.type_name()
        name = self.name()
        self.expect("=")
        sign = -1 if self.accept("-") else 1
        return Constant(type_name, name, sign * self.number(), "")

    def type_name(self):
        line = self.tokens[self.at]
        words = [self.matching(re.compile("[A-Za-z_].*"), "a type")]
        while words[-1] in ("unsigned", "long") and self.accept("long"):
            words.append("long")
        name = " ".join(words)
        if name not in BASIC_TYPES and "::" not in name:
            raise IdlError(f"line {line[2]}: unknown type '{name}'")
        return name

    def element(self, member):
        member.type = self.type_name()
        if member.type == "string" and self.accept("<"):
            member.string_bound = self.number()
            self.expect(">")

    def member(self):
        member = Member("", "", line=self.tokens[self.at][2])
        if self.accept("sequence"):
            self.expect("<")
            self.element(member)
            member.shape = "unbounded"
            if self.accept(","):
                member.shape = "bounded"
                member.size = self.number()
            self.expect(">")
        else:
            self.element(member)
        member.name = self.name()
        if member.shape == "one" and self.accept("["):
            member.shape = "array"
            member.size = self.number()
            self.expect("]")
        return member

    def check_references(self):
        for struct in self.idl.structs.values():
            for member in struct.members:
                if "::" in member.type and member.type not in self.idl.structs:
                    raise IdlError(f"line {member.line}: unknown type '{member.type}'")
        for owner in self.idl.constants:
            if owner not in self.idl.structs:
                raise IdlError(f"constants of {owner}, which is not a struct")


def parse(text):
    """The structs and constants of an IDL text; IdlError where it cannot be read."""
    return Parser(text).parse()
