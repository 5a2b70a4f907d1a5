# SPDX-License-Identifier: BSD-3-Clause
"""A copy of the tree that holds all faults, each asleep until its number is chosen when a program starts."""

import os
import shutil
import subprocess

from fault_table import planted

FOLDERS = ("cmake", "core", "parallel", "spatial", "scenes", "worlds", "verify", "planners", "solve", "pictures",
           "apps", "tools", "tests", "bench", "docs", "examples")
VARIABLE = "WARREN_PLANTED_FAULT"

HEADER = """// SPDX-License-Identifier: BSD-3-Clause
// Written by tools/mutate: which of the planted faults this process has. Constant from before main() on.
#pragma once

namespace warren {
extern int planted_fault;  // 0: none
constexpr bool planted(int number) noexcept { return !__builtin_is_constant_evaluated() && planted_fault == number; }
}  // namespace warren
"""

SOURCE = f"""// SPDX-License-Identifier: BSD-3-Clause
#include "core/planted.hpp"

#include <cstdlib>

namespace warren {{
int planted_fault = 0;
namespace {{
[[gnu::constructor(101)]] void choose_planted_fault() {{
  if (const char* number = std::getenv("{VARIABLE}")) planted_fault = std::atoi(number);
}}
}}  // namespace
}}  // namespace warren
"""


def files_of(root):
    names = [name for name in os.listdir(root) if os.path.isfile(os.path.join(root, name))]
    for folder in FOLDERS:
        for path, folders, files in os.walk(os.path.join(root, folder)):
            folders[:] = [name for name in folders if name != "__pycache__"]
            names += [os.path.relpath(os.path.join(path, name), root) for name in files]
    return [name for name in names if not name.endswith(".pyc")]


def write_if_changed(path, content):
    """What has not changed is not built again."""
    try:
        with open(path, "rb") as file:
            if file.read() == content:
                return
    except OSError:
        os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content)


def make_tree(root, tree, faults):
    """Makes `tree` what `root` is, with the faults. TableError for one that can't be planted."""
    by_file = {}
    for fault in faults:
        by_file.setdefault(fault.file, []).append(fault)
    contents = {"core/planted.hpp": HEADER.encode(), "core/planted.cpp": SOURCE.encode()}
    for name in files_of(root):
        with open(os.path.join(root, name), "rb") as file:
            content = file.read()
        here = by_file.pop(name, None)
        contents[name] = planted(content.decode(), here).encode() if here else content
    for name, here in by_file.items():
        raise FileNotFoundError(f"{here[0].name}: {name} does not exist")
    for name, content in contents.items():
        path, original = os.path.join(tree, name), os.path.join(root, name)
        write_if_changed(path, content)
        if os.path.exists(original):
            shutil.copymode(original, path)
    for name in files_of(tree):
        if name not in contents:
            os.remove(os.path.join(tree, name))
    shared = os.path.join(os.path.dirname(os.path.abspath(root)), "shared")
    link = os.path.join(os.path.dirname(os.path.abspath(tree)), "shared")
    if os.path.isdir(shared) and not os.path.lexists(link):
        os.symlink(shared, link)


def build(tree, log):
    """Configures and builds the copy as preset dev has it; returns the folder, or None where that fails."""
    environment = dict(os.environ, CCACHE_BASEDIR=tree, CCACHE_NOHASHDIR="1")
    if shutil.which("ccache"):
        environment["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    folder = os.path.join(tree, "build", "dev")
    with open(log, "w", encoding="utf-8") as output:
        for command in (["cmake", "--preset", "dev"], ["ninja", "-C", folder, "-k", "0"]):
            done = subprocess.run(command, cwd=tree, stdout=output, stderr=output, stdin=subprocess.DEVNULL,
                                  env=environment, check=False)
            if done.returncode != 0:
                return None
    return folder
