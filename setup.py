# SPDX-License-Identifier: BSD-3-Clause
"""The Python package by pip: `pip install --no-build-isolation .` in a virtual environment that sees Debian's packages.

CMake builds the module, with the library inside, below build/pip; WARREN_BUILD_DIR names a build of the preset python whose
module is taken instead.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
BUILD = ROOT / "build" / "pip"


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        there = os.environ.get("WARREN_BUILD_DIR")
        build = pathlib.Path(there) if there else BUILD / "cmake"
        if not there:
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCMAKE_UNITY_BUILD=ON", "-DWARREN_TESTS=OFF", "-DWARREN_PYTHON=ON",
                            f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "warren_python"], check=True)
        (module,) = (build / "python" / "warren").glob("_core*.so")
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(module, target)
        subprocess.run(["strip", "--strip-unneeded", target], check=True)


BUILD.mkdir(parents=True, exist_ok=True)
setup(version=re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1],
      ext_modules=[Extension("warren._core", [])], cmdclass={"build_ext": BuildByCMake},
      options={"build": {"build_base": str(BUILD)}, "egg_info": {"egg_base": str(BUILD)}})
