#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a page that shows pictures as eyes see them that lack a kind of cone, in light and in dark.

    simulated_eyes.py PAGE.html PICTURE.svg|PICTURE.png ...

The simulation is that of tests/pictures/model/colors_test.cpp (Machado, Oliveira and Fernandes 2009, severity 1), done by
the browser in linear light. Pictures are inside of the page; it needs no network.
"""

import base64
import os
import sys

EYES = {
    "protanopia": [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
    "deuteranopia": [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881],
    "tritanopia": [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900],
}
TYPES = {".svg": "image/svg+xml", ".png": "image/png"}


def filter_of(name, matrix):
    rows = [" ".join(map(str, matrix[3 * row:3 * row + 3])) + " 0 0" for row in range(3)]
    return (f'<filter id="{name}" color-interpolation-filters="linearRGB"><feColorMatrix values="{" ".join(rows)} 0 0 0 1 0"/></filter>')


def shown(picture):
    with open(picture, "rb") as file:
        data = base64.b64encode(file.read()).decode()
    source = f"data:{TYPES[os.path.splitext(picture)[1]]};base64,{data}"
    name = os.path.basename(picture)
    figures = [f'<figure><img alt="{name}" src="{source}" style="filter:{f"url(#{eyes})" if eyes != "all cones" else "none"}">'
               f"<figcaption>{eyes}</figcaption></figure>" for eyes in ("all cones", *EYES)]
    return f"<h2>{name}</h2>\n<div>{''.join(figures)}</div>"


def main():
    if len(sys.argv) < 3 or any(os.path.splitext(name)[1] not in TYPES for name in sys.argv[2:]):
        sys.exit(__doc__)
    filters = "".join(filter_of(name, matrix) for name, matrix in EYES.items())
    page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>As other eyes see it</title><style>
:root {{ color-scheme: light dark; }} body {{ font: 14px sans-serif; margin: 1rem; }}
div {{ display: grid; grid-template-columns: repeat(4, minmax(0, 1fr)); gap: .5rem; }}
figure {{ margin: 0; }} img {{ width: 100%; background: #fff; }}
</style></head><body><svg width="0" height="0" style="position:absolute">{filters}</svg>
{chr(10).join(shown(name) for name in sys.argv[2:])}
</body></html>
"""
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    main()
