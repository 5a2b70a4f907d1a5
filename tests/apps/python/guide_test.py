# SPDX-License-Identifier: BSD-3-Clause
"""docs/python.md: its programs run, in their order, and it names all there is."""
import pathlib
import re
import runpy

import matplotlib
import warren
from conftest import ROOT

matplotlib.use("Agg")
GUIDE = (ROOT / "docs" / "python.md").read_text()


def test_the_programs_of_the_guide_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    blocks = re.findall(r"```python\n(.*?)```", GUIDE, re.S)
    assert len(blocks) >= 7
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)  # noqa: S102


def test_readme_shows_a_program_that_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)
    exec(compile(block, "README.md", "exec"), {})  # noqa: S102
    assert pathlib.Path("path.svg").read_text().startswith("<")


def test_the_guide_names_all_there_is():
    table = GUIDE[GUIDE.index("## All names"):]
    for name in warren.__all__:
        if name.startswith("__") or name == "EdgeCounts":
            continue
        assert name in table, name
        thing = getattr(warren, name)
        for member in vars(thing) if isinstance(thing, type) and name in ("World", "Answer", "Roadmap") else ():
            assert member.startswith("_") or re.search(rf"\b{member}\b", table), f"{name}.{member}"


def test_the_typed_program_runs():
    runpy.run_path(str(pathlib.Path(__file__).with_name("typed_program.py")), run_name="__main__")
