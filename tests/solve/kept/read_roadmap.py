# SPDX-License-Identifier: BSD-3-Clause
"""read_roadmap.py FILE: what a .roadmap file holds, by docs/file_formats.md and nothing else of the project."""
import json
import struct
import sys

data = open(sys.argv[1], "rb").read()
(magic, major, minor, mark, size, count, head, world, recipe,
 writer) = struct.unpack_from("<8sHHIQIIQQ16s", data, 0)
assert magic == b"\x89WRRMAP\n" and major == 1 and mark == 0x01020304 and size == len(data)
sections = {}
for i in range(count):
    name, kind, flags, offset, elements = struct.unpack_from("<16s4sIQQ", data, 64 + 64 * i)
    letter = dict(u1="B", i1="b", u2="H", i2="h", u4="I", i4="i", u8="Q", i8="q", f4="f", f8="d")[kind[1:3].decode()]
    numbers = struct.unpack_from(f"<{elements}{letter}", data, offset)
    sections[name.rstrip(b"\0").decode()] = {"optional": flags == 1, "numbers": numbers}
print(json.dumps({"writer": writer.rstrip(b"\0").decode(), "world": world, "recipe": recipe, "sections": sections}))
