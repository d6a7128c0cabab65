"""Reflexes along the way: a doorway is seen once each time, wherever, however fast, however turned."""

import math
from dataclasses import replace

import numpy as np
import pytest
from buildings import DOOR, Along, exact_laser, exact_robot, line, simulated, two_rooms

from ssrics_like.memory.surroundings import agreement
from ssrics_like.perception import LaserScan, Observation, PerceptionBuffer, PerceptionProfile, Pose
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.gap import FEATURES
from ssrics_like.perception.panorama import BEAMS, panorama
from ssrics_like.perception.trees import BoostedTrees

WIDTH, WALLS = FEATURES.index("width_m"), FEATURES.index("wall_in_all_lesser")


def narrower(width_m):
    """Make a cue for which whatever is narrower and has walls on both sides is a doorway."""
    return DoorwayCue(
        BoostedTrees(
            -2.0, np.array([0], np.int32), np.array([WIDTH, WALLS, -1, -1, -1], np.int32),
            np.array([width_m, 0.35, 0.0, 0.0, 0.0]), np.array([1, 2, 0, 0, 0], np.int32),
            np.array([4, 3, 0, 0, 0], np.int32), np.array([0.0, 0.0, 0.0, 6.0, 0.0]),
        ),
        0.5,
    )  # fmt: skip


NARROW = narrower(1.2)
ALONG = PerceptionProfile(along="metres", doorways="narrow", interval=12)
THERE = line((1.0, 1.5), (5.0, 1.5))


def drive(places=THERE, laser=None, grid=None, **changes):
    robot = exact_robot(laser or exact_laser(), **changes)
    return list(simulated(grid or two_rooms(), robot, (*places[0], 0.0), [Along(places)]))


def reflexes(observations, profile=ALONG, cue=NARROW):
    buffer = PerceptionBuffer(profile, cue)
    fired = []
    for observation in observations:
        fired += [(reflex, observation) for reflex in buffer.update(observation)]
    return fired + [(reflex, observations[-1]) for reflex in buffer.flush()], buffer


def doorways(observations):
    return [(r, now) for r, now in reflexes(observations)[0] if r.structure == "doorway"]


@pytest.mark.parametrize(
    ("rate_hz", "speed_m_s"), [(5.0, 0.9), (10.0, 0.9), (40.0, 0.9), (10.0, 0.45), (10.0, 1.8)]
)
def test_a_doorway_is_seen_once_where_it_is_and_soon_whatever_speed_and_rate(rate_hz, speed_m_s):
    seen = doorways(drive(laser=exact_laser(rate_hz=rate_hz), speed_m_s=speed_m_s))
    assert len(seen) == 1
    reflex, now = seen[0]
    assert math.hypot(reflex.pose.x_m - DOOR[0], reflex.pose.y_m - DOOR[1]) <= 0.3
    spacing_m = speed_m_s / rate_hz
    driven_m = math.hypot(now.pose.x_m - reflex.pose.x_m, now.pose.y_m - reflex.pose.y_m)
    assert 0.6 <= driven_m <= 0.7 + spacing_m + 0.05
    assert reflex.perceived_s == now.t_s
    assert 0.0 <= reflex.novelty <= 1.0


def test_each_passage_is_seen():
    there_and_back = np.concatenate([THERE, line((5.0, 1.5), (1.0, 1.5))])
    seen = doorways(drive(there_and_back))
    assert [round(r.pose.x_m) for r, _ in seen] == [3, 3]
    assert seen[0][0].travelled_m < 3.0
    assert seen[1][0].travelled_m > 5.0


