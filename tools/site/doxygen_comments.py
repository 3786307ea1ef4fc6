#!/usr/bin/env python3
"""Filter for Doxygen: plain comments of a header become its documentation. doxygen_comments.py FILE

Lines of // before a declaration document it; // after one documents that one; the first comment of a file is about the
file. Characters that Doxygen would take for commands or tags are escaped."""
import pathlib
import re
import sys

COMMENT = re.compile(r"^(\s*)//(?!/)(.*)$")
# Code, then a comment; no // within quotes before it.
TRAILING = re.compile(r'^((?:[^"/]|"(?:\\.|[^"\\])*"|/(?!/))*\S(?:[^"/]|"(?:\\.|[^"\\])*"|/(?!/))*)//(?!/)(.*)$')
ESCAPED = str.maketrans({"\\": "\\\\", "@": "\\@", "<": "&lt;", ">": "&gt;", "#": "\\#", "%": "\\%", "*": "\\*"})


def escaped(text):
    """The text as Doxygen shows it unchanged; code between backticks stays code."""
    parts = text.split("`")
    if len(parts) % 2 == 0:  # an odd backtick is no code
        return text.replace("`", "'").translate(ESCAPED)
    return "`".join(part if number % 2 else part.translate(ESCAPED) for number, part in enumerate(parts))


def documented(lines):
    """The lines with comments that Doxygen reads."""
    first = True
    for number, line in enumerate(lines):
        comment, trailing = COMMENT.match(line), TRAILING.match(line)
        if comment:
            if first:
                yield "/// @file"
                first = False
            yield f"{comment.group(1)}///{escaped(comment.group(2))}"
        elif trailing and not line.lstrip().startswith(("#", "}  // namespace")):
            yield f"{trailing.group(1)}///<{escaped(trailing.group(2))}"
        else:
            first = first and (not line.strip() or line.startswith("#pragma"))
            yield line


def main():
    for line in documented(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").split("\n")):
        print(line)


if __name__ == "__main__":
    main()
