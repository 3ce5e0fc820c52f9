"""For mkdocs. Pages link to files of the repository that are no pages: the site shows these as they are."""

import html
import pathlib
import posixpath
import re

ROOT = pathlib.Path(__file__).resolve().parents[1]
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(((?:\.\./)+[^)#\s]+)\)")
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{name}</title>
<style>
:root {{ color-scheme: light dark }}
body {{ margin: 2em; font-family: sans-serif }}
pre {{ overflow-x: auto }}
</style></head>
<body><h1>{name}</h1>{body}</body></html>
"""


def show(name, folder):
    """Writes folder/name.html, and of a folder what is in it, too."""
    path = ROOT / name
    if path.is_dir():
        inside = sorted(child.name for child in path.iterdir())
        for child in inside:
            show(f"{name}/{child}", folder)
        links = (f'<li><a href="{path.name}/{child}.html">{child}</a></li>' for child in inside)
        body = f"<ul>{''.join(links)}</ul>"
    else:
        body = f"<pre>{html.escape(path.read_text())}</pre>"
    page = folder / f"{name}.html"
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(PAGE.format(name=name, body=body))


def on_page_markdown(markdown, page, config, **_):
    """Links that leave docs/ lead to source/ in the site."""
    folder = posixpath.dirname(f"docs/{page.file.src_path}")

    def kept_or_shown(link):
        target = posixpath.normpath(posixpath.join(folder, link[2]))
        if target.startswith("docs/"):
            return link[0]
        show(target, pathlib.Path(config["site_dir"]) / "source")
        return f'<a href="{posixpath.relpath(f"docs/source/{target}.html", folder)}">{link[1]}</a>'

    return LINK.sub(kept_or_shown, markdown)
