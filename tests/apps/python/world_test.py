# SPDX-License-Identifier: BSD-3-Clause
"""Worlds of arrays, geometries and files; what they show; how they are drawn and compared."""
import csv
import gc
import json
import os
import pickle
import warnings

import geopandas
import matplotlib
import numpy as np
import pandas
import pytest
import shapely.geometry
import warren
from conftest import WORLDS

matplotlib.use("Agg")


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_walls_are_read_from_arrays_and_shown_as_views(kind):
    walls = np.array([[3, 0, 3, 5], [0, 7, 4, 7]], kind)
    world = warren.scene(walls=walls, bounds=(0, 0, 9, 9))
    shown = world.walls
    walls[:] = 0  # what was given is not held
    del world
    gc.collect()
    assert shown.dtype == kind and shown.tolist() == [[3, 0, 3, 5], [0, 7, 4, 7]] and not shown.flags.writeable


def test_whole_numbers_are_numbers():
    walls = [(0, 0, 1, 1), (2, 0, 2, 5)]
    world = warren.scene(walls=walls, bounds=(0, 0, 9, 9))
    for given in (np.array(walls), np.array(walls, np.int8), np.asfortranarray(walls), np.array(walls, np.uint64)):
        assert warren.scene(walls=given, bounds=np.array([0, 0, 9, 9])).hash == world.hash
    assert warren.scene(polygons=[np.array([[0, 0], [2, 0], [1, 2]])]).hash == warren.scene(polygons=[[(0, 0), (2, 0), (1, 2)]]).hash


def test_names_of_files_may_be_any_bytes(tmp_path):
    name = os.fsdecode(bytes(tmp_path / "a") + b"\xff.npy")
    warren.maze(3, 3).save(name)
    assert warren.read_world(name).hash == warren.maze(3, 3).hash
    with pytest.raises(ValueError, match="surrogates"):
        warren.read_world("\ud800")


def test_sizes_of_a_maze_are_whole_numbers():
    assert warren.maze(np.int64(5), 5).hash == warren.maze(5, 5).hash
    for wrong in ((5.9, 5), ("5", "5"), (5, 5.0)):
        with pytest.raises(TypeError):
            warren.maze(*wrong)
    with pytest.raises(TypeError):
        warren.maze(5, 5, seed=1.5)


@pytest.mark.parametrize("body", [
    lambda: warren.disc(-1), lambda: warren.disc(float("nan")), lambda: warren.polygon([(0, 0), (1, 0)]),
    lambda: warren.car(0, radius=1), lambda: warren.car(1, radius=-1), lambda: warren.car(1, radius=1, steering="left"),
    lambda: warren.puma560(-0.1), lambda: warren.puma560(0.1, limits="none"), lambda: warren.arm("arm.dh", -1)])
def test_a_body_that_can_not_be_is_refused_at_once(body):
    with pytest.raises(warren.InputError, match="^robot: "):
        body()


def test_columns_of_a_comparison_are_of_one_type_whatever_they_hold():
    found = warren.compare("maze:5x5", planners=["prm", "lazy-prm"], sampler="uniform", samples=200, seeds=2)
    lattice = warren.compare("maze:5x5", planners=["prm"], sampler="lattice", seeds=2)
    for table in (found.table, lattice.table):
        assert table["deterministic"].dtype == bool
        assert table["length_median"].dtype == float and table["hops"].dtype == float
        assert table["runs"].dtype == int and table["planner"].dtype == object and table["search"].dtype == object
    assert lattice.table["deterministic"].all() and not found.table["deterministic"].all()
    assert lattice["length"].dtype == float and lattice["seed"].dtype == int


def test_the_same_world_has_the_same_hash_whatever_it_is_made_of(tmp_path):
    maze = warren.maze(9, 9)
    again = warren.scene(walls=maze.walls, maze=(9, 9), start=maze.start, goal=maze.goal)
    assert again.hash == maze.hash and warren.solve(again).length == warren.solve(maze).length
    maze.save(tmp_path / "maze.npy")
    assert np.array_equal(np.load(tmp_path / "maze.npy"), maze.walls)
    assert warren.read_world(tmp_path / "maze.npy").hash == maze.hash


