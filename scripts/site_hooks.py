"""For mkdocs. Pages link to files of the repository that are no pages: the site shows these as they are. And pictures
below `<!-- live: NAME -->` open a page of `prohull view`, made here, when they are clicked. Where the pages for the browser
were built, the site has them, and `<!-- page: FILE -->` is a link to one."""

import html
import os
import pathlib
import posixpath
import re
import shutil
import subprocess
import tempfile

from mkdocs.exceptions import PluginError

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROHULL = pathlib.Path(os.environ.get("PROHULL", ROOT / "build/release/bin/prohull"))
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(((?:\.\./)+[^)#\s]+)\)")
BROWSER_PAGES = ROOT / "build/wasm/js/app"
BROWSER_PAGE = re.compile(r"<!-- page: ([\w.]+) -->")
LIVE = re.compile(r"<!-- live: (\w+) -->\n!\[([^\]]+)\]\(([^)\s]+)\)")
PICTURE = """<figure class="live"><a href="{page}"><img src="{picture}" alt="{alt}"></a>
<figcaption><a href="{page}">Turn it around</a></figcaption></figure>"""
#: What makes the page OUT.html of each name.
LIVE_PAGES = {
    "bracket": ["sample bracket --faces 3000 -o part.stl",
                "build part.stl --faces 200 -o hull.stl --hierarchy part.phull",
                "view part.phull -o OUT.html"],
    "pony": ["sample pony --faces 20000 -o pony.ply",
             "build pony.ply --faces 600 -o hull.stl --hierarchy pony.phull",
             "view pony.phull -o OUT.html"],
    "arm": ["sample arm -o arm", "urdf arm/arm.urdf -o arm_safe --configurations 0 --no-cache --no-pictures",
            "view arm_safe/arm.urdf -o OUT.html"],
}
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


def make_live(name, folder):
    """Writes folder/NAME.html."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        for command in LIVE_PAGES[name]:
            arguments = command.replace("OUT", str(folder.resolve() / name)).split()
            try:
                subprocess.run([PROHULL, *arguments], cwd=work, check=True, capture_output=True, text=True)
            except OSError as error:
                raise PluginError(f"{PROHULL}: {error.strerror}; build it by scripts/setup") from error
            except subprocess.CalledProcessError as error:
                raise PluginError(f"prohull {command}: {error.stderr}") from error


def on_page_markdown(markdown, page, config, **_):
    """Links that leave docs/ lead to source/ in the site, and pictures may open live pages."""
    folder = posixpath.dirname(f"docs/{page.file.src_path}")

    def live(picture):
        name, alt, source = picture.groups()
        make_live(name, pathlib.Path(config["site_dir"]) / "live")
        target = posixpath.relpath(f"docs/live/{name}.html", folder)
        return PICTURE.format(page=target, picture=source, alt=html.escape(alt))

    def opened(place):
        if not (BROWSER_PAGES / place[1]).exists():
            return ""
        return f'<a href="{posixpath.relpath(f"docs/{place[1]}", folder)}">Open the page</a>'

    def kept_or_shown(link):
        target = posixpath.normpath(posixpath.join(folder, link[2]))
        if target.startswith("docs/"):
            return link[0]
        show(target, pathlib.Path(config["site_dir"]) / "source")
        return f'<a href="{posixpath.relpath(f"docs/source/{target}.html", folder)}">{link[1]}</a>'

    return LINK.sub(kept_or_shown, BROWSER_PAGE.sub(opened, LIVE.sub(live, markdown)))


def on_post_build(config, **_):
    if BROWSER_PAGES.is_dir():
        shutil.copytree(BROWSER_PAGES, config["site_dir"], dirs_exist_ok=True)
