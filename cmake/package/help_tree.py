"""The command line as a tree, read from what each program prints for `--help` (CLI11's layout and argparse's)."""
import dataclasses
import os
import re
import subprocess

TEXT_COLUMN = 30  # where CLI11 begins the text of an entry


@dataclasses.dataclass
class Entry:
    """One option, argument or command as the help lists it."""
    names: list
    value: str = ""
    text: str = ""

    @property
    def choices(self) -> list:
        """The words that the value is one of; empty where it is free."""
        if listed := re.search(r"\{([^}]*)\}", self.value):
            return [word.split("->")[0] for word in listed[1].split(",")]
        return re.split(r"[|=]", self.value)[:-1] if re.fullmatch(r"[a-z][\w-]*(\|[a-z][\w-]*)+=.*", self.value) else []

    @property
    def takes_value(self) -> bool:
        """False for a flag."""
        return re.sub(r"(Excludes|Needs): .*|REQUIRED", "", self.value).strip() != ""


@dataclasses.dataclass
class Command:
    """One command with what its help says; `words` is how it is typed."""
    words: list
    summary: str = ""
    about: str = ""
    usage: str = ""
    arguments: list = dataclasses.field(default_factory=list)
    options: list = dataclasses.field(default_factory=list)
    commands: list = dataclasses.field(default_factory=list)
    closing: str = ""

    @property
    def name(self) -> str:
        return " ".join(self.words)

    def all(self):
        """This command and all below it."""
        yield self
        for command in self.commands:
            yield from command.all()


def read_tree(folder: str) -> Command:
    """The command `ensonify` of a folder of programs, with all verbs and their commands."""
    tree = read_command(folder, Command(["ensonify"], "real-time underwater sonar simulator"))
    if not tree.commands:
        raise ValueError(f"{folder}/ensonify --help lists no verb")
    return tree


def read_command(folder: str, command: Command) -> Command:
    """Fills in what the help of the command and of those below it says."""
    program = os.path.join(folder, command.words[0])
    environment = {**os.environ, "COLUMNS": "1000"}  # argparse wraps nothing then
    answer = subprocess.run([program, *command.words[1:], "--help"], env=environment, check=True, capture_output=True, text=True)
    parse(answer.stdout, command)
    for below in command.commands:
        read_command(folder, below)
    return command


def parse(text: str, command: Command) -> None:
    """Sorts the parts of one help text."""
    entries = {"arguments": command.arguments, "options": command.options, "commands": []}
    kinds = {"Positionals": "arguments", "positional arguments": "arguments", "Subcommands": "commands"}
    about, closing, section, kind = [], [], "", ""
    lines = text.rstrip().splitlines()
    for number, line in enumerate(lines):
        indent = len(line) - len(line.lstrip())
        if line.lower().startswith("usage: "):
            command.usage = line[len("usage: "):].split("   ")[0].strip()
            section = "commands"  # `ensonify` lists its verbs without a heading
        elif heading := re.fullmatch(r"(\w[\w ]*):", line):
            section = kinds.get(heading[1], "options")
        elif indent > 6:
            entries[kind][-1].text = f"{entries[kind][-1].text} {line.strip()}".strip()
        elif indent > 0:
            # argparse lists commands below the name of their argument, indented deeper
            kind = "commands" if section == "arguments" and indent == 4 else section
            entries[kind].append(entry_of(line, lines[number + 1] if number + 1 < len(lines) else ""))
        else:
            (closing if any(entries.values()) else about).append(line)
    command.about, command.closing = "\n".join(about).strip(), "\n".join(closing).strip()
    if entries["commands"]:
        command.arguments.clear()  # the argument that argparse makes of its commands
    command.commands = [Command([*command.words, entry.names[0]], entry.text) for entry in entries["commands"]]


def entry_of(line: str, following: str) -> Entry:
    """The entry that an indented line begins: names, value, and two spaces or a full column later the text."""
    head, text = re.fullmatch(r"\s*(.*?)(?: {2,}(.*))?", line).groups(default="")
    if not text and line[TEXT_COLUMN - 1:TEXT_COLUMN] == " " and not following.startswith(" " * TEXT_COLUMN):
        head, text = line[:TEXT_COLUMN].strip(), line[TEXT_COLUMN:]
    names = []
    while option := re.match(r"(-[\w-]+)(?:,? ?(?=-)|\s+|$)", head):
        names.append(option[1])
        head = head[option.end():]
    if not names:
        name, _, head = head.partition(" ")
        names = [name]
    return Entry(names, head.strip(), text)
