"""What holds for every designator: names, settings, order, determinism, any scan."""

import inspect
import math
import pickle
import sys

import numpy as np
import pytest
from designator_drives import ROOM, observation, straight, travelled
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import ssrics_like.designators as package
from ssrics_like.designators import (
    DesignatorSettings,
    Mark,
    add_designator,
    designate,
    designator_kind,
    designator_names,
    make_designator,
    registry,
    train,
)
from ssrics_like.errors import (
    LibraryError,
    MissingPackageError,
    ScanError,
    SettingsError,
    SsricsError,
)
from ssrics_like.perception.observation import LaserScan

NAMES = (
    "every-metres",
    "random",
    "turning",
    "report",
    "surprise-histogram",
    "surprise-gaussian",
    "bocpd",
    "change-points",
    "doorway-gap",
    "gwr",
    "boosted-scan",
)
PACKAGES = {"change-points": "ruptures", "boosted-scan": "sklearn"}
LOW = {  # thresholds so low that something is marked
    "random": {"per_100_m": 300.0},
    "turning": {"threshold_rad": 0.01},
    "report": {"interval": 2, "sector_check": False},
    "surprise-histogram": {"threshold_nats": 0.0},
    "surprise-gaussian": {"threshold_nats": 0.0},
    "bocpd": {"threshold": 1e-6},
    "change-points": {"penalty": 0.01, "apart_m": 0.2},
    "doorway-gap": {"max_gap_m": 7.0, "widen_m": 0.0},
    "gwr": {"threshold": 0.1},
    "every-metres": {"every_m": 1.0},
    "boosted-scan": {"threshold": 1e-6},
}


@pytest.fixture(scope="module")
def made():
    """Make a designator that marks readily, or skip where its library is not installed."""
    models = []

    def make(name, **more):
        if name in PACKAGES:
            pytest.importorskip(PACKAGES[name])
        if name == "boosted-scan":
            if not models:
                rng = np.random.default_rng(0)
                scans = [LaserScan(rng.uniform(0.3, 9.0, 30), -1.5, 0.1) for _ in range(120)]
                models.append(train(scans, np.arange(120) % 2 == 0, 0))
            more = {"model": models[0], **more}
        return make_designator(name, **{**LOW[name], **more})

    return make


def test_all_public_names_are_there():
    assert sorted(package.__all__) == package.__all__
    for name in package.__all__:
        assert getattr(package, name) is not None


def test_every_designator_is_found_by_its_name():
    assert designator_names() == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_every_designator_names_its_source_and_what_tuning_tries(name):
    kind = designator_kind(name)
    text = inspect.getdoc(kind)
    assert "References\n----------" in text
    for cited in kind.source.split("; "):
        first = cited.split()[0].strip("'").split(",")[0]
        assert first == "a" or first in text, cited
    assert kind.hindsight is (name == "change-points")
    assert 1 <= math.prod(len(values) for values in kind.GRID.values()) <= 100
    for key, values in kind.GRID.items():
        assert len(set(values)) == len(values) > 1
        for value in values:  # each must be a value that the settings take
            kind.Settings.__pydantic_validator__.validate_assignment(
                kind.Settings.model_construct(), key, value
            )


def test_an_unknown_name_gets_the_nearest_known_one():
    with pytest.raises(
        LibraryError, match=r"no designator 'doorway-gab'; did you mean 'doorway-gap'"
    ):
        make_designator("doorway-gab")


@pytest.mark.parametrize(
    ("name", "wrong", "says"),
    [
        (
            "turning",
            {"treshold_rad": 1.0},
            "unknown key 'treshold_rad'; did you mean 'threshold_rad'",
        ),
        ("every-metres", {"every_m": 0.0}, "every-metres: every_m: 0.0: expected greater than 0"),
        ("gwr", {"repair_window": 4}, "expected 0 (off) or an odd number of beams, 3 or more"),
        ("bocpd", {"change_m": math.nan}, "change_m: nan: expected a finite number"),
        ("report", {"mark": "peek"}, "did you mean 'peak'"),
        ("boosted-scan", {}, "key 'model' is missing"),
        ("random", {"seed": 1.5}, "seed: 1.5"),
    ],
)
def test_wrong_settings_are_refused_with_their_name(name, wrong, says):
    with pytest.raises(SettingsError) as caught:
        make_designator(name, **wrong)
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


