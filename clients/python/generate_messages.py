#!/usr/bin/env python3
"""Writes ensonify/messages.py from the field lists of the C++ structs in messages/*.h.

  generate_messages.py MESSAGES_FOLDER [--check FILE]   prints the module, or compares it with FILE (exit 1 if it differs)
"""
import pathlib
import re
import sys

STRUCT = re.compile(r"((?:^///[^\n]*\n)*)^struct (\w+) \{\n(.*?)^\};", re.M | re.S)
TYPE = re.compile(r'kType = "([^"]+)"')
ABOUT = re.compile(r'kAbout =\s*((?:"[^"]*"\s*)+);', re.S)
MEMBER = re.compile(r"^  ([\w:]+(?:<[^;={]*>)?) (\w+)(?: = ([^;]+)|(\{[^;]*\}))?;", re.M)
VISIT = re.compile(r'visit\(\s*"(\w+)",\s*"([^"]*)",\s*((?:"[^"]*"\s*)+),\s*self\.(\w+)\)', re.S)
BESIDE = re.compile(r"(\w+)::fields\(self\.(\w+), visit\);")  # a member whose fields stand beside the struct's own

SCALARS = {"std::int64_t": "int", "std::int32_t": "int", "std::uint32_t": "int", "std::uint8_t": "int", "double": "float",
           "float": "float", "bool": "bool", "std::string": "str"}
ZERO = {"int": "0", "float": "0.0", "bool": "False", "str": '""'}
DTYPES = {"std::uint8_t": "u1", "std::int16_t": "i2", "std::uint16_t": "u2", "std::int32_t": "i4", "std::uint32_t": "u4",
          "std::int64_t": "i8", "float": "f4", "double": "f8"}

HEADER = '''"""Message types, generated from messages/*.h by generate_messages.py: edit those, not this.

Arrays are numpy arrays; received ones are read-only views. docs/manual/messages.md is the reference.
"""
from dataclasses import dataclass

import numpy as np

from ensonify.typed import Message, Struct, array, fixed, list_of
'''


def python_field(kind, default, braces):
    """Annotation and default of a C++ member."""
    if kind in SCALARS:
        scalar = SCALARS[kind]
        text = (default or ZERO[scalar]).replace("true", "True").replace("false", "False")
        text = re.sub(r"kUnchanged|std::numeric_limits<double>::quiet_NaN\(\)", 'float("nan")', text)
        return scalar, text
    if match := re.fullmatch(r"(?:msg::)?Array<(.+)>", kind):
        return "np.ndarray", f'array("{DTYPES[match[1]]}")'
    if match := re.fullmatch(r"std::array<(.+), (\d+)>", kind):
        scalar, count = SCALARS[match[1]], int(match[2])
        given = [x.strip() for x in (braces or "{}").strip("{}").split(",") if x.strip()]
        values = given + [ZERO[scalar]] * (count - len(given))
        if scalar == "float":
            values = [repr(float(x)) for x in values]
        return "tuple", f"fixed({', '.join(values)})"
    if match := re.fullmatch(r"std::vector<(\w+)>", kind):
        return "list", f"list_of({match[1]})"
    if kind == "std::vector<std::string>":
        return "list", "list_of(str)"
    raise SystemExit(f"generate_messages.py: no Python for a member of type {kind}")


def fields_of(name, bodies):
    """The fields of a C++ struct as (key, unit, sentence, (kind, default, braces)), spliced ones in their place."""
    body = bodies[name]
    members = {m[2]: (m[1], m[3], m[4]) for m in MEMBER.finditer(body)}
    found, named = [], []
    for match in re.finditer(f"{VISIT.pattern}|{BESIDE.pattern}", body, re.S):
        key, unit, sentence, member, struct, spliced = match.groups()
        named.append(member or spliced)
        if struct:
            found += fields_of(struct, bodies)
        else:
            found.append((key, unit, "".join(re.findall(r'"([^"]*)"', sentence)), members.get(member)))
    if len(re.findall(r"visit\(|::fields\(", body)) != len(named) or named != list(members):
        raise SystemExit(f"generate_messages.py: the fields of {name} are not its members: {named} {list(members)}")
    return found


def python_class(comment, name, bodies):
    """The dataclass of one C++ struct."""
    body = bodies[name]
    message = TYPE.search(body)
    about = ABOUT.search(body)
    comment = ("".join(re.findall(r'"([^"]*)"', about[1])) if about
               else " ".join(line.strip("/ ") for line in comment.splitlines()) or f"Part of a message: {name}.")
    lines = ["@dataclass(eq=False)", f"class {name}({'Message' if message else 'Struct'}):", f'    """{comment}', ""]
    visits = fields_of(name, bodies)
    lines += [f"    {key} [{unit}]: {sentence}" if unit else f"    {key}: {sentence}" for key, unit, sentence, _ in visits]
    lines += ['    """', ""]
    if message:
        lines += [f'    TYPE = "{message[1]}"']
    for key, _, _, declared in visits:
        annotation, default = python_field(*declared)
        lines.append(f"    {key}: {annotation} = {default}")
    return "\n".join(lines) + "\n", message and message[1]


def module(folder):
    """The whole text of messages.py."""
    classes, names, table = [], [], []
    headers = "".join(header.read_text() for header in sorted(pathlib.Path(folder).glob("*.h")))
    structs = [m.groups() for m in STRUCT.finditer(headers) if "fields(Self& self" in m[3]]
    bodies = {name: body for _, name, body in structs}
    for comment, name, _ in structs:
        text, type_name = python_class(comment, name, bodies)
        classes.append(text)
        names.append(name)
        if type_name:
            table.append(name)
    listed = "__all__ = [\n    " + ",\n    ".join(f'"{name}"' for name in names) + ",\n]\n"
    types = "TYPES = {cls.TYPE: cls for cls in (\n    " + ",\n    ".join(table) + ",\n)}\n"
    return "\n\n".join([HEADER + "\n" + listed, *classes, types])


def main(arguments):
    text = module(arguments[0])
    if arguments[1:2] != ["--check"]:
        sys.stdout.write(text)
    elif pathlib.Path(arguments[2]).read_text() != text:
        raise SystemExit(f"{arguments[2]} is out of date: generate_messages.py {arguments[0]} > {arguments[2]}")


if __name__ == "__main__":
    main(sys.argv[1:])
