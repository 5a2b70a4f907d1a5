# SPDX-License-Identifier: BSD-3-Clause
"""A wheel, built with Debian's packages alone by the same call as pip's (pip itself takes half a minute to make a venv)."""
import os
import pathlib
import subprocess
import sys
import zipfile

import warren
from conftest import ROOT


def test_the_wheel_that_pip_builds_works(tmp_path):
    here = {**os.environ, "WARREN_BUILD_DIR": str(pathlib.Path(warren.__file__).parents[2])}
    subprocess.run([sys.executable, "-B", "-c", f"from setuptools import build_meta; build_meta.build_wheel({str(tmp_path)!r})"],
                   check=True, env=here, cwd=ROOT, stdout=subprocess.DEVNULL)
    (wheel,) = tmp_path.glob(f"warren-{warren.__version__}-*.whl")
    zipfile.ZipFile(wheel).extractall(tmp_path / "site")
    program = "import warren; print(warren.__version__, warren.__file__, warren.solve('maze:5x5').length)"
    told = subprocess.run([sys.executable, "-B", "-c", program], check=True, stdout=subprocess.PIPE, text=True,
                          env={**os.environ, "PYTHONPATH": str(tmp_path / "site")}).stdout.split()
    assert told == [warren.__version__, str(tmp_path / "site" / "warren" / "__init__.py"), "19.0"]
    installed = {file.name for file in (tmp_path / "site" / "warren").iterdir()}
    assert {"py.typed", "__init__.pyi", "_solving.pyi"} <= installed