@pytest.mark.parametrize("parts, error, said", [
    ({"walls": np.zeros((2, 4), bool)}, TypeError, r"walls: expected float32 or float64 \(n, 4\).*bool \(2, 4\)"),
    ({"walls": np.ma.array(np.zeros((2, 4)), mask=[[0, 0, 0, 1], [0, 0, 0, 0]])}, TypeError, "walls: a mask hides"),
    ({"walls": [np.ma.array([0., 0, 0, 1], mask=[0, 0, 0, 1])]}, TypeError, "walls: a mask hides"),
    ({"polygons": [np.ma.masked_less(np.zeros((3, 2)), 1)]}, TypeError, r"polygons\[0\]: a mask hides"),
    ({"source": "\ud800"}, ValueError, "source: a lone surrogate"),
    ({"robot": "\ud800"}, ValueError, "robot: a lone surrogate"),
    ({"walls": np.zeros((2, 3))}, TypeError, r"walls: expected .*\(found: float64 \(2, 3\)\)"),
    ({"walls": np.zeros((4, 2)).T}, TypeError, "walls: expected"),
    ({"walls": [[0, 0, 1, np.inf]]}, ValueError, r"walls\[0\]: numbers must be finite"),
    ({"polygons": [[(0, 0), (1, 1), (1, 0), (0, 1)]]}, ValueError, "polygon 0"),
    ({"bounds": (0, 0, 0, 1)}, ValueError, "bounds: "),
    ({"spheres": [(0, 0, 0, -1)]}, ValueError, r"spheres\[0\]: "),
    ({"boxes": [(1, 0, 0, 0, 1, 1)]}, ValueError, r"boxes\[0\]: "),
    ({"solids": ["obox 0 0 0 0 0 0 0 1 1 1"]}, ValueError, r"solids\[0\]: `obox`: the quaternion"),
    ({"solids": ["ball 0 0 0 1"]}, ValueError, r"solids\[0\]: expected sphere, box, obox"),
    ({"solids": 5}, TypeError, "solids: expected a sequence of lines"),
    ({"walls": [(0.2, 0, 0.2, 1)], "maze": (3, 3)}, ValueError, r"walls\[0\]: is not on the unit grid"),
    ({"maze": (0, 3)}, ValueError, "maze: "),
    ({"maze": (2**16, 2**16)}, ValueError, "maze: "),
    ({"maze": 5}, TypeError, r"maze: expected rows and columns \(found: 5\)"),
    ({"maze": (5.5, 1)}, TypeError, "maze: expected rows and columns"),
    ({"walls": 5}, TypeError, r"walls: expected numbers in rows, \(n, 4\) \(found: one\)"),
    ({"walls": np.array(5.0)}, TypeError, r"walls: expected .*\(found: float64 \(\)\)"),
    ({"bounds": 5}, TypeError, "bounds: expected "),
    ({"polygons": 5}, TypeError, "polygons: expected "),
    ({"source": 5}, TypeError, "source: expected "),
    ({"robot": "disc -1"}, ValueError, "robot: "),
])
def test_parts_that_make_no_world_are_refused(parts, error, said):
    with pytest.raises(error, match=said):
        warren.scene(**parts)


def test_examples_are_those_of_the_program():
    world = warren.example("flat")
    assert world.source == "flat.yaml" and world.hash == warren.read_world(WORLDS / "flat.yaml").hash
    assert warren.solve(warren.example("parking-lot")).verified
    with pytest.raises(warren.UsageError, match="flat.*parking-lot"):
        warren.example("nosuch")


