# SPDX-License-Identifier: BSD-3-Clause
"""Planners and searches side by side."""
import numpy as np

from . import _core
from ._options import documented
from ._making_worlds import as_world
from ._pictures import Pictured


_TEXTS = {"source", "planner", "search", "queue", "library", "options", "status"}
_COUNTS = {"vertices", "edges", "runs", "solved", "seed", "samples", "neighbour_queries", "edges_checked", "rounds",
           "refused", "milestones", "components"}


def _column(name, words, counts):
    """Of one type whatever the numbers: texts, truths (None where no seed is drawn), counts (floats where some are not
    known, which are nan), else floats; of options, whose values are anything, as they are."""
    if name in _TEXTS:
        return np.array(words, dtype=object)
    if name == "deterministic":
        truths = [{"true": True, "false": False}.get(word) for word in words]
        return np.array(truths, dtype=object if None in truths else bool)
    if name in counts or name.startswith("option_"):
        try:
            return np.array([int(word) for word in words])
        except (ValueError, OverflowError):
            pass
    try:
        return np.array([float(word) if word else np.nan for word in words])
    except ValueError:
        return np.array(words, dtype=object)


def _table(text, counts):
    import csv
    import io
    rows = list(csv.reader(io.StringIO(text)))
    return {name: _column(name, [row[i] for row in rows[1:]], counts) for i, name in enumerate(rows[0])}


class Comparison(dict):
    """What :func:`compare` measured: a column a name, a row a run, as pandas.DataFrame takes it.

    Attributes
    ----------
    table : dict of ndarray
        The same with a row a planner or search: how many of its runs were solved, medians and quartiles.
    """

    __module__ = "warren"

    def __init__(self, core):
        super().__init__(_table(core.runs_csv(), _COUNTS | {"hops", "expanded"}))
        self._core = core
        self.table = _table(core.table_csv(), _COUNTS)

    def __repr__(self):
        contenders, runs = (len(next(iter(table.values()), ())) for table in (self.table, self))
        return f"<Comparison of {contenders} contenders, {runs} runs>"

    def __str__(self):
        return self._core.summary()

    def json(self):
        """warren.compare/1, as `warren compare --json -` prints it."""
        return self._core.json()

    def curves_csv(self):
        """A line for each path that was the best so far in its run, as `warren compare --curves FILE.csv` writes it."""
        return self._core.curves_csv()

    def svg(self):
        """Plots of success and times, as `warren compare --picture` draws them."""
        return self._core.svg()

    def _repr_svg_(self):
        return self.svg()

    _repr_html_ = Pictured._repr_html_


@documented(_core.compare_keywords())
def compare(world=None, **options):
    """Runs planners, or searches on one graph, side by side; every path that counts as solved was verified.

    With `planners` these plan in the world, over many seeds: an option that is a list makes a contender of each of its
    values, of each planner that takes it. Without, `searches` and `queues` search the graph that a planner makes of the
    world, or with `sizes` random graphs of so many vertices.

    Parameters
    ----------
    world : World, str, path, ndarray, or geometry, optional
        As :func:`solve` takes it; only random graphs need none.
    start, goal : sequence of float, optional
        As :func:`solve` takes them.
    {options}

    Returns
    -------
    Comparison

    Examples
    --------
    >>> import warren
    >>> found = warren.compare("maze:9x9", planners=["prm", "lazy-prm"], sampler="uniform", samples=[200, 900], seeds=3)
    >>> found
    <Comparison of 4 contenders, 12 runs>
    >>> sorted(set(found["planner"])), found.table["solved"].shape
    (['lazy-prm', 'prm'], (4,))
    >>> searched = warren.compare("maze:41x41", searches=["dijkstra", "astar"], queues="heap", trials=5)
    >>> list(searched.table["search"]), set(searched["length"])
    (['dijkstra', 'astar'], {495.0})
    """
    there = None if world is None else as_world(world, options.get("robot"))._core
    return Comparison(_core.compare(there, options))
