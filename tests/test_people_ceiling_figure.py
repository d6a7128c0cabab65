"""The picture of the human ceiling: a dot for each person and run, where they stand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from people_choices import at_doors, compared, near, rows, write_choices
from results_folders import build_world

from ssrics_like.people.files import write_people
from ssrics_like.report import style
from ssrics_like.report.people_ceiling_figure import LEVELS, draw_people_ceiling, swarm


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    return build_world(tmp_path_factory.mktemp("world") / "world", runs=6, poses=400)


def dots(axes, marker):
    return [line for line in axes.lines if line.get_marker() == marker]


def test_dots_stand_where_the_tables_say(world, tmp_path):
    made = compared([world], write_choices(tmp_path / "c.csv", at_doors(7)))
    write_people(made, {}, tmp_path / "out", {})
    table = rows(tmp_path / "out" / "people.csv")
    with style.context():
        left, right = draw_people_ceiling(made).figure.axes
    for axes, name in ((left, "f"), (right, "kappa")):
        (people,), (runs,) = dots(axes, "o"), dots(axes, "D")
        told = [float(row[name]) for row in table if row["measured"] == "people"]
        assert people.get_xdata() == pytest.approx(told, abs=1e-6)
        # The mean over runs and people is the same whichever is taken first.
        assert np.mean(runs.get_xdata()) == pytest.approx(
            made.figures["world"][f"{name}_others"].value
        )
        assert len(runs.get_xdata()) == 6
        upright = [x[0] for line in axes.lines if len(x := line.get_xdata()) == 2 and x[0] == x[1]]
        assert made.figures["people"][f"{name}_others"].value in upright
        low, high = axes.get_xlim()
        assert low < min(people.get_xdata().min(), runs.get_xdata().min())
        assert max(people.get_xdata().max(), runs.get_xdata().max()) < high


def test_of_one_person_there_is_no_picture_and_of_no_consensus_an_empty_one(world, tmp_path):
    one = compared([world], write_choices(tmp_path / "c.csv", {"only": [near(0)]}))
    assert draw_people_ceiling(one) is None
    apart = {f"p{k}": [near(k)] for k in range(6)}
    made = compared([world], write_choices(tmp_path / "c.csv", apart))
    assert math.isnan(made.figures["people"]["f_others"].value)
    with style.context():
        left, _ = draw_people_ceiling(made).figure.axes
    assert all(len(line.get_xdata()) == 0 for line in dots(left, "o") + dots(left, "D"))


@given(st.lists(st.floats(0, 1), max_size=40), st.floats(0.001, 0.2))
def test_dots_of_a_row_do_not_cover_one_another_while_there_is_room(values, dot):
    values = np.array(values, float)
    steps = swarm(values, dot)
    assert len(steps) == len(values)
    assert np.abs(steps).max(initial=0) <= LEVELS
    if len(values) <= 2 * LEVELS + 1:
        for level in set(steps.tolist()):
            assert (np.diff(np.sort(values[steps == level])) >= dot).all()
    assert (swarm(values, 0.0) == 0).all()
