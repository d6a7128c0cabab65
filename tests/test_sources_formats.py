"""What each format's lines mean: poses, units, angles, beam order, odd variants."""

import math

import numpy as np
import pytest

from ssrics_like.perception.observation import Pose
from ssrics_like.sources import open_log
from ssrics_like.sources.angles import fan
from ssrics_like.sources.mm_rows import MmRowsReader


@pytest.fixture
def read(tmp_path):
    def _read(text, **arguments):
        path = tmp_path / "hand.log"
        path.write_text(text, encoding="ascii")
        source = open_log(path, **arguments)
        return list(source), source.report

    return _read


@pytest.mark.parametrize(
    ("beams", "first", "last"),
    [(180, -90, 89), (181, -90, 90), (360, -90, 89.5), (361, -90, 90), (91, -90, 90)],
)  # fmt: skip
def test_bearings_follow_from_the_beam_count(beams, first, last):
    start, step = fan(beams)
    assert math.degrees(start) == pytest.approx(first)
    assert math.degrees(start + (beams - 1) * step) == pytest.approx(last)


def test_flaser_gives_the_laser_pose_and_ipc_time(read):
    seen, _ = read("FLASER 3 1 2.5 4 1.5 -2 0.25 1 -2.5 0.3 12.5 host 99\n")
    assert seen[0].pose == Pose(1.5, -2.0, 0.25)
    assert seen[0].t_s == 12.5
    assert seen[0].true_pose is None
    np.testing.assert_array_equal(seen[0].scan.ranges_m, [1, 2.5, 4])
    np.testing.assert_allclose(np.degrees(seen[0].scan.bearings_rad), [-90, 0, 90])


def test_logger_time_stands_in_for_an_unusable_ipc_time(read):
    text = "".join(f"FLASER 2 1 1 0 0 0 0 0 0 1e9 h {k * 0.5}\n" for k in range(4))
    seen, report = read(text)
    assert [o.t_s for o in seen] == [0, 0.5, 1, 1.5]
    assert (report.timing.usable, report.timing.column) == (True, "logger_time")
    assert report.warnings() == []


def test_a_time_that_is_no_number_does_not_cost_the_scan(read):
    times = ["0", "0.1", "soon", "0.3", "0.4"]
    seen, report = read("".join(f"FLASER 2 1 1 0 0 0 0 0 0 {t} h {t}\n" for t in times))
    assert [o.t_s for o in seen] == pytest.approx([0, 0.1, 0.101, 0.3, 0.4])
    assert report.timing.repaired == 1


ROBOT = "0 -1.2 2.4 0.8 30.0 0.1 0 4 1 2 3 4{} 1 2 0.5 0.9 2 0.5 0 0 0 0 0 {} x 7\n"


@pytest.mark.parametrize("remissions", ["", " 0", " 4 10 11 12 13"])
def test_robotlaser_with_and_without_remissions(read, remissions):
    seen, report = read("".join("ROBOTLASER1 " + ROBOT.format(remissions, t) for t in (5, 6)))
    assert report.malformed == 0
    assert [o.t_s for o in seen] == [5, 6]
    assert seen[0].pose == Pose(1.0, 2.0, 0.5)
    np.testing.assert_array_equal(seen[0].scan.ranges_m, [1, 2, 3, 4])
    np.testing.assert_allclose(seen[0].scan.bearings_rad, [-1.2, -0.4, 0.4, 1.2])


def test_robotlaser_without_resolution_spreads_its_field_of_view(read):
    line = "ROBOTLASER1 " + ROBOT.format(" 0", 5).replace(" 0.8 ", " 0 ")
    assert read(line)[0][0].scan.angle_increment_rad == pytest.approx(0.8)


def test_robotlaser_with_a_wrong_remission_count_is_malformed(read):
    good = "ROBOTLASER1 " + ROBOT.format(" 0", 5)
    _, report = read(good + "ROBOTLASER1 " + ROBOT.format(" 3 1 2", 6) + good)
    assert report.malformed == 1
    assert "4 beams and 3 remissions" in report.examples[0]


def test_rear_laser_and_other_records_are_skipped_and_counted(read):
    flaser = "FLASER 2 1 1 0 0 0 0 0 0 {} h 0\n"
    text = flaser.format(1) + "RLASER 2 1 1 0 0 0 0 0 0 1 h 0\n" * 3 + "SONAR 1 2 3\n"
    seen, report = read(text + "SYNC x\nTRUEPOS 1 2 3\n" + flaser.format(2))
    assert len(seen) == 2
    assert report.skipped == {"RLASER": 3, "SONAR": 1}
    assert report.warnings() == ["3 RLASER records skipped.", "1 SONAR record skipped."]


def test_a_sweep_logged_twice_counts_once(read):
    both = "ROBOTLASER1 " + ROBOT.format("", 5) + "FLASER 4 1 2 3 4 1 2 0 1 2 0 5 h 5\n"
    seen, report = read(both + both.replace(" 5 ", " 6 "))
    assert len(seen) == 2
    assert report.skipped == {"FLASER": 2}


def test_cmu_is_in_centimetres_and_at_the_laser(read):
    text = "O 100 200 0.5 0.9\n" + "".join(
        f"L 100 200 0.5 125 200 0.5 {' '.join(['64'] * 90 + ['8183'] * 90)} {t}\n" for t in (1, 2)
    )
    seen, report = read(text)
    assert seen[0].pose == Pose(1.25, 2.0, 0.5)
    assert seen[1].t_s == 2
    assert seen[0].scan.ranges_m[0] == 0.64  # right
    assert np.isinf(seen[0].scan.ranges_m[90:]).all()  # left
    assert report.no_return == 180
    assert report.no_return_share == 0.5


