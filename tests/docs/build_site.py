#!/usr/bin/env python3
"""Builds the site with `mkdocs build --strict` into a folder and checks what was built: build_site.py FOLDER

Every local link and anchor of every page exists, and no page fetches scripts, styles or fonts from elsewhere. Ends with
77, for "skipped", where mkdocs is not installed."""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import urllib.parse

TOP = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77


class Page(html.parser.HTMLParser):
    """Ids, local links and what is fetched from elsewhere."""

    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.fetched = set(), [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.update(values[key] for key in ("id", "name") if values.get(key))
        link = values.get("href") or values.get("src")
        if not link:
            return
        if urllib.parse.urlsplit(link).netloc:
            if tag != "a":
                self.fetched.append(link)
        elif not urllib.parse.urlsplit(link).scheme:
            self.links.append(link)


def faults(folder):
    # Pages of Doxygen, in api/ where there are some, are its own.
    built = {path.resolve(): Page(path) for path in sorted(folder.rglob("*.html"))
             if path.relative_to(folder).parts[0] != "api"}
    for path, page in built.items():
        name = path.relative_to(folder)
        yield from (f"{name} fetches {link}" for link in page.fetched)
        if name.name == "404.html":     # its links are for a server
            continue
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                yield f"{name}: no such file: {link}"
            elif parts.fragment and target in built and urllib.parse.unquote(parts.fragment) not in built[target].ids:
                yield f"{name}: no such heading: {link}"


def main():
    if not shutil.which("mkdocs"):
        print("mkdocs is not installed")
        return SKIPPED
    folder = pathlib.Path(sys.argv[1]).resolve()
    subprocess.run(["mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)], cwd=TOP, check=True)
    found = sorted(set(faults(folder)))
    pages = len(list(folder.rglob("*.html")))
    print("\n".join(found + [f"site: {pages} pages, {len(found)} faults"]))
    return 1 if found or pages < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
