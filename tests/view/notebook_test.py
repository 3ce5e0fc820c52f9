#!/usr/bin/python3
"""Opens in a browser what show() gives to notebooks: notebook_test.py NODE CHROMIUM"""

import pathlib
import subprocess
import sys
import tempfile

import prohull


def main(node, chromium):
    hull = prohull.build(prohull.sample("pony", 2000), 300, levels=True)
    shown = prohull.view(hull)._repr_mimebundle_()["text/html"]
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "notebook.html"
        page.write_text(f'<!DOCTYPE html><html><meta charset="utf-8"><body>{shown}</body></html>', encoding="utf-8")
        script = pathlib.Path(__file__).with_name("embedded_test.cjs")
        return subprocess.run([node, script, page.as_uri(), chromium]).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
