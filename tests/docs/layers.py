#!/usr/bin/python3
"""Fails unless the table of folders in docs/architecture.md says what tests/layering.cmake enforces: layers.py ROOT [--write]

--write puts into the table what is enforced now.
"""

import pathlib
import re
import sys

ROOM = re.compile(r"^room\((\w+)([^)]*)\)", re.MULTILINE)
ROW = re.compile(r"^\| `(\w+)` \|([^|]*)\|([^|]*)\|([^|]*)\|$", re.MULTILINE)


def rules(text):
    """The public headers of each folder, and what it may include."""
    for name, body in ROOM.findall(re.sub(r" +#.*", "", text)):
        owns, _, may = body.partition("MAY")
        yield name, (sorted(owns.split()[1:]), may.split())


def main(root, *arguments):
    page = pathlib.Path(root) / "docs/architecture.md"
    enforced = dict(rules((pathlib.Path(root) / "tests/layering.cmake").read_text()))
    text = page.read_text()
    told = [row[1] for row in ROW.finditer(text)]
    for folder in sorted(enforced.keys() ^ set(told)):
        print(f"{folder}: has no row in docs/architecture.md, or no rule in tests/layering.cmake")
    places = {folder: place for place, folder in enumerate(told)}

    def renewed(row):
        owns, may = enforced.get(row[1], ([], []))
        may = sorted(may, key=lambda name: (places.get(name, len(places)), name))
        return f"| `{row[1]}` |{row[2]}| {', '.join(f'`{name}`' for name in owns)} | {', '.join(may)} |"

    now = ROW.sub(renewed, text)
    if now != text:
        if "--write" not in arguments:
            print("docs/architecture.md: its table is not what tests/layering.cmake enforces; renew it: tests/docs/layers.py . --write")
            return False
        page.write_text(now)
    return enforced.keys() == set(told)


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
