"""Commands that the pages tell readers to type: where they are, what their words mean, and their faults.

A command stands in a block of code, or in a code span of a paragraph or table. Its words are checked against the
program, scripts and files of the repository."""
import functools
import json
import pathlib
import re
import shlex
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "tools" / "site"))
import pages  # noqa: E402

FOLDERS = ("docs", "scenes")
# Records of the past and generated tables: their commands are not for readers to type.
LEFT_OUT = ("docs/decisions", "docs/validation/")
STARTS = ("seiche", "build/release/seiche", "build/debug/seiche", "./demo", "./check", "cmake", "ctest", "mkdocs",
          "mpirun", "python3", "blender", "pvbatch", "hython", "docker", "apptainer", "xvfb-run")
SCRIPTS = re.compile(r"^(tools|benchmarks)/[\w/]+$")
SPAN = re.compile(r"`([^`]+)`")
# A word in capitals, one in angle brackets or a shell variable stands for something that readers choose.
PLACEHOLDER = re.compile(r"^[A-Z][A-Z_./a-z]*$|[<>$…]|\bNAME\b|KEY=VALUE")


class Command:
    """One command: its page, line and words."""

    def __init__(self, page, line, words, in_block):
        self.page, self.line, self.words, self.in_block = page, line, words, in_block

    def __str__(self):
        return f"{self.page}:{self.line}: {' '.join(self.words)}"