@pytest.mark.parametrize("egomotion", ["odometry", "laser"])
@pytest.mark.parametrize("aside_m", [-0.15, 0.0, 0.15])
def test_a_doorway_has_one_place_however_it_is_passed(aside_m, egomotion):
    there = line((1.0, 1.5 - aside_m), (5.0, 1.5 + aside_m))
    back = line((5.0, 1.5 + aside_m), (1.0, 1.5 - aside_m))
    profile = ALONG.model_copy(update={"egomotion": egomotion})
    fired, _ = reflexes(drive(np.concatenate([there, back])), profile)
    seen = [reflex for reflex, _ in fired if reflex.structure == "doorway"]
    assert len(seen) == 2
    for reflex, through in zip(seen, (0.0, math.pi), strict=True):
        assert math.hypot(reflex.place.x_m - DOOR[0], reflex.place.y_m - DOOR[1]) <= 0.08
        assert abs(math.remainder(reflex.place.theta_rad - through, math.tau)) <= 0.05
        assert reflex.directed
    assert seen[1].turned_rad - seen[0].turned_rad >= 0.9 * math.pi


def test_without_a_doorway_there_is_none_and_rooms_and_corridors_have_their_names():
    wide = drive(grid=two_rooms(2.9))
    assert doorways(wide) == []
    fired, _ = reflexes(wide, ALONG.model_copy(update={"mark": "every", "gradient": 0.999}))
    middle = [r.structure for r, _ in fired if 2.2 < r.pose.x_m < 3.8]
    assert len(middle) >= 5
    assert set(middle) == {"corridor"}  # 2.8 m from wall to wall


def test_without_a_cue_structure_is_unknown():
    fired, buffer = reflexes(
        drive(), ALONG.model_copy(update={"doorways": "", "mark": "every"}), None
    )
    assert {r.structure for r, _ in fired} == {"unknown"}
    assert buffer.intervals > 10


def test_a_profile_and_its_cue_come_together():
    with pytest.raises(ValueError, match="expected that cue"):
        PerceptionBuffer(ALONG)
    with pytest.raises(ValueError, match="expected no cue"):
        PerceptionBuffer(PerceptionProfile(), NARROW)


def test_a_robot_that_stands_or_turns_on_the_spot_perceives_nothing():
    scan = LaserScan(np.full(180, 3.0), -math.pi / 2, math.pi / 180)
    buffer = PerceptionBuffer(ALONG, NARROW)
    for i in range(500):
        assert buffer.update(Observation(i, 0.1 * i, Pose(1.0, 1.0, 0.05 * i), scan)) == []
    assert buffer.flush() == []
    assert buffer.intervals == 0


def test_a_change_of_the_laser_in_the_middle_loses_no_doorway():
    first = drive()
    other = drive(laser=exact_laser(90, 180.0))
    mixed = [o if o.pose.x_m < 2.5 else p for o, p in zip(first, other, strict=True)]
    assert len(doorways(mixed)) == 1


def test_turning_a_scan_turns_its_panorama_back():
    rng = np.random.default_rng(0)
    world = rng.uniform(1.0, 5.0, BEAMS)
    bearings = np.radians(np.arange(-90.0, 90.0))
    for turn in (0, 17, 90, 200, -33):
        seen = world[(np.arange(-90, 90) + turn) % BEAMS]
        around = panorama(seen, bearings, math.radians(turn))
        known = ~np.isnan(around)
        assert known.sum() == 180
        assert (around[known] == world[known]).all()


@pytest.mark.parametrize("rate_hz", [2.5, 10.0])
def test_no_peak_of_novelty_takes_a_doorways_place(rate_hz):
    there_and_back = np.concatenate([THERE, line((5.0, 1.5), (1.0, 1.5))])
    observations = drive(there_and_back, exact_laser(rate_hz=rate_hz))
    fired, _ = reflexes(observations, ALONG.model_copy(update={"mark": "every"}))
    at = [r.travelled_m for r, _ in fired if r.structure == "doorway"]
    assert len(at) == 2
    moments = [now.index for _, now in fired]
    for reflex, now in fired[:-1]:
        if reflex.structure == "doorway":
            assert moments.count(now.index) == 1
            later = [r.travelled_m for r, then in fired if then.index > now.index]
            assert all(abs(m - reflex.travelled_m) >= 0.8 for m in later)


