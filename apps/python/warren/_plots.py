# SPDX-License-Identifier: BSD-3-Clause
"""Worlds, answers and roadmaps on axes of matplotlib, which is imported when it is first drawn on."""

import numpy as np

from . import _core
from ._answers import Answer
from ._making_worlds import as_world
from ._roadmaps import Roadmap

# The colours of the pictures that the program draws.
WALL, POLYGON, OUTLINE, BODY = "#1e293b", "#d9dde3", "#66717f", "#30b090"
EDGE, TREE, LINE, PATH, START, GOAL = "#9cc3ea", "#f0b429", "#96d3a8", "#c8102e", "#0072b2", "#6a0dad"


def _draw_cells(ax, world):
    from matplotlib.colors import ListedColormap
    from matplotlib.transforms import Affine2D
    cells, raster = world.cells, world.raster
    if cells is None or raster is None:
        return
    cell, x, y, yaw = raster
    height, width = cells.shape
    image = ax.imshow(cells, cmap=ListedColormap(["white", WALL]), vmin=0, vmax=1, origin="upper",
                      extent=(0, width * cell, 0, height * cell), interpolation="nearest")
    place = Affine2D().rotate(yaw).translate(x, y)
    image.set_transform(place + ax.transData)
    corners = place.transform([(0, 0), (width * cell, 0), (width * cell, height * cell), (0, height * cell)])
    ax.update_datalim(corners)
    ax.set_xlim(corners[:, 0].min(), corners[:, 0].max())
    ax.set_ylim(corners[:, 1].min(), corners[:, 1].max())


