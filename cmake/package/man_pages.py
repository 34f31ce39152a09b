"""Manual pages of `ensonify` and its verbs, from the tree of their help."""
import re

from help_tree import Command, Entry


def man_pages(tree: Command, version: str) -> dict:
    """Text by page name: ensonify, and one page per verb with the verb's own commands."""
    return {"-".join(command.words): page(command, tree, version) for command in [tree, *tree.commands]}


def page(command: Command, tree: Command, version: str) -> str:
    title = "-".join(command.words)
    lines = [f'.TH {title.upper()} 1 "" "ensonify {version}" "Ensonify"', ".nh", ".ad l", ".SH NAME", f"{roff(title)} \\- {roff(command.summary)}",
             ".SH SYNOPSIS", f".B {roff(command.usage)}"]
    if command.about:
        lines += [".SH DESCRIPTION", *text(command.about)]
    lines += lists(command, ".SH")
    if command is tree:
        lines += [".SH COMMANDS", *(line for verb in tree.commands for line in item(f"\\fB{roff(verb.name)}\\fR", verb.summary))]
    else:
        lines += [line for below in list(command.all())[1:] for line in subsection(below)]
    if command.closing:
        lines += [".SH NOTES", *text(command.closing)]
    others = ["-".join(verb.words) for verb in [tree, *tree.commands] if verb is not command]
    lines += [".SH SEE ALSO", ",\n".join(f"\\fB{roff(name)}\\fR(1)" for name in others)]
    return "\n".join(lines) + "\n"


def subsection(command: Command) -> list:
    """A command of a verb."""
    return [f'.SH "{roff(command.name)}"', f".B {roff(command.usage)}", ".PP", *text(command.about or command.summary), *lists(command, ".SS")]


def lists(command: Command, heading: str) -> list:
    """Arguments and options, with headings of the given rank."""
    lines = []
    for name, entries in (("Arguments", command.arguments), ("Options", command.options)):
        if entries:
            lines += [f"{heading} {name.upper() if heading == '.SH' else name}"]
            lines += [line for entry in entries for line in item(label(entry), entry.text)]
    return lines


def label(entry: Entry) -> str:
    """What is typed in bold, what stands for a value in italics."""
    names = ", ".join(f"\\fB{roff(name)}\\fR" for name in entry.names)
    value = re.sub(r"\b(\w+):\1 in ", r"\1 in ", entry.value)  # CLI11 names the type of a bounded number twice
    return f"{names} \\fI{roff(value)}\\fR" if value else names


def item(tag: str, content: str) -> list:
    return [".TP", tag, *(text(content) or ["\\&"])]


def text(content: str) -> list:
    """Running text; a line that would begin with a control character is held back."""
    return [re.sub(r"^([.'])", r"\\&\1", roff(line)) for line in content.splitlines()]


def roff(content: str) -> str:
    return content.replace("\\", "\\e").replace("-", "\\-")
