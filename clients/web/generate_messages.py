#!/usr/bin/env python3
"""Writes src/messages.ts from the field lists of the C++ structs in messages/*.h, as the Python client's are written.

  generate_messages.py MESSAGES_FOLDER [--check FILE]   prints the module, or compares it with FILE (exit 1 if it differs)
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "python"))
from generate_messages import STRUCT, TYPE, fields_of  # noqa: E402

SCALARS = {"bool": "boolean", "std::string": "string"}
ARRAYS = {"std::uint8_t": "Uint8Array", "std::int16_t": "Int16Array", "std::uint16_t": "Uint16Array", "std::int32_t": "Int32Array",
          "std::uint32_t": "Uint32Array", "std::int64_t": "BigInt64Array", "float": "Float32Array", "double": "Float64Array"}

HEADER = """// Message types, generated from messages/*.h by generate_messages.py: edit those, not this.

/** An array of a message: elements in C order. */
export interface Numbers<T> {
  shape: number[];
  data: T;
}
"""


def fnv1a(text):
    """As messages/envelope.h."""
    value = 0xCBF29CE484222325
    for byte in text.encode():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


def typescript(kind):
    """The type of a C++ member."""
    if match := re.fullmatch(r"(?:msg::)?Array<(.+)>", kind):
        return f"Numbers<{ARRAYS[match[1]]}>"
    if match := re.fullmatch(r"std::array<.+, \d+>", kind):
        return "number[]"
    if match := re.fullmatch(r"std::vector<(.+)>", kind):
        return f"{SCALARS.get(match[1], match[1])}[]"
    return SCALARS.get(kind, "number")


def module(folder):
    """The whole text of messages.ts."""
    headers = "".join(header.read_text() for header in sorted(pathlib.Path(folder).glob("*.h")))
    structs = [m.groups() for m in STRUCT.finditer(headers) if "fields(Self& self" in m[3]]
    bodies = {name: body for _, name, body in structs}
    text, types = [HEADER], []
    for _, name, body in structs:
        lines = [f"export interface {name} {{"]
        for key, unit, sentence, (kind, _, _) in fields_of(name, bodies):
            lines += [f"  /** {sentence}{f' ({unit})' if unit else ''} */", f"  {key}: {typescript(kind)};"]
        text.append("\n".join(lines + ["}\n"]))
        if found := TYPE.search(body):
            types.append((found[1], name))
    table = "".join(f'  "{fnv1a(name):016x}": "{name}",\n' for name, _ in types)
    text.append(f"/** Names of types by the hash in an envelope, in hexadecimal. */\nexport const TYPES: Record<string, string> = {{\n{table}}};\n")
    return "\n".join(text)


def main(arguments):
    text = module(arguments[0])
    if arguments[1:2] != ["--check"]:
        sys.stdout.write(text)
    elif pathlib.Path(arguments[2]).read_text() != text:
        raise SystemExit(f"{arguments[2]} is out of date: generate_messages.py {arguments[0]} > {arguments[2]}")


if __name__ == "__main__":
    main(sys.argv[1:])
