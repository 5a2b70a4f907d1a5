# SPDX-License-Identifier: BSD-3-Clause
"""Roadmaps: asked, updated, in files, as arrays."""
import gc
import pickle
import re
import threading
import time

import numpy as np
import pytest
import warren
from conftest import WORLDS, unmeasured
from scipy.sparse.csgraph import shortest_path


@pytest.fixture(scope="module")
def maze():
    return warren.maze(31, 31, seed=5, loops=0.1)


def places(rng, n, side=31):
    return rng.integers(1, side + 1, (n, 2)).astype(float)


@pytest.mark.parametrize("options", [{}, {"planner": "lazy-prm", "sampler": "uniform", "samples": 3000, "seed": 4}])
def test_a_query_has_the_bytes_of_the_program(program, tmp_path, maze, options):
    words = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    file = tmp_path / "theirs.roadmap"
    program.run("build", maze.source, *words, "-o", file)
    roadmap = warren.build(maze, **options)
    roadmap.save(tmp_path / "ours.roadmap")
    assert (tmp_path / "ours.roadmap").read_bytes() == file.read_bytes()
    question = ("query", file, "--start", "3,4", "--goal", "27,29")
    opened = warren.open_roadmap(file)
    for asked in (roadmap, opened):
        assert unmeasured(asked.query((3, 4), (27, 29)).json()) == unmeasured(program.json(*question))
    explained = warren.open_roadmap(file).query((3, 4), (27, 29), explain=True)
    assert unmeasured(explained.json()) == unmeasured(program.json(*question, "--explain"))
    assert explained.explained.narrowest.clearance == explained.min_clearance


def test_lengths_are_those_of_queries_and_of_scipy(maze):
    roadmap = warren.build(maze)
    rng = np.random.default_rng(1)
    starts, goals = places(rng, 50), places(rng, 50)
    lengths = roadmap.lengths(starts, goals)
    assert lengths.tolist() == [roadmap.query(a, b).length for a, b in zip(starts, goals)]
    assert np.array_equal(roadmap.matrix(starts, goals).diagonal(), lengths)
    assert np.array_equal(roadmap.lengths(starts, goals[:1]), roadmap.matrix(starts, goals[:1])[:, 0])
    at = {tuple(state): i for i, state in enumerate(roadmap.states)}
    theirs = shortest_path(roadmap.to_scipy(), indices=[at[tuple(a)] for a in starts])
    assert np.allclose(theirs[range(50), [at[tuple(b)] for b in goals]], lengths)


def test_a_roadmap_keeps_its_prices(tmp_path):
    cells = np.zeros((40, 60), bool)
    cells[:30, 30] = True
    flat, ends = warren.grid(cells, cell=0.1), ((0.5, 0.5), (5.5, 0.5))
    words = {"robot": warren.disc(0.2), "planner": "prm", "samples": 600,
             "clearance_price": (3, 0.5), "area": (5, [(3.5, 0), (5, 0), (5, 2), (3.5, 2)])}
    answer = warren.solve(flat, *ends, **words)
    roadmap = warren.build(flat, **words)
    roadmap.save(tmp_path / "priced.roadmap")
    for asked in (roadmap, warren.open_roadmap(tmp_path / "priced.roadmap")):
        again = asked.query(*ends)
        assert again.cost == answer.cost > answer.length
        assert again.path.tolist() == answer.path.tolist()
        assert warren.verify(flat, again).verified


def test_the_index_of_a_large_maze_says_the_same():
    world = warren.maze(300, 300, seed=2, loops=0.02)
    indexed, searched = warren.build(world), warren.build(world, index="none")
    rng = np.random.default_rng(2)
    starts, goals = places(rng, 40, 300), places(rng, 40, 300)
    assert np.allclose(indexed.lengths(starts, goals), searched.lengths(starts, goals), rtol=1e-12)
    assert indexed.query((1, 1), (300, 300)).to_dict().get("index") == "route"
    matrix = indexed.to_scipy()
    assert matrix.shape == (90000, 90000) and np.shares_memory(matrix.data, indexed.csr()[2])


