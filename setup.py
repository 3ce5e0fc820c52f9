"""Builds the Python package by CMake, as scripts/setup does; pyproject.toml has the rest.

Compiler and libraries have to be there: `scripts/install-packages build wheel` installs them on Debian 12. From the network
nothing is needed, but for the page of hull.show(): where node and npm are there, they fetch what it is made of.

    python3 -m pip install --no-build-isolation .

PROHULL_BUILD_DIR names a folder where CMake has built prohull; then nothing is compiled twice. With PROHULL_SELF_CONTAINED=1
the package brings the shared libraries that it needs; scripts/wheel sets both.
"""

import contextlib
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
SELF_CONTAINED = os.environ.get("PROHULL_SELF_CONTAINED") == "1"


def say(message):
    print(f"prohull: {message}", file=sys.stderr, flush=True)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = pathlib.Path(os.environ.get("PROHULL_BUILD_DIR", self.build_temp)).resolve()
        if "PROHULL_BUILD_DIR" not in os.environ:
            self.configure(build)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        say(f"compiling in {build} with {jobs} jobs; this takes about two minutes on two cores")
        self.cmake("--build", str(build), "--target", "prohull_wheel", "--parallel", jobs)
        self.cmake("--install", str(build), "--strip", "--component", "wheel", "--prefix", str(package))
        if SELF_CONTAINED:
            say("adding the shared libraries")
            subprocess.run([sys.executable, str(ROOT / "scripts" / "bundle-libraries"), str(package)], check=True)

    def configure(self, build):
        """With pybind11 of the Python packages, where that comes from PyPI."""
        missing = [tool for tool in ("cmake", "pkg-config", os.environ.get("CXX", "c++")) if not shutil.which(tool)]
        if missing:
            sys.exit(self.failed(f"{' and '.join(missing)} not found"))
        say("looking for the libraries that it is built with")
        with contextlib.suppress(ImportError):
            import pybind11
            os.environ.setdefault("pybind11_DIR", pybind11.get_cmake_dir())
        try:
            self.cmake("-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
                       "-DPROHULL_BENCH=OFF", "-DPROHULL_PYTHON=REQUIRED",
                       f"-DPython_EXECUTABLE={sys.executable}")
        except subprocess.CalledProcessError:
            sys.exit(self.failed("CMake has not found everything, see above"))

    def failed(self, why):
        return (f"\nprohull: {why}.\nprohull is compiled here, with a C++20 compiler, CMake 3.25 and the libraries of "
                "docs/dependencies.md.\nOn Debian 12, `scripts/install-packages build wheel` installs all of them. A wheel made "
                "by `scripts/wheel`\non such a machine needs none of this.")

    def cmake(self, *arguments):
        subprocess.run(["cmake", *arguments], check=True)


version = re.search(r"project\(prohull VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
with tempfile.TemporaryDirectory() as folder:
    options = {}
    if SELF_CONTAINED:  # what it still takes from the system is glibc and libstdc++, of this version or a later one
        glibc = platform.libc_ver()[1].replace(".", "_")
        options["bdist_wheel"] = {"plat_name": f"manylinux_{glibc}_{platform.machine()}"}
    if "PROHULL_BUILD_DIR" in os.environ:
        options["build"] = {"build_base": folder}
    setup(version=version, options=options, ext_modules=[Extension("prohull._prohull", sources=[])],
          cmdclass={"build_ext": CMakeBuild})
