"""The manual page, the completion scripts and the schema that come with the program are what it prints.

Usage: shell_files.py PROGRAM [--write]    Exit code 0 if they agree; --write brings the files up to date."""
import json
import pathlib
import subprocess
import sys
import tempfile

SHARE = pathlib.Path(__file__).resolve().parents[2] / "share"
FILES = {"man/seiche.1": ["manual"], "completions/seiche.bash": ["completion", "bash"],
         "completions/_seiche": ["completion", "zsh"], "completions/seiche.fish": ["completion", "fish"]}


def printed(program, words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def bash_completes(program):
    """What bash offers for a verb, for options of a verb, and for a file after one."""
    script = printed(program, ["completion", "bash"])
    tries = {"seiche re": ["render", "resume"], "seiche run --ov": ["--overwrite"], "seiche export --fo": ["--format"],
             "seiche help re": ["render", "resume"], "seiche completion z": ["zsh"], "seiche run re": []}
    for line, wanted in tries.items():
        words = line.split()
        ask = f"COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _seiche; echo \"${{COMPREPLY[@]}}\""
        said = subprocess.run(["bash", "-c", script + ask], check=True, capture_output=True, text=True).stdout.split()
        if sorted(said) != wanted:
            yield f"bash completes '{line}' to {said}, not {wanted}"


def manual_formats(program):
    """man's formatter finds nothing to warn of, where there is one."""
    with tempfile.NamedTemporaryFile("w", suffix=".1") as page:
        page.write(printed(program, ["manual"]))
        page.flush()
        try:
            said = subprocess.run(["man", "--warnings", "-l", page.name], capture_output=True, text=True)
        except FileNotFoundError:
            return
        if said.stderr or "seiche run" not in said.stdout:
            yield f"man: {said.stderr or 'the page lacks seiche run'}"


def schema_faults(program):
    schema = json.loads(printed(program, ["schema"]))
    solid = schema["properties"]["solid"]["items"]["properties"]
    if solid["rotate"]["properties"]["quaternion"]["minItems"] != 4 or "domain" not in schema["required"]:
        yield "the schema lacks what scenes have"


def main(program, write):
    faults = [*bash_completes(program), *manual_formats(program), *schema_faults(program)]
    for name, words in FILES.items():
        text = printed(program, words)
        file = SHARE / name
        if write:
            file.parent.mkdir(exist_ok=True)
            file.write_text(text)
        elif not file.exists() or file.read_text() != text:
            faults.append(f"share/{name} is not what `seiche {' '.join(words)}` prints; run this test with --write")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--write" in sys.argv))
