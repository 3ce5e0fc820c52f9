#!/usr/bin/python3
"""Runs what readers can copy: snippets.py ROOT PROHULL [--write] [PAGE...]

Of README.md, CONTRIBUTING.md and all pages below docs/, or of the given ones, each in an empty folder of its own:

    console   lines that begin with "$ " are run by sh, one after the other; the lines below are what each prints
    python    run as one program for each page, between the commands
    text      what the block before it prints
    cpp       stands in one of examples/, which are tests of their own, between "// docs: NAME" and "// docs: end"
    cmake     stands in docs/install.md, of which the test `consumer` runs all, but for the version
    xml       is well-formed, and so is
    yaml      where PyYAML is installed
    sh        installs or builds: not run here, and no line of it begins with prohull

Lines shown must be printed, in this order; more may be printed. Their numbers must be those that are printed, but for times and sizes
of memory, which change from machine to machine. --write puts the other numbers that are printed now into the pages. Blocks that are indented, not fenced, take minutes or models and are not run. Where a module is not
installed that the Python of a page imports, the rest of its Python is not run, which is said.
"""

import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
import xml.etree.ElementTree

FENCED = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PART_OF_EXAMPLE = re.compile(r"// docs: [a-z_]+\n(.*?)\n *// docs: end", re.DOTALL)


class Wrong(Exception):
    pass


NUMBER = r"\d[\d,.]*(e[-+]?\d+)?"
MEASURED = re.compile(rf"\b{NUMBER} ?(s|ms|us|ns|min|minutes?|hours?|MiB|GiB|MB|GB|KB|threads?|per second|times)\b|"
                      rf"(?<=seconds\": ){NUMBER}|(?<=threads: ){NUMBER}|\d[\d.]*e-1\d")  # the last is rounding


def form(line):
    """The line without its numbers."""
    return re.sub(NUMBER, "#", line).replace("threads", "thread").strip()


def without_measures(line):
    """The line without its numbers that change from machine to machine."""
    return form(line) if re.search(r"seconds|per second", line) else MEASURED.sub("#", line).replace("threads", "thread").strip()


def with_measures_of(line, found):
    """The line `found` with the times that `line` has, if it has as many."""
    known = [measure[0] for measure in MEASURED.finditer(line)]
    if len(known) != len(list(MEASURED.finditer(found))):
        return found
    return MEASURED.sub(lambda _: known.pop(0), found)


def run(command):
    done = subprocess.run(["sh", "-c", command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise Wrong(f"exit code {done.returncode}: {command}{done.stdout}")
    return done.stdout.splitlines()


def lines_at(code, at):
    for line in code.splitlines(keepends=True):
        yield line, at
        at += len(line)


class Page:
    def __init__(self, root, path):
        self.root, self.path, self.text = root, path, path.read_text()
        self.names = {"__name__": "page"}  # of its Python; None if that cannot run
        self.printed = []  # by the last block that ran
        self.renewed = []  # lines whose numbers are others now: where, what is there, what to write
        self.stale = []  # the same for messages

    def check(self):
        kinds = dict(console=self.console, python=self.python, text=self.shown, cpp=self.cpp, cmake=self.cmake,
                     xml=self.xml, yaml=self.yaml, sh=self.sh)
        blocks = list(FENCED.finditer(self.text))
        if self.text.count("```") != 2 * len(blocks):
            raise Wrong("has a fenced block that is indented or not closed")
        for block in blocks:
            if block[1] not in kinds:
                raise Wrong(f"has a block of {block[1] or 'nothing'}, expected one of {', '.join(kinds)}")
            kinds[block[1]](block[2], block.start(2))

    def console(self, code, at):
        self.printed, unseen, command = [], [], ""
        for line, begin in lines_at(code, at):
            if not command and not line.startswith("$ "):
                self.find(line, begin, unseen)
                continue
            command += line if command else line[2:]
            if not command.endswith("\\\n"):
                unseen, command = run(command), ""
                self.printed += unseen

    def python(self, code, _):
        if self.names is None:
            return
        out = io.StringIO()
        try:
            with contextlib.redirect_stdout(out):
                exec(compile(code, f"the Python of {self.path.name}", "exec"), self.names)
        except ModuleNotFoundError as error:
            if error.name.startswith("prohull."):
                raise
            print(f"{self.path}: its Python is not run: {error}")
            self.names, self.printed = None, None
            return
        self.printed = out.getvalue().splitlines()

    def shown(self, text, at):
        if self.printed is None:
            return
        unseen = list(self.printed)
        for line, begin in lines_at(text, at):
            self.find(line, begin, unseen)

    def find(self, line, at, unseen):
        """Takes the lines off `unseen` up to one that is this line, or else up to one of its form, whose numbers are then stale."""
        for key in (without_measures, form):
            at_line = next((i for i, found in enumerate(unseen) if key(found) == key(line)), None)
            if at_line is None:
                continue
            found = unseen[at_line]
            del unseen[:at_line + 1]
            if key is form:
                self.renewed.append((at, line, with_measures_of(line, found) + "\n"))
                self.stale.append(f"{line.strip()}\n  printed is: {found.strip()}")
            return
        raise Wrong(f"shows what is not printed: {line}printed is\n" + "\n".join(unseen))

    def cpp(self, code, _):
        for example in self.root.glob("examples/*.cpp"):
            if code.strip() in (textwrap.dedent(part).strip() for part in PART_OF_EXAMPLE.findall(example.read_text())):
                return
        raise Wrong(f"has C++ that is in none of examples/*.cpp:\n{code}")

    def cmake(self, code, _):
        version = re.compile(r"(?<=find_package\(prohull) [\d.]+")
        if version.sub("", code) not in version.sub("", (self.root / "docs/install.md").read_text()):
            raise Wrong(f"has CMake that is not in docs/install.md:\n{code}")

    def xml(self, code, _):
        xml.etree.ElementTree.fromstring(code)

    def yaml(self, code, _):
        try:
            import yaml
        except ModuleNotFoundError:
            return print(f"{self.path}: its YAML is not read: PyYAML is not installed")
        if not isinstance(yaml.safe_load(code), dict):
            raise Wrong(f"has YAML without keys:\n{code}")

    def sh(self, code, _):
        if re.search(r"^prohull ", code, re.MULTILINE):
            raise Wrong(f"has sh that can be run, so make it console:\n{code}")

    def write(self):
        for at, line, printed in sorted(self.renewed, reverse=True):
            self.text = self.text[:at] + printed + self.text[at + len(line):]
        self.path.write_text(self.text)


def check(page, write):
    """Whether it holds; says why not."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["XDG_CACHE_HOME"] = f"{folder}/.cache"
        try:
            page.check()
            if page.stale and not write:
                raise Wrong("shows numbers that are others now; --write renews them\n" + "\n".join(page.stale))
        except Exception as error:  # also what the Python of the page raises
            print(f"{page.path}: {error if isinstance(error, Wrong) else repr(error)}")
            return False
        finally:
            os.chdir("/")
    if write:
        page.write()
    return True


def main(root, prohull, *arguments):
    root = pathlib.Path(root).resolve()
    os.environ["PATH"] = f"{pathlib.Path(prohull).resolve().parent}:{os.environ['PATH']}"
    paths = [pathlib.Path(a).resolve() for a in arguments if a != "--write"]
    pages = [Page(root, path) for path in paths or [root / "README.md", root / "CONTRIBUTING.md", *sorted(root.glob("docs/**/*.md"))]]
    return all([check(page, "--write" in arguments) for page in pages])


if __name__ == "__main__":
    sys.exit(not main(*sys.argv[1:]))
