# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of examples/notebooks run from their first cell to the last, and are kept without outputs."""
import json
import os
import shutil
import subprocess
import sys
import zlib

import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))


def asked_today():
    """All of them; by day one, which WARREN_PICK chooses."""
    pick = os.environ.get("WARREN_PICK", "")
    if os.environ.get("WARREN_SEEDS") != "day" or not pick:
        return NOTEBOOKS
    return [NOTEBOOKS[zlib.crc32(pick.encode()) % len(NOTEBOOKS)]]


TODAY = asked_today()


@pytest.mark.parametrize("notebook", TODAY, ids=[file.stem for file in TODAY])
def test_a_notebook_runs(notebook, tmp_path):
    pytest.importorskip("nbconvert", reason="needs Debian's jupyter-nbconvert")
    pytest.importorskip("ipykernel", reason="needs Debian's python3-ipykernel")
    shutil.copytree(ROOT / "examples" / "worlds", tmp_path / "worlds")
    (tmp_path / "notebooks").mkdir()
    done = subprocess.run([sys.executable, "-B", "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir",
                           tmp_path / "done", shutil.copy(notebook, tmp_path / "notebooks")], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=240, cwd=tmp_path,
                          env={**os.environ, "HOME": str(tmp_path), "MPLBACKEND": "module://matplotlib_inline.backend_inline"})
    assert done.returncode == 0, done.stdout[-3000:]
    cells = json.loads((tmp_path / "done" / notebook.name).read_text())["cells"]
    assert any("image/png" in out.get("data", {}) for cell in cells for out in cell.get("outputs", []))


def test_notebooks_are_kept_without_outputs():
    assert len(NOTEBOOKS) == 3
    for notebook in NOTEBOOKS:
        for cell in json.loads(notebook.read_text())["cells"]:
            assert not cell.get("outputs") and cell.get("execution_count") is None, notebook.name