def test_cells_are_read_where_they_lie():
    cells = np.zeros((6, 8), np.uint8)
    cells[0, 3] = 7
    for given in (cells, cells != 0, np.asfortranarray(cells), cells[::-1][::-1]):
        world = warren.grid(given, 0.5, (10, 20))
        assert np.array_equal(world.cells, cells != 0) and world.raster == (0.5, 10.0, 20.0, 0.0)
        assert world.box == (10.0, 20.0, 14.0, 23.0)
    # The top row is the highest: the cell at row 0 is blocked at y 22.5 .. 23.
    assert warren.solve(world, (11.75, 22.75), (10.1, 20.1), planner="grid").status == "start_blocked"
    for given in (cells.astype(int), -cells.astype(np.int8), cells.astype(np.uint32) << 8, cells.tolist(),
                  tuple(map(tuple, (cells != 0).tolist())), np.ma.array(cells), cells.astype(float),
                  cells.astype(np.float32).tolist()):
        assert warren.grid(given, 0.5, (10, 20)).hash == world.hash
    for wrong in (cells[0], []):
        with pytest.raises(TypeError, match=r"cells: expected bool or uint8 \(rows, columns\)"):
            warren.grid(wrong)
    for wrong, said in ((5, "an array or lists"), ([[0, 1], [0]], "rows of one length"),
                        (cells * 0.1, r"bool or whole numbers .found: 0.7.* at \(0, 3\).; .* cells > 0.5"),
                        ([[0.0, float("nan")]], r"bool or whole numbers .found: nan at \(0, 1\)"),
                        (np.ma.masked_greater(cells, 0), "a mask hides"), ([np.ma.masked_less([0, 1], 1)], "an array or lists")):
        with pytest.raises(TypeError, match=f"cells: (expected )?{said}"):
            warren.grid(wrong)
    with pytest.raises(ValueError, match="^cell: "):
        warren.grid(cells, 0)


def test_a_map_of_cells_is_solved_as_its_file_is():
    flat = warren.read_world(WORLDS / "flat.yaml")
    same = warren.grid(flat.cells, flat.raster[0], flat.raster[1:3])
    ends = {"start": (0.5, 0.5), "goal": (4.3, 0.5), "robot": warren.disc(0.2)}
    assert same.hash == flat.hash
    assert np.array_equal(warren.solve(same, **ends).path, warren.solve(flat, **ends).path)


def test_geometries_of_shapely_and_geopandas_are_worlds():
    yard = shapely.geometry.Polygon([(2, 0), (6, 0), (6, 6), (2, 6)], [[(3, 1), (5, 1), (5, 5), (3, 5)]])
    fence = shapely.geometry.LineString([(0, 7), (6, 7)])
    frame = geopandas.GeoDataFrame({"name": ["yard", "fence"], "geometry": [yard, fence]})
    bounds = (-1, -1, 9, 9)
    worlds = [warren.from_geo(given, bounds=bounds) for given in
              (frame, [yard, fence], shapely.geometry.GeometryCollection([yard, fence]), frame.__geo_interface__)]
    assert len({world.hash for world in worlds}) == 1 and worlds[0].bounds == bounds
    assert warren.solve(worlds[0], (0, 3), (8, 3)).optimal
    assert warren.solve(worlds[0], (4, 3), (8, 3)).status in ("infeasible", "not_connected")
    assert warren.solve(shapely.geometry.box(0, 0, 4, 3), (0, 0), (4, 3)).length == 7.0
    assert warren.solve([yard, fence], (0, 0), (1, 6)).verified
    with pytest.raises(ValueError):
        warren.from_geo({"type": "Polygon", "coordinates": [[(0, 0), (1, 1), (1, 0), (0, 1), (0, 0)]]})


@pytest.mark.parametrize("geometry, error, said", [
    ("abc", TypeError, r"geometry: expected what has a __geo_interface__ \(found: str\)"),
    (3, TypeError, "found: int"),
    ([None], TypeError, "found: NoneType"),
    ({"type": "FeatureCollection"}, ValueError, "geometry: a FeatureCollection needs a list"),
    ({"type": "Polygon"}, ValueError, 'a Polygon needs "coordinates"'),
])
def test_what_is_no_geometry_is_refused(geometry, error, said):
    with pytest.raises(error, match=said):
        warren.from_geo(geometry)


@pytest.mark.parametrize("rows, error, said", [
    ([1.7], TypeError, r"rows: expected whole numbers \(found: float\)"),
    ([True], TypeError, "found: bool"),
    (np.array([True, False]), TypeError, "found: bool_"),
    ([-1], warren.InputError, r"rows: there is no such wall \(found: -1\)"),
    ([20], warren.InputError, "rows: there is no such wall"),
])
def test_walls_that_there_are_not_cannot_go(rows, error, said):
    with pytest.raises(error, match=said):
        warren.maze(5, 5).without_walls(rows)
    assert len(warren.maze(5, 5).without_walls(np.array([3, 3], np.uint8)).walls) == 19


