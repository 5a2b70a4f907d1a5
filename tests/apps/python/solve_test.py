# SPDX-License-Identifier: BSD-3-Clause
"""solve(): the program's answers, byte for byte; options, errors, arrays."""
import gc
import json
import pickle
import threading

import numpy as np
import pytest
import warren
from conftest import WORLDS, unmeasured


TOWN = {"start": "1.5,1.5", "goal": "9.5,8.5"}
FLAT = {"start": "0.5,0.5", "goal": "4.3,0.5"}
SAME = [
    ("maze:41x41,seed=3", {}),
    ("maze:21x21,seed=5,loops=0.2", {"planner": "lazy-prm", "sampler": "uniform", "samples": 4000, "seed": 9}),
    ("maze:15x15", {"planner": "prm", "pipeline": "plain", "clearance": 0.25, "optimise": True}),
    ("maze:15x15,loops=0.3", {"planner": "lazy-prm", "lazy": "expansion", "robot": warren.disc(0.1)}),
    ("poly-easy.scene", {}),
    ("town.geojson", {"planner": "visibility", "full": True, **TOWN}),
    ("town.geojson", {"planner": "cells", "doors": "funnel", **TOWN}),
    ("town.geojson", {"planner": "voronoi", "objective": "clearance", **TOWN}),
    ("poly-easy.scene", {"planner": "rrt", "goal_bias": 0.1, "seed": 4, "nodes": 20000}),
    ("flat.yaml", {"planner": "grid", "robot": warren.disc(0.2), **FLAT}),
    ("flat.yaml", {"map_rules_of_world": "ros1", **FLAT}),
    ("parking.scene", {"seed": 2}),
    ("puma.scene", {"seed": 3}),
    ("walls.scene", {"contact": "blocked"}),
]


def words_of(options):
    words = []
    for name, value in options.items():
        words.append("--" + name.replace("_of_world", "").replace("_", "-"))
        words += [] if value is True else [str(value)]
    return words


@pytest.mark.parametrize("world, options", SAME, ids=[f"{w}-{'-'.join(o) or 'usual'}" for w, o in SAME])
def test_an_answer_has_the_bytes_of_the_program(program, world, options):
    name = world if world.startswith("maze:") else str(WORLDS / world)
    theirs = program.json("solve", name, *words_of(options))
    reading = {key[:-9]: value for key, value in options.items() if key.endswith("_of_world")}
    ours = warren.solve(warren.read_world(name, **reading), **{k: v for k, v in options.items() if k not in
                                                               ("map_rules_of_world",)})
    assert unmeasured(ours.json()) == unmeasured(theirs)
    assert ours.verified and ours.status == "solved"
    assert ours.path.tolist() == json.loads(theirs)["path"]


def test_numbers_reach_the_planner_with_all_their_digits():
    start = (0.1 + 0.2, 1 + 2 ** -50)
    answer = warren.solve("maze:5x5", start, np.array([5.25, 5.0]), clearance=np.float32(0.1), seed=np.int64(3))
    assert answer.start == start and answer.goal == (5.25, 5.0)
    assert answer.clearance == float(np.float32(0.1)) and answer.seed == 3


def test_the_path_is_a_read_only_view_that_outlives_all_else():
    path = warren.solve("maze:41x41").path
    gc.collect()
    warren.solve("maze:99x99")
    assert path.dtype == np.float64 and path.shape[1] == 2 and not path.flags.owndata
    assert path[0].tolist() == [0.5, 1.0] and path[-1].tolist() == [41.5, 41.0]
    with pytest.raises(ValueError):
        path[0, 0] = 1.0


def test_an_answer_is_an_array_where_one_is_expected():
    answer = warren.solve("maze:5x5")
    assert np.array_equal(np.asarray(answer), answer.path)
    assert np.asarray(answer, dtype=np.float32).dtype == np.float32


@pytest.mark.parametrize("options, status", [({"goal": (9, 9)}, "goal_blocked"), ({"start": (0, 9)}, "start_blocked"),
                                             ({"clearance": 0.6}, "goal_blocked")])
def test_no_path_is_no_exception(options, status):
    answer = warren.solve("maze:5x5", **{"start": (1, 1), "goal": (4, 4), **options})
    assert answer.status in (status, "start_blocked") and not answer and not answer.verified
    assert answer.path.shape == (0, 2) and np.isnan(answer.length) and np.isnan(answer.min_clearance)
    assert answer.blocked.end in ("start", "goal") and answer.blocked.by


