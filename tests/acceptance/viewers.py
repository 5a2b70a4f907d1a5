#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens pictures of mazes, 41 x 41 cells to 4000 x 4000, by the programs that people open them with, and prints a table.

    viewers.py PROGRAM [--sides 41,200,1000,4000] [--keep FOLDER]

Each maze is solved and drawn as SVG and as PDF; rsvg-convert, Inkscape and Chromium make a PNG of the one, pdftoppm of the
other. Exit code 1 where one of them fails, or shows less than walls and a path: fewer than three colours far apart.
Times are of the processor, all threads, so a busy machine changes them little. Programs that are not there are left out.
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile

from PIL import Image

PATIENCE_S = 400
SIZE = "900x1000"
VIEWERS = {  # picture's ending, words; {0} the picture, {1} the PNG
    "rsvg-convert": (".svg", ["rsvg-convert", "{0}", "-o", "{1}"]),
    "inkscape": (".svg", ["inkscape", "{0}", "--export-filename={1}"]),
    "chromium": (".svg", ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=900,1000",
                          "--screenshot={1}", "{0}"]),
    "pdftoppm": (".pdf", ["pdftoppm", "-png", "-r", "96", "-singlefile", "{0}", "{1}"]),
}


def processor_s(words, folder):
    """(seconds, trouble): trouble is empty where it ended well."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, timeout=PATIENCE_S)
        trouble = "" if done.returncode == 0 else f"exit code {done.returncode}: {done.stderr.decode(errors='replace').strip()[-200:]}"
    except subprocess.TimeoutExpired:
        trouble = f"no end in {PATIENCE_S} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, trouble


def what_is_shown(png):
    """Why the PNG can't be the picture; empty: it can. Dark walls, a red path and white paper are looked for."""
    if not os.path.exists(png):
        return "no image"
    with Image.open(png) as image:
        pixels = image.convert("RGB").resize((450, 500)).tobytes()
    triples = list(zip(pixels[0::3], pixels[1::3], pixels[2::3]))
    white = sum(min(p) > 245 for p in triples)
    red = sum(r > 150 and g < 0.6 * r and b < 0.7 * r for r, g, b in triples)
    dark = sum(max(p) < 215 for p in triples)
    missing = [name for name, count in (("paper", white), ("path", red), ("walls", dark)) if count < 30]
    return f"no {' and no '.join(missing)} seen" if missing else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--sides", default="41,200,1000,4000")
    parser.add_argument("--keep", help="a folder that the pictures stay in")
    options = parser.parse_args()
    folder = options.keep or tempfile.mkdtemp(prefix="viewers-")
    os.makedirs(folder, exist_ok=True)
    program = os.path.abspath(options.program)
    viewers = {name: viewer for name, viewer in VIEWERS.items() if shutil.which(viewer[1][0])}
    print("| maze | SVG | PDF | " + " | ".join(viewers) + " |\n|---|---|---|" + "---|" * len(viewers))
    troubles = []
    for side in options.sides.split(","):
        cells = [f"{side}²"]
        for ending in (".svg", ".pdf"):
            picture = f"maze-{side}{ending}"
            seconds, trouble = processor_s([program, "solve", f"maze:{side}x{side}", "--size", SIZE, "--svg", picture, "--quiet"], folder)
            size = 0 if trouble else os.path.getsize(os.path.join(folder, picture)) / 1e6
            cells.append(trouble or f"{size:.2f} MB, {seconds:.1f} s")
            troubles += [f"{picture}: {trouble}"] if trouble else []
        for name, (ending, words) in viewers.items():
            picture, png = os.path.join(folder, f"maze-{side}{ending}"), os.path.join(folder, f"maze-{side}-{name}.png")
            target = png[:-4] if name == "pdftoppm" else png
            seconds, trouble = processor_s([word.format(picture, target) for word in words], folder)
            trouble = trouble or what_is_shown(png)
            cells.append(trouble or f"{seconds:.1f} s")
            troubles += [f"{name} of {side}: {trouble}"] if trouble else []
        print("| " + " | ".join(cells) + " |", flush=True)
    if not options.keep:
        shutil.rmtree(folder)
    sys.exit("\n".join(troubles) if troubles else 0)


if __name__ == "__main__":
    main()