def test_a_map_has_no_walls_to_change():
    world = warren.grid(np.zeros((4, 4), bool))
    for change in (lambda: world.with_walls([(2, -1, 2, 5)]), lambda: world.without_walls([])):
        with pytest.raises(warren.InputError, match="^walls: the world is a map"):
            change()


def test_a_file_holds_the_obstacles_and_says_what_else_it_leaves_out(tmp_path):
    cells = np.zeros((4, 4), bool)
    cells[1:, 1] = True
    world = warren.grid(cells, 0.5, start=(0.2, 0.2), goal=(1.8, 0.2), robot=warren.disc(0.1))
    for ending in ("map", "yaml", "pgm", "png"):
        place = "" if ending == "yaml" else ", resolution"
        with pytest.warns(UserWarning, match=f"{ending}: its format has no start, goal, robot{place}: left out"):
            world.save(tmp_path / f"a.{ending}")
        assert np.array_equal(warren.read_world(tmp_path / f"a.{ending}").cells, cells)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        world.save(tmp_path / "a.scene")  # the cells' borders
        warren.maze(5, 5).save(tmp_path / "maze.npy")
    again = warren.read_world(tmp_path / "a.scene")
    assert (again.start, again.goal, again.robot) == (world.start, world.goal, world.robot)
    assert warren.solve(again).length > 2 and warren.solve(world).length > 2
    walls = warren.scene(walls=[(0, 0, 2, 2)], robot=warren.disc(0.1))
    for ending, said in (("geojson", "no robot"), ("wkt", "no robot"), ("npy", "no robot")):
        with pytest.warns(UserWarning, match=said):
            walls.save(tmp_path / f"b.{ending}")
    with pytest.raises(warren.UsageError, match="^cell: is missing"):
        walls.save(tmp_path / "b.yaml")
    with pytest.warns(UserWarning, match="no robot"):
        walls.save(tmp_path / "b.yaml", cell=0.5)
    assert warren.read_world(tmp_path / "b.yaml").cells.shape == (4, 4)
    for world, ending in ((world, "yaml"), (walls, "scene")):
        with pytest.raises(warren.UsageError, match="^cell: "):
            world.save(tmp_path / f"c.{ending}", cell=0.5)


def test_functions_take_worlds_names_cells_and_geometry(tmp_path):
    file = tmp_path / "a.scene"
    file.write_text("wall 3 0 3 5\nbounds 0 0 9 9\nstart 1 1\ngoal 8 1\n")
    assert warren.solve(file).length == warren.solve(str(file)).length == warren.solve(warren.read_world(file)).length
    assert warren.solve(np.zeros((4, 4), bool), (0.5, 0.5), (3.5, 3.5)).verified
    with pytest.raises(TypeError, match="world: expected a World, a name"):
        warren.solve(3)


def test_an_arm_is_planned_among_solids_of_arrays():
    cell = warren.scene(spheres=np.array([[0.9, 0.4, 0.2, 0.15]]), boxes=[(0.6, -0.9, -0.6, 0.8, -0.7, 0.4)],
                        robot=warren.puma560(0.05))
    answer = warren.solve(cell, np.zeros(6), (0.6, -0.5, 0.3, 0, 0.2, 0), seed=3)
    assert answer.status == "solved" and answer.path.shape[1] == 6
    assert warren.verify(cell, answer)
    assert answer.svg().startswith("<svg")
    with pytest.raises(ValueError, match="plot: draws the plane"):
        warren.plot(answer)


def test_solids_are_lines_and_are_kept_by_pickles():
    lines = ["cylinder 0.1 0.7 0.3 0 0 1 0.2", "obox 1 0 0 0 0 0.6 0.8 0.1 0.2 0.3", "hull 0 0 0 1 0 0 0 1 0 0 0 1"]
    world = warren.scene(solids=lines)
    assert world.solids == lines
    back = pickle.loads(pickle.dumps(world))
    assert back.solids == lines and back.hash == world.hash != warren.scene(solids=lines[:2]).hash
    assert json.loads(json.dumps(world.facts()))["solids"] == 3


