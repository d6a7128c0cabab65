"""The report's rule on real logs: the state is novel nearly all the time."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
import yaml

from ssrics_like.perception import (
    PerceptionBuffer,
    PerceptionProfile,
    condition,
    novelty_profile,
)
from ssrics_like.sources import open_log


def profile(name, **changes):
    path = Path(__file__).parents[1] / "perception" / f"{name}.yaml"
    text = yaml.safe_load(path.read_text(encoding="utf-8"))
    return PerceptionProfile.model_validate({**text, **changes})


@cache
def observations(path):
    return list(open_log(path))


def replay(data_dir, log, settings):
    buffer = PerceptionBuffer(settings)
    fired = []
    for observation in observations(data_dir / "logs" / f"{log}.log"):
        fired += buffer.update(observation)
    return buffer, fired + buffer.flush()


# Scans, and by advance: novel share in per cent, and onsets.
WEAN = [
    ("wean-1", 713, {"sliding": (100.0, 1), "tumbling": (100.0, 1)}),
    ("wean-2", 2251, {"sliding": (94.1, 4), "tumbling": (95.6, 3)}),
    ("wean-3", 1241, {"sliding": (100.0, 1), "tumbling": (100.0, 1)}),
]


@pytest.mark.parametrize("advance", ["sliding", "tumbling"])
@pytest.mark.parametrize(("log", "scans", "known"), WEAN)
def test_novel_share_and_onsets_on_the_wean_logs(data_dir, log, scans, known, advance):
    buffer, fired = replay(data_dir, log, profile("report", advance=advance))
    assert buffer.intervals == (scans - 49 if advance == "sliding" else scans // 50)
    share = 100 * buffer.novel_intervals / buffer.intervals
    assert (round(share, 1), buffer.onsets) == known[advance]
    assert 94 <= share <= 100
    assert 1 <= buffer.onsets <= 4
    assert len(fired) == buffer.novel_intervals  # every novel interval is marked
    assert buffer.restarts == 0


def test_a_cap_of_eighty_metres_leaves_no_bored_interval(data_dir):
    for log, _, _ in WEAN:
        buffer, _ = replay(data_dir, log, profile("report", advance="sliding", range_cap_m=80.0))
        assert buffer.novel_intervals == buffer.intervals


def test_peaks_are_few_and_their_places_lie_on_the_path(data_dir):
    marks = 0
    for log, scans, _ in WEAN:
        _, fired = replay(data_dir, log, PerceptionProfile())
        seen = observations(data_dir / "logs" / f"{log}.log")
        marks += len(fired)
        for reflex in fired:
            assert 10 <= reflex.scan < scans
            assert reflex.pose == seen[reflex.scan].pose
            assert reflex.t_s == seen[reflex.scan].t_s <= reflex.perceived_s
    # A mark each 2 m or rarer, where every novel interval would be one each few centimetres.
    assert 20 <= marks <= 176 / 2


def test_streaming_and_batch_agree_on_a_real_log(data_dir):
    settings = PerceptionProfile()
    buffer = PerceptionBuffer(settings)
    taus = []
    seen = observations(data_dir / "logs" / "wean-2.log")
    for observation in seen:
        buffer.update(observation)
        taus.append(buffer.tau)
    ranges = [
        condition(o.scan.ranges_m, settings.range_cap_m, settings.repair_window).ranges_m
        for o in seen
    ]
    batch = novelty_profile(np.array(ranges), settings.interval, settings.gradient)
    assert taus[settings.interval - 1 :] == batch.tolist()