def test_a_blocked_end_says_what_the_json_says():
    world = warren.scene(polygons=[[(4, 1), (7, 1), (7, 3), (4, 3)]], bounds=(0, 0, 10, 4))
    for start, robot in (((4.5, 2), "point"), ((4.5, 2), "disc 0.2"), ((12, 1), "point"), ((3.9, 2), "disc 0.2")):
        answer = warren.solve(world, start, (9, 3), robot=robot)
        blocked = answer.blocked
        told = answer.to_dict()["blocked"]
        assert isinstance(blocked, warren.BlockedEnd) and blocked._fields == tuple(told)
        assert blocked._replace(free_place=list(blocked.free_place)) == tuple(told.values())
        assert all(blocked[name] == getattr(blocked, name) for name in told) and blocked[0] == blocked.end == "start"
        assert pickle.loads(pickle.dumps(answer)).blocked == blocked
    with pytest.raises(KeyError):
        blocked["nothing"]
    shut = warren.scene(walls=[(0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0)], bounds=(0, 0, 1, 1))
    nowhere = warren.solve(shut, (0.5, 0.5), (0.6, 0.5), robot=warren.disc(3.0)).blocked
    assert nowhere.free_place is None and nowhere.distance is None


def test_what_is_infeasible_is_said():
    walls = [(0, 2, 4, 2)]
    answer = warren.solve(warren.scene(walls=walls, bounds=(0, 0, 4, 4)), (1, 1), (1, 3), planner="visibility")
    assert answer.status in ("infeasible", "not_connected") and answer.blocked is None


def test_an_option_that_is_none_or_false_is_not_given():
    assert warren.solve("maze:9x9", optimise=False, planner=None).json() != ""
    assert "optimise" not in warren.solve("maze:9x9", optimise=False).to_dict()["options"]


@pytest.mark.parametrize("options, where, value", [
    ({"goal_bias": 2, "planner": "rrt"}, "goal_bias", "'2'"),
    ({"planner": "prn"}, "planner", ""),
    ({"start": (float("nan"), 1)}, "start", "'nan,1'"),
    ({"seed": -1}, "seed", "'-1'"),
    ({"threads": 0}, "threads", "'0'"),
    ({"budget": 0.0}, "budget", "'0s'"),
    ({"memory": "lots"}, "memory", "'lots'"),
    ({"robot": "disk 0.1"}, "robot", "disk"),
    ({"planner": "visibility", "samples": 5}, "samples", ""),
])
def test_a_wrong_value_is_a_value_error_with_its_parts(options, where, value):
    with pytest.raises(ValueError) as caught:
        warren.solve("maze:9x9", **options)
    error = caught.value
    assert isinstance(error, warren.UsageError) and isinstance(error, warren.InputError)
    assert error.where == where and error.what and value in error.value
    assert "--" not in str(error) and "@" not in str(error) and "\n" not in str(error)


@pytest.mark.parametrize("options, said", [
    ({"gaol": (1, 1)}, "unexpected keyword argument 'gaol'; did you mean goal"),
    ({"json": "x"}, "unexpected keyword argument 'json'"),
    ({"footprint": 1}, "unexpected keyword argument 'footprint'; robot "),
    ({"optimise": 3}, "optimise: expected True or False"),
    ({"planner": {"a": 1}}, "planner: expected"),
    ({"planner": True}, "planner: expected"),
    ({"seed": False}, r"seed: expected .* \(found: bool\)"),
    ({"goal": False}, "goal: expected"),
    ({"progress": 3}, "progress: expected a function"),
])
def test_a_wrong_keyword_or_type_is_a_type_error(options, said):
    with pytest.raises(TypeError, match=said):
        warren.solve("maze:9x9", **options)


def test_both_spellings_of_a_keyword_are_the_same():
    ours = warren.solve("maze:9x9", sampler="uniform", neighbours=6, optimise=True)
    theirs = warren.solve("maze:9x9", sampler="uniform", neighbors=6, optimize=True)
    assert theirs.length == ours.length < warren.solve("maze:9x9", sampler="uniform", neighbours=6).length


