#!/usr/bin/python3
"""Fails unless what README.md, CONTRIBUTING.md, CHANGELOG.md and the pages below docs/ link to or show is there: links.py ROOT

Files, pictures and headings, by relative links; also unless each page is in the nav of mkdocs.yml, and each picture on
some page, as one of its kinds.
"""

import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
PICTURES = (".png", ".svg")


def anchors(page):
    """Of its headings, as GitHub and MkDocs make them."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def wrong_with(page, link):
    path, _, anchor = link.partition("#")
    target = (page.parent / path).resolve() if path else page
    if not target.exists():
        return "is not there"
    if anchor and anchor not in anchors(target):
        return "has no such heading"
    return None


def main(root):
    root = pathlib.Path(root).resolve()
    pages = sorted(root.glob("docs/**/*.md"))
    nav = set(re.findall(r"[\w/-]+\.md", (root / "mkdocs.yml").read_text()))
    wrong = [f"mkdocs.yml: its nav has no {page}" for page in
             sorted({str(page.relative_to(root / "docs")) for page in pages} - nav)]
    shown = set()
    for page in [root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md", *pages]:
        links = [link for link in LINK.findall(CODE.sub("", page.read_text())) if not re.match(r"\w+:", link)]
        shown |= {(page.parent / link).resolve() for link in links if link.endswith(PICTURES)}
        for link in links:
            what = wrong_with(page, link)
            if what:
                wrong.append(f"{page.relative_to(root)}: {link} {what}")
    for picture in sorted(root.glob("docs/figures/*.*")):
        if picture.suffix in PICTURES and not {picture.with_suffix(kind) for kind in PICTURES} & shown:
            wrong.append(f"{picture.relative_to(root)}: on no page")
    print("\n".join(wrong))
    return not wrong


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
