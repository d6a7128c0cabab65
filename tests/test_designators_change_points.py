"""Change points in hindsight, with the library that finds them."""

import numpy as np
import pytest
from designator_drives import ROOM, spots, straight

from ssrics_like.designators import designate, designator_kind, make_designator

pytest.importorskip("ruptures")

NARROW = np.full(ROOM.size, 0.9)


def stretches(x):
    return NARROW if 8.0 - 1e-6 <= x < 16.0 - 1e-6 else ROOM


def test_changes_are_marked_where_they_came_when_the_drive_is_over():
    drive = straight(24.0, ranges=stretches)
    online = make_designator("change-points")
    assert [mark for seen in drive for mark in online.update(seen)] == []
    marks = online.flush()
    assert spots(drive, marks)[:, 0] == pytest.approx([8.0, 16.0], abs=0.2)
    assert {mark.decided_scan for mark in marks} == {len(drive) - 1}
    assert designator_kind("change-points").hindsight


def test_the_strength_is_the_distance_of_the_means_in_the_space_of_the_kernel():
    """Two pieces, each of equal data: |phi(a) - phi(b)|^2 = 2 - 2 k(a, b)."""
    drive = straight(16.0, ranges=lambda x: ROOM if x < 8.0 - 1e-6 else NARROW)
    (mark,) = designate(make_designator("change-points", width=2.0), drive)
    # Each feature that changes takes two values as often: about 2 deviations apart; those
    # that do not change add nothing. Spread and roughness are 0 in a uniform scan.
    data, changing = 7, 5
    expected = 2.0 - 2.0 * np.exp(-changing * 2.0**2 / (data * 2.0**2))
    assert mark.strength == pytest.approx(expected, rel=0.02)


def test_a_drive_without_a_change_or_too_short_for_one_has_no_mark():
    assert designate(make_designator("change-points"), straight(10.0)) == []
    assert designate(make_designator("change-points"), straight(1.0, ranges=stretches)) == []
    assert designate(make_designator("change-points"), []) == []


def test_a_higher_penalty_makes_fewer_marks():
    rng = np.random.default_rng(0)
    levels = rng.uniform(0.8, 5.0, 20)
    drive = straight(39.0, ranges=lambda x: np.full(ROOM.size, levels[int(x / 2.0)]))
    counts = [
        len(designate(make_designator("change-points", penalty=penalty), drive))
        for penalty in (0.1, 2.0, 50.0)
    ]
    assert counts[0] > counts[1] > counts[2] == 0
