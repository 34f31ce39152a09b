"""Completion for bash, zsh and fish, from the tree of the help. All three find the command that the typed words name, then
offer its commands, its options, the words that an option is one of, or else files."""
import re

from help_tree import Command

FOUND = {  # how each shell walks along the typed words; @COMMANDS@ are the full names of all commands
    "bash": '''\
_ensonify() {
  local at=ensonify word i choices=""
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$at ${COMP_WORDS[i]}" in
      @COMMANDS@) at="$at ${COMP_WORDS[i]}" ;;
    esac
  done
''',
    "zsh": '''\
#compdef ensonify
local at=ensonify word previous=${words[CURRENT-1]}
local -a commands options
for word in ${words[2,CURRENT-1]}; do
  case "$at $word" in
    @COMMANDS@) at="$at $word" ;;
  esac
done
''',
    "fish": '''\
function __ensonify_at
    set -l at ensonify
    for word in (commandline -opc)[2..-1]
        if contains -- "$at $word" @COMMANDS@
            set at "$at $word"
        end
    end
    test "$at" = "$argv"
end
'''}


def completions(tree: Command) -> dict:
    """Text by file below share/."""
    return {"bash-completion/completions/ensonify": bash(tree), "zsh/vendor-completions/_ensonify": zsh(tree),
            "fish/vendor_completions.d/ensonify.fish": fish(tree)}


def found(shell: str, tree: Command, between: str) -> str:
    return FOUND[shell].replace("@COMMANDS@", between.join(f'"{below.name}"' for below in list(tree.all())[1:]))


def bash(tree: Command) -> str:
    text = found("bash", tree, " | ") + '  case "$at:$previous" in\n'
    for command in tree.all():
        for option in valued(command):
            pattern = " | ".join(f'"{command.name}:{name}"' for name in option.names)
            text += f'    {pattern}) {"choices=" + quoted(" ".join(option.choices)) if option.choices else "return"} ;;\n'
    text += '    *)\n      case "$at:$current" in\n'
    for command in tree.all():
        text += f'        "{command.name}:"-*) choices={quoted(" ".join(name for option in command.options for name in option.names))} ;;\n'
        if command.commands:
            text += f'        "{command.name}:"*) choices={quoted(" ".join(below.words[-1] for below in command.commands))} ;;\n'
    return text + '''      esac ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
}
complete -o default -F _ensonify ensonify
'''


def zsh(tree: Command) -> str:
    text = found("zsh", tree, "|") + 'case "$at:$previous" in\n'
    for command in tree.all():
        for option in valued(command):
            pattern = "|".join(f'"{command.name}:{name}"' for name in option.names)
            text += f'  {pattern}) {"compadd -- " + " ".join(option.choices) if option.choices else "_files"}; return ;;\n'
    text += 'esac\ncase "$at" in\n'
    for command in tree.all():
        commands = " ".join(quoted(f"{below.words[-1]}:{brief(below.summary)}") for below in command.commands)
        options = " ".join(quoted(f"{name}:{brief(option.text)}") for option in command.options for name in option.names)
        text += f'  "{command.name}")\n    commands=({commands})\n    options=({options}) ;;\n'
    return text + '''esac
if [[ ${words[CURRENT]} == -* ]]; then
  _describe option options
elif (( ${#commands} )); then
  _describe command commands
else
  _files
fi
'''


def fish(tree: Command) -> str:
    text = found("fish", tree, " ")
    for command in tree.all():
        here = f"complete -c ensonify -n '__ensonify_at {command.name}'"
        for below in command.commands:
            text += f"{here} -f -a {below.words[-1]} -d {quoted(brief(below.summary), fish=True)}\n"
        for option in command.options:
            names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
            value = f" -x -a '{' '.join(option.choices)}'" if option.choices else " -r" if option.takes_value else ""
            text += f"{here} {names}{value} -d {quoted(brief(option.text), fish=True)}\n"
    return text


def valued(command: Command) -> list:
    """The options that take a value."""
    return [option for option in command.options if option.takes_value]


def brief(text: str) -> str:
    """The first sentence or part of one, for a line in a menu."""
    return re.split(r"[.;:] ", text)[0].rstrip(".")[:100]


def quoted(text: str, fish: bool = False) -> str:
    """A word in single quotes, as the shells and fish escape one inside."""
    return "'" + (text.replace("\\", "\\\\").replace("'", "\\'") if fish else text.replace("'", "'\\''")) + "'"
