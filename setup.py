"""Builds the Python package by CMake, as scripts/setup does; pyproject.toml has the rest.

The libraries have to be there (scripts/install-packages). From the network nothing is needed:

    python3 -m pip install --no-build-isolation .
"""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        self.cmake("-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
                   "-DPROHULL_PYTHON=REQUIRED", f"-DPython_EXECUTABLE={sys.executable}")
        self.cmake("--build", str(build), "--target", "prohull_wheel", "--parallel", jobs)
        self.cmake("--install", str(build), "--component", "wheel", "--prefix", str(package))

    def cmake(self, *arguments):
        subprocess.run(["cmake", *arguments], check=True)


version = re.search(r"project\(prohull VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
setup(version=version, ext_modules=[Extension("prohull._prohull", sources=[])], cmdclass={"build_ext": CMakeBuild})
