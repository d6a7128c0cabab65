"""The novelty algorithm against the report's pseudo-code, written out literally."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from ssrics_like.errors import SettingsError, SsricsError
from ssrics_like.perception import (
    NoveltyDetector,
    ScanError,
    boredom_quotient,
    is_novel,
    novelty_profile,
    scan_correlations,
)


def naive_correlation(x, y):
    common = [(a, b) for a, b in zip(x, y, strict=True) if math.isfinite(a) and math.isfinite(b)]
    if len(common) < 2:
        return 0.0
    xs, ys = zip(*common, strict=True)
    if min(xs) == max(xs) or min(ys) == max(ys):
        return 1.0 if xs == ys else 0.0
    x_mean = math.fsum(xs) / len(xs)
    y_mean = math.fsum(ys) / len(ys)
    dx = [a - x_mean for a in xs]
    dy = [b - y_mean for b in ys]
    xx = math.fsum(a * a for a in dx)
    yy = math.fsum(b * b for b in dy)
    return math.fsum(a * b for a, b in zip(dx, dy, strict=True)) / math.sqrt(xx * yy)


def naive_profile(scans, interval, gradient, advance):
    """Report, section 2.1, one interval after the other."""
    step = 1 if advance == "sliding" else interval
    taus = []
    for start in range(0, len(scans) - interval + 1, step):
        alpha = scans[start : start + interval]
        gamma = 0
        for i in range(interval):
            for j in range(i + 1, interval):
                if naive_correlation(alpha[i], alpha[j]) > gradient:
                    gamma += 1
        taus.append(gamma / ((interval**2 - interval) / 2))
    return taus


def streamed(scans, interval, gradient, advance):
    detector = NoveltyDetector(interval, gradient, advance)
    return [tau for tau in map(detector.update, scans) if tau is not None]


def drive(scans, beams, seed, step=0.5):
    """Scans that drift at a changing pace about one shape: correlations on both sides of .99."""
    rng = np.random.default_rng(seed)
    pace = step * rng.uniform(0, 1, scans) ** 4
    offset = np.zeros(beams)
    shape = 6 + 2 * np.sin(np.linspace(0, 3, beams))
    rows = []
    for scale in pace:
        offset = 0.95 * offset + scale * rng.normal(size=beams)
        rows.append(shape + offset)
    return np.array(rows)


readings = st.one_of(
    st.sampled_from([0.5, 1.0, 2.0, 3.25, 8.0, math.nan, math.inf]),
    st.floats(0.1, 80.0),
)


@st.composite
def logs(draw):
    """Short logs with repeated, constant, partly invalid and slightly changed scans."""
    beams = draw(st.integers(1, 11))
    rows = [draw(st.lists(readings, min_size=beams, max_size=beams))]
    for _ in range(draw(st.integers(1, 11))):
        kind = draw(st.sampled_from(["new", "same", "constant", "moved", "hole"]))
        row = list(rows[draw(st.integers(0, len(rows) - 1))])
        if kind == "new":
            row = draw(st.lists(readings, min_size=beams, max_size=beams))
        elif kind == "constant":
            row = [draw(st.sampled_from([2.0, 8.0]))] * beams
        elif kind == "moved":
            row = [r + 0.1 * draw(st.floats(-1, 1)) for r in row]
        elif kind == "hole":
            row[draw(st.integers(0, beams - 1))] = math.nan
        rows.append(row)
    return np.array(rows)


@settings(max_examples=150, deadline=None)
@given(
    logs(), st.integers(2, 6), st.sampled_from([0.3, 0.9, 0.99]),
    st.sampled_from(["sliding", "tumbling"]),
)  # fmt: skip
@example(np.full((4, 3), 8.0), 3, 0.99, "sliding")
@example(np.full((4, 1), 8.0), 3, 0.99, "tumbling")
@example(np.full((4, 3), np.nan), 2, 0.99, "sliding")
@example(np.array([[8.0, 8.0, 8.000000000000002]] * 4), 2, 0.99, "sliding")
def test_batch_streaming_and_the_literal_double_loop_agree(scans, interval, gradient, advance):
    # A correlation that equals the gradient is decided by rounding; leave it out.
    for i, x in enumerate(scans):
        for y in scans[:i]:
            assume(abs(naive_correlation(x, y) - gradient) > 1e-9)
    batch = novelty_profile(scans, interval, gradient, advance)
    assert batch.dtype == np.float64
    assert batch.tolist() == streamed(scans, interval, gradient, advance)
    assert batch.tolist() == naive_profile(scans, interval, gradient, advance)


@pytest.mark.parametrize("advance", ["sliding", "tumbling"])
@pytest.mark.parametrize("interval", [2, 7, 16, 50, 97])
def test_longer_logs_agree_across_blocks_and_chunks(interval, advance):
    scans = drive(5000, 9, seed=interval)
    scans[40:44, 3] = np.nan
    scans[100:130] = 8.0
    batch = novelty_profile(scans, interval, 0.99, advance)
    assert 0.02 < batch.mean() < 0.98
    assert batch.tolist() == streamed(scans, interval, 0.99, advance)


@pytest.mark.parametrize("beams", [5, 180, 682])
def test_counts_equal_those_of_numpy_corrcoef(beams):
    scans = drive(260, beams, seed=beams, step=0.2)
    upper = np.triu_indices(50, 1)
    expected = [
        np.count_nonzero(np.corrcoef(scans[k : k + 50])[upper] > 0.99) for k in range(260 - 49)
    ]
    assert 100 < np.mean(expected) < 1125
    assert np.rint(novelty_profile(scans) * 1225).astype(int).tolist() == expected


@pytest.mark.parametrize("off", [1e-5, 1e-6, 1e-8, 1e-11])
def test_pairs_nearer_to_the_gradient_than_float32_resolves_are_decided_rightly(off):
    rng = np.random.default_rng(5)
    gradient, beams, expected, scans = 0.99, 180, [], []
    for k in range(200):
        base, other = rng.normal(size=(2, beams))
        base -= base.mean()
        other -= other.mean()
        base /= np.linalg.norm(base)
        other -= base * (base @ other)
        other /= np.linalg.norm(other)
        r = gradient + (off if k % 3 else -off)
        scans += [5 + base, 5 + r * base + math.sqrt(1 - r * r) * other]
        expected.append(1.0 if k % 3 else 0.0)
    assert novelty_profile(scans, 2, gradient, "tumbling").tolist() == expected
    assert streamed(scans, 2, gradient, "tumbling") == expected


def test_a_correlation_that_only_equals_the_gradient_does_not_exceed_it():
    # Deviations with mean 0, squares that sum to 2, products that sum to 1: r is 1/2.
    half = np.array([[1.0, -1.0, 0.0, 0.0], [1.0, 0.0, -1.0, 0.0]])
    assert scan_correlations(half).tolist() == [0.5]
    assert novelty_profile(half, 2, 0.5).tolist() == [0.0]
    assert novelty_profile(half, 2, math.nextafter(0.5, 0)).tolist() == [1.0]


def test_the_reports_worked_examples():
    assert round(boredom_quotient(420, 50), 2) == 0.34
    assert is_novel(boredom_quotient(420, 50), 0.75)
    assert boredom_quotient(1176, 50) == 0.96
    assert not is_novel(boredom_quotient(1176, 50), 0.75)


def test_the_threshold_is_strict():
    assert is_novel(0.75, 0.75)
    assert not is_novel(math.nextafter(0.75, 1), 0.75)


@pytest.mark.parametrize("advance", ["sliding", "tumbling"])
def test_a_log_shorter_than_one_interval_has_no_quotient(advance):
    assert novelty_profile(np.ones((49, 4)), advance=advance).shape == (0,)
    assert novelty_profile(np.ones((0, 4)), advance=advance).shape == (0,)
    assert novelty_profile(np.ones((99, 4)), advance=advance).shape == (
        (50,) if advance == "sliding" else (1,)
    )


def test_constant_scans_are_the_same_only_when_equal():
    varied = [1.0, 2.0, 4.0]
    pairs = scan_correlations(np.array([[2.0] * 3, [2.0] * 3, [3.0] * 3, varied]))
    assert pairs.tolist() == [1, 0, 0, 0, 0, 0]


def test_partly_invalid_scans_are_compared_over_their_common_beams():
    nan, inf = math.nan, math.inf
    table = np.array([
        [1, 2, 4, nan, 7], [1, 2, 4, 9, inf], [nan, nan, nan, 1, 2], [5, 5, nan, nan, 1],
    ])  # fmt: skip
    ab, ac, ad, bc, bd, cd = scan_correlations(table)
    assert ab == 1.0  # equal over the first three beams
    assert ac == 0.0  # one common beam
    assert ad == pytest.approx(np.corrcoef([1, 2, 7], [5, 5, 1])[0, 1], abs=1e-15)
    assert bc == 0.0
    assert bd == 0.0  # constant over the two common beams, and not equal
    assert cd == 0.0


def test_correlation_does_not_depend_on_the_scale():
    scans = drive(2, 40, seed=1)
    (r,) = scan_correlations(scans)
    for scale in (1e-120, 1e-60, 1e60, 1e120):
        assert scan_correlations(scans * scale) == pytest.approx([r], rel=1e-12)
    assert scan_correlations(np.array([[1e200, 1, 2, 4], [3, 1, 2, 4.0]])).tolist() == [1.0]


def test_scans_that_differ_in_their_last_bits_are_still_correlated_rightly():
    # 1000.1 + k ulp has the correlations of k; the mean alone is rounded by more than that.
    rng = np.random.default_rng(0)
    steps = rng.integers(0, 4, (4, 181)).astype(float)
    steps[2:] = steps[:2] + (rng.uniform(size=(2, 181)) < 0.1)
    scans = 1000.1 + steps * np.spacing(1000.1)
    expected = np.corrcoef(steps)[np.triu_indices(4, 1)]
    assert scan_correlations(scans) == pytest.approx(expected, abs=1e-12)


def test_the_detectors_correlations_are_those_that_tau_counts():
    scans = drive(130, 20, seed=3)
    for advance in ("sliding", "tumbling"):
        detector = NoveltyDetector(50, 0.99, advance)
        assert detector.correlations().size == 0
        for k, scan in enumerate(scans):
            tau = detector.update(scan)
            if tau is not None:
                held = detector.correlations()
                assert held.shape == (1225,)
                assert np.count_nonzero(held > 0.99) / 1225 == tau
                assert held.tolist() == scan_correlations(scans[k - 49 : k + 1]).tolist()
        in_hand = 50 if advance == "sliding" else 30
        assert detector.correlations().size == in_hand * (in_hand - 1) // 2


def test_a_reset_detector_may_take_scans_of_another_size():
    detector = NoveltyDetector(2)
    detector.update([1.0, 2.0, 3.0])
    with pytest.raises(ScanError, match="4 beams; the interval began with 3"):
        detector.update([1.0, 2.0, 3.0, 4.0])
    assert detector.update([1.0, 2.0, 3.0]) == 1.0  # the refused scan left no trace
    detector.reset()
    assert detector.update([1.0, 2.0, 3.0, 4.0]) is None
    assert detector.update([4.0, 3.0, 2.0, 1.0]) == 0.0


def test_inputs_are_not_changed_and_may_be_of_any_numeric_kind():
    scans = np.rint(drive(120, 12, seed=2, step=1.0) * 100)
    expected = novelty_profile(scans, 10)
    frozen = scans.copy()
    frozen.flags.writeable = False
    others = (frozen, scans.astype(np.int64), scans.astype(np.float32), scans[:, ::-1])
    for other in (*others, np.asfortranarray(scans), scans.tolist()):
        assert novelty_profile(other, 10).tolist() == expected.tolist()
        assert streamed(other, 10, 0.99, "sliding") == expected.tolist()
    assert np.array_equal(frozen, scans)


def test_a_scan_handed_in_may_be_overwritten_afterwards():
    scans = drive(60, 12, seed=4)
    shared = np.empty(12)
    detector = NoveltyDetector(10)
    taus = []
    for scan in scans:
        shared[:] = scan
        taus.append(detector.update(shared))
        shared[:] = -1
    assert taus[9:] == novelty_profile(scans, 10).tolist()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"interval": 1}, "interval is 1; expected a whole number of scans, 2 or more"),
        ({"interval": 2.5}, "interval is 2.5"),
        ({"interval": "many"}, "interval is 'many'"),
        ({"gradient": 99}, "gradient is 99; expected a fraction above 0 and below 1"),
        ({"gradient": math.nan}, "gradient is nan"),
        ({"advance": "slide"}, "expected one of sliding, tumbling; did you mean 'sliding'"),
    ],
)
def test_settings_out_of_range_are_refused_by_both_twins(arguments, message):
    with pytest.raises(SettingsError, match=message):
        novelty_profile(np.ones((60, 3)), **arguments)
    with pytest.raises(SettingsError, match=message):
        NoveltyDetector(**arguments)


@pytest.mark.parametrize(
    ("scans", "message"),
    [
        (np.ones(5), r"scans have shape \(5,\); expected \(scans, beams\)"),
        (np.ones((60, 0)), r"shape \(60, 0\)"),
        ([[1.0, 2.0], [1.0]], "not a table of numbers"),
        ([["a", "b"]], "expected ranges in metres"),
    ],
)
def test_what_is_not_a_table_of_ranges_is_refused(scans, message):
    with pytest.raises(ScanError, match=message) as caught:
        novelty_profile(scans)
    assert isinstance(caught.value, SsricsError)
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize("ranges", [[], 3.0, [[1.0, 2.0]], ["near", "far"]])
def test_what_is_not_a_scan_is_refused(ranges):
    with pytest.raises(ScanError):
        NoveltyDetector().update(ranges)
