"""Links and headings of the project's Markdown pages: shared by the site's hooks and the test of links."""
import re

FENCE = re.compile(r"^\s*(```+|~~~+)\s*(\S*)(.*)$")
INLINE_CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)")
LINK = re.compile(r"(\]\()([^()\s]+(?:\([^()\s]*\)[^()\s]*)?)(\s+\"[^\"]*\")?(\))")
HEADING = re.compile(r"^(#{1,6})\s+(.*?)\s*#*\s*$")
INDENTED = re.compile(r"^( {4,}|\t)")
ITEM = re.compile(r"^( *)([-*+]|\d+[.)])( +)(?=\S)")
ABSOLUTE = re.compile(r"^([a-z][a-z0-9+.-]*:|/)")


def is_code(lines):
    """For each line whether it is code: fenced, or indented after a blank line and not part of a list."""
    fence, flags, inside_list, code_before = None, [], False, False
    for number, line in enumerate(lines):
        match = FENCE.match(line)
        if match and fence is None:
            fence = match.group(1)
            flags.append(True)
        elif fence is not None:
            flags.append(True)
            if match and match.group(1).startswith(fence) and not match.group(2):
                fence = None
        else:
            blank_before = number == 0 or not lines[number - 1].strip()
            if ITEM.match(line):
                inside_list = True
            elif line.strip() and not line.startswith(" "):
                inside_list = False
            deep = INDENTED.match(line) and (not inside_list or len(line) - len(line.lstrip()) >= 7)
            code_before = bool(deep) and (blank_before or code_before)
            flags.append(code_before)
    return flags


def without_inline_code(line):
    """The line with code replaced by spaces, so that places stay."""
    return INLINE_CODE.sub(lambda match: " " * len(match.group()), line)


def links(text):
    """(line number from 1, target) of every link and picture."""
    lines = text.split("\n")
    for number, (line, code) in enumerate(zip(lines, is_code(lines)), 1):
        if not code:
            for match in LINK.finditer(without_inline_code(line)):
                yield number, match.group(2)


def replace_links(text, change):
    """The text with change(target) in place of each target."""
    lines = text.split("\n")
    for number, code in enumerate(is_code(lines)):
        if code:
            continue
        masked, parts, place = without_inline_code(lines[number]), [], 0
        for match in LINK.finditer(masked):
            parts += [lines[number][place:match.start(2)], change(match.group(2))]
            place = match.end(2)
        lines[number] = "".join(parts) + lines[number][place:]
    return "\n".join(lines)


def slug(heading, separator="-"):
    """The anchor of a heading, as code hosts make it."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "").lower()
    return re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", separator)


def anchors(text):
    """The anchors of all headings; equal ones are counted."""
    lines, seen, found = text.split("\n"), {}, set()
    for line, code in zip(lines, is_code(lines)):
        match = None if code else HEADING.match(line)
        if match:
            name = slug(match.group(2))
            found.add(f"{name}-{seen[name]}" if name in seen else name)
            seen[name] = seen.get(name, 0) + 1
    return found


def fenced(text):
    """(first line, language, further words, content) of each fenced block."""
    fence, start, head, content = None, 0, ("", ""), []
    for number, line in enumerate(text.split("\n"), 1):
        match = FENCE.match(line)
        if match and fence is None:
            fence, start, head, content = match.group(1), number, (match.group(2), match.group(3).strip()), []
        elif fence is not None and match and match.group(1).startswith(fence) and not match.group(2):
            yield start, head[0], head[1], "\n".join(content) + "\n"
            fence = None
        elif fence is not None:
            content.append(line)
