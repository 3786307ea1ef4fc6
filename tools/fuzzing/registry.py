"""The scene keys, read from docs/scene-reference.md. A unit test keeps that page equal to the reader's table."""
import dataclasses
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "scene-reference.md"
CONDITION = re.compile(r'; for (\w+) = ((?:"\w+"(?:, | or )?)+)')
RESERVED = "; not in this version"


@dataclasses.dataclass(frozen=True)
class Key:
    table: str          # "liquid.region[]"
    name: str
    kind: str           # the column "value"
    choices: tuple      # permitted words; empty if it is not a choice
    required: bool
    decided_by: str     # key of the same table that decides whether this one is permitted, or ""
    for_values: tuple   # values of that key which permit this one

    @property
    def takes_many(self):
        return self.kind.startswith("any of")

    def applies(self, table):
        """True if the table (a dict) permits the key; deciding keys come first in a table."""
        return not self.decided_by or table.get(self.decided_by) in self.for_values

    @property
    def label(self):
        return f"[{self.table}] {self.name}" if self.table else self.name


def table_name(title):
    """Maps "`[[liquid.region]]`" to "liquid.region[]"; sides of the domain to "side"."""
    if title == "Top level":
        return ""
    name = title.split("`")[1]
    name = name[2:-2] + "[]" if name.startswith("[[") else name[1:-1]
    return name.replace("domain.boundary.x_lower", "side")


def parse_row(table, line):
    cells = [cell.strip().replace("\0", "|") for cell in line.replace("\\|", "\0").strip("| \n").split(" | ")]
    name, kind, default, meaning = cells[0].strip("`"), cells[1], cells[2], cells[-1]
    words = tuple(re.findall(r'"(\w+)"', kind))
    condition = CONDITION.search(meaning.split(RESERVED)[0])
    return Key(table, name, kind, words, default == "required", condition.group(1) if condition else "",
               tuple(re.findall(r'"(\w+)"', condition.group(2))) if condition else ())


def read_registry(page=PAGE):
    """Keys by table, in the order of the page."""
    tables, table = {}, None
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            table = None if line == "## Not in this version" else table_name(line[3:])
        elif table is not None and line.startswith("| `"):
            tables.setdefault(table, []).append(parse_row(table, line))
    return tables