def _draw_world(ax, world):
    from matplotlib.collections import PolyCollection
    _draw_cells(ax, world)
    if world.polygons:
        ax.add_collection(PolyCollection(world.polygons, facecolor=POLYGON, edgecolor=OUTLINE, linewidth=0.5))
    _draw_segments(ax, world.walls.reshape(-1, 2, 2), WALL, width=1.0)
    if len(world.spheres) or len(world.boxes) or world.solids:
        raise ValueError("plot: draws the plane; answer.svg() shows arms from three sides")
    if world.bounds is not None:
        x0, y0, x1, y1 = world.bounds
        _draw_segments(ax, [[(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]], WALL, width=1.0)


def _draw_segments(ax, segments, color, label="", width=0.5):
    from matplotlib.collections import LineCollection
    if len(segments):
        ax.add_collection(LineCollection(segments, colors=color, linewidth=width, label=label))


def _roadmap_segments(roadmap):
    indptr, indices, _ = roadmap.csr()
    rows = np.repeat(np.arange(len(indptr) - 1), np.diff(indptr))
    keep = slice(None) if roadmap.directed else rows < indices
    places = roadmap.states[:, :2]
    return np.stack((places[rows[keep]], places[indices[keep]]), axis=1)


def _outlines(answer, states):
    """The body's outline at each state, (k, corners, 2); None of a point."""
    outline, radius = _core.body_of(answer._core)
    if len(outline) == 0:
        if not radius > 0.0:
            return None
        turn = np.linspace(0.0, 2.0 * np.pi, 33)
        outline = radius * np.column_stack((np.cos(turn), np.sin(turn)))
    heading = states[:, 2] if states.shape[1] == 3 else np.zeros(len(states))
    c, s = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x, y = outline[:, 0], outline[:, 1]
    return np.stack((c * x - s * y, s * x + c * y), axis=2) + states[:, None, :2]


def _draw_answer(ax, answer, bodies):
    from matplotlib.collections import PolyCollection
    if answer.path.shape[1] == 6:
        raise ValueError("plot: draws the plane; answer.svg() shows arms from three sides")
    if len(answer.path):
        turns = answer.path.shape[1] == 3 and len(answer.path) > 1
        curve = answer.sample(answer.length / 1000.0)[0] if turns else answer.path  # a car's arcs shall look round
        if bodies > 0:
            states, _ = answer.sample(max(answer.length / bodies, 1e-300))
            outlines = _outlines(answer, states)
            if outlines is not None:
                ax.add_collection(PolyCollection(outlines, facecolor="none", edgecolor=BODY, linewidth=0.8, alpha=0.8, zorder=2))
        ax.plot(curve[:, 0], curve[:, 1], color=PATH, linewidth=2.0, label="path")
    for name, state, color, mark in (("start", answer.start, START, "o"), ("goal", answer.goal, GOAL, "*")):
        if len(state) in (2, 3):
            ax.plot(state[0], state[1], mark, color=color, label=name)


def plot(what, *, answer=None, ax=None, roadmap=True, tree=False,
         lines=False, bodies=0):
    """Draws a world, an answer in its world, or a roadmap in its world, one artist a layer.

    Parameters
    ----------
    what : World, Answer, Roadmap, or what :func:`solve` takes as a world
        What is drawn.
    answer : Answer, optional
        Drawn upon it.
    ax : matplotlib.axes.Axes, optional
        Where (default: axes of a new figure).
    roadmap, tree, lines : bool
        Shall roadmap, search tree and further lines of the planner be drawn, of answers asked with `keep=True`?
    bodies : int
        How many times the body is shown along the path.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        For arms, which aren't plane: `answer.svg()` shows them.

    Examples
    --------
    >>> import warren
    >>> ax = warren.plot(warren.solve("maze:15x15", keep=True), tree=True)
    >>> [artist.get_label() for artist in ax.lines]
    ['path', 'start', 'goal']
    """
    if ax is None:
        from matplotlib import pyplot
        _, ax = pyplot.subplots()
    if isinstance(what, Answer):
        what, answer = what.world, what if answer is None else answer
    if isinstance(what, Roadmap):
        _draw_world(ax, what.world)
        _draw_segments(ax, _roadmap_segments(what), EDGE, "roadmap")
    else:
        _draw_world(ax, as_world(what))
    if answer is not None:
        if lines:
            for name, chains in answer.lines().items():
                from matplotlib.collections import LineCollection
                ax.add_collection(LineCollection(chains, colors=LINE, linewidth=0.6, label=name))
        if roadmap:
            _draw_segments(ax, answer.edges(), EDGE, "roadmap")
        if tree:
            _draw_segments(ax, answer.edges(tree=True), TREE, "tree")
        _draw_answer(ax, answer, bodies)
    ax.set_xlabel("x"), ax.set_ylabel("y")
    ax.set_aspect("equal")
    ax.autoscale_view()
    return ax


def animate(answer, *, ax=None, frames=200, interval=40.0, speed=None,
            acceleration=None):
    """The body on its way, as an animation of matplotlib.

    Parameters
    ----------
    answer : Answer
        With a path in the plane.
    ax : matplotlib.axes.Axes, optional
        Where (default: axes of a new figure).
    frames : int
        How many pictures, without a speed.
    interval : float
        Milliseconds from picture to picture.
    speed, acceleration : float, optional
        The body moves as fast as they allow, in units of length and seconds (default: evenly, in `frames` pictures).

    Returns
    -------
    matplotlib.animation.FuncAnimation

    Raises
    ------
    ValueError
        Where there is no path, and for arms.
    """
    from matplotlib.animation import FuncAnimation
    if not answer:
        raise ValueError(f"animate: the answer has no path ({answer.status})")
    axes = plot(answer, ax=ax, roadmap=False)
    if speed is not None:
        states = answer.sample(f"{interval!r}ms", speed=speed, acceleration=acceleration)[0]
    else:
        places, along = answer.sample(max(answer.length / frames, 1e-300))
        at = np.linspace(0.0, along[-1], frames)
        states = places[np.searchsorted(along, at).clip(0, len(along) - 1)]
    outlines = _outlines(answer, states)
    if outlines is None:
        body, = axes.plot([], [], "o", color=BODY, markersize=8)
    else:
        body, = axes.fill(outlines[0, :, 0], outlines[0, :, 1], facecolor=BODY, alpha=0.6)

    def show(i):
        if outlines is None:
            body.set_data(states[i:i + 1, 0], states[i:i + 1, 1])
        else:
            body.set_xy(outlines[i])
        return (body,)

    return FuncAnimation(axes.figure, show, frames=len(states), interval=interval, blit=True)
