#!/usr/bin/env python3
"""Every command of the pages can be typed: test_commands.py SEICHE WORK

Words of all commands are checked (commands.py). Commands that take a second are run as they stand. The rest are run by
the tests that the table below names, or have a reason there. Prints one line for each fault."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import commands
import links

# Verbs and options of seiche that are run here, as they stand.
QUICK = re.compile(r"^seiche (--version|--help|check scenes/\S+|init |completion |manual|schema|validate --list|"
                   r"(run|render) --help)")
# Commands that this test neither runs nor checks by their words: pattern, and the reason or the test that runs them.
ELSEWHERE = (
    (r"^(docker|apptainer) ", "containers are not available to tests; `seiche` in them is the same program"),
    (r"^mpirun.* apptainer ", "containers are not available to tests"),
    (r"^mkdocs build", "run by the test `docs: site`"),
    (r"^ctest ", "the tests themselves"),
    (r"^hython ", "Houdini is not free; `programs: reading a run` runs the script with a stand-in"),
    (r"^mpirun (-n \d+|has .*)?$", "no command: the name of a program or a message"),
    (r"^(blender|mpirun|cmake|seiche|build/release/seiche)$", "no command: the name of a program"),
    (r"^cmake ninja ", "a list of packages"),
    (r"^python3 -c ", "run by `docs: first path`"),
    (r"^mpirun -n \d+ python3 program.py", "the reader's own program; `python: ranks` runs one"),
)


def reason(text):
    """Why a command is not checked here, or None."""
    return next((why for pattern, why in ELSEWHERE if re.search(pattern, text)), None)


def scratch_clone(work, seiche):
    """A folder with what readers have after ./demo: scenes, scripts, the program; results stay in it."""
    shutil.rmtree(work, ignore_errors=True)
    (work / "build/release").mkdir(parents=True)
    for name in ("scenes", "share"):
        shutil.copytree(commands.TOP / name, work / name)
    os.symlink(pathlib.Path(seiche).resolve(), work / "build/release/seiche")
    return work


def environment(work):
    """The environment in which `seiche` is the built program."""
    path = f"{work / 'build/release'}{os.pathsep}{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "SEICHE": str(work / "build/release/seiche")}


def run_fault(words, work):
    """The fault of a command that was run, or None."""
    done = subprocess.run(words, cwd=work, env=environment(work), capture_output=True, text=True, check=False)
    return None if done.returncode == 0 else f"exit code {done.returncode}: {(done.stderr or done.stdout)[-500:]}"


def main():
    seiche, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    program, counts, faults, seen = links.Program(str(seiche)), {"run": 0, "checked": 0, "elsewhere": 0}, [], {}
    scratch_clone(work, seiche)
    for page in commands.all_pages():
        for command in commands.commands_of(page):
            text = " ".join(commands.plain(command.words))
            if reason(" ".join(command.words)):
                counts["elsewhere"] += 1
                continue
            found = list(commands.faults(command, program))
            short = re.sub(r"^build/release/", "", text)
            runs = QUICK.search(short) and not any(map(commands.is_placeholder, command.words))
            if runs and short not in seen:
                seen[short] = run_fault(["seiche", *commands.plain(command.words)[1:]], work)
            found += [seen[short]] if runs and seen[short] else []
            counts["run" if runs else "checked"] += 1
            faults += [f"{command.page}:{command.line}: {' '.join(command.words)}: {what}" for what in found]
    shutil.rmtree(work, ignore_errors=True)
    total = ", ".join(f"{number} {what}" for what, number in counts.items())
    print("\n".join(faults + [f"commands: {total}, {len(faults)} faults"]))
    return 1 if faults or min(counts.values()) == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
