# SPDX-License-Identifier: BSD-3-Clause
"""Planners that get better with time: what they tell on their way, who may end them, and what their answers say."""
import pickle
import threading

import pytest
import warren

TOWN = warren.scene(polygons=[[(3, 1), (5, 1), (5, 6), (3, 6)], [(6, 3), (8, 3), (8, 9), (6, 9)]], bounds=(0, 0, 10, 10),
                    start=(1, 5), goal=(9, 5))
ASKED = dict(planner="anytime", iterations=20)


def test_each_better_path_is_told_on_the_calling_thread():
    told, threads = [], set()

    def on_improvement(better):
        told.append(better)
        threads.add(threading.get_ident())

    answer = warren.solve(TOWN, on_improvement=on_improvement, **ASKED)
    assert answer.verified and told == answer.improvements
    assert threads == {threading.get_ident()}
    costs = [better.cost for better in told]
    assert costs == sorted(costs, reverse=True) and len(set(costs)) == len(costs)
    assert all(isinstance(better, warren.Improvement) and better.by for better in told)
    assert all(0 < better.lower_bound <= better.cost for better in told)


def test_an_answer_says_how_good_it_is():
    answer = warren.solve(TOWN, **ASKED)
    assert answer.ended_by in ("iterations", "optimum") and answer.iterations <= 20
    assert answer.lower_bound <= answer.length and answer.gap == pytest.approx(answer.length / answer.lower_bound - 1)
    assert answer.to_dict()["iterations"] == answer.iterations
    again = pickle.loads(pickle.dumps(answer))
    assert again.improvements == answer.improvements and again.ended_by == answer.ended_by
    other = warren.solve(TOWN, planner="rrt-connect")
    assert other.improvements == [] and other.iterations is None and other.ended_by is None


def test_false_ends_the_search_with_the_path_that_it_has():
    answer = warren.solve(TOWN, planner="anytime", on_improvement=lambda better: False)
    assert answer.verified and len(answer.improvements) == 1
    assert answer.ended_by in ("caller", "optimum")
    assert warren.solve(TOWN, on_improvement=lambda better: None, **ASKED).iterations == warren.solve(TOWN, **ASKED).iterations


def test_what_it_raises_passes_through():
    def raises(better):
        raise LookupError(better.by)

    with pytest.raises(LookupError):
        warren.solve(TOWN, planner="anytime", on_improvement=raises)
    with pytest.raises(TypeError, match="on_improvement"):
        warren.solve(TOWN, on_improvement=3)


def test_a_budget_that_ends_it_gives_the_path():
    answer = warren.solve(TOWN, planner="rrt-star", budget=0.3)
    assert answer.verified and answer.ended_by == "budget"


def test_curves_have_a_line_for_each_better_path():
    found = warren.compare(TOWN, planners=["anytime", "rrt-connect"], iterations=5, seeds=2)
    lines = found.curves_csv().splitlines()
    assert lines[0] == "planner,seed,seconds,cost,length,by,lower_bound,options"
    assert {line.split(",")[0] for line in lines[1:]} == {"anytime", "rrt-connect"}