def test_threads_change_nothing(maze):
    roadmap = warren.build(maze, planner="prm", sampler="uniform", samples=4000)
    rng = np.random.default_rng(3)
    starts, goals = rng.uniform(1, 31, (300, 2)), rng.uniform(1, 31, (300, 2))
    one = roadmap.lengths(starts, goals, threads=1)
    assert np.array_equal(one, roadmap.lengths(starts, goals, threads=3))
    told = []
    askers = [threading.Thread(target=lambda: told.append(roadmap.lengths(starts, goals))) for _ in range(4)]
    for asker in askers:
        asker.start()
    for asker in askers:
        asker.join()
    assert len(told) == 4 and all(np.array_equal(one, other) for other in told)


def test_where_there_is_no_way_the_length_is_infinite():
    roadmap = warren.build("maze:5x5")
    assert roadmap.lengths([(1, 1), (9, 9)], [(5, 5)]).tolist() == [18.0, np.inf]
    assert roadmap.lengths(np.zeros((0, 2)), np.zeros((0, 2))).shape == (0,)
    assert roadmap.matrix(np.zeros((0, 2)), [(1, 1)]).shape == (0, 1)


def test_places_may_be_whole_numbers():
    roadmap = warren.build("maze:5x5")
    assert roadmap.lengths(np.array([[1, 1]]), np.array([[5, 5]], np.uint8)).tolist() == [18.0]


@pytest.mark.parametrize("starts, error, said", [
    (np.zeros((3, 2), np.float32), TypeError, r"starts: expected float64 \(n, 2\) in C order \(found: float32 \(3, 2\)\)"),
    (np.zeros((3, 3), np.int64), TypeError, r"found: float64 \(3, 3\)"),
    (np.ma.masked_less(np.zeros((3, 2)), 1), TypeError, "starts: a mask hides"),
    (np.zeros((3, 3)), TypeError, r"found: float64 \(3, 3\)"),
    (np.zeros((2, 3)).T, TypeError, "not in C order"),
    (np.zeros(2), TypeError, r"found: float64 \(2,\)"),
    ([("a", 1)], TypeError, "expected numbers"),
    (np.ones((4, 2)), ValueError, "as many of both, or one of either"),
    (np.full((3, 2), np.nan), ValueError, r"^starts\[\d\]: coordinates are numbers"),
    (3.0, TypeError, r"starts: expected numbers in rows, \(n, 2\) \(found: one\)"),
    (np.float64(3), TypeError, "starts: expected numbers in rows"),
])
def test_wrong_arrays_are_refused(starts, error, said):
    with pytest.raises(error, match=said):
        warren.build("maze:5x5").lengths(starts, np.ones((3, 2)))


def test_what_is_fixed_when_it_is_built_is_no_option_of_a_query():
    with pytest.raises(warren.UsageError, match="^planner: the roadmap was built with its own"):
        warren.build("maze:5x5").query(planner="prm")
    with pytest.raises(TypeError, match="unexpected keyword argument 'serach'; did you mean search"):
        warren.build("maze:5x5").lengths([(1, 1)], [(2, 2)], serach="astar")
    for ask in (warren.build("maze:5x5").lengths, warren.build("maze:5x5").matrix):
        with pytest.raises(TypeError, match=rf"^{ask.__name__}\(\) got an unexpected keyword argument 'start'"):
            ask([(1, 1)], [(2, 2)], start=(1, 1))
        with pytest.raises(warren.UsageError, match="^cusp_cost: "):
            ask([(1, 1)], [(2, 2)], cusp_cost=2.0)
    with pytest.raises(warren.InputError, match=r"^goals\[1\]: coordinates are numbers"):
        warren.build("maze:5x5").lengths([(1, 1)], [(2, 2), (1, np.inf)])


def test_an_update_is_what_building_anew_gives(maze, tmp_path):
    old = warren.build(maze, index="none")
    changed = maze.without_walls([200, 300, 301])
    new = old.update(changed)
    new.save(tmp_path / "new.roadmap")
    warren.build(changed, index="none").save(tmp_path / "built.roadmap")
    assert (tmp_path / "new.roadmap").read_bytes() == (tmp_path / "built.roadmap").read_bytes()
    assert new.report["mode"] == "changed" and 0 < new.report["edges_checked"] < 60 and old.report is None
    assert new.edges.free == old.edges.free + 3 and new.world.hash == changed.hash != maze.hash


