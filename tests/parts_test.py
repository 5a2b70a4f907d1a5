# SPDX-License-Identifier: BSD-3-Clause
"""tests/parts names all that a part stands on, and every folder with sources is below some part: else a fault could stand
where the check does not look again."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[1]
PARTS = {}
for line in (ROOT / "tests" / "parts").read_text(encoding="utf-8").splitlines():
    if line and not line.startswith("#"):
        name, tests, *paths = line.split()
        re.compile(tests)
        PARTS[name] = paths
FOLDERS = {"/".join(path.parts[: 2 if path.parts[0] == "apps" else 1])
           for path in (file.relative_to(ROOT) for file in ROOT.glob("*/**/*.hpp")) if path.parts[0] not in ("build", "out")}
STANDS_ON = {folder: set() for folder in FOLDERS}
for folder in FOLDERS:
    for file in (ROOT / folder).rglob("*.[ch]pp"):
        STANDS_ON[folder] |= {f for f in re.findall(r'#include "((?:apps/)?[a-z]+)/', file.read_text(encoding="utf-8"))} & FOLDERS

faults = []
for name, paths in PARTS.items():
    faults += [f"{name}: {path} is not there" for path in paths if not (ROOT / path).exists()]
    for folder in FOLDERS & set(paths):
        faults += [f"{name}: {folder} stands on {below}" for below in sorted(STANDS_ON[folder] - set(paths))]
named = {path for paths in PARTS.values() for path in paths}
faults += [f"no part stands on {folder}" for folder in sorted(FOLDERS - named - {"tests"})]
assert len(PARTS) > 1 and len(FOLDERS) > 10, (PARTS, FOLDERS)
assert not faults, "\n".join(faults)
