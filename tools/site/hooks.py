"""Hooks of mkdocs.yml: README.md is the home page, and links that leave docs/ lead to copies within the site."""
import pathlib
import posixpath
import re
import shutil
import sys

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import lists  # noqa: E402
import pages  # noqa: E402

TOP = pathlib.Path(__file__).resolve().parents[2]
HOME = "README.md"
# Pages of Doxygen, where the target api has made them, their place in the site, and where api.md gets its link to them.
API, API_IN_SITE, API_MARK = TOP / "build" / "api" / "html", "api", "<!-- api -->"


def repository_path(site_path):
    """Where a file of the site is in the repository: pages lie in docs/, what was added lies elsewhere."""
    inside = posixpath.join("docs", site_path)
    return inside if (TOP / inside).exists() else site_path


def site_path_of(path):
    return path[len("docs/"):] if path.startswith("docs/") else path


def target_of(page, link):
    """The repository's path that a page's link leads to, or None if it leads out or stays on the page."""
    path = link.split("#")[0]
    if not path or pages.ABSOLUTE.match(link):
        return None
    target = posixpath.normpath(posixpath.join(posixpath.dirname(page), path))
    if (TOP / target).is_dir():
        target = posixpath.join(target, "README.md")
    return target if (TOP / target).is_file() else None


def on_config(config):
    config["mdx_configs"].setdefault("toc", {})["slugify"] = pages.slug
    return config


def on_files(files, config):
    """Adds the home page and all that pages link to outside docs/, and what these link to."""
    queue = [HOME] + ["docs/" + file.src_uri for file in files.documentation_pages()]
    known = {file.src_uri for file in files}
    while queue:
        path = queue.pop()
        site_path = site_path_of(path)
        if site_path not in known:
            known.add(site_path)
            files.append(File(path, str(TOP), config["site_dir"], config["use_directory_urls"]))
        if path.endswith(".md"):
            found = (target_of(path, link) for _, link in pages.links((TOP / path).read_text(encoding="utf-8")))
            queue += [target for target in found if target and site_path_of(target) not in known]
    return files


def on_page_markdown(markdown, page, config, files):
    here = repository_path(page.file.src_uri)

    def change(link):
        target = target_of(here, link)
        if target is None:
            return link
        anchor = "#" + link.split("#")[1] if "#" in link else ""
        return posixpath.relpath(site_path_of(target), posixpath.dirname(page.file.src_uri) or ".") + anchor

    markdown = lists.wider(pages.replace_links(markdown, change))
    if (API / "index.html").is_file():
        markdown = markdown.replace(API_MARK, f'<a href="{API_IN_SITE}/index.html">All headers, by Doxygen</a>\n')
    return markdown


def on_page_content(html, page, config, files):
    """Tables get the theme's looks."""
    return html.replace("<table>", '<table class="docutils">')


def without_missing_script(output, config):
    """Debian's theme asks for a script that it does not bring."""
    folders = [pathlib.Path(folder) for folder in config["theme"].dirs]
    if any((folder / "js" / "theme_extra.js").exists() for folder in folders):
        return output
    return re.sub(r'<script src="[^"]*theme_extra\.js"[^>]*></script>', "", output)


def on_post_page(output, page, config):
    return without_missing_script(output, config)


def on_post_template(output, template_name, config):
    return without_missing_script(output, config)


def on_post_build(config):
    """Pages of Doxygen are copied. Debian's theme asks for another version of jQuery than it brings."""
    folder = pathlib.Path(config["site_dir"])
    if (API / "index.html").is_file():
        shutil.copytree(API, folder / API_IN_SITE, dirs_exist_ok=True)
    wanted = re.search(r"js/(jquery-[\d.]+\.min\.js)", (folder / "index.html").read_text(encoding="utf-8"))
    present = sorted((folder / "js").glob("jquery*.min.js"))
    if wanted and present and not (folder / "js" / wanted.group(1)).exists():
        shutil.copy(present[0], folder / "js" / wanted.group(1))
