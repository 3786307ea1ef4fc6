#!/usr/bin/env python3
"""Checks the pages against the repository and the program: links.py SEICHE

Every relative link and anchor of README.md, scenes/README.md, CHANGELOG.md and docs/ exists. Scenes in TOML blocks pass
`seiche check`; one after `<!-- scene: PATH -->` is that file, word for word. Commands in sh blocks name verbs and options
of the program and files of the repository. Prints one line for each fault."""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "tools" / "site"))
import pages  # noqa: E402

MARK = re.compile(r"^<!-- scene: (\S+) -->$")
WHOLE = re.compile(r"^\[domain\]", re.MULTILINE), re.compile(r"^\[time\]", re.MULTILINE)


def all_pages():
    return [TOP / "README.md", TOP / "CHANGELOG.md", TOP / "scenes" / "README.md", *sorted((TOP / "docs").rglob("*.md"))]


class Links:
    """Links of pages, each page's anchors read once."""

    def __init__(self):
        self.anchors = {}

    def of(self, page):
        if page not in self.anchors:
            self.anchors[page] = pages.anchors(page.read_text(encoding="utf-8"))
        return self.anchors[page]

    def faults(self, page, text):
        for number, link in pages.links(text):
            if pages.ABSOLUTE.match(link):
                continue
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            if not target.exists() or TOP not in (target, *target.parents):
                yield number, f"no such file: {link}"
            elif anchor and (target.suffix != ".md" or anchor not in self.of(target)):
                yield number, f"no such heading: {link}"


class Program:
    """The built program: its verbs, their options, and its verdict on scenes."""

    def __init__(self, path):
        self.path, self.options = path, {}
        listing = self.ask("--help").split("Subcommands:")[1]
        self.verbs = re.findall(r"^  (\w+)  ", listing, re.MULTILINE)

    def ask(self, *words):
        return subprocess.run([self.path, *words], capture_output=True, text=True, check=True).stdout

    def options_of(self, verb):
        if verb not in self.options:
            help_text = self.ask(verb, "--help")
            self.options[verb] = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_text, re.MULTILINE))
        return self.options[verb]

    def refusal(self, scene):
        """The first line of what is wrong with a scene, or an empty text."""
        result = subprocess.run([self.path, "check", str(scene)], capture_output=True, text=True, check=False)
        return "" if result.returncode == 0 else (result.stderr.strip() or f"exit code {result.returncode}").split("\n")[0]

    def command_faults(self, words):
        if words[1:] == ["--version"]:
            return
        verb = words[1] if len(words) > 1 else ""
        if verb not in self.verbs:
            yield f"no such verb: {verb}"
            return
        for word in words[2:]:
            if word.startswith("--") and word.split("=")[0] not in self.options_of(verb):
                yield f"{verb} has no option {word}"
            if word.startswith("scenes/") and not (TOP / word).is_file():
                yield f"no such file: {word}"


def scene_faults(text, program):
    lines = text.split("\n")
    for number, language, _, content in pages.fenced(text):
        if language != "toml":
            continue
        mark = MARK.match(lines[number - 2]) if number > 1 else None
        if mark:
            scene = TOP / mark.group(1)
            if not scene.is_file() or scene.read_text(encoding="utf-8") != content:
                yield number, f"differs from {mark.group(1)}"
            elif program.refusal(scene):
                yield number, program.refusal(scene)
        elif all(pattern.search(content) for pattern in WHOLE):
            with tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder) / "scene.toml"
                scene.write_text(content, encoding="utf-8")
                fault = program.refusal(scene)
            if fault:
                yield number, fault


def commands(content):
    """The words of each command in a block of shell, lines that end in a backslash joined."""
    for line in content.replace("\\\n", " ").split("\n"):
        words = shlex.split(line, comments=True)
        if words:
            yield words


def shell_faults(text, program):
    for number, language, _, content in pages.fenced(text):
        for words in commands(content) if language == "sh" else []:
            if words[0] in ("seiche", "build/release/seiche"):
                yield from ((number, fault) for fault in program.command_faults(words))
            if words[0] == "python3" and not (TOP / words[1]).is_file():
                yield number, f"no such file: {words[1]}"


def main():
    program, links, faults = Program(sys.argv[1]), Links(), []
    for page in all_pages():
        text = page.read_text(encoding="utf-8")
        found = [*links.faults(page, text), *scene_faults(text, program), *shell_faults(text, program)]
        faults += [f"{page.relative_to(TOP)}:{number}: {what}" for number, what in found]
    print("\n".join(faults + [f"docs: {len(all_pages())} pages, {len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
