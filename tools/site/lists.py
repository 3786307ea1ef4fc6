"""Lists as Python-Markdown reads them: pages indent what belongs to an item by its marker, Python-Markdown by four."""
import pages

WIDTH = 4


def starts_table(lines, number):
    return lines[number].startswith("|") and number + 1 < len(lines) and lines[number + 1].startswith("|-")


def wider(text):
    """The text with four spaces a level, and a blank line before lists and tables that interrupt a paragraph."""
    lines, result, columns, fenced = text.split("\n"), [], [], None
    for number, line in enumerate(lines):
        blank_before = not result or not result[-1].strip()
        if not line.strip():
            result.append("")
            continue
        indent = len(line) - len(line.lstrip(" "))
        fence, item = pages.FENCE.match(line), pages.ITEM.match(line)
        if fenced is None:
            kept = [column for column in columns if column <= indent]
            lazy = not item and not fence and not blank_before and len(kept) < len(columns)
            if not lazy:
                columns = kept
        depth, base = len(columns), (columns[-1] if columns else 0)
        if fence:
            fenced = fence.group(1) if fenced is None else (None if not fence.group(2) else fenced)
        elif fenced is None and item and indent - base < WIDTH:
            if not blank_before and depth == 0 and not pages.ITEM.match(lines[number - 1]) and not inside(result):
                result.append("")
            columns.append(item.end())
            result.append(" " * (WIDTH * depth) + line[indent:])
            continue
        elif fenced is None and not blank_before and starts_table(lines, number):
            if not lines[number - 1].startswith("|"):
                result.append("")
        result.append(" " * (WIDTH * depth) + line[min(indent, base):])
    return "\n".join(result)


def inside(result):
    """Whether the last paragraph of the result is a list's."""
    for line in reversed(result):
        if not line.strip():
            return False
        if pages.ITEM.match(line):
            return True
    return False