def test_a_car_drives_by_its_words():
    car = warren.car(1.0, outline=[(-0.5, -0.3), (0.5, -0.3), (0.5, 0.3), (-0.5, 0.3)], steering="reeds-shepp")
    world = warren.scene(walls=[(3, 0, 3, 5)], bounds=(0, 0, 9, 9), robot=car)
    answer = warren.solve(world, (1, 1, 0), (8, 1, np.pi / 2), seed=2)
    assert answer.status == "solved" and answer.robot == world.robot and answer.path.shape[1] == 3
    assert warren.solve("maze:9x9", robot=warren.polygon([(-.1, -.1), (.1, -.1), (0, .1)]), start=(1, 1, 0),
                        goal=(9, 9)).status == "solved"


def test_pictures_are_those_of_the_library():
    answer = warren.solve("maze:9x9", keep=True)
    svg = answer.svg()
    assert svg.count("<svg") == 1 and 'id="path"' in svg and 'id="edges"' in svg
    assert 'id="edges"' not in warren.solve("maze:9x9").svg()
    assert "animateMotion" in answer.svg(moving=True) and "animateMotion" not in svg
    assert answer.html().lower().startswith("<!doctype html>") and answer.png().startswith(b"\x89PNG")
    assert answer._repr_svg_() == svg and "solved and verified" in answer._repr_html_()
    assert "<title>mine" in answer.svg(title="mine", show=["world", "path"]) and 'id="edges"' not in answer.svg(show="world,path")
    assert len(answer.png(size="200x100")) < len(answer.png(size="800x800")) and 'width="300' in answer.svg(size="300x200")
    with pytest.raises(warren.UsageError, match="^show: "):
        answer.svg(show="wold")
    with pytest.raises(TypeError, match="did you mean title"):
        answer.world.svg(titel="a")
    world = warren.read_world(WORLDS / "flat.yaml")
    assert world._repr_html_().startswith("<svg") and world._repr_html_() in world.svg()
    assert 'id="walls"' in world.svg() and world._repr_svg_() == world.svg() and world.png().startswith(b"\x89PNG")
    roadmap = warren.build("maze:9x9")
    assert 'id="edges"' in roadmap.svg() and roadmap.png(size="200x100").startswith(b"\x89PNG")
    assert roadmap.html().lower().startswith("<!doctype html>")


def test_pictures_go_into_files_by_their_endings(tmp_path):
    answer = warren.solve("maze:9x9")
    for thing in (answer, answer.world, warren.build("maze:9x9")):
        thing.save_picture(tmp_path / "a.svg", title="mine")
        assert (tmp_path / "a.svg").read_text() == thing.svg(title="mine")
        thing.save_picture(tmp_path / "a.PNG")
        assert (tmp_path / "a.PNG").read_bytes() == thing.png()
        thing.save_picture(tmp_path / "a.pdf", size="100x100mm")
        assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
        with pytest.raises(warren.UsageError, match="^file: expected an ending among .svg .png .pdf .html"):
            thing.save_picture(tmp_path / "a.jpg")
        with pytest.raises(warren.UsageError, match="^size: a page fills its window"):
            thing.html(size="100x100")
    with pytest.raises(warren.WriteError):
        answer.save_picture(tmp_path / "none" / "a.svg")
    for wrong in (lambda: answer.world.svg(moving=True), lambda: answer.png(moving=True)):
        with pytest.raises(TypeError, match="unexpected keyword argument 'moving'"):
            wrong()


