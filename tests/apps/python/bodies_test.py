# SPDX-License-Identifier: BSD-3-Clause
"""Bodies in words: each keyword says something, and a world takes it."""
import inspect

import pytest
import warren

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
PLAIN = {
    warren.disc: {"radius": 0.1},
    warren.polygon: {"outline": SQUARE},
    warren.car: {"turning_radius": 1.0, "radius": 0.1},
    warren.puma560: {"radius": 0.05},
    warren.arm: {"table": "arm.dh", "radius": 0.05},
}
OTHER = {"radius": 0.2, "outline": [(0, 0), (2, 0), (0, 1)], "turning_radius": 3.0, "steering": "dubins", "tool": 0.3,
         "limits": "symmetric", "self_collision": True, "table": "other.dh"}


def test_an_arm_of_files_stands_anywhere():
    said = warren.urdf("a.urdf", package_path="p", base_pose=(1, 0, 0.5, 0, 0, 0, 1))
    assert said == "urdf a.urdf package-path p base-pose 1.0 0.0 0.5 0.0 0.0 0.0 1.0"
    with pytest.raises(warren.InputError, match="QX QY QZ QW"):
        warren.urdf("a.urdf", base_pose=(1, 0, 0))


@pytest.mark.parametrize("make, keyword", [(make, keyword) for make in PLAIN for keyword in inspect.signature(make).parameters])
def test_every_keyword_of_a_body_is_in_its_words(make, keyword):
    plain = PLAIN[make]
    other = {**plain, keyword: OTHER[keyword]}
    if make is warren.car and keyword == "outline":
        other.pop("radius")
    assert make(**other) != make(**plain)
