# SPDX-License-Identifier: BSD-3-Clause
"""A wheel, built and installed with Debian's packages alone."""
import os
import pathlib
import subprocess
import sys

import warren
from conftest import ROOT


def test_pip_installs_what_was_built(tmp_path):
    here = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    here["WARREN_BUILD_DIR"] = str(pathlib.Path(warren.__file__).parents[2])
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    python = tmp_path / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-build-isolation", "--no-deps", ROOT],
                   check=True, env=here)
    told = subprocess.run([python, "-c", "import warren; print(warren.__version__, warren.__file__, warren.solve('maze:5x5').length)"],
                          check=True, env=here, cwd=tmp_path, stdout=subprocess.PIPE, text=True).stdout.split()
    assert told[0] == warren.__version__ and told[1].startswith(str(tmp_path)) and told[2] == "19.0"
    installed = {file.name for file in pathlib.Path(told[1]).parent.iterdir()}
    assert {"py.typed", "__init__.pyi", "_solving.pyi"} <= installed