def test_worlds_answers_and_roadmaps_are_plotted(tmp_path):
    from matplotlib import pyplot
    answer = warren.solve("maze:9x9", keep=True)
    _, given = pyplot.subplots()
    ax = warren.plot(answer, ax=given, tree=True)
    assert ax is given and [line.get_label() for line in ax.lines] == ["path", "start", "goal"]
    assert np.array_equal(ax.lines[0].get_xydata(), answer.path)
    picture = answer.svg()  # one colour a thing everywhere
    assert [line.get_color() in picture for line in ax.lines] == [True] * 3
    assert [line.get_marker() for line in ax.lines[1:]] == ["o", "*"]
    layers = {c.get_label(): len(c.get_segments()) for c in ax.collections if not c.get_label().startswith("_")}
    assert layers["roadmap"] == answer.to_dict()["roadmap"]["edges"]
    assert ax.get_xlim()[0] <= 0.5 and ax.get_xlim()[1] >= 9.5 and ax.get_aspect() == 1.0
    roadmap = warren.build("maze:9x9")
    drawn = warren.plot(roadmap).collections[-1]
    assert len(drawn.get_segments()) == roadmap.edges.free
    flat = warren.read_world(WORLDS / "flat.yaml")
    ends = {"start": (0.5, 0.5), "goal": (4.3, 0.5), "robot": warren.disc(0.2)}
    ax = warren.plot(flat, answer=warren.solve(flat, **ends), bodies=20)
    assert np.array_equal(ax.images[0].get_array(), flat.cells)
    ax.figure.savefig(tmp_path / "flat.png")
    pyplot.close("all")


def test_the_body_moves_in_an_animation(tmp_path):
    from matplotlib import pyplot
    world = warren.read_world(WORLDS / "parking.scene")
    answer = warren.solve(world)
    moving = warren.animate(answer, frames=6)
    moving.save(tmp_path / "parking.gif", writer="pillow")
    assert (tmp_path / "parking.gif").stat().st_size > 0
    assert len(list(warren.animate(warren.solve("maze:5x5"), speed=2.0).new_saved_frame_seq())) > 100
    with pytest.raises(ValueError, match="has no path"):
        warren.animate(warren.solve("maze:5x5", (1, 1), (9, 9)))
    pyplot.close("all")


def test_a_comparison_is_a_frame_of_pandas(program):
    options = {"planners": ["prm", "lazy-prm"], "sampler": "uniform", "samples": [300, 900], "seeds": 3}
    found = warren.compare("maze:9x9", **options)
    frame = pandas.DataFrame(found)
    assert len(frame) == 12 and set(frame["status"]) <= {"solved", "not_connected"}
    theirs = program.run("compare", "maze:9x9", "--planners", "prm,lazy-prm", "--sampler", "uniform", "--samples",
                         "300,900", "--seeds", "3", "--runs", "-").stdout.splitlines()
    assert theirs[0].split(",") == list(frame.columns)
    at = theirs[0].split(",").index("length")
    assert [float(row.split(",")[at] or "nan") for row in theirs[1:]] == pytest.approx(list(frame["length"]), nan_ok=True)
    assert pandas.DataFrame(found.table)["runs"].tolist() == [3, 3, 3, 3]
    assert found.svg().startswith("<svg")
    assert '"warren.compare/1"' in found.json() and "prm" in str(found)
    with pytest.raises(TypeError, match="did you mean planners"):
        warren.compare("maze:9x9", planers=["prm"])


def test_searches_are_compared_as_the_program_compares_them(program):
    found = warren.compare("maze:41x41,loops=0.2", searches=["dijkstra", "astar"], queues=["heap", "sorted-array"], trials=5)
    theirs = program.run("compare", "maze:41x41,loops=0.2", "--searches", "dijkstra,astar", "--queues", "heap,sorted-array",
                         "--trials", "5", "--runs", "-").stdout.splitlines()
    rows = list(csv.DictReader(theirs))
    assert list(rows[0]) == list(found) and len(rows) == len(found["search"]) == 20
    assert [(row["search"], row["queue"]) for row in rows] == list(zip(found["search"], found["queue"]))
    for column in ("length", "expanded"):
        assert [float(row[column]) for row in rows] == found[column].tolist()
    random = warren.compare(sizes=[30, 100], searches="dijkstra", queues="heap", seeds=2, trials=3)
    assert len(random.table["search"]) == 4 and random.svg().startswith("<svg")
    with pytest.raises(warren.UsageError, match="WORLD is missing"):
        warren.compare(searches=["astar"])