def test_files_pickles_and_views_outlive_their_makers(maze, tmp_path):
    roadmap = warren.build(maze, planner="prm", sampler="halton", samples=2000, seed=7)
    states, (indptr, indices, lengths) = roadmap.states, roadmap.csr()
    again = pickle.loads(pickle.dumps(roadmap))
    assert np.array_equal(again.states, states) and again.edges == roadmap.edges
    assert (again.planner, again.seed, again.robot, len(again)) == ("prm", 7, "point", len(states))
    copied = states.copy()
    del roadmap
    gc.collect()
    assert np.array_equal(states, copied) and not states.flags.writeable
    ends = np.hypot(*(states[indices] - states[np.repeat(np.arange(len(states)), np.diff(indptr))]).T)
    assert np.allclose(ends, lengths)
    with pytest.raises(warren.ReadError):
        warren.open_roadmap(tmp_path / "none.roadmap")
    (tmp_path / "bad.roadmap").write_bytes(b"nonsense")
    with pytest.raises(warren.InputError):
        warren.open_roadmap(tmp_path / "bad.roadmap")


def test_lazy_edges_are_learnt(maze):
    roadmap = warren.build(maze, planner="lazy-prm", sampler="uniform", samples=3000, seed=4)
    assert roadmap.edges.free == 0 and len(roadmap.csr()[1]) == 0 and set(roadmap.edge_states) == {0}
    assert roadmap.query((1, 1), (31, 31)).status == "solved"
    roadmap.learn()
    assert roadmap.edges.free > 0 and len(roadmap.csr()[1]) == 2 * roadmap.edges.free
    assert len(roadmap.csr(unchecked=True)[1]) == 2 * sum(roadmap.edges) == len(roadmap.edge_states)
    assert len(set(roadmap.components)) < len(roadmap)


@pytest.mark.parametrize("long, short, said", [
    (lambda roadmap: roadmap.learn(), lambda roadmap: roadmap.edge_states, "^roadmap: another thread calls its learn"),
    (lambda roadmap: roadmap.query((1, 1), (61, 61)), lambda roadmap: roadmap.learn(), "^learn: another thread asks"),
], ids=["learn", "ask"])
def test_nobody_asks_while_a_roadmap_learns(long, short, said):
    def meet(samples):
        """Who is refused, or None where the long call was over before the short one came."""
        roadmap = warren.build(warren.maze(61, 61, loops=0.2), planner="lazy-prm", sampler="uniform", samples=samples)
        thread = threading.Thread(target=long, args=(roadmap,))  # the first call of all prepares what it asks
        thread.start()
        refused = None
        while thread.is_alive() and refused is None:
            try:
                short(roadmap)
                time.sleep(0.0005)
            except ValueError as error:
                refused = str(error)
        thread.join()
        assert roadmap.query((1, 1), (61, 61))
        return refused

    refusals = (meet(samples) for samples in (40_000, 80_000, 160_000, 320_000, 640_000))  # longer on faster machines
    assert re.match(said, next(filter(None, refusals)))


def test_a_roadmap_is_exported_as_by_the_program(program, tmp_path):
    roadmap = warren.build(warren.read_world(WORLDS / "walls.scene"), samples=200)
    roadmap.save(tmp_path / "a.roadmap")
    for ending in ("graphml", "npz", "dot"):
        program.run("export", tmp_path / "a.roadmap", "-o", tmp_path / f"theirs.{ending}")
        told = roadmap.export(tmp_path / f"ours.{ending}")
        assert (tmp_path / f"ours.{ending}").read_bytes() == (tmp_path / f"theirs.{ending}").read_bytes()
    assert told["vertices"] == len(roadmap) and told["edges"] == roadmap.edges.free
    with pytest.raises(warren.UsageError):
        roadmap.export(tmp_path / "a.doc")
