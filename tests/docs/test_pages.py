#!/usr/bin/env python3
"""The reader of pages and the checks of links.py find what they should, and nothing else."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import links  # noqa: E402
import lists  # noqa: E402
import pages  # noqa: E402

PAGE = """# A page: with `code`

See [one](one.md), [two](two.md#part "title") and ![a picture](a.png), not `I[u](x_d)`.

    u = I[u](x_d)

```sh
seiche run [x](y)
```

1. Item

       I[u](x_d)

   with [three](three.md)

## Part
## Part
"""


class Pages(unittest.TestCase):
    def test_links(self):
        self.assertEqual([link for _, link in pages.links(PAGE)], ["one.md", "two.md#part", "a.png", "three.md"])

    def test_replaced_links(self):
        text = pages.replace_links(PAGE, lambda link: "X")
        self.assertEqual([link for _, link in pages.links(text)], ["X"] * 4)
        self.assertIn('[two](X "title")', text)
        self.assertIn("seiche run [x](y)", text)

    def test_anchors(self):
        self.assertEqual(pages.anchors(PAGE), {"a-page-with-code", "part", "part-1"})
        self.assertEqual(pages.slug("Pins & [joints](joints.md), 2D"), "pins--joints-2d")

    def test_lists(self):
        text = "Text:\n* a\n  * b\n    more\n\n  still a\n\nend"
        self.assertEqual(lists.wider(text), "Text:\n\n* a\n    * b\n        more\n\n    still a\n\nend")
        self.assertEqual(lists.wider("1. a\n\n       code\n"), "1. a\n\n        code\n")


class Program(links.Program):
    def __init__(self):
        self.verbs, self.options = ["run"], {"run": {"--set", "--out"}}

    def refusal(self, scene):
        return "" if "end" in scene.read_text() else "no end"


class Faults(unittest.TestCase):
    def test_links(self):
        with tempfile.TemporaryDirectory(dir=links.TOP / "docs") as folder:
            page = pathlib.Path(folder) / "page.md"
            text = "[a](page.md#head) [b](page.md#hand) [c](gone.md) [d](#head) [e](https://x.org/y)\n\n# Head\n"
            page.write_text(text)
            faults = [what for _, what in links.Links().faults(page, text)]
        self.assertEqual(faults, ["no such heading: page.md#hand", "no such file: gone.md"])

    def test_scenes(self):
        whole = "```toml\n[domain]\n[time]\n{}\n```\n"
        self.assertEqual(list(links.scene_faults(whole.format("end = 1"), Program())), [])
        self.assertEqual(list(links.scene_faults(whole.format("and = 1"), Program())), [(1, "no end")])
        marked = "<!-- scene: scenes/dam_break_2d.toml -->\n```toml\nx = 1\n```\n"
        self.assertEqual(list(links.scene_faults(marked, Program())), [(2, "differs from scenes/dam_break_2d.toml")])

    def test_commands(self):
        text = "```sh\nfor a in 1 2; do\n  seiche run scenes/dam_break_2d.toml \\\n    --set a=1 --fast # --none\ndone\nseiche runn\n```\n"
        faults = [what for _, what in links.shell_faults(text, Program())]
        self.assertEqual(faults, ["run has no option --fast", "no such verb: runn"])


if __name__ == "__main__":
    unittest.main()
