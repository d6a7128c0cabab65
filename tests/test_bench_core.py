"""The benchmark's parts: scoring, tuning, running, courses, what is written."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from buildings import DOOR, Along, exact_laser, exact_robot, line, simulated, two_rooms
from designator_drives import straight

from ssrics_like import CognitiveModel, load_memory, load_perception, load_productions
from ssrics_like.bench import (
    BenchSettings,
    Candidate,
    Course,
    course_names,
    curves_svg,
    make_candidates,
    make_courses,
    markdown,
    read_tuned,
    run_bench,
    score_marks,
    tuned_data,
    write_bench,
)
from ssrics_like.bench.candidates import MODELS, chosen_names
from ssrics_like.bench.conditions import CONDITIONS, Condition
from ssrics_like.bench.curves import OUR_COLOURS, THEIR_COLOURS
from ssrics_like.bench.drives import (
    TRAINING,
    TUNING,
    BenchDrive,
    OnPlan,
    Simulated,
    make_drive,
)
from ssrics_like.bench.model import ModelDesignator
from ssrics_like.bench.plans import load_plan
from ssrics_like.bench.running import f_interval
from ssrics_like.bench.tuned import Tuned, TunedDesignator
from ssrics_like.bench.tuning import at_edges, drives_of, pooled_f
from ssrics_like.comparison import Passages, Tally, Way
from ssrics_like.designators import Mark, designate, tune
from ssrics_like.errors import LibraryError, MapError, ResultsError
from ssrics_like.library import folder
from ssrics_like.maps import save_building
from ssrics_like.sources import open_log
from ssrics_like.world.building import Building
from ssrics_like.world.grid import GridMap
from ssrics_like.world.locations import Location

DOORS_AT_M = (8.0, 16.0)
TINY = Condition(rooms=2, rate_hz=2.5)
PATH_ONLY = (
    Candidate("every-metres", {"every_m": 4.0}),
    Candidate("random", {}),
    Candidate("turning", {}),
)


def corridor(doors_m=DOORS_AT_M):
    """Return a straight drive of 24 m, a scan every 5 cm, through doorways."""
    observations = tuple(straight(24.0))
    places = tuple(Location(f"D{i}", at, 0.0) for i, at in enumerate(doors_m))
    return BenchDrive(
        observations,
        "odometry",
        Way.through([(o.pose.x_m, o.pose.y_m) for o in observations]),
        places,
        np.ones(len(places), bool),
        Passages.of(range(len(places)), doors_m),
    )


def marks_at(*places_m, later_m=0.0):
    return [Mark(round(at / 0.05), round((at + later_m) / 0.05), 1.0) for at in places_m]


def tiny_courses(drives=2):
    specs = tuple(Simulated(TINY, seed) for seed in range(drives))
    sweep = [
        Course(f"over-noise {at:g}", "noise, cm", specs[:1], "over-noise", at) for at in (0, 2)
    ]
    return [Course("tiny", "tiny buildings", specs), *sweep]


@pytest.fixture(scope="module")
def bench():
    return run_bench(BenchSettings(seeds=2), PATH_ONLY, tiny_courses())


# Scoring


def test_a_perfect_designator_has_an_f_of_one_and_its_delay_is_told():
    tally = score_marks(corridor(), marks_at(*DOORS_AT_M, later_m=0.5), 1.0).tally
    assert (tally.f, tally.f_place, tally.pass_recall, tally.precision) == (1.0, 1.0, 1.0, 1.0)
    assert tally.delay_m == pytest.approx(0.5)
    assert tally.marks_per_100_m == pytest.approx(100 * 2 / 24)


def test_one_that_marks_nothing_recalls_nothing_and_has_no_precision():
    result = score_marks(corridor(), [], 1.0)
    assert result.tally.pass_recall == 0.0
    assert math.isnan(result.tally.precision)
    assert math.isnan(result.tally.f)
    assert result.found == (False, False)


def test_half_of_the_doors_and_a_false_mark_make_a_half():
    tally = score_marks(corridor(), marks_at(8.4, 12.0), 1.0).tally
    assert (tally.pass_recall, tally.precision, tally.f) == (0.5, 0.5, 0.5)
    # One place within 1 m on 24 m of path, two marks: 1 - (1 - 2/24)^2.
    figures = score_marks(corridor(), marks_at(8.4, 12.0), 1.0, draws=4000).tally.figures()
    assert figures["pass_chance"] == pytest.approx(1 - (1 - 2 / 24) ** 2, abs=0.02)


def test_the_order_of_marks_does_not_matter_and_the_radius_does():
    marks = marks_at(16.3, 8.3, 3.0)
    forth, back = score_marks(corridor(), marks, 1.0), score_marks(corridor(), marks[::-1], 1.0)
    assert forth == back
    assert score_marks(corridor(), marks, 0.2).tally.f == 0.0


# The model as a designator


def test_a_models_marks_are_decided_at_the_newest_scan_of_that_moment():
    observations = list(open_log(folder("scenarios") / "logs" / "demo.log.gz"))
    wrapped = ModelDesignator("human-like", "landmark", 0, "odometry")
    marks = [mark for o in observations for mark in wrapped.update(o)] + wrapped.flush()
    model = CognitiveModel(load_perception("human-like"), load_productions("landmark"),
                           load_memory("act-r"), seed=0)  # fmt: skip
    decisions = [d for o in observations for d in model.observe(o)] + model.finish()
    expected = [
        (d.scan, max(o.index for o in observations if o.t_s <= d.decided_s))
        for d in decisions
        if d.decision in ("declared", "recognised")
    ]
    assert [(mark.scan, mark.decided_scan) for mark in marks] == expected
    assert any(decided > scan + 1 for scan, decided in expected)


@pytest.mark.parametrize("rate_hz", [5.0, 10.0, 40.0])
@pytest.mark.parametrize("speed_m_s", [0.45, 0.9, 1.8])
def test_the_model_decides_about_a_doorway_within_a_metre_of_travel(rate_hz, speed_m_s):
    robot = exact_robot(exact_laser(rate_hz=rate_hz), speed_m_s=speed_m_s)
    there, back = line((1.0, 1.5), (5.0, 1.5)), line((5.0, 1.5), (1.0, 1.5))
    observations = list(simulated(two_rooms(), robot, (1.0, 1.5, 0.0), [Along(there), Along(back)]))
    marks = designate(ModelDesignator("human-like", "landmark", 0, "odometry"), observations)
    places = np.array([(o.true_pose.x_m, o.true_pose.y_m) for o in observations])
    way = Way.through(places)
    assert len(marks) == 2  # declared, then recognised
    for mark in marks:
        assert math.dist(places[mark.scan], DOOR) <= 0.2
        assert way.along_m[mark.decided_scan] - way.along_m[mark.scan] <= 1.0


def test_a_model_of_an_unknown_entry_is_refused_with_the_nearest_name():
    with pytest.raises(LibraryError, match="did you mean 'human-like'"):
        ModelDesignator("human-lik", "report", 0, "odometry")


# Tuning


def test_tuning_takes_the_best_of_a_grid_by_the_pooled_f():
    drives = [corridor(), corridor((8.0,))]
    best = tune(
        "every-metres",
        [drive.observations for drive in drives],
        lambda marks: pooled_f(drives, marks, 1.0),
        {"every_m": (3.0, 8.0, 5.0)},
    )
    # Every 8 m finds all three passages; its marks at 24 m, and at 16 m of the second, are false.
    assert best == {"every_m": 8.0}
    marks = [marks_at(8.0, 16.0, 24.0), marks_at(8.0, 16.0, 24.0)]
    assert pooled_f(drives, marks, 1.0) == pytest.approx(2 * 0.5 / 1.5)


def test_tuning_training_and_tests_share_no_building():
    tuning, training = drives_of(TUNING, 12), drives_of(TRAINING, 12)
    tests = [Simulated(condition, seed) for _, condition in CONDITIONS.values() for seed in (0, 1)]
    assert not {*tuning} & {*training}
    assert not {*tests} & {*tuning, *training}
    one, other = (make_drive(Simulated(TINY, 0, purpose)) for purpose in (TUNING, TRAINING))
    assert one.locations != other.locations
    conditions = [condition for _, condition in CONDITIONS.values()]
    assert [spec.condition for spec in tuning[:11]] == conditions
    assert tuning[11].condition == conditions[0]


def test_what_was_tuned_is_read_back(tmp_path):
    designators = {"every-metres": TunedDesignator(settings={"every_m": 3.0}, f=0.3, tried=5)}
    tuned = Tuned(tuning=6, training=4, radius_m=1.0, designators=designators)
    file = tmp_path / "tuned.json"
    file.write_text(json.dumps(tuned_data(tuned)))
    assert read_tuned(file, ["every-metres", *MODELS]) == tuned


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"format": "ssrics-scores"}, "format: 'ssrics-scores', expected 'ssrics-tuned'"),
        ({"version": 2}, "version: input should be 1"),
        ({"designators": {}}, "designators: lacks every-metres"),
        ({"designators": {"every-metre": {"settings": {}, "f": None, "tried": 1}}}, "did you mean"),
        (
            {"designators": {"every-metres": {"settings": {"every": 1}, "f": 0, "tried": 1}}},
            "unknown setting 'every'; did you mean 'every_m'",
        ),
        (
            {"designators": {"every-metres": {"settings": {"every_m": -1}, "f": 0, "tried": 1}}},
            "every-metres: every_m: -1",
        ),
    ],
)
def test_another_file_is_refused(tmp_path, change, said):
    data = {
        "format": "ssrics-tuned", "version": 1, "tuning": 1, "training": 1, "radius_m": 1.0,
        "designators": {"every-metres": {"settings": {"every_m": 3.0}, "f": 0.3, "tried": 5}},
    }  # fmt: skip
    file = tmp_path / "tuned.json"
    file.write_text(json.dumps({**data, **change}))
    with pytest.raises(ResultsError) as refused:
        read_tuned(file, ["every-metres"])
    assert said in str(refused.value)
    assert str(refused.value).startswith(f"{file}: ")


# Candidates and courses


def test_candidates_are_found_by_name():
    assert chosen_names(["turning", "random", "human-like+report"]) == [
        "random", "turning", "human-like+report",
    ]  # fmt: skip
    with pytest.raises(LibraryError, match="no candidate 'turnin'; did you mean 'turning'"):
        chosen_names(["turnin"])
    with pytest.raises(LibraryError, match="no productions entry 'landmarks'; did you mean"):
        chosen_names(["report+landmarks"])
    (only,) = make_candidates(["change-points"], {"change-points": {"width": 2.0}})
    assert (only.hindsight, only.is_model, only.settings) == (True, False, {"width": 2.0})


def test_a_random_designator_differs_between_drives():
    marked = []
    for seed in (1, 2):
        designator = Candidate("random").make(seed, "odometry")
        marked.append([m.scan for o in corridor().observations for m in designator.update(o)])
    assert marked[0] != marked[1]


def test_all_courses_without_data_are_those_that_need_none_and_it_is_said():
    settings = BenchSettings(seeds=3, sweep_seeds=2)
    courses, left_out = make_courses(settings)
    names = [course.name for course in courses]
    assert names[: len(CONDITIONS)] == list(CONDITIONS)
    assert [line.split(",")[0] for line in left_out] == ["left out: plans", "left out: logs"]
    assert {len(course.drives) for course in courses if not course.sweep} == {3}
    assert {len(course.drives) for course in courses if course.sweep} == {2}
    noisy = next(course for course in courses if course.name == "over-noise 5")
    assert noisy.drives[0] == courses[names.index("noise")].drives[0]  # made once for both


def test_courses_are_chosen_by_name():
    chosen, left_out = make_courses(BenchSettings(seeds=1), chosen=["people", "over-rate"])
    assert [course.name for course in chosen] == [
        "people", "over-rate 2.5", "over-rate 5", "over-rate 10", "over-rate 20", "over-rate 40",
    ]  # fmt: skip
    assert not left_out
    with pytest.raises(LibraryError, match="no course 'peopel'; did you mean 'people'"):
        make_courses(BenchSettings(), chosen=["peopel"])
    with pytest.raises(LibraryError, match="course 'plans' needs data: --maps FOLDER"):
        make_courses(BenchSettings(), chosen=["plans"])
    assert {"plans", "logs"} < {*course_names()}


def test_a_condition_reaches_robot_and_building():
    condition = Condition(noise_m=0.05, dropout=0.03, rate_hz=5.0, speed=2.0, drift=0.05)
    robot, plain = condition.robot(), Condition().robot()
    assert (robot.laser.noise_m, robot.laser.dropout, robot.laser.rate_hz) == (0.05, 0.03, 5.0)
    assert robot.speed_m_s == 2.0 * plain.speed_m_s
    assert (robot.odometry.scale, plain.odometry.scale) == (0.05, 0.01)
    wide = make_drive(Simulated(Condition(rooms=2, rate_hz=2.5, doorway_m=(1.3, 1.75)), 0))
    gaps = make_drive(Simulated(Condition(rooms=2, rate_hz=2.5, false_gaps=8), 0))
    nominal = make_drive(Simulated(TINY, 0))
    assert wide.locations != nominal.locations
    assert gaps.locations == nominal.locations
    first = [drive.observations[0].scan.ranges_m for drive in (gaps, nominal)]
    assert not np.array_equal(*first)


def plan_folder(path: Path, kinds=("doorway", "cut")):
    """Write two rooms of 4 x 4 m with a doorway of 1 m between them, and a table of doors."""
    cells = np.zeros((82, 162), np.uint8)
    cells[[0, -1]] = 1
    cells[:, [0, 80, 81, -1]] = 1
    cells[30:50, 80:82] = 0
    path.mkdir()
    save_building(Building("two rooms", GridMap(cells, 0.05)), path, "map_furnished")
    rows = [f"D{i},4.05,2.0,1.0,0.0,{kind}" for i, kind in enumerate(kinds)]
    (path / "doors.csv").write_text("\n".join(["id,x_m,y_m,width_m,angle_rad,kind", *rows]))
    return path


def test_a_plan_has_doorways_and_lines_across_them_and_is_explored(tmp_path):
    plan_at = plan_folder(tmp_path / "plan")
    plan = load_plan(plan_at)
    assert [place.kind for place in plan.locations] == ["doorway", "opening"]
    assert sorted(plan.lines_m[0].tolist()) == [[4.05, 1.5], [4.05, 2.5]]
    one, other = (make_drive(OnPlan(plan_at, seed)) for seed in (0, 1))
    assert one.way.xy_m[0].tolist() != other.way.xy_m[0].tolist()
    assert one.designated.tolist() == [True, False]
    crossed = np.flatnonzero(np.diff(one.way.xy_m[:, 0] > 4.05))
    assert len(one.passages.through(one.designated)) == len(crossed) > 0


def test_a_plan_that_is_wrong_is_refused_before_any_drive(tmp_path):
    plan_at = plan_folder(tmp_path / "plan", ("doorway", "cutt"))
    with pytest.raises(MapError, match=r"doors.csv:3: kind: 'cutt'; did you mean 'cut'"):
        make_courses(BenchSettings(), maps=[plan_at])
    with pytest.raises(MapError, match="no such folder"):
        make_courses(BenchSettings(), maps=[tmp_path / "none"])
    with pytest.raises(MapError, match="no door is a doorway"):
        make_courses(BenchSettings(), maps=[plan_folder(tmp_path / "other", ("cut",))])


# Running, and what is written


def test_whatever_the_number_of_jobs_the_result_is_the_same(bench):
    other = run_bench(BenchSettings(seeds=2), PATH_ONLY, tiny_courses(), jobs=2)
    assert other == bench


def test_a_course_pools_its_drives_and_a_curve_shares_them(bench):
    tiny = bench.figures["tiny", "every-metres"].tally
    point = bench.figures["over-noise 0", "every-metres"].tally
    assert (tiny.runs, point.runs) == (2, 1)
    assert 0 < point.marks < tiny.marks
    assert math.isnan(bench.figures["tiny", "every-metres"].consistency)


def test_runs_through_one_plan_have_a_consistency(tmp_path):
    plan_at = plan_folder(tmp_path / "plan")
    course = Course("plans", "", tuple(OnPlan(plan_at, seed) for seed in (0, 1)))
    dense = Candidate("every-metres", {"every_m": 0.5})
    made = run_bench(BenchSettings(), [dense], [course])
    assert made.figures["plans", "every-metres"].consistency == 1.0


def test_the_interval_of_f_needs_drives_that_differ():
    one = Tally(runs=1, passages=4, passed=2, merged=4, right=2)
    assert f_interval([one] * 5) == (0.5, 0.5)
    assert all(math.isnan(end) for end in f_interval([one] * 4))
    better = Tally(runs=1, passages=4, passed=4, merged=4, right=4)
    low, high = f_interval([one] * 5 + [better] * 5)
    assert 0.5 < low < 0.75 < high < 1.0


def test_files_hold_every_figure_and_the_same_bytes_each_time(bench, tmp_path):
    tuned = Tuned(tuning=1, training=1, radius_m=1.0, designators={})
    written = []
    for name in ("one", "two"):
        files = write_bench(bench, tuned, tmp_path / name, curves_svg(bench), ["left out: logs"])
        written.append({file.name: file.read_bytes() for file in files})
    assert written[0] == written[1]
    assert {*written[0]} == {
        "designators.csv", "designators.json", "designators.md", "tuned.json", "curves.svg",
    }  # fmt: skip
    lines = written[0]["designators.csv"].decode().splitlines()
    assert len(lines) == 1 + 3 * 3
    data = json.loads(written[0]["designators.json"])
    row = next(r for r in data["figures"] if (r["course"], r["candidate"]) == ("tiny", "turning"))
    assert row["f"] == pytest.approx(bench.figures["tiny", "turning"].tally.f, abs=1e-6)
    assert data["courses"][0]["seeds"] == [0, 1]
    assert data["courses"][0]["condition"]["rooms"] == 2
    assert data["candidates"][0]["settings"] == {"every_m": 4.0}
    assert data["notes"] == ["left out: logs"]
    assert data["versions"]["numpy"] == np.__version__


def test_the_document_has_a_row_for_each_candidate_and_says_what_is_left_out(bench):
    text = markdown(bench, ["left out: logs"])
    head = next(line for line in text.splitlines() if line.startswith("| "))
    assert head == "|  | tiny |"
    assert text.count("| every-metres |") == 3  # summary, course, curve
    f, chance = (bench.figures["tiny", "turning"].tally.figures()[n] for n in ("f", "f_chance"))
    assert f"| turning | {f:.2f} ({chance:.2f}) |" in text
    assert text.endswith("\nLeft out: logs.\n")


def test_each_baseline_has_a_colour_of_its_own():
    baselines = [one for one in make_candidates(chosen_names(), {}) if not one.is_ours]
    assert len({*THEIR_COLOURS} - {*OUR_COLOURS}) >= len(baselines)


def test_curves_name_every_line_and_there_are_none_without_points(bench):
    svg = curves_svg(bench)
    for name in ("every-metres", "random", "turning", "chance", "F over range noise, cm"):
        assert f">{name}</text>" in svg
    table = run_bench(BenchSettings(), PATH_ONLY[:1], tiny_courses(1)[:1])
    assert curves_svg(table) is None


def test_the_folder_of_another_benchmark_keeps_no_curves_that_are_not_its_own(bench, tmp_path):
    tuned = Tuned(tuning=1, training=1, radius_m=1.0, designators={})
    write_bench(bench, tuned, tmp_path, curves_svg(bench))
    write_bench(bench, tuned, tmp_path, None)
    assert not (tmp_path / "curves.svg").exists()
    (tmp_path / "file").write_text("")
    with pytest.raises(ResultsError, match="cannot be written"):
        write_bench(bench, tuned, tmp_path / "file", None)


def test_settings_at_an_edge_of_their_grid_are_named():
    grid = {"apart_m": (0.5, 1.0, 2.0), "threshold": (0.2, 0.5, 0.9), "mark": ("every", "peak"),
            "sector_check": (True, False)}  # fmt: skip
    chosen = {"apart_m": 0.5, "threshold": 0.5, "mark": "peak", "sector_check": True}
    assert at_edges(chosen, grid) == ["apart_m"]
    assert at_edges({**chosen, "apart_m": 1.0, "threshold": 0.9}, grid) == ["threshold"]
