"""Whatever people and robots mark, a comparison is made, and its figures stay in their bounds."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.comparison.way import Way
from ssrics_like.people import Marker, Settings, compare_people
from ssrics_like.people.definitions import file_definitions
from ssrics_like.people.figures import Model
from ssrics_like.people.files import (
    agreement_rows,
    comparison_data,
    location_rows,
    mark_rows,
    people_rows,
)
from ssrics_like.report.people_tables import (
    figure_table,
    location_table,
    pair_table,
    people_table,
)
from ssrics_like.results.files import json_text
from ssrics_like.world.locations import Location

PLACE = st.tuples(
    st.floats(-3, 13).map(lambda v: round(v, 2)), st.floats(-2, 2).map(lambda v: round(v, 2))
)
MARKS = st.lists(PLACE, max_size=6)
SHARES = ("precision", "recall", "f", "f_chance", "f_exceeds", "kappa_exceeds", "f_others")


def markers(group, rows):
    return tuple(
        Marker(
            f"{group} {n}",
            group,
            np.array(xy, float).reshape(-1, 2),
            np.full(len(xy), math.nan),
            ("",) * len(xy),
        )
        for n, xy in enumerate(rows)
    )


def way(length_m):
    x = np.arange(0.0, length_m, 0.1)
    return Way.through(np.column_stack([x, np.zeros(len(x))]))


@given(
    st.lists(MARKS, min_size=1, max_size=7),
    st.lists(
        st.lists(st.tuples(MARKS, st.sampled_from([0.0, 0.05, 4.0, 10.0])), min_size=1, max_size=3),
        min_size=1,
        max_size=3,
    ),
    st.lists(PLACE, max_size=4, unique=True),
    st.sampled_from([0.3, 1.0, 4.0]),
    st.sampled_from([0.5, 1.0, 5.0]),
)
@settings(max_examples=25, deadline=None)
def test_any_marks_can_be_compared(people, models, places, radius_m, bin_m):
    locations = [Location(f"L{n}", *xy) for n, xy in enumerate(places)]
    made = compare_people(
        markers("people", people),
        [
            Model(
                f"m{k}",
                markers(f"m{k}", [marks for marks, _ in runs]),
                tuple(way(length) for _, length in runs),
            )
            for k, runs in enumerate(models)
        ],
        locations,
        Settings(radius_m, bin_m, 1, 20),
    )
    for figures in made.figures.values():
        for name, figure in figures.items():
            low, high = figure.interval
            assert math.isnan(low) == math.isnan(high)
            assert not low > high, name
            if name in SHARES:
                assert math.isnan(figure.value) or -1e-9 <= figure.value <= 1 + 1e-9, name
            if "kappa" in name and "ceiling" not in name:
                assert math.isnan(figure.value) or -1 - 1e-9 <= figure.value <= 1 + 1e-9, name
    for share in made.shares:
        low, high = share.interval
        assert low - 1e-9 <= share.share <= high + 1e-9
    count = len(people) + sum(map(len, models))
    assert made.kappa.shape == (count, count)
    assert len(agreement_rows(made)) == count * (count - 1) // 2
    assert len(mark_rows(made)) == sum(map(len, made.markers))
    assert len(location_rows(made)) == len(locations) * (1 + len(models))
    assert len(people_rows(made)) == len(people) * (1 + len(models))
    assert len(made.pairs) == 3 * math.comb(len(models), 2)
    defined = set().union(*(key.split(", ") for key in file_definitions()))
    assert set().union(*made.figures.values()) <= defined
    assert json_text(comparison_data(made, {}))
    for table in (location_table, figure_table, pair_table, people_table):
        for row in table(made).rows:
            assert len(row) == len(table(made).headings)