def test_settings_cannot_be_changed():
    chosen = designator_kind("turning").Settings()
    with pytest.raises(ValueError, match="frozen"):
        chosen.apart_m = 3.0


class AtTheStart:
    """A designator of somebody else's."""

    class Settings(DesignatorSettings):
        strength: float = 1.0

    GRID = {"strength": (1.0, 2.0)}  # noqa: RUF012
    hindsight = False
    source = "nobody"

    def __init__(self, chosen):
        self.strength = chosen.strength

    def update(self, seen):
        return [Mark(0, 0, self.strength)] if seen.index == 0 else []

    def flush(self):
        return []


def test_anyone_can_add_a_designator(monkeypatch):
    monkeypatch.setattr(registry, "_KINDS", dict(registry._KINDS))
    add_designator("at-the-start", AtTheStart)
    assert designator_names() == (*NAMES, "at-the-start")
    marks = designate(make_designator("at-the-start", strength=2.0), straight(1.0))
    assert marks == [Mark(0, 0, 2.0)]
    with pytest.raises(LibraryError, match="already"):
        add_designator("at-the-start", AtTheStart)
    with pytest.raises(SettingsError, match="lacks Settings, GRID, hindsight, source"):
        add_designator("list", type("L", (), {"update": None, "flush": None}))
    wrong = type("W", (AtTheStart,), {"GRID": {"force": (1.0,)}})
    with pytest.raises(SettingsError, match="GRID names no setting: force"):
        add_designator("wrong", wrong)


def test_a_missing_library_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "ruptures", None)
    monkeypatch.setitem(sys.modules, "sklearn.ensemble", None)
    with pytest.raises(
        MissingPackageError, match="'change-points' needs the package ruptures"
    ) as e:
        make_designator("change-points")
    assert isinstance(e.value, SsricsError)
    assert isinstance(e.value, ImportError)
    with pytest.raises(MissingPackageError, match="'boosted-scan' needs the package scikit-learn"):
        train([], [], 0)


@pytest.mark.parametrize(
    "name", [n for n in NAMES if n not in ("every-metres", "random", "turning")]
)
def test_a_scan_without_beams_is_refused(made, name):
    empty = observation(0, (0.0, 0.0, 0.0), [], angle_min=0.0, step=0.1)
    with pytest.raises(ScanError):
        made(name).update(empty)


ODD_RANGES = (math.nan, math.inf, -math.inf, 0.0, -1.0, 1e300, 81.83)
ODD_PLACES = (math.nan, math.inf, 1e6, -3.0)


def any_drive(seed, scans, odd):
    """Drive anyhow with a laser that may change, a share of readings and poses being odd."""
    rng = np.random.default_rng(seed)
    seen, x, y = [], 0.0, 0.0
    beams, angle_min, step = 12, -1.5, 0.25
    for index in range(3, 3 + scans):
        if rng.uniform() < 0.1:
            beams = int(rng.integers(1, 40))
            angle_min, step = rng.uniform(-math.pi, math.pi), rng.uniform(0.001, 0.5)
        ranges = rng.choice([0.05, 0.5, 3.0, 12.0]) * rng.uniform(0.9, 1.0, beams)
        lost = rng.uniform(size=beams) < odd
        ranges[lost] = rng.choice(ODD_RANGES, lost.sum())
        x, y = x + rng.uniform(-0.2, 0.5), y + rng.uniform(-0.2, 0.2)
        pose = [x, y, rng.uniform(-4.0, 4.0)]
        if rng.uniform() < 0.2 * odd:
            pose[rng.integers(3)] = rng.choice(ODD_PLACES)
        seen.append(observation(index, pose, ranges, angle_min, step))
    return seen


