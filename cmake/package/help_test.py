"""Man pages and completions from help texts in the two layouts that our programs print: CLI11's and argparse's."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from completions import completions  # noqa: E402
from help_tree import Command, parse, read_tree  # noqa: E402
from man_pages import man_pages  # noqa: E402

TOP = """Usage: ensonify VERB [OPTIONS]      (ensonify VERB --help tells more)

  run        start a launch file's processes
  plot       pictures

Processes of a launch file: vehicle
"""
RUN = """Starts processes.
Usage: ensonify run [OPTIONS] launch

Positionals:
  launch TEXT Excludes: --run launch file (YAML)

Options:
  -h,--help                   Print this help message and exit
  --rate FLOAT:FLOAT in [0.001 - 1e+06] Excludes: --free
                              sim seconds per wall second
                              and more
  --free Excludes: --rate     run as fast as possible
  --order TEXT:{up,down}=up   which way
  --law fine-sand|clay=clay   whose law

Exit codes: 0 all well.
"""
PLOT = """usage: ensonify plot [-h] VERB ...

Pictures from a record.

positional arguments:
  VERB
    angular-response
                    Backscatter against angle.
    fan             One ping.

options:
  -h, --help        show this help message and exit
"""
FAN = """usage: ensonify plot fan [-h] [--out FILE] [RECORD]

One ping.

positional arguments:
  RECORD                an MCAP file

options:
  --out FILE            the picture
"""


def parsed(text: str) -> Command:
    command = Command(["ensonify", "x"])
    parse(text, command)
    return command


def tree_of_programs() -> Command:
    """The tree as read from programs that print these texts."""
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder, "ensonify")
        texts = {"--help": TOP, "run --help": RUN, "plot --help": PLOT, "plot fan --help": FAN, "plot angular-response --help": FAN}
        cases = "".join(f'"{arguments}") cat <<\'TEXT\'\n{text}TEXT\n;;\n' for arguments, text in texts.items())
        program.write_text(f'#!/bin/sh\ncase "$*" in\n{cases}*) exit 2 ;;\nesac\n')
        program.chmod(0o755)
        return read_tree(folder)


class HelpTest(unittest.TestCase):
    def test_an_entry_of_cli11_has_names_value_and_text(self):
        run = parsed(RUN)
        self.assertEqual([option.names for option in run.options],
                         [["-h", "--help"], ["--rate"], ["--free"], ["--order"], ["--law"]])
        self.assertEqual(run.options[1].text, "sim seconds per wall second and more")
        self.assertEqual((run.arguments[0].names, run.arguments[0].text), (["launch"], "launch file (YAML)"))
        self.assertEqual((run.about, run.usage, run.closing), ("Starts processes.", "ensonify run [OPTIONS] launch", "Exit codes: 0 all well."))

    def test_a_flag_takes_no_value_whatever_it_excludes(self):
        self.assertEqual([option.takes_value for option in parsed(RUN).options], [False, True, False, True, True])

    def test_choices_are_the_words_that_a_value_is_one_of(self):
        self.assertEqual([option.choices for option in parsed(RUN).options], [[], [], [], ["up", "down"], ["fine-sand", "clay"]])

    def test_argparse_lists_commands_below_the_name_of_their_argument(self):
        plot = parsed(PLOT)
        self.assertEqual([(below.name, below.summary) for below in plot.commands],
                         [("ensonify x angular-response", "Backscatter against angle."), ("ensonify x fan", "One ping.")])
        self.assertEqual((plot.arguments, plot.about), ([], "Pictures from a record."))

    def test_there_is_a_page_for_the_program_and_for_each_verb(self):
        pages = man_pages(tree_of_programs(), "1.2.3")
        self.assertEqual(sorted(pages), ["ensonify", "ensonify-plot", "ensonify-run"])
        self.assertIn(".SH NAME\nensonify\\-run \\- start a launch file's processes\n", pages["ensonify-run"])
        self.assertIn('.SH "ensonify plot fan"\n', pages["ensonify-plot"])
        self.assertIn("\\fB\\-\\-rate\\fR \\fIFLOAT in [0.001 \\- 1e+06]", pages["ensonify-run"])

    def test_bash_offers_what_may_follow(self):
        script = completions(tree_of_programs())["bash-completion/completions/ensonify"]
        for typed, offered in (("", "run plot"), ("pl", "plot"), ("plot ", "angular-response fan"), ("plot fan --", "--out"),
                               ("run --r", "--rate"), ("run --rate ", ""), ("run --order ", "up down"), ("run x.yaml --law c", "clay")):
            with self.subTest(typed=typed):
                words = " ".join(f"'{word}'" for word in ["ensonify", *typed.split(" ")])
                ask = f'COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _ensonify; echo "${{COMPREPLY[*]}}"'
                answer = subprocess.run(["bash", "-c", script + ask], check=True, capture_output=True, text=True)
                self.assertEqual(answer.stdout.strip(), offered)


if __name__ == "__main__":
    unittest.main()
