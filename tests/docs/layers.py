#!/usr/bin/python3
"""Fails unless the table of folders in docs/architecture.md says what tests/layering.cmake enforces: layers.py ROOT"""

import pathlib
import re
import sys

ROOM = re.compile(r"^room\((\w+)([^)]*)\)", re.MULTILINE)
ROW = re.compile(r"^\| `(\w+)` \|[^|]*\|([^|]*)\|([^|]*)\|$", re.MULTILINE)


def rules(text):
    """Public headers and what may be included, by folder."""
    for name, body in ROOM.findall(re.sub(r" +#.*", "", text)):
        owns, _, may = body.partition("MAY")
        yield name, (set(owns.replace("OWNS", "").split()), set(may.split()))


def rows(text):
    for name, owns, may in ROW.findall(text):
        yield name, (set(re.findall(r"\w+", owns)), set(re.findall(r"[\w/]+", may)))


def main(root):
    root = pathlib.Path(root)
    enforced = dict(rules((root / "tests/layering.cmake").read_text()))
    told = dict(rows((root / "docs/architecture.md").read_text()))
    wrong = 0
    for folder in sorted(enforced.keys() | told.keys()):
        if enforced.get(folder) != told.get(folder):
            wrong += 1
            print(f"{folder}: tests/layering.cmake has {enforced.get(folder)}, docs/architecture.md {told.get(folder)}")
    return wrong == 0


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