def test_vertex_pose_wins_over_the_pose_in_its_record(read):
    record = "ROBOTLASER1 " + ROBOT.format(" 0", 5)
    seen, report = read(f"VERTEX2 0 7 8 0.9\n{record}")
    assert seen[0].pose == Pose(7, 8, 0.9)
    assert report.notes == []


def test_scans_without_a_vertex_of_their_own_use_their_record(read):
    vertices = "".join(f"VERTEX2 {k} {k} 0 0\n" for k in range(3))
    records = "".join("ROBOTLASER1 " + ROBOT.format(" 0", t) for t in range(3))
    seen, report = read(vertices + "EDGE2 0 1 1 0 0 1 1 1\n" + records)
    assert {o.pose for o in seen} == {Pose(1, 2, 0.5)}
    assert report.notes[0].startswith("3 scans have no VERTEX2 line")


def test_dpslam_pairs_each_laser_with_the_odometry_before_it(read):
    laser = f"Laser 181 {' '.join(['1.5'] * 181)} \n"
    seen, report = read(laser + f"Odometry 1 2 0.5 \n{laser}{laser}Odometry 3 4 1 \n{laser}")
    assert [o.pose.x_m for o in seen] == [1, 1, 3]
    assert [o.t_s for o in seen] == pytest.approx([0, 0.1, 0.2])
    assert report.examples == ["hand.log:1: Laser stands before the first Odometry"]
    assert report.warnings()[1] == (
        "The log's times are not given: the scans are timed at 10 per second "
        "in the order of the file."
    )


def test_the_fallback_rate_is_the_callers(read):
    text = "Odometry 0 0 0\nLaser 3 1 1 1\n" * 3
    seen, report = read(text, fallback_rate_hz=4)
    assert [o.t_s for o in seen] == [0, 0.25, 0.5]
    assert "4 per second" in report.warnings()[0]


def row(microseconds, left, right, ranges):
    return f"{microseconds} 14710 {left} {right} {'0 ' * 21} {' '.join(map(str, ranges))} \n"


def test_mm_rows_scan_geometry_and_error_codes(read):
    ranges = [1500] * 682
    ranges[340] = 2500  # step 384, straight ahead
    ranges[100] = 0
    ranges[101] = 6
    seen, _ = read(row(2_500_000, 0, 0, ranges))
    scan = seen[0].scan
    assert scan.bearings_rad[340] == pytest.approx(0)
    assert scan.ranges_m[340] == 2.5
    assert np.degrees(scan.bearings_rad[[0, -1]]) == pytest.approx([-119.53, 119.88], abs=0.01)
    assert np.isinf(scan.ranges_m[100])
    assert np.isnan(scan.ranges_m[101])
    assert np.isnan(scan.ranges_m[:70]).all()
    assert np.isnan(scan.ranges_m[-70:]).all()
    assert np.isfinite(scan.ranges_m[102:-70]).all()
    assert seen[0].t_s == 2.5


def test_mm_rows_with_24_header_columns_end_with_the_same_readings():
    ranges = " ".join(str(1000 + k) for k in range(682))
    short = MmRowsReader().parse(f"{'0 ' * 24}{ranges}".encode())
    longer = MmRowsReader().parse(f"{'0 ' * 25}{ranges}".encode())
    np.testing.assert_array_equal(short.ranges_m, longer.ranges_m)


def test_mm_rows_pose_is_integrated_from_the_wheels(read):
    ranges = [1500] * 682
    # 2000 counts a turn of a 77 mm wheel: straight on, then a half turn on the spot.
    metre = 2000 / (2 * math.pi * 0.077)
    half_turn = math.pi * 0.165 * metre
    counts = [(0, 0), (metre, metre), (metre - half_turn, metre + half_turn)]
    seen, report = read("".join(row(k * 100_000, a, b, ranges) for k, (a, b) in enumerate(counts)))
    ahead = 0.145
    assert seen[0].pose == Pose(ahead, 0, 0)
    assert seen[1].pose.x_m == pytest.approx(1 + ahead)
    assert seen[2].pose.theta_rad == pytest.approx(math.pi)
    assert seen[2].pose.x_m == pytest.approx(1 - ahead)
    assert seen[2].pose.y_m == pytest.approx(0, abs=1e-9)
    assert "wheel encoders" in report.warnings()[0]


def test_mm_rows_a_jump_of_the_counters_is_no_drive(read):
    ranges = [1500] * 682
    counts = [(0, 0), (10, 10), (1e9, 1e9), (1e9 + 10, 1e9 + 10)]
    seen, report = read("".join(row(k * 100_000, a, b, ranges) for k, (a, b) in enumerate(counts)))
    assert seen[2].pose == seen[1].pose
    assert seen[3].pose.x_m - seen[2].pose.x_m == pytest.approx(seen[1].pose.x_m - seen[0].pose.x_m)
    assert "jumped 1 times" in report.notes[1]


def test_a_row_of_another_width_is_malformed(read):
    ranges = [1500] * 682
    good = row(0, 0, 0, ranges)
    seen, report = read(good + row(1, 0, 0, [*ranges, 1]) + good.replace("0", "1", 1))
    assert len(seen) == 2
    assert report.examples == ["hand.log:2: row of 708 columns, expected 707; it begins with '1'"]
