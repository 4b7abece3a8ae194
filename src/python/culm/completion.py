"""Prints what a shell needs to complete the words of a command line: verbs, options, files.

bash reads it from a folder such as ~/.local/share/bash-completion/completions, as `culm`; zsh from a
folder of its fpath, as `_culm`."""

from . import commands


def declare(parser):
    parser.add_argument("shell", choices=("bash", "zsh"), help="that shall complete")


def main(arguments, program):
    culm = commands.read(program)
    print({"bash": _bash, "zsh": _zsh}[arguments.shell](culm), end="")
    return 0


def _words(command):
    """What may follow a command: its verbs and its options."""
    options = [name for option in command.options if not option.positional for name in option.names]
    return [verb.verb for verb in command.verbs] + options


def _bash(culm):
    cases = "".join(
        f'    "{command.name}") words="{" ".join(_words(command))}" ;;\n' for command in culm.all()
    )
    return f"""# bash completion for culm, made by `culm completion bash`
_culm() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} command=culm words=
  local -i i
  for ((i = 1; i < COMP_CWORD && i < 3; ++i)); do
    case "$command ${{COMP_WORDS[i]}}" in
      {" | ".join(f'"{command.name}"' for command in culm.all() if command is not culm)})
        command+=" ${{COMP_WORDS[i]}}" ;;
      *) break ;;
    esac
  done
  case "$command" in
{cases}  esac
  if [[ $word == -* || " {" ".join(f"{c.name}" for c in culm.all() if c.verbs)} " == *" $command "* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _culm culm
"""


def _zsh(culm):
    return "#compdef culm\n# made by `culm completion zsh`\n" + "".join(
        _zsh_function(command) for command in culm.all()
    ) + f'{_function_name(culm)} "$@"\n'


def _function_name(command):
    return "_" + command.name.replace(" ", "_").replace("-", "_")


def _escaped(text):
    """For a specification of _arguments in single quotes."""
    text = " ".join(text.split())
    for special in "\\[]:":
        text = text.replace(special, "\\" + special)
    return text.replace("'", "'\\''")


def _zsh_function(command):
    name = _function_name(command)
    if command.verbs:
        verbs = "".join(f"    '{verb.verb}:{_escaped(verb.summary)}'\n" for verb in command.verbs)
        calls = "".join(f"    {verb.verb}) {_function_name(verb)} ;;\n" for verb in command.verbs)
        return f"""{name}() {{
  local -a verbs=(
{verbs}  )
  if ((CURRENT == 2)); then
    _describe verb verbs
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
{calls}  esac
}}
"""
    specifications = []
    for option in command.options:
        if option.positional:
            specifications.append("'*:file:_files'")
            continue
        value = f":{_escaped(option.value)}:_files" if option.value else ""
        specifications += [f"'*{one}[{_escaped(option.help)}]{value}'" for one in option.names]
    lines = " \\\n    ".join(dict.fromkeys(specifications))
    return f"{name}() {{\n  _arguments \\\n    {lines}\n}}\n"
