"""Tuning: what is tried, what is chosen."""

import math

import pytest
from designator_drives import straight

from ssrics_like.designators import designator_kind, trials, tune
from ssrics_like.errors import LibraryError, SettingsError

DRIVES = [straight(21.0), straight(9.0)]


def near_ten(marks):
    """Score best at ten marks in all."""
    return -abs(sum(map(len, marks)) - 10)


def test_the_choice_is_the_one_that_scores_best():
    # 21 / 3 + 9 / 3 = 10 marks.
    assert tune("every-metres", DRIVES, near_ten) == {"every_m": 3.0}
    assert tune("every-metres", DRIVES, near_ten, grid={"every_m": [1.0, 20.0]}) == {
        "every_m": 20.0
    }


def test_every_choice_of_the_grid_is_scored_once_with_the_marks_of_each_drive():
    seen = []
    done = trials("every-metres", DRIVES, lambda marks: seen.append([len(m) for m in marks]) or 1.0)
    values = designator_kind("every-metres").GRID["every_m"]
    assert [trial.settings for trial in done] == [{"every_m": v} for v in values]
    assert seen == [[math.floor(21 / v + 1e-9), math.floor(9 / v + 1e-9)] for v in values]


def test_fixed_settings_stay_and_are_not_varied():
    done = trials("random", DRIVES, near_ten, per_100_m=30.0, seed=7)
    assert [trial.settings for trial in done] == [{"per_100_m": 30.0, "seed": 7}]
    done = trials("random", DRIVES, near_ten, seed=7)
    assert [trial.settings["seed"] for trial in done] == [7] * 6


def test_of_equals_the_first_is_chosen_and_nan_never_before_a_number():
    assert tune("every-metres", DRIVES, lambda _: 0.5) == {"every_m": 0.5}
    assert tune("every-metres", DRIVES, lambda m: 0.1 if len(m[0]) == 4 else math.nan) == {
        "every_m": 5.0
    }


def test_two_settings_are_tried_in_every_combination():
    grid = {"threshold_rad": [0.5, 1.0], "apart_m": [1.0, 2.0]}
    done = trials("turning", DRIVES, near_ten, grid=grid)
    assert [tuple(trial.settings.values()) for trial in done] == [
        (0.5, 1.0), (0.5, 2.0), (1.0, 1.0), (1.0, 2.0),
    ]  # fmt: skip


def test_what_cannot_be_tuned_is_refused():
    with pytest.raises(SettingsError, match="at least one drive"):
        tune("every-metres", [], near_ten)
    with pytest.raises(LibraryError, match="did you mean 'every-metres'"):
        tune("every-metre", DRIVES, near_ten)
    with pytest.raises(SettingsError, match="unknown key 'every_km'"):
        tune("every-metres", DRIVES, near_ten, grid={"every_km": [1.0]})
