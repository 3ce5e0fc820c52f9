#!/usr/bin/python3
"""Builds the site and fails unless its links lead somewhere and its live pages are there: site_test.py ROOT PROHULL

With node, NODE_PATH and Chromium it also opens the live pages: site_test.py ROOT PROHULL NODE CHROMIUM. Exits with 77,
which ctest takes for skipped, where mkdocs is missing.
"""

import contextlib
import functools
import html.parser
import http.server
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import urllib.parse

SKIPPED = 77
LIVE = {"tour.html": "live/bracket.html", "guides/view.html": "live/pony.html", "guides/robots.html": "live/arm.html"}
MADE_BY_DOXYGEN = "reference/cpp/index.html"


class Links(html.parser.HTMLParser):
    """What a page links to or loads."""

    def __init__(self, page):
        super().__init__()
        self.found, self.anchors = [], set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        facts = dict(attributes)
        self.found += [facts[name] for name in ("href", "src") if facts.get(name)]
        self.anchors |= {facts[name] for name in ("id", "name") if facts.get(name)}


def wrong_links(site):
    pages = {page: Links(page) for page in site.rglob("*.html") if "live" not in page.relative_to(site).parts}
    assert len(pages) > 20, f"only {len(pages)} pages"
    for page, links in pages.items():
        for link in links.found:
            url = urllib.parse.urlsplit(link)
            target = (page.parent / urllib.parse.unquote(url.path)).resolve() if url.path else page
            if url.scheme or page.name == "404.html" or target == (site / MADE_BY_DOXYGEN).resolve():
                continue
            if target.is_dir():
                target /= "index.html"
            if not target.exists():
                yield f"{page.relative_to(site)}: {link} is not there"
            elif url.fragment and target in pages and urllib.parse.unquote(url.fragment) not in pages[target].anchors | {"__skip"}:
                yield f"{page.relative_to(site)}: {link} has no such place"


def wrong_live(site):
    for page, live in LIVE.items():
        if not (site / live).exists():
            yield f"{live} was not made"
        text = (site / page).read_text(encoding="utf-8")
        link = os.path.relpath(live, pathlib.Path(page).parent)
        if f'<figure class="live"><a href="{link}"><img src="' not in text:
            yield f"{page}: no picture that opens {live}"


def wrong_in_browser(site, node, chromium):
    script = pathlib.Path(__file__).parents[1] / "view" / "embedded_test.cjs"
    with served(site) as address:
        for page in LIVE:
            run = subprocess.run([node, script, f"{address}/{page}", chromium], capture_output=True, text=True)
            if run.returncode == SKIPPED:
                print(run.stdout, end="")
                return
            if run.returncode != 0:
                yield f"{page}: {run.stdout}{run.stderr}"


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@contextlib.contextmanager
def served(site):
    """The address of the site, as long as it is open."""
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=site)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


def main(root, prohull, *browser):
    try:
        from mkdocs.utils import get_theme_names
    except ImportError:
        get_theme_names = list
    if "material" not in get_theme_names():
        print("skipped: install mkdocs and mkdocs-material")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder).resolve() / "site"
        build = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "-d", site], cwd=root,
                               env={**os.environ, "PROHULL": prohull}, capture_output=True, text=True)
        if build.returncode != 0:
            print(build.stdout + build.stderr)
            return 1
        wrong = [*wrong_links(site), *wrong_live(site)]
        if len(browser) == 2:
            wrong += wrong_in_browser(site, *browser)
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
