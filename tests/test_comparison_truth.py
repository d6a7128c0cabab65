"""Labels of a log are read whole, or every problem is named with its file and line."""

import numpy as np
import pytest
from labelled_logs import CROSSINGS, SCANS, TRUTH, write_truth

from ssrics_like.comparison import load_truth
from ssrics_like.errors import MapError


def test_labels_are_read(tmp_path):
    truth = load_truth(write_truth(tmp_path / "t"))
    assert [place.id for place in truth.locations] == ["D1", "D2", "W1", "J1"]
    # The doorways that were gone through; not the one seen in passing, nor the junction.
    assert truth.designated.tolist() == [True, True, False, False]
    assert len(truth.way.xy_m) == SCANS
    assert truth.way.length_m == pytest.approx(120.0)
    assert truth.passages.place.tolist() == [0, 1, 3, 0]
    assert truth.passages.along_m == pytest.approx([3.2, 8.0, 20.0, 90.0])
    assert truth.jambs_m[0].tolist() == [[3.2, -0.5], [3.2, 0.5]]
    assert np.isnan(truth.jambs_m[3]).all()


def changed(folder, name, old, new):
    file = write_truth(folder) / name
    text = file.read_text()
    assert text.count(old) >= 1
    file.write_text(text.replace(old, new, 1))
    return folder


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("truth.csv", "sure,1,8.0", "sure,yes,8.0", "truth.csv:3: crossed: 'yes': expected 1 or 0"),
        ("truth.csv", "D2,", "D1,", "truth.csv:3: id 'D1' stands twice (first in line 2)"),
        ("truth.csv", "J1,junction", "J1,juncton", "truth.csv:5: kind: unknown 'juncton'; did you"),
        ("truth.csv", ",20.0,", ",,", "truth.csv:5: x_m: nothing where a number was expected"),
        ("truth.csv", "crossed", "crosed", "truth.csv:1: column 'crossed' is missing; did you"),
        ("truth.csv", "3.2,-0.5", "a,-0.5", "truth.csv:2: jamb_ax_m: 'a' where a number was"),
        ("crossings.csv", "D2,80", "D9,80", "crossings.csv:3: id: 'D9': no such id in truth.csv"),
        ("crossings.csv", "J1,", "W1,", "crossings.csv:4: id: 'W1': has crossed 0 in truth.csv"),
        ("crossings.csv", "D2,80,8.0\n", "", "crossings.csv:1: id: 'D2': has crossed 1 in truth"),
        ("crossings.csv", "900", "1201", "crossings.csv:5: scan: '1201': expected a scan of poses"),
        ("crossings.csv", "32", "-1", "crossings.csv:2: scan: '-1': expected a scan of poses.csv"),
        ("poses.csv", "\n7,", "\n8,", "poses.csv:9: scan: '8': expected 7, one row for each laser"),
        ("poses.csv", "0.9,0.9,", "0.9,x,", "poses.csv:11: x_m: 'x' where a number was expected"),
        ("poses.csv", "y_m", "z_m", "poses.csv:1: column 'y_m' is missing"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, name, old, new, said):
    with pytest.raises(MapError) as caught:
        load_truth(changed(tmp_path / "t", name, old, new))
    assert f"{tmp_path / 't'}/{said}" in str(caught.value)


def test_every_problem_of_a_table_is_named(tmp_path):
    wrong = CROSSINGS.replace("D2,80", "D7,80").replace("900", "many")
    with pytest.raises(MapError) as caught:
        load_truth(write_truth(tmp_path / "t", crossings=wrong))
    lines = str(caught.value).splitlines()
    assert [line.split("crossings.csv:")[1].split(":")[0] for line in lines] == ["1", "3", "5"]


@pytest.mark.parametrize("name", ["truth.csv", "crossings.csv", "poses.csv"])
def test_a_missing_table_is_named(tmp_path, name):
    folder = write_truth(tmp_path / "t")
    (folder / name).unlink()
    with pytest.raises(MapError, match=f"{name}: no such file"):
        load_truth(folder)


def test_a_table_without_ends_of_gaps_will_do(tmp_path):
    short = "\n".join(",".join(line.split(",")[:6]) for line in TRUTH.splitlines())
    truth = load_truth(write_truth(tmp_path / "t", truth=short))
    assert np.isnan(truth.jambs_m).all()


def test_the_labels_of_real_logs_are_read(data_dir):
    truth = load_truth(data_dir / "truth" / "intel_lab")
    through = truth.passages.through(truth.designated)
    # As the folder's own description says: 16 crossed doorways in 30 passages.
    assert (int(truth.designated.sum()), len(through)) == (16, 30)
    # Every passage lies near the doorway that it leads through.
    places = np.array([(p.x_m, p.y_m) for p in truth.locations])
    away = truth.way.at(through.along_m) - places[through.place]
    assert np.hypot(*away.T).max() < 1.0
    for name, doorways in (("wean1", 1), ("wean2", 2), ("wean3", 1)):
        assert load_truth(data_dir / "truth" / name).designated.sum() == doorways