AROUND = ALONG.model_copy(update={"view": "surroundings"})


def seen_around(places, grid=None, cue=NARROW):
    """Return the views of the doorway, by the way that is driven."""
    fired, _ = reflexes(drive(places, grid=grid), profile=AROUND, cue=cue)
    return [reflex for reflex, _ in fired if reflex.structure == "doorway"]


def test_what_surrounds_a_doorway_is_looked_at_from_its_middle_along_the_way_through():
    (reflex,) = seen_around(THERE)
    assert reflex.directed
    assert reflex.view.shape == (AROUND.view_length,)
    lengths, unknown, vista = reflex.view.reshape(3, -1)
    ahead, aside = lengths[0], lengths[9]
    assert ahead == pytest.approx(2.9, abs=0.2)  # to the wall of the room behind
    assert aside == pytest.approx(0.45, abs=0.15)  # to the jamb
    assert unknown[0] < 1.0
    assert unknown[18] > 1.0  # the wall behind its start was never seen
    assert not vista.any()  # nothing is so far away


def test_from_the_other_side_it_is_the_same_half_a_turn_aside():
    (there,), (back,) = seen_around(THERE), seen_around(line((5.0, 1.5), (1.0, 1.5)))
    alike = agreement(there.view, back.view[None])[0]
    assert alike > 0.8


@pytest.mark.parametrize("slant", [-0.9, -0.5, 0.5, 0.9])
def test_a_doorway_that_is_entered_at_a_slant_lies_where_it_is(slant):
    """As far as that is possible through so narrow a doorway, up to 42 degrees."""
    (reflex,) = seen_around(line((1.8, 1.5 - 1.2 * slant), (4.2, 1.5 + 1.2 * slant)))
    assert reflex.directed
    assert math.hypot(reflex.place.x_m - DOOR[0], reflex.place.y_m - DOOR[1]) <= 0.1
    assert abs(reflex.place.theta_rad) <= 0.12


THERE_AND_BACK = np.vstack([line((1.0, 1.5), (3.1, 1.5)), line((3.1, 1.45), (1.0, 1.45))])


def test_a_doorway_that_the_robot_turns_back_in_lies_where_it_is():
    (through,), seen = seen_around(THERE), seen_around(THERE_AND_BACK)
    assert seen
    for reflex in seen:
        assert reflex.directed
        assert math.hypot(reflex.place.x_m - DOOR[0], reflex.place.y_m - DOOR[1]) <= 0.1
        assert abs(math.remainder(reflex.place.theta_rad, math.pi)) <= 0.05
        assert agreement(reflex.view, through.view[None])[0] > 0.8


def test_a_gap_wider_than_doorways_that_the_robot_turns_back_in_has_neither_direction_nor_view():
    seen = seen_around(THERE_AND_BACK, grid=two_rooms(1.8), cue=narrower(2.0))
    assert seen
    for reflex in seen:
        assert not reflex.directed
        assert np.isnan(agreement(reflex.view, reflex.view[None])).all()
    through = seen_around(THERE, grid=two_rooms(1.8), cue=narrower(2.0))
    assert [reflex.directed for reflex in through] == [True]


@pytest.mark.parametrize("jump_m", [8.0, 15.0])
def test_of_a_doorway_that_the_robot_was_carried_away_from_nothing_more_is_known(jump_m):
    """The map is another one by the time at which it is decided that it was a doorway."""
    carried = [
        replace(o, pose=Pose(o.pose.x_m, o.pose.y_m + jump_m, o.pose.theta_rad))
        if o.pose.x_m > 3.45
        else o
        for o in drive()
    ]
    fired, _ = reflexes(carried, profile=AROUND)
    (reflex,) = [reflex for reflex, _ in fired if reflex.structure == "doorway"]
    assert not reflex.directed
    assert np.isnan(agreement(reflex.view, reflex.view[None])).all()
    assert math.hypot(reflex.pose.x_m - DOOR[0], reflex.pose.y_m - DOOR[1]) <= 0.3
