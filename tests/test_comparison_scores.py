"""Scores of runs: published values, closed forms, naive twins, and nothing at all."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.comparison.agreement import consistency
from ssrics_like.comparison.drive import Drive, Marks, Passages
from ssrics_like.comparison.proportions import chance_corrected, harmonic_mean, wilson
from ssrics_like.comparison.scores import score_runs
from ssrics_like.comparison.way import Way
from ssrics_like.world.locations import Location


def wilson_by_formula(found, tried, z=1.959963984540054):
    """Wilson (1927): (p + z^2/2n -+ z sqrt(p(1-p)/n + z^2/4n^2)) / (1 + z^2/n)."""
    p = found / tried
    middle = p + z**2 / (2 * tried)
    half = z * math.sqrt(p * (1 - p) / tried + z**2 / (4 * tried**2))
    return (middle - half) / (1 + z**2 / tried), (middle + half) / (1 + z**2 / tried)


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 200).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_the_interval_is_wilsons(counts):
    assert wilson(*counts) == pytest.approx(wilson_by_formula(*counts), abs=1e-9)


def test_the_reports_own_shares_have_the_published_intervals():
    # Report, table 1: 57, 78, 57, 71, 57 and 71 % of 14 runs are 8, 11, 8, 10, 8 and 10 runs.
    assert sum([8, 11, 8, 10, 8, 10]) == 55
    assert [round(value, 2) for value in wilson(55, 84)] == [0.55, 0.75]
    # Brown, Cai & DasGupta (2001), "Interval estimation for a binomial proportion": at p = 0 the
    # lower limit is 0 and the upper z^2 / (n + z^2).
    assert wilson(0, 14) == pytest.approx((0.0, 1.959964**2 / (14 + 1.959964**2)), abs=1e-6)
    assert all(math.isnan(value) for value in wilson(0, 0))


def test_chance_correction_and_the_harmonic_mean():
    assert chance_corrected(0.65, 0.44) == pytest.approx(0.375)
    assert chance_corrected(0.3, 0.3) == 0.0
    assert chance_corrected(1.0, 0.3) == 1.0
    assert math.isnan(chance_corrected(1.0, 1.0))
    assert harmonic_mean(0.5, 1.0) == pytest.approx(2 / 3)
    assert harmonic_mean(0.0, 0.0) == 0.0
    assert math.isnan(harmonic_mean(math.nan, 1.0))


@settings(max_examples=60, deadline=None)
@given(st.integers(2, 6), st.integers(1, 5), st.integers(0, 2**32 - 1))
def test_consistency_agrees_with_a_loop_over_pairs(runs, places, seed):
    found = np.random.default_rng(seed).random((runs, places)) < 0.5
    pairs = [np.mean(a == b) for a, b in itertools.combinations(found, 2)]
    assert consistency(found) == pytest.approx(np.mean(pairs))


def test_consistency_is_one_for_equal_runs_and_nothing_for_a_single_one():
    assert consistency([[True, False]] * 3) == 1.0
    assert consistency([[True, True], [False, False]]) == 0.0
    assert math.isnan(consistency([[True]]))
    assert math.isnan(consistency(np.zeros((3, 0))))


STRAIGHT = np.column_stack([np.linspace(0, 50, 501), np.zeros(501)])
PLACES = (
    Location("1", 10.0, 0.0),
    Location("2", 20.0, 0.0),
    Location("3", 40.0, 0.0),
    Location("J", 20.5, 0.0, kind="junction"),
    Location("O", 30.0, 0.0, kind="opening"),
)


def drive(*xs, path=STRAIGHT, passages=None, late_m=0.0):
    # On a straight path from 0 a place's x is the metres driven up to it.
    marks = Marks.of([(x, 0.0) for x in xs], xs, [x + late_m for x in xs])
    return Drive(Way.through(path), marks, passages)


def test_two_runs_counted_by_hand():
    # Run 0: doorway 1 three times (two repetitions), doorway 2 once, near the junction too;
    # a false mark at 46 m. Run 1: the opening, doorway 1.
    runs = [drive(9.8, 10.0, 10.4, 20.2, 46.0), drive(30.1, 9.5)]
    scores = score_runs(runs, PLACES, 1.0, np.random.default_rng(0))
    assert scores.found.tolist() == [
        [True, True, False, True, False],
        [True, False, False, False, True],
    ]
    first, second = scores.runs
    assert (first.marks, first.merged, first.right) == (5, 3, 2)
    assert (first.designated, first.found, first.repeats) == (3, 2, 2)
    assert first.recall == pytest.approx(2 / 3)
    assert first.precision == pytest.approx(2 / 3)
    assert first.duplicates == 1.0
    assert first.marks_per_100_m == 10.0
    assert (second.recall, second.precision, second.duplicates) == (pytest.approx(1 / 3), 1.0, 0.0)
    both = scores.pooled
    assert both.recall == pytest.approx(3 / 6)
    assert both.precision == pytest.approx(4 / 5)
    assert both.marks_per_100_m == pytest.approx(7.0)
    assert both.duplicates == pytest.approx(2 / 3)
    assert both.f_place == pytest.approx(2 * 0.5 * 0.8 / 1.3)
    assert math.isnan(both.f)  # no passages are known
    assert both.interval == wilson(3, 6)
    # They agree about doorways 1 and 3.
    assert scores.consistency == pytest.approx(2 / 3)
    assert [place.share for place in scores.places] == [1.0, 0.5, 0.0, 0.5, 0.5]
    assert [place.designated for place in scores.places] == [True, True, True, False, False]


def test_chance_of_runs_follows_the_closed_form():
    runs = [drive(*np.linspace(1, 49, 6))] * 20
    scores = score_runs(runs, PLACES[:3], 1.0, np.random.default_rng(5))
    expected = 1 - (1 - 2 / 50) ** 6
    assert [place.chance for place in scores.places] == pytest.approx([expected] * 3, abs=0.03)
    assert scores.pooled.chance == pytest.approx(expected, abs=0.02)
    pool = scores.pooled
    assert pool.corrected_recall == pytest.approx((pool.recall - pool.chance) / (1 - pool.chance))


def test_equal_generators_give_equal_scores():
    runs = [drive(9.8, 25.0), drive(11.0)]
    twice = [score_runs(runs, PLACES, 1.0, np.random.default_rng(9)) for _ in range(2)]
    assert twice[0].places == twice[1].places
    assert twice[0].runs == twice[1].runs


@pytest.mark.parametrize(
    ("drives", "locations"),
    [
        ([], PLACES),
        ([drive()], PLACES),
        ([drive(1.0)], ()),
        ([drive(1.0)], PLACES[3:]),
        ([drive(1.0, path=STRAIGHT[:1])], PLACES),
        ([drive(1.0, path=STRAIGHT[:0])], PLACES),
    ],
)  # fmt: skip
def test_what_cannot_be_said_is_nan(drives, locations):
    scores = score_runs(drives, locations, 1.0, np.random.default_rng(0))
    tally = scores.pooled
    assert math.isnan(scores.consistency)
    doors = len(drives) * sum(place.kind == "doorway" for place in locations)
    assert math.isnan(tally.recall) == (doors == 0)
    assert math.isnan(tally.precision) == (tally.marks == 0)
    assert math.isnan(tally.duplicates) == (tally.found == 0)
    assert math.isnan(tally.marks_per_100_m) == (tally.length_m == 0)
    for value in tally.figures().values():
        assert math.isnan(value) or 0 <= value <= 100


def test_passages_counted_by_hand():
    # There through doorways 1 and 2, back through 2, and through the opening, which is none.
    # Marks at 9 and 10.5 m compete for one passage; the one at 20.4 m is too far along from 22.
    passages = Passages.of([4, 0, 1, 1], [30.0, 10.0, 20.0, 22.0])
    run = drive(9.0, 10.5, 20.4, 30.0, 46.0, passages=passages, late_m=1.5)
    scores = score_runs([run], PLACES, 1.0, np.random.default_rng(0))
    (outcome,) = scores.outcomes
    assert outcome.passages.along_m.tolist() == [10.0, 20.0, 22.0]
    assert outcome.passage_mark.tolist() == [1, 2, -1]
    tally = scores.pooled
    assert (tally.passages, tally.passed) == (3, 2)
    assert tally.pass_recall == pytest.approx(2 / 3)
    # 9 and 10.5 are further than 1 m apart: five groups; at doorways 1 and 2 or the junction and
    # the opening: three are right, for the second at doorway 1 finds it taken.
    assert (tally.merged, tally.right) == (5, 3)
    assert tally.f == pytest.approx(2 * (2 / 3) * 0.6 / (2 / 3 + 0.6))
    assert tally.f_place == pytest.approx(2 * (2 / 3) * 0.6 / (2 / 3 + 0.6))
    assert tally.delay_m == pytest.approx(1.5)
    assert outcome.fates() == ["false", "hit", "hit", "other", "false"]


def test_one_mark_between_two_passages_finds_one_of_them():
    run = drive(10.5, passages=Passages.of([0, 0], [10.0, 11.0]))
    tally = score_runs([run], PLACES, 1.0, np.random.default_rng(0)).pooled
    assert (tally.passages, tally.passed) == (2, 1)


def test_a_place_is_found_from_beside_it_but_not_its_passage():
    # The path comes back past doorway 1 in the next room, 0.8 m aside, 20 m further on.
    way = Way.through([(x, 0) for x in range(21)] + [(x, 0.8) for x in range(20, -1, -1)])
    run = Drive(way, Marks.on(way, [30.8]), Passages.of([0], [10.0]))
    tally = score_runs([run], PLACES[:1], 1.0, np.random.default_rng(0)).pooled
    assert (tally.found, tally.passed) == (1, 0)


def test_what_a_mark_is_when_it_repeats():
    # Three at doorway 1, the first of which lies farthest; two where nothing is.
    run = drive(9.1, 9.9, 10.1, 35.0, 35.5)
    (outcome,) = score_runs([run], PLACES, 1.0, np.random.default_rng(0)).outcomes
    assert outcome.fates() == ["repeat", "hit", "repeat", "false", "repeat"]
    assert outcome.group.tolist() == [0, 0, 0, 1, 1]
    assert outcome.group_place.tolist() == [0, -1]


def test_who_says_what_is_designated_is_heard():
    scores = score_runs(
        [drive(9.8, 30.0)], PLACES, 1.0, np.random.default_rng(0),
        designated=[False, False, False, False, True],
    )  # fmt: skip
    assert (scores.pooled.designated, scores.pooled.found) == (1, 1)
    assert [place.designated for place in scores.places] == [False] * 4 + [True]


def test_the_f_of_chance_and_of_a_clock_follow_closed_forms():
    # One mark on 50 m; each of two places 10 m apart has a window of 2 m: precision 2 * 2/50, and
    # each of two passages is found with p = 2/50, whether at random or by a clock.
    run = drive(1.0, passages=Passages.of([0, 1], [10.0, 20.0]))
    pooled = score_runs([run], PLACES[:2], 1.0, np.random.default_rng(8), 20_000).pooled
    p = 2 / 50
    for name in ("chance", "clock"):
        figures = pooled.figures()
        assert figures[f"pass_{name}"] == pytest.approx(p, abs=0.005)
        assert figures[f"precision_{name}"] == pytest.approx(2 * p, abs=0.008)
        assert figures[f"f_{name}"] == pytest.approx(2 * p * 2 * p / (3 * p), abs=0.006)
        assert figures[f"f_place_{name}"] == pytest.approx(2 * p * 2 * p / (3 * p), abs=0.006)


METRES = st.integers(0, 100).map(lambda n: n / 2)


@settings(max_examples=60, deadline=None)
@given(st.lists(METRES, max_size=8), st.lists(METRES, max_size=6),
       st.sampled_from([0.5, 1.0, 2.0, 5.0]), st.integers(0, 2**31))  # fmt: skip
def test_every_share_lies_between_0_and_1(xs, crossed, radius_m, seed):
    run = drive(*sorted(xs), passages=Passages.of(np.arange(len(crossed)) % 3, crossed))
    tally = score_runs([run], PLACES, radius_m, np.random.default_rng(seed), 20).pooled
    for name, value in tally.figures().items():
        if not name.startswith(("corrected", "marks", "duplicates", "delay")):
            assert math.isnan(value) or 0 <= value <= 1, name
    assert tally.passed <= min(tally.passages, tally.marks)
    assert tally.right <= tally.merged <= tally.marks
    assert math.isnan(tally.f) == (not xs or not crossed)


@settings(max_examples=40, deadline=None)
@given(st.lists(METRES, max_size=6), st.lists(METRES, max_size=5), st.permutations(range(5)))
def test_the_order_of_places_and_passages_does_not_matter(xs, crossed, order):
    passages = [(i % 3, along) for i, along in enumerate(crossed)]
    new = {old: i for i, old in enumerate(order)}
    shuffled = [(new[place], along) for place, along in reversed(passages)]
    tallies = []
    for through, places in ((passages, PLACES), (shuffled, [PLACES[i] for i in order])):
        known = Passages.of([p for p, _ in through], [along for _, along in through])
        run = drive(*sorted(xs), passages=known)
        tallies.append(score_runs([run], places, 1.0, np.random.default_rng(1), 5).pooled)
    one, other = tallies
    for name, value in one.figures().items():
        assert other.figures()[name] == pytest.approx(value, nan_ok=True), name


@settings(max_examples=30, deadline=None)
@given(st.lists(st.lists(METRES, max_size=5), min_size=1, max_size=4), st.data())
def test_the_order_of_runs_does_not_matter(each, data):
    runs = [drive(*sorted(xs), passages=Passages.of([0, 2], [10.0, 40.0])) for xs in each]
    mixed = data.draw(st.permutations(runs))
    one, other = (
        score_runs(some, PLACES, 1.0, np.random.default_rng(0), 1) for some in (runs, mixed)
    )
    assert one.consistency == pytest.approx(other.consistency, nan_ok=True)
    for name in ("recall", "pass_recall", "precision", "f", "f_place", "duplicates"):
        same = other.pooled.figures()[name]
        assert one.pooled.figures()[name] == pytest.approx(same, nan_ok=True), name


def test_columns_of_unequal_length_are_refused():
    with pytest.raises(ValueError, match=r"along_m has shape \(1,\), expected \(2,\)"):
        Marks.of([(0, 0), (1, 0)], [0.0])
    with pytest.raises(ValueError, match=r"decided_m has shape \(3,\), expected \(2,\)"):
        Marks.on(Way.through(STRAIGHT), [0.0, 1.0], [0.0, 1.0, 2.0])
    with pytest.raises(ValueError, match=r"along_m has shape \(0,\), expected \(1,\)"):
        Passages.of([0])
