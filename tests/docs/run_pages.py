#!/usr/bin/env python3
"""Runs the shell blocks of a page as they stand, in a folder of their own: run_pages.py SEICHE WORK PAGE

Blocks marked `sh` are run one after the other by bash. Runs of the gallery stop after their first frame."""
import pathlib
import re
import shutil
import subprocess
import sys

import commands
import test_commands as tests
from commands import pages

# Replacements that make a page's commands short: page, pattern, replacement.
SHORTER = (("docs/gallery.md", r"--frames \d+", "--frames 1"), ("docs/gallery.md", r"--size 640x360", "--size 160x120"))


def blocks(page):
    """(line, text) of the shell blocks of a page, shortened."""
    name = page.relative_to(commands.TOP).as_posix()
    for line, language, _, content in pages.fenced(page.read_text(encoding="utf-8")):
        if language == "sh":
            for of, pattern, replacement in SHORTER:
                content = re.sub(pattern, replacement, content) if of == name else content
            yield line, content


def main():
    seiche, work, page = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), commands.TOP / sys.argv[3]
    tests.scratch_clone(work, seiche)
    count = 0
    for line, content in blocks(page):
        count += 1
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", content], cwd=work, env=tests.environment(work),
                              capture_output=True, text=True, check=False)
        if done.returncode:
            print(f"{page}:{line}: exit code {done.returncode}\n{content}\n{(done.stdout + done.stderr)[-2000:]}")
            return 1
    shutil.rmtree(work, ignore_errors=True)
    print(f"{page.name}: {count} blocks ran")
    return 0 if count else 1


if __name__ == "__main__":
    sys.exit(main())
