#!/usr/bin/python3
"""Fails unless what README.md, CONTRIBUTING.md and the pages in docs/ name is there: names.py ROOT

A path in backticks must be the path of a file or folder, or the end of one; it may have asterisks. A name of code, such as
`CollapseLoop::run` or `place_outside`, must stand in the sources. All else, such as commands and formulas, is passed over.
"""

import fnmatch
import pathlib
import re
import sys

FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`([^`\n]+)`")
SUFFIXES = "h cpp py js mjs cmake sh md json csv svg yml pyi txt"
PATH = re.compile(rf"[\w.*-]*(/[\w.*-]+)+/?|[\w*-]+/|[\w*-]+\.({SUFFIXES.replace(' ', '|')})")
NAME = re.compile(r"(\w+::)*\w+(\(\))?")
SOURCE = re.compile(r"\.(h|cpp|py|pyi|cmake|sh|mjs)$|^js/prohull/|CMakeLists\.txt$|CMakePresets\.json$|^scripts/")
ELSEWHERE = ("build/", "out/", "/", "CGAL::", "std::")  # made by building, of the system, of others
NOT_OURS = ("build", "out", ".git")
TEST_PROGRAM = re.compile(r"prohull_add_test\((\w+)")


def is_name_of_code(text):
    """With an underscore, a colon or a capital after the first letter, as words of English have none."""
    return NAME.fullmatch(text) and re.search(r"_|::|.[A-Z]|\(\)", text) and not text.endswith("_")


def is_there(path, files):
    path = path.rstrip("/")
    pattern = re.compile(rf"(.*/)?{fnmatch.translate(path)}")
    return any(pattern.match(name) or pattern.match(name.removesuffix(".h")) for name in files)  # tables leave .h out


def wrong_names(page, files, words):
    for text in CODE.findall(FENCED.sub("", page.read_text())):
        if text.startswith(ELSEWHERE):
            continue
        if PATH.fullmatch(text):
            if not is_there(text, files):
                yield f"{text} is not there"
        elif is_name_of_code(text):
            for word in re.findall(r"\w+", text):
                if word not in words:
                    yield f"{text}: no source has {word}"


def main(root):
    root = pathlib.Path(root).resolve()
    files = {str(path.relative_to(root)) for path in root.rglob("*")
             if path.is_file() and path.relative_to(root).parts[0] not in NOT_OURS}
    words = set()
    for text in ((root / name).read_text(errors="replace") for name in files
                 if SOURCE.search(name) and (root / name) != pathlib.Path(__file__).resolve()):
        words.update(re.findall(r"\w+", text))
        words.update(f"{name}_test" for name in TEST_PROGRAM.findall(text))
    files |= {str(folder) for name in files for folder in pathlib.PurePath(name).parents}
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted(root.glob("docs/*.md"))]
    wrong = [f"{page.relative_to(root)}: {what}" for page in pages for what in wrong_names(page, files, words)]
    print("\n".join(wrong))
    return not wrong


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