@pytest.mark.parametrize("name", NAMES)
@settings(
    max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.integers(0, 2**32 - 1), st.integers(0, 60), st.sampled_from([0.0, 0.1, 0.5, 1.0]))
@example(306402235, 21, 1.0)  # an infinite heading after an infinite one
def test_any_drive_gives_marks_in_order_and_the_same_ones_again(made, name, seed, scans, odd):
    drive = any_drive(seed, scans, odd)
    marks = designate(made(name), drive)
    assert marks == designate(made(name), drive)
    indices = {o.index for o in drive}
    for mark in marks:
        assert mark.scan in indices
        assert mark.decided_scan in indices
        assert mark.decided_scan >= mark.scan
        assert math.isfinite(mark.strength)
    assert [m.scan for m in marks] == sorted({m.scan for m in marks})
    assert [m.decided_scan for m in marks] == sorted(m.decided_scan for m in marks)


def noisy(metres, seed=1):
    """Drive past things that come and go, and turn now and then."""
    rng = np.random.default_rng(seed)
    seen = []
    for k in range(round(metres / 0.05)):
        x = 0.05 * k
        near = 1.0 + 0.8 * math.sin(0.7 * x) + (0.9 if math.sin(1.9 * x) > 0 else 0.0)
        ranges = np.where(np.arange(ROOM.size) % 30 < 10, near, 3.0)
        ranges = ranges + rng.normal(0.0, 0.02, ROOM.size)
        seen.append(observation(k, (x, 0.0, 0.5 * math.sin(1.3 * x)), ranges))
    return seen


@pytest.mark.parametrize("name", [name for name in NAMES if name != "change-points"])
def test_what_is_decided_online_is_decided_within_a_metre_of_the_place(made, name):
    drive = noisy(40.0)
    at_m = travelled(drive)
    marks = designate(made(name), drive)
    assert len(marks) >= 3
    # The report's rule counts scans instead: its interval of two is a tenth of a metre here.
    assert max(at_m[m.decided_scan] - at_m[m.scan] for m in marks) <= 1.0 + 1e-9


@pytest.mark.parametrize("name", [name for name in NAMES if name != "change-points"])
def test_what_is_decided_online_does_not_depend_on_what_comes_later(made, name):
    drive = noisy(40.0)
    cut = 500
    online = made(name)
    early = [mark for seen in drive[:cut] for mark in online.update(seen)]
    whole = designate(made(name), drive)
    assert early == [mark for mark in whole if mark.decided_scan < cut]
    assert 0 < len(early) < len(whole)


@pytest.mark.parametrize(
    "name", [name for name in NAMES if name not in ("report", "change-points", "boosted-scan")]
)
def test_a_robot_that_waits_is_the_same_as_one_that_does_not(made, name):
    """Metres count, not scans: a long stop adds no mark and moves none."""
    drive = noisy(20.0)
    waits = [*drive[:200], *[drive[200]] * 300, *drive[200:]]
    waits = [observation(k, (o.pose.x_m, o.pose.y_m, o.pose.theta_rad), o.scan.ranges_m)
             for k, o in enumerate(waits)]  # fmt: skip
    there = [round(drive[m.scan].pose.x_m, 6) for m in designate(made(name), drive)]
    assert there
    assert there == [round(waits[m.scan].pose.x_m, 6) for m in designate(made(name), waits)]


@pytest.mark.parametrize(
    "name", [name for name in NAMES if name not in ("report", "change-points")]
)
def test_memory_does_not_grow_with_the_drive(made, name):
    """The report's rule is held to that by the tests of its perception."""
    designator = made(name, **({"nodes_max": 20} if name == "gwr" else {}))
    drive = noisy(90.0)
    sizes = []
    for seen in drive:
        designator.update(seen)
        if seen.index in (600, 1790):
            sizes.append(len(pickle.dumps(designator)))
    assert sizes[1] < 1.1 * sizes[0] + 200