def test_a_file_that_is_not_there_is_an_os_error():
    with pytest.raises(OSError) as caught:
        warren.solve("no such file.scene")
    assert isinstance(caught.value, warren.ReadError)
    assert caught.value.where == "no such file.scene" and "can't be read" in caught.value.what


def test_a_world_that_contradicts_itself_names_file_and_line(tmp_path):
    file = tmp_path / "bad.scene"
    file.write_text("0 0 1 1\nwall 1 2 3\n")
    with pytest.raises(warren.InputError) as caught:
        warren.read_world(file)
    assert not isinstance(caught.value, warren.UsageError)
    assert caught.value.where == f"{file}:2" and caught.value.what and str(caught.value).startswith(f"{file}:2: ")


def test_errors_survive_pickling():
    for error in (warren.InputError("a:1", "wrong", "x"), warren.ReadError("f", "can't be read: gone"),
                  warren.UsageError("seed", "no"), warren.Stopped("budget", "the time budget ended", None)):
        again = pickle.loads(pickle.dumps(error))
        assert type(again) is type(error) and again.args == error.args and str(again) == str(error)
        assert (again.where, again.what, again.value) == (error.where, error.what, error.value)


def test_threads_may_ask_one_world_at_once():
    world = warren.maze(301, 301, seed=2)
    alone = warren.solve(world, threads=1).path
    paths = []
    askers = [threading.Thread(target=lambda: paths.append(warren.solve(world, threads=2).path)) for _ in range(6)]
    for asker in askers:
        asker.start()
    for asker in askers:
        asker.join()
    assert len(paths) == 6 and all(np.array_equal(path, alone) for path in paths)


def test_verify_judges_answers_arrays_and_files(tmp_path):
    world = warren.maze(15, 15)
    answer = warren.solve(world, clearance=0.2)
    answer.save(tmp_path / "a.json")
    assert (tmp_path / "a.json").read_text() == answer.json()
    with pytest.raises(warren.WriteError, match="none/a.json: can't be written"):
        answer.save(tmp_path / "none" / "a.json")
    for path in (answer, answer.path, answer.path.tolist(), tmp_path / "a.json"):
        verdict = warren.verify(world, path)
        assert verdict and verdict.length == answer.length and verdict.violation is None
    refuted = warren.verify(world, answer.path, clearance=0.51)
    leg, distance, obstacle = refuted.violation
    assert not refuted and leg == 0 and distance < 0.51 and obstacle
    with pytest.raises(TypeError, match=r"path: expected float64 \(n, 2\) or"):
        warren.verify(world, np.zeros((3, 4)))


@pytest.mark.parametrize("joints", [1, 2, 4, 8, 14])
def test_a_path_of_an_arm_of_files_has_its_joints(tmp_path, joints):
    links = "".join(f'<link name="l{i}"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>'
                    for i in range(joints + 1))
    chain = "".join(f'<joint name="j{i}" type="prismatic"><parent link="l{i}"/><child link="l{i + 1}"/>'
                    '<origin xyz="1 0 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>' for i in range(joints))
    (tmp_path / "arm.urdf").write_text(f'<robot name="r">{links}{chain}</robot>')
    scene = tmp_path / "arm.scene"
    scene.write_text(f"robot urdf {tmp_path / 'arm.urdf'}\nsphere 0 9 0 1\n")
    path = np.linspace(np.zeros(joints), np.full(joints, 0.1), 3)
    assert warren.verify(str(scene), path)
    with pytest.raises(warren.InputError, match=rf"an arm takes {joints} joint value"):
        warren.verify(str(scene), np.zeros((2, joints % 14 + 1)))


