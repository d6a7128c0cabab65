"""The doorway gap in simulated buildings whose doors are known."""

import csv
import math

import numpy as np
import pytest
from buildings import DOOR, exact_laser, offices, room, two_rooms
from designator_drives import driven, observation, spots, travelled

from ssrics_like.designators import designate, make_designator
from ssrics_like.sources import open_log

THROUGH = [(1.0, 1.5), (5.0, 1.5)]
LASERS = {
    "180 beams": exact_laser(),
    "361 beams": exact_laser(361, 180.5),
    "240 degrees": exact_laser(682, 240.0),
    "all round": exact_laser(360, 360.0),
    "few beams": exact_laser(91, 182.0),
    "8 m": exact_laser(range_max_m=8.0),
}


def marked(drive, **chosen):
    return designate(make_designator("doorway-gap", **chosen), drive)


@pytest.mark.parametrize("laser", LASERS.values(), ids=LASERS)
def test_a_doorway_is_marked_where_it_is(laser):
    drive = driven(two_rooms(), THROUGH, laser)
    marks = marked(drive)
    assert len(marks) == 1
    assert spots(drive, marks)[0] == pytest.approx(DOOR, abs=0.2)
    # The gap is 0.9 m; what is narrower than 1.2 m has the difference for its strength.
    assert marks[0].strength == pytest.approx(0.3, abs=0.06)
    at_m = travelled(drive)
    assert 0.5 < at_m[marks[0].decided_scan] - at_m[marks[0].scan] <= 1.0


@pytest.mark.parametrize(("door_m", "max_gap_m", "found"), [
    (0.9, 1.2, 1), (0.9, 0.8, 0), (1.4, 1.2, 0), (1.4, 1.6, 1), (1.1, 1.2, 1), (2.4, 1.6, 0),
])  # fmt: skip
def test_a_gap_wider_than_allowed_is_none(door_m, max_gap_m, found):
    drive = driven(two_rooms(door_m), THROUGH)
    assert len(marked(drive, max_gap_m=max_gap_m)) == found


def test_a_doorway_crossed_obliquely_is_as_narrow():
    start, end = (DOOR[0] - 1.1, DOOR[1] - 0.8), (DOOR[0] + 1.1, DOOR[1] + 0.8)
    drive = driven(two_rooms(), [start, DOOR, end])
    marks = marked(drive)
    assert len(marks) == 1
    assert spots(drive, marks)[0] == pytest.approx(DOOR, abs=0.25)


def test_a_narrow_corridor_has_no_neck_but_a_pinch_in_it_is_one():
    corridor = room(10.0, 1.1 + 0.2)  # 1.1 m between the walls
    assert marked(driven(corridor, [(0.6, 0.65), (9.4, 0.65)])) == []
    pinch = room(10.0, 1.3, walls=[(5.0, 0.0, 5.1, 0.25), (5.0, 1.05, 5.1, 1.3)])
    drive = driven(pinch, [(0.6, 0.65), (9.4, 0.65)])
    assert spots(drive, marked(drive, widen_m=0.2))[:, 0] == pytest.approx([5.05], abs=0.2)
    assert marked(drive, widen_m=0.5) == []


def test_every_passage_of_an_office_door_is_marked():
    """Out of one office, along the corridor, and into another: doors at x = 2.45 and 6.65."""
    way = [(2.45, 1.0), (2.45, 3.0), (6.65, 3.0), (6.65, 5.0)]
    drive = driven(offices(), way)
    places = spots(drive, marked(drive))
    assert places == pytest.approx(np.array([(2.45, 2.15), (6.65, 3.85)]), abs=0.25)


@pytest.mark.parametrize("keep", [4, 6])
def test_between_sparse_scans_a_doorway_is_found_too(keep):
    """Scans 0.35 and 0.53 m apart, as in logs of key frames."""
    dense = driven(two_rooms(), THROUGH)
    drive = [
        observation(k, (o.pose.x_m, o.pose.y_m, o.pose.theta_rad), o.scan.ranges_m)
        for k, o in enumerate(dense[::keep])
    ]
    assert 0.3 < np.diff(travelled(drive)).max() < 0.6
    places = spots(drive, marked(drive))
    assert places == pytest.approx(np.array([DOOR]), abs=0.35)


def test_dropouts_and_beams_without_an_answer_hide_no_door():
    rng = np.random.default_rng(0)
    drive = []
    for seen in driven(two_rooms(), THROUGH):
        ranges = seen.scan.ranges_m + rng.normal(0.0, 0.02, seen.scan.ranges_m.size)
        lost = rng.uniform(size=ranges.size)
        ranges[lost < 0.05] = math.inf
        ranges[lost < 0.02] = math.nan
        pose = (seen.pose.x_m, seen.pose.y_m, seen.pose.theta_rad)
        drive.append(observation(seen.index, pose, ranges))
    assert spots(drive, marked(drive)) == pytest.approx(np.array([DOOR]), abs=0.25)


def test_only_the_shape_of_the_path_counts_not_where_or_how_it_lies():
    drive = driven(two_rooms(), THROUGH)
    moved = []
    for seen in drive:
        x, y, turn = seen.pose.x_m, seen.pose.y_m, 2.0
        pose = (
            30.0 + x * math.cos(turn) - y * math.sin(turn),
            -9.0 + x * math.sin(turn) + y * math.cos(turn),
            seen.pose.theta_rad + turn,
        )
        moved.append(observation(seen.index, pose, seen.scan.ranges_m))
    assert [m.scan for m in marked(moved)] == [m.scan for m in marked(drive)] != []


def test_being_carried_into_a_doorway_makes_no_neck_of_two_places():
    """The free width of one place says nothing about another 20 m away."""
    before = driven(room(6.0, 3.0), [(1.0, 1.5), (3.0, 1.5)])
    after = driven(two_rooms(), [(3.0, 1.5), (5.0, 1.5)])
    drive = [*before]
    for k, seen in enumerate(after):
        pose = (seen.pose.x_m + 20.0, seen.pose.y_m, seen.pose.theta_rad)
        drive.append(observation(len(before) + k, pose, seen.scan.ranges_m))
    assert marked(drive) == []


def test_every_passage_of_a_narrow_door_of_a_real_building_is_found(data_dir):
    """Intel Research Lab: a scan every 0.16 m, doors that were labelled surely, up to 1.2 m."""
    truth = data_dir / "truth" / "intel_lab"
    with (truth / "truth.csv").open(encoding="utf-8") as file:
        narrow = {
            row["id"]
            for row in csv.DictReader(file)
            if row["kind"] == "doorway"
            and row["confidence"] == "sure"
            and float(row["width_m"] or 9.0) <= 1.2
        }
    with (truth / "crossings.csv").open(encoding="utf-8") as file:
        passages = [(row["id"], int(row["scan"])) for row in csv.DictReader(file)]
    marks = marked(open_log(data_dir / "logs" / "intel-lab.log.gz"))
    scans = np.array([mark.scan for mark in marks])
    expected = [scan for door, scan in passages if door in narrow]
    assert len(expected) >= 18
    assert all(np.abs(scans - scan).min() <= 5 for scan in expected)
    doorways = np.array([scan for door, scan in passages if door.startswith("D")])
    assert np.mean([np.abs(doorways - scan).min() <= 6 for scan in scans]) > 0.7