def all_pages():
    """The pages whose commands are checked."""
    found = [TOP / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")]
    for folder in FOLDERS:
        found += sorted((TOP / folder).rglob("*.md"))
    return [page for page in found if not page.relative_to(TOP).as_posix().startswith(LEFT_OUT)]


def starts_command(text):
    """Whether a text begins with the name of something to run. A message such as "seiche: ..." does not."""
    first = text.split(" ")[0]
    return first in STARTS or (bool(SCRIPTS.match(first)) and (TOP / first).is_file())


def simple_commands(line):
    """The words of each command of a shell line, without what is around it: loops, settings of the environment."""
    try:
        lexer = shlex.shlex(line, posix=True, punctuation_chars="|&;()<>")
        lexer.whitespace_split, lexer.commenters = True, "#"
        words = list(lexer)
    except ValueError:
        return
    part = []
    for word in [*words, ";"]:
        if not re.fullmatch(r"[|&;()<>]+", word):
            part.append(word)
            continue
        while part and (re.match(r"^\w+=", part[0]) or part[0] in ("do", "then", "export")):
            part.pop(0)
        if part and starts_command(part[0]):
            yield part
        part = []


def commands_of(page):
    """All commands of a page."""
    name, text = page.relative_to(TOP).as_posix(), page.read_text(encoding="utf-8")
    lines = text.split("\n")
    messages = set()
    for number, language, _, content in pages.fenced(text):
        if language not in ("", "sh", "bash", "console"):
            messages.update(range(number, number + content.count("\n") + 2))
    joined, first = "", 0
    for number, (line, code) in enumerate(zip(lines, pages.is_code(lines)), 1):
        if code and number not in messages:
            first = first or number
            joined += line.strip()
            if joined.endswith("\\"):
                joined = joined[:-1]
                continue
            yield from (Command(name, first, words, True) for words in simple_commands(joined))
        elif not code:
            for span in SPAN.findall(line):
                span = re.sub(r"<[^>]*>", "NAME", span.replace("\\|", "|"))
                if starts_command(span):
                    yield from (Command(name, number, words, False) for words in simple_commands(span))
        joined, first = "", 0


def is_placeholder(word):
    """Whether a word stands for something that the reader puts in."""
    return bool(PLACEHOLDER.search(word))


def plain(words):
    """The words of the command that a launcher starts: mpirun -n 4 seiche ... is seiche ..."""
    words = list(words)
    if words[0] == "mpirun":
        words = words[1:]
        while words and (words[0].startswith("-") or words[0].isdigit() or is_placeholder(words[0])):
            words.pop(0)
        if words[:2] == ["apptainer", "exec"]:
            words = words[3:]
    if words[:4] == ["xvfb-run", "-a", "-s", "-noreset"]:
        words = words[4:]
    return words


def options(words):
    """The options among words, without values."""
    return [word.split("=")[0] for word in words if re.match(r"^--?[a-zA-Z]", word) and word != "--"]


def options_in_source(path):
    """Long options that a script mentions, in its parser or elsewhere."""
    return set(re.findall(r"--[a-z][\w-]*", path.read_text(encoding="utf-8")))


def script_faults(words, path):
    """Faults of a call of a script of the repository."""
    if not (TOP / path).is_file():
        yield f"no such file: {path}"
        return
    known = options_in_source(TOP / path) | {"--help"}
    for package in sorted((TOP / "tools" / "fuzzing").glob("*.py")) if "fuzz" in path else []:
        known |= options_in_source(package)
    for option in options(words):
        if option.startswith("--") and option not in known:
            yield f"{path} has no option {option}"


def cmake_faults(words):
    """Presets, options of the project and targets that CMake is told of."""
    presets = {one["name"] for one in json.loads((TOP / "CMakePresets.json").read_text())["configurePresets"]}
    lists = "\n".join(f.read_text(encoding="utf-8") for f in [TOP / "CMakeLists.txt", *TOP.glob("*/CMakeLists.txt"),
                                                             *TOP.glob("cmake/*.cmake")])
    for word, following in zip(words, [*words[1:], ""]):
        if word == "--preset" and following not in presets:
            yield f"no such preset: {following}"
        if word == "--target" and not re.search(rf"\b{re.escape(following)}\b", lists):
            yield f"no such target: {following}"
        if word in ("--build", "--install") and following and not re.match(r"^build/(release|debug)$", following):
            yield f"no preset builds into {following}"
        name = re.match(r"^-D(SEICHE_\w+)", word)
        if name and name.group(1) not in lists:
            yield f"no such option of the project: {name.group(1)}"


def seiche_faults(words, program):
    """A verb and options that the program has, and scenes that exist."""
    if len(words) == 1 or words[1] in ("--version", "--help"):
        return
    verb = words[1]
    if is_placeholder(verb) or verb.startswith("-"):  # `seiche --set` in a sentence: of any verb
        return
    if verb not in program.verbs:
        yield f"no such verb: {verb}"
        return
    known = program.options_of(verb)
    for option in options(words[2:]):
        if option.startswith("--") and option not in known | {"--help"}:
            yield f"{verb} has no option {option}"
    for word in words[2:]:
        if word.startswith("scenes/") and not is_placeholder(word) and not (TOP / word).is_file():
            yield f"no such file: {word}"
    if verb == "validate":
        yield from validate_faults(words[2:])


def validate_faults(words):
    """Cases, runs of cases and tags that exist."""
    for word, before in zip(words, ["", *words]):
        if before.startswith("--") or word.startswith("--") or is_placeholder(word):
            continue
        case = TOP / "validation" / word.split("/")[0] / "case.toml"
        tagged = f'"{word}"' in "".join(re.findall(r"^tags = .*$", all_cases(), re.MULTILINE))
        if not case.is_file() and not tagged:
            yield f"no such case or tag: {word}"


@functools.cache
def all_cases():
    """The text of all cases of validation."""
    return "\n".join(f.read_text(encoding="utf-8") for f in sorted((TOP / "validation").glob("*/case.toml")))


def faults(command, program):
    """What is wrong with a command; empty where it can be typed."""
    words = plain(command.words)
    name = words[0] if words else ""
    if name.endswith("seiche"):
        yield from seiche_faults(words, program)
    elif name in ("./demo", "./check"):
        yield from script_faults(words[1:], name)
        for word in words[1:]:
            if word.endswith(".toml") and not is_placeholder(word) and "NAME" not in word and not (TOP / word).is_file():
                yield f"no such file: {word}"
    elif name == "cmake":
        yield from cmake_faults(words)
    elif name in ("python3", "pvbatch", "hython", "blender"):
        script = next((word for word in words[1:] if word.endswith(".py") and "/" in word), None)
        if script and not is_placeholder(script):
            after = words[words.index("--") + 1:] if "--" in words else words[words.index(script) + 1:]
            yield from script_faults(after, script)
    elif SCRIPTS.match(name):
        yield from script_faults(words[1:], name)
