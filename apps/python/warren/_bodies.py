# SPDX-License-Identifier: BSD-3-Clause
"""Bodies, as the words of the scene format: what `robot=` takes. One that can't be is an InputError at once."""
import os

from . import _core


def _numbers(values):
    return " ".join(f"{float(x)!r}" for x in values)


def _corners(outline):
    return " ".join(f"{float(x)!r} {float(y)!r}" for x, y in outline)


def disc(radius):
    """A disc that doesn't turn.

    Parameters
    ----------
    radius : float
        At least 0; 0 is a point.

    Returns
    -------
    str
        The body as scene files and `robot=` have it.

    Examples
    --------
    >>> import warren
    >>> warren.disc(0.2)
    'disc 0.2'
    """
    return _core.body(f"disc {float(radius)!r}")


def polygon(outline):
    """A rigid body that moves and turns.

    Parameters
    ----------
    outline : array_like, (n, 2)
        Corners around the reference point, which a state's x and y place; simple, in either direction.

    Examples
    --------
    >>> import warren
    >>> warren.polygon([(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)])
    'polygon -1.0 -0.5 1.0 -0.5 1.0 0.5 -1.0 0.5'
    """
    return _core.body(f"polygon {_corners(outline)}")


def car(turning_radius, *, outline=None,
        radius=None, steering=None):
    """A car: it moves where it faces, on curves no tighter than its turning circle.

    Parameters
    ----------
    turning_radius : float
        Of the reference point, above 0.
    outline : array_like, (n, 2), optional
        Corners around the reference point.
    radius : float, optional
        Of a disc instead of an outline; one of the two is given.
    steering : {'dubins', 'reeds-shepp', 'differential'}, optional
        Forwards only (the default), backwards too, or straight both ways with turns
        on the spot; then the turning radius says what a radian of turning counts.

    Examples
    --------
    >>> import warren
    >>> warren.car(2.0, radius=0.5, steering="reeds-shepp")
    'car radius 0.5 turning 2.0 steering reeds-shepp'
    """
    if (outline is None) == (radius is None):
        raise TypeError("car: give an outline or a radius")
    shape = f"radius {float(radius)!r}" if radius is not None else f"polygon {_corners(outline)}"
    return _core.body(f"car {shape} turning {float(turning_radius)!r}" + (f" steering {steering}" if steering else ""))


def _links(radius, tool, self_collision, limits=None):
    words = f"radius {float(radius)!r}"
    words += f" tool {float(tool)!r}" if tool else ""
    words += f" limits {limits}" if limits else ""
    return words + (" self-collision" if self_collision else "")


def puma560(radius, *, tool=0.0, limits=None, self_collision=False):
    """The Puma 560: six joints, lengths in metres.

    Parameters
    ----------
    radius : float
        Of its links, which are capsules.
    tool : float
        Length of the tool.
    limits : {'classic', 'symmetric'}, optional
        Of its joints (default: classic).
    self_collision : bool
        May links not touch each other?

    Examples
    --------
    >>> import warren
    >>> warren.puma560(0.05, tool=0.1)
    'puma560 radius 0.05 tool 0.1'
    """
    return _core.body("puma560 " + _links(radius, tool, self_collision, limits))


def arm(table, radius, *, tool=0.0,
        self_collision=False):
    """An arm of one to six revolute joints by its Denavit-Hartenberg table.

    Parameters
    ----------
    table : str or path
        The file of the table (docs/file_formats.md); no blanks in its name.
    radius : float
        Of its links, which are capsules.
    tool : float
        Length of the tool.
    self_collision : bool
        May links not touch each other?

    Examples
    --------
    >>> import warren
    >>> warren.arm("arm.dh", 0.05)
    'arm arm.dh radius 0.05'
    """
    return _core.body(f"arm {os.fspath(table)} " + _links(radius, tool, self_collision))


def urdf(file, *, srdf=None, group=None, base=None, tip=None, package_path=(), base_pose=None):
    """An arm that a URDF describes: 1 to 14 joints that move, links with spheres, boxes, cylinders, capsules, meshes.

    Parameters
    ----------
    file, srdf : str or path
        The robot, and what MoveIt says of it; no blanks in their names.
    group : str, optional
        Of the SRDF: which joints move.
    base, tip : str, optional
        Links, instead of a group: the joints between them move. Without either all joints do.
    package_path : str, path or list of them
        Folders where ``package://`` is looked for, beside the file's own.
    base_pose : (7,), optional
        Where the URDF's root stands in the world: x, y, z and a quaternion x, y, z, w (default: at 0 0 0).

    Examples
    --------
    >>> import warren
    >>> warren.urdf("panda.urdf", srdf="panda.srdf", group="panda_arm")
    'urdf panda.urdf srdf panda.srdf group panda_arm'
    """
    words = f"urdf {os.fspath(file)}"
    for name, value in (("srdf", srdf), ("group", group), ("base", base), ("tip", tip)):
        words += f" {name} {os.fspath(value)}" if value is not None else ""
    folders = [package_path] if isinstance(package_path, (str, os.PathLike)) else package_path
    words += "".join(f" package-path {os.fspath(folder)}" for folder in folders)
    return _core.body(words + (f" base-pose {_numbers(base_pose)}" if base_pose is not None else ""))