def test_poses_of_moveit_are_in_frames_of_the_robot_that_is_named(tmp_path):
    (tmp_path / "arm.urdf").write_text(
        '<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>'
        '<joint name="j" type="prismatic"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1"/></joint></robot>')
    (tmp_path / "r.srdf").write_text(
        '<robot name="r"><virtual_joint name="v" type="planar" parent_frame="odom" child_link="a"/></robot>')
    scene = tmp_path / "scene.yaml"
    scene.write_text("""robot_model_name: r
robot_state:
  joint_state: {name: [j], position: [0.5]}
  multi_dof_joint_state: {joint_names: [v], transforms: [{translation: [0, 7, 0]}]}
world:
  collision_objects:
    - {id: c, header: {frame_id: b}, primitives: [{type: sphere, dimensions: [0.5]}], primitive_poses: [{position: [2, 0, 0]}]}
""")
    robot = warren.urdf(tmp_path / "arm.urdf", srdf=tmp_path / "r.srdf")
    world = warren.read_world(scene, robot=robot)
    assert world.spheres.tolist() == [[3, 7, 0.5, 0.5]]
    for there in (world, str(scene), pickle.loads(pickle.dumps(world))):
        answer = warren.solve(there, [-0.9], [0.9], robot=robot)
        assert answer.verified and answer.robot.endswith("base-pose 0 7 0 0 0 0 1 hold j 0.5")
        assert warren.verify(there, answer, robot=robot)
    with pytest.raises(warren.InputError, match="only the SRDF's virtual joint"):
        warren.read_world(scene)
    for other in ("maze:5x5", WORLDS / "parking.scene"):
        with pytest.raises(warren.UsageError, match="^robot: is for a scene or request of MoveIt"):
            warren.read_world(other, robot=robot)


def test_a_path_of_a_world_without_ends_is_judged_by_its_own():
    world = warren.scene(walls=[(3, 0, 3, 5)], bounds=(0, 0, 9, 9))
    assert warren.verify(world, [(1, 1), (1, 6), (8, 6)]) and not warren.verify(world, [(1, 1), (8, 1)])
    assert warren.verify(world, [(1, 1), (1, 6)], start=(2, 2)).violation is not None


def test_a_list_that_holds_itself_is_a_type_error():
    itself = [1.0]
    itself.append(itself)
    with pytest.raises(TypeError, match="start"):
        warren.solve("maze:5x5", start=itself)


def test_what_is_printed_names_keywords():
    said = str(warren.solve("maze:15x15", planner="prm", sampler="uniform", samples=200, explain=True))
    assert " samples 800:" in said and "--" not in said


def test_a_path_is_sampled_along_its_curve():
    world = warren.read_world(WORLDS / "parking.scene")
    answer = warren.solve(world)
    states, along = answer.sample(0.05)
    assert states.shape == (len(along), 3) and along[0] == 0.0
    assert along[-1] == pytest.approx(answer.length, rel=1e-9) and np.all(np.diff(along) > 0)
    assert np.all(np.hypot(*np.diff(states[:, :2], axis=0).T) <= 0.05 + 1e-9)
    states, times = answer.sample("100ms", speed=2.0, acceleration=1.0)
    assert np.allclose(np.diff(times)[:-1], 0.1) and states[0].tolist() == answer.path[0].tolist()
    with pytest.raises(warren.UsageError, match="^every: moments need speed"):
        answer.sample("100ms")
    for keyword in ("budget", "frame"):
        with pytest.raises(TypeError, match=rf"^sample\(\) got an unexpected keyword argument '{keyword}'"):
            answer.sample(**{keyword: "1"})
    for other in ("step", "spacing"):
        with pytest.raises(warren.UsageError, match=rf"^{other}: .* every="):
            answer.sample(**{other: 0.1})


def test_a_path_is_written_as_the_program_writes_it(program, tmp_path):
    program.run("solve", "maze:9x9", "--path", "theirs.csv", "--every", "0.3", "--speed", "1", cwd=tmp_path)
    told = warren.solve("maze:9x9").save_path(tmp_path / "ours.csv", every=0.3, speed=1)
    assert (tmp_path / "ours.csv").read_bytes() == (tmp_path / "theirs.csv").read_bytes()
    assert told["places"] == len((tmp_path / "ours.csv").read_text().splitlines()) - 1 and told["duration_s"] > 0
    with pytest.raises(warren.UsageError, match="^path: writes"):
        warren.solve("maze:9x9").save_path("a.txt")
    with pytest.raises(warren.WriteError):
        warren.solve("maze:9x9").save_path(tmp_path / "none" / "a.csv")


EXPLAINED = [
    ("maze:15x15", {"planner": "prm", "sampler": "uniform", "samples": 300}),
    ("maze:15x15", {"planner": "prm", "pipeline": "plain"}),
    ("maze:41x41", {}),
    ("parking.scene", {"seed": 2}),
    ("maze:5x5", {"start": "1,1", "goal": "9,9"}),
]


