"""Left, front or right: where a scan reaches farthest."""

import math

import numpy as np
import pytest

from ssrics_like.errors import SettingsError
from ssrics_like.perception import ScanError, SectorClassifier, classify

DEGREES = np.arange(-90, 91)
BEARINGS = np.radians(DEGREES)


def scan_with(*stretches, beams=181, base=1.0):
    """A wall at `base` metres with (first degree, last degree, range) stretches."""
    ranges = np.full(beams, base)
    for first, last, value in stretches:
        ranges[first + 90 : last + 91] = value
    return ranges


@pytest.mark.parametrize("rule", ["maximum", "robust"])
@pytest.mark.parametrize(
    ("first", "sector"),
    [(-80, "right"), (-40, "right"), (-10, "front"), (20, "front"), (35, "left"), (80, "left")],
)
def test_the_widest_stretch_names_the_sector(rule, first, sector):
    assert classify(scan_with((first, first + 6, 5.0)), BEARINGS, rule) == sector


@pytest.mark.parametrize(
    ("degree", "sector"), [(-31, "right"), (-30, "front"), (30, "front"), (31, "left")]
)
def test_front_includes_thirty_degrees_on_either_side(degree, sector):
    ranges = scan_with((degree, degree, 5.0))
    assert classify(ranges, BEARINGS, "maximum") == sector
    # Bearings summed up beam by beam are off by rounding only.
    summed = -math.pi / 2 + np.cumsum(np.full(181, math.pi / 180)) - math.pi / 180
    assert classify(ranges, summed, "maximum") == sector


@pytest.mark.parametrize("bad", [80.0, 0.01, math.nan, math.inf])
@pytest.mark.parametrize("beams", [181, 361, 721])
def test_no_single_bad_beam_flips_the_robust_rule(bad, beams):
    bearings = np.radians(np.linspace(-90, 90, beams))
    ranges = 2 + np.cos(bearings - 0.9)  # farthest at 52 degrees, left
    classifier = SectorClassifier(bearings, "robust")
    assert classifier.classify(ranges) == "left"
    for k in range(beams):
        spoilt = ranges.copy()
        spoilt[k] = bad
        assert classifier.classify(spoilt) == "left", k


def test_a_single_bad_beam_does_flip_the_reports_maximum():
    ranges = scan_with((40, 60, 4.0), (-70, -70, 8.0))
    assert classify(ranges, BEARINGS, "maximum") == "right"
    assert classify(ranges, BEARINGS, "robust") == "left"


def test_the_robust_rule_is_the_largest_running_median():
    rng = np.random.default_rng(1)
    for beams, half in ((181, 2), (361, 5), (37, 2)):
        bearings = np.radians(np.linspace(-90, 90, beams))
        side = np.where(np.abs(bearings) < math.radians(30) + 1e-9, 0, np.where(bearings > 0, 1, 2))
        for _ in range(50):
            ranges = rng.uniform(0.1, 8.0, beams)
            ranges[rng.uniform(size=beams) < 0.1] = math.nan
            best = [-math.inf] * 3
            for k in range(beams):
                near = ranges[max(k - half, 0) : k + half + 1]
                near = sorted(near[~np.isnan(near)])
                if not math.isnan(ranges[k]):
                    best[side[k]] = max(best[side[k]], near[(len(near) - 1) // 2])
            expected = ("front", "left", "right")[int(np.argmax(best))]
            assert classify(ranges, bearings, "robust") == expected


@pytest.mark.parametrize("rule", ["maximum", "robust"])
def test_ties_go_to_front_then_left(rule):
    left, front, right = (40, 60, 8.0), (-5, 5, 8.0), (-60, -40, 8.0)
    assert classify(scan_with(left, front, right), BEARINGS, rule) == "front"
    assert classify(scan_with(left, right), BEARINGS, rule) == "left"
    assert classify(np.full(181, 8.0), BEARINGS, rule) == "front"


@pytest.mark.parametrize("rule", ["maximum", "robust"])
def test_a_sector_out_of_view_never_wins(rule):
    for low, high, sector in ((-20, 20, "front"), (40, 90, "left"), (-90, -40, "right")):
        assert classify(np.ones(20), np.radians(np.linspace(low, high, 20)), rule) == sector
    assert classify([3.0], [1.0], rule) == "left"
    assert classify([math.nan, 3.0], [0.0, -1.0 + 2.0], rule) == "left"


@pytest.mark.parametrize("rule", ["maximum", "robust"])
def test_a_blind_scan_is_front(rule):
    assert classify(np.full(181, math.nan), BEARINGS, rule) == "front"


def test_wrong_geometry_is_refused():
    with pytest.raises(ScanError, match="bearings do not rise"):
        SectorClassifier(BEARINGS[::-1])
    with pytest.raises(ScanError, match="180 beams for 181 bearings"):
        classify(np.ones(180), BEARINGS)
    with pytest.raises(SettingsError, match="did you mean 'robust'"):
        SectorClassifier(BEARINGS, "robus")