@pytest.mark.parametrize("world, options", EXPLAINED, ids=[f"{w}-{'-'.join(o) or 'usual'}" for w, o in EXPLAINED])
def test_an_explanation_is_that_of_the_program(program, world, options):
    name = world if world.startswith("maze:") else str(WORLDS / world)
    theirs = program.json("solve", name, *words_of(options), "--explain")
    ours = warren.solve(name, explain=True, **options)
    assert unmeasured(ours.json()) == unmeasured(theirs)
    told = json.loads(theirs)["explained"]
    explained = ours.explained
    assert explained.samples._asdict() == told["samples"] and explained.motions._asdict() == told["motions"]
    facts = explained.components and {**explained.components._asdict(), "count": explained.components.number}
    assert (facts is None) == (told["components"] is None)
    assert facts is None or all(facts[key] == value for key, value in told["components"].items())
    assert (explained.narrowest is None) == (told["narrowest"] is None) and explained.stopped_by is None
    assert [list(hint.options) for hint in explained.hints] == [hint["options"] for hint in told["hints"]]
    assert bool(explained.hints) == (not ours) and ("time went to" in str(ours))
    assert pickle.loads(pickle.dumps(ours)).explained == explained and len(ours.edges()) == 0
    assert warren.solve(name, **options).explained is None


def test_a_hint_can_be_tried_as_it_stands():
    answer = warren.solve("maze:5x5", (1, 1), (9, 9), explain=True)
    assert warren.solve("maze:5x5", **{"start": (1, 1), **answer.explained.hints[0].keywords})


def test_the_narrowest_place_of_a_path_is_that_of_the_program(program, tmp_path):
    answer = warren.solve("maze:15x15", optimise=True)
    answer.save(tmp_path / "a.json")
    told = json.loads(program.json("verify", "maze:15x15", tmp_path / "a.json", "--explain"))["narrowest"]
    narrow = warren.verify("maze:15x15", answer, explain=True).narrowest
    assert {**narrow._asdict(), "place": list(narrow.place)} == told
    assert warren.verify("maze:15x15", answer).narrowest is None


def test_a_stopped_answer_says_what_it_can():
    with pytest.raises(warren.Stopped) as caught:
        warren.solve(warren.maze(3000, 3000), budget=0.001, keep=True, explain=True)
    assert caught.value.answer.explained.hints[0].why


def test_a_replanner_answers_as_a_fresh_solve():
    cells = np.zeros((20, 30), bool)
    cells[5:15, 14] = True
    ends = ((2.5, 10.5), (27.5, 10.5))
    again = warren.Replanner(warren.grid(cells), *ends, clearance_price=(3, 2))
    first = again.solve()
    again.update([(14, y) for y in range(15, 19)])
    longer = again.solve()
    fresh = warren.solve(again.world, *ends, clearance_price=(3, 2))
    assert longer.cost == fresh.cost > first.cost
    assert np.array_equal(longer.path, fresh.path)
    again.update(box=(14, 15, 15, 19), blocked=False)
    assert again.solve().cost == first.cost


def test_a_route_is_kept_to_an_answer():
    cells = np.zeros((20, 30), bool)
    cells[5:15, 14] = True
    question = (warren.grid(cells), (2.5, 10.5), (27.5, 10.5))
    old = warren.solve(*question, clearance_price=(3, 2))
    kept = warren.solve(*question, clearance_price=(3, 2), keep_to=old, unless_gain=0.05)
    assert kept.keeping.kept and kept.cost == pytest.approx(old.cost)
    again = warren.Replanner(*question, clearance_price=(3, 2), keep_to=old, unless_gain=0.05)
    assert again.solve().keeping.kept


def test_holes_and_certificates(tmp_path):
    cells = np.zeros((20, 30), bool)
    cells[5:15, 14] = True
    cells[10, 20] = True
    world, ends, price = warren.grid(cells), ((2.5, 10.5), (27.5, 10.5)), {"clearance_price": (3, 2)}
    many = warren.solve(world, *ends, alternatives=8, hole=0, stretch=2, **price)
    few = warren.solve(world, *ends, alternatives=8, hole=5, stretch=2, **price)
    assert len(many.alternatives) > len(few.alternatives) > 0
    file = str(tmp_path / "bound.npy")
    answer = warren.solve(world, *ends, gap="20%", certificate=file, **price)
    assert answer.bound_of == "all" and warren.verify(world, answer, certificate=file)
    potential = np.load(file)
    np.save(file, 2 * potential)  # steeper than anything costs
    assert not warren.verify(world, answer, certificate=file)
