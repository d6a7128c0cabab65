"""Opening, recognising, reporting and surviving: what holds for every format."""

import gzip
import itertools
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like import sources
from ssrics_like.errors import SourceError
from ssrics_like.perception.observation import Observation
from ssrics_like.sources import FORMATS, open_log
from ssrics_like.sources.lines import LineReader


def flaser(k, beams=180, *, x=None, t=None):
    ranges = " ".join(f"{2 + (k + i) % 7 * 0.1:.2f}" for i in range(beams))
    pose = f"{k * 0.1 if x is None else x} 0.5 0.1"
    time = k * 0.1 if t is None else t
    return f"FLASER {beams} {ranges} {pose} {pose} {time} host {time}\n"


def odom(k):
    return f"ODOM {k * 0.1} 0.5 0.1 0 0 0 {k * 0.1} host {k * 0.1}\n"


CARMEN = "# a comment\n## two\n#PARAM old style\n\nPARAM robot_use_laser on nohost 0\n" + "".join(
    odom(k) + flaser(k) for k in range(6)
)
CMU = "".join(
    f"O 10 20 0.1 {k * 0.2}\nL 10 20 0.1 35 20 0.1 {' '.join(['150'] * 180)} {k * 0.2 + 0.1}\n"
    for k in range(4)
)
VERTEX2 = "".join(
    f"VERTEX2 {k} {k} 2 0.5\nROBOTLASER1 0 -1.570796 3.141593 0.017453 50.0 0.1 0 180 "
    f"{' '.join(['3.5'] * 180)} 0 9 9 9 9 9 9 0 0 0 0 0 {100 + k} x {k}\n"
    for k in range(4)
)
DPSLAM = "".join(f"Odometry {k} 0 0.1 \nLaser 181 {' '.join(['1.5'] * 181)} \n" for k in range(4))
ROWS = "".join(
    f"{k * 100_000} 1 {k * 100} {k * 100} {'0 ' * 21} {' '.join(['1500'] * 682)} \n"
    for k in range(3)
)
SAMPLES = {
    "carmen": (CARMEN, 6),
    "cmu": (CMU, 4),
    "vertex2": (VERTEX2, 4),
    "odometry-laser": (DPSLAM, 4),
    "mm-rows": (ROWS, 3),
}


@pytest.fixture
def write(tmp_path):
    def _write(content, name="some.dat", *, zipped=False):
        data = content.encode("latin-1") if isinstance(content, str) else content
        path = tmp_path / name
        path.write_bytes(gzip.compress(data) if zipped else data)
        return path

    return _write


def test_public_names_exist():
    assert set(sources.__all__) == {
        "FORMATS", "LogSource", "ReadReport", "TimingSummary", "open_log",
    }  # fmt: skip
    assert all(hasattr(sources, name) for name in sources.__all__)
    assert set(FORMATS) == set(SAMPLES)


@pytest.mark.parametrize("zipped", [False, True])
@pytest.mark.parametrize("name", SAMPLES)
def test_every_format_is_recognised_by_content_plain_or_gzipped(write, name, zipped):
    text, scans = SAMPLES[name]
    source = open_log(write(text, "log.png", zipped=zipped))
    assert source.format == name
    observations = list(source)
    assert len(observations) == scans == source.report.scans
    assert source.report.lines == text.count("\n")
    assert source.report.malformed == 0
    assert source.report.truncated_last_line is False
    assert source.progress == 1.0
    assert [o.index for o in observations] == list(range(scans))
    assert all(np.diff([o.t_s for o in observations]) > 0)


def test_iterating_twice_gives_the_same_and_fresh_counts(write):
    source = open_log(write(CARMEN))
    assert source.progress == 0.0
    first, second = list(source), list(source)
    assert source.report.scans == 6
    for a, b in zip(first, second, strict=True):
        assert (a.t_s, a.pose) == (b.t_s, b.pose)
        np.testing.assert_array_equal(a.scan.ranges_m, b.scan.ranges_m)


def test_windows_line_ends_and_a_byte_order_mark_are_no_matter(write):
    data = b"\xef\xbb\xbf" + "".join(flaser(k) for k in range(3)).replace("\n", "\r\n").encode()
    source = open_log(write(data))
    assert len(list(source)) == 3
    assert source.report.malformed == 0


def test_bytes_that_are_not_utf8_survive(write):
    text = CARMEN.replace("host", "h\xe4st").replace("# a comment", "# \xff\xfe caf\xe9")
    source = open_log(write(text))
    assert len(list(source)) == 6
    assert source.report.malformed == 0


def test_sha256_is_that_of_the_file_as_it_lies(write):
    path = write(b"", "x")
    path.write_bytes(b"FLASER 2 1 1 0 0 0 0 0 0 0 h 0\n")
    # printf 'FLASER 2 1 1 0 0 0 0 0 0 0 h 0\n' | sha256sum
    assert open_log(path).sha256 == (
        "2db04916d9907d66ba861686587a9e6b4561bcfda7321175eb4eec2c2b6279f6"
    )


# frame


def test_frame_is_odometry_when_the_laser_rides_rigidly(write):
    lines = [
        f"FLASER 2 1 1 {k + 0.2 * np.cos(k)} {0.2 * np.sin(k)} {k} {k} 0 {k} {k} h {k}\n"
        for k in range(5)
    ]
    assert open_log(write("".join(lines))).frame == "odometry"


def test_frame_is_corrected_when_the_laser_moves_against_the_odometry(write):
    lines = [f"FLASER 2 1 1 {k * 1.1} 0 0 {k} 0 0 {k} h {k}\n" for k in range(5)]
    assert open_log(write("".join(lines))).frame == "corrected"


def test_frame_is_corrected_when_a_particle_filter_wrote_the_log(write):
    assert open_log(write(CARMEN + "NEFF 30\n")).frame == "corrected"


@pytest.mark.parametrize(
    ("name", "frame"),
    [("vertex2", "corrected"), ("cmu", "odometry"), ("odometry-laser", "odometry"),
     ("mm-rows", "odometry"), ("carmen", "odometry")],
)  # fmt: skip
def test_frame_of_the_other_formats(write, name, frame):
    assert open_log(write(SAMPLES[name][0])).frame == frame


def test_a_frame_that_is_asked_for_wins(write):
    assert open_log(write(CARMEN), frame="map").frame == "map"


# errors a user can cause


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"format": "carman"}, "unknown log format 'carman'; did you mean 'carmen'?"),
        ({"frame": "corected"}, "unknown frame 'corected'; did you mean 'corrected'?"),
        ({"fallback_rate_hz": 0.0}, "fallback rate 0.0 is not a positive number"),
        ({"fallback_rate_hz": float("nan")}, "fallback rate nan"),
    ],
)
def test_wrong_arguments_are_named_with_the_nearest(write, arguments, words):
    with pytest.raises(SourceError) as raised:
        open_log(write(CARMEN), **arguments)
    assert words in str(raised.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b"\n \n\n", "is empty"),
        (gzip.compress(b"", mtime=0), "is empty"),
        (b"\x1f\x8b\x00\x00", "is empty: the gzip stream is damaged"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "is not a laser log|is a binary file"),
        (bytes(range(256)) * 20, "is a binary file"),
        (b"# Read me\n\nOnce upon a time.\n" * 300, "is not a laser log of a known format"),
        (b"a,b,c\n1,2,3\n", "is not a laser log of a known format"),
        (b"1 2 3\n4 5 6\n", "is not a laser log of a known format"),
        (CARMEN.encode().replace(b"FLASER", b"RLASER"), "holds no laser scan"),
        (b"ODOM 0 0 0 0 0 0 0 h 0\n" * 6000, "holds no 'carmen' laser scan .6000 lines"),
        (b"VERTEX2 0 1 2 3\nEDGE2 0 1 1 1 1 1 1 1\n", "holds no laser scan"),
        (b"FLASER 180 1 2 3\n", "holds no 'carmen' laser scan"),
    ],
)  # fmt: skip
def test_an_empty_foreign_or_scanless_file_is_one_clear_line(write, content, words):
    path = write(content)
    with pytest.raises(SourceError, match=words) as raised:
        list(open_log(path))
    assert str(raised.value).startswith(f"{path}: ")
    assert "\n" not in str(raised.value)


def test_a_missing_file_suggests_its_neighbour(write):
    path = write(CARMEN, "robot.log")
    with pytest.raises(SourceError, match=r"no such file; did you mean 'robot.log'\?"):
        open_log(path.with_name("robto.log"))


def test_a_folder_is_refused(tmp_path):
    with pytest.raises(SourceError, match="is a folder"):
        open_log(tmp_path)


def test_a_wrong_forced_format_says_what_the_file_looks_like(write):
    source = open_log(write(CARMEN), format="cmu")
    with pytest.raises(SourceError, match=r"holds no 'cmu' laser scan.*looks like 'carmen'"):
        list(source)


# malformed and truncated lines


BAD = "FLASER 180 1 2 oops\n"


def test_malformed_lines_are_counted_with_file_line_and_reason(write):
    lines = [flaser(0), "!!! ???\n", flaser(1), flaser(2).replace("2.3", "2.x", 1)]
    lines += [BAD, "FLASER x\n", "FLASER 1 1 0 0 0 0 0 0 0 h 0\n", flaser(4)]
    source = open_log(write("".join(lines), "robot.log"))
    assert len(list(source)) == 3
    assert source.report.malformed == 5
    assert source.report.examples == [
        "robot.log:2: '!!!' is not a kind of CARMEN record",
        "robot.log:4: '2.x0' is not a number",
        "robot.log:5: FLASER of 180 beams has 5 fields, expected 191",
        "robot.log:6: beam count 'x' is not a whole number",
        "robot.log:7: FLASER has 1 beams, expected at least 2",
    ]
    assert source.report.warnings()[0].startswith("5 malformed lines left out: robot.log:2: ")


def test_a_log_whose_laser_changes_keeps_all_its_scans(write):
    source = open_log(write(flaser(0, 90) + flaser(1) + flaser(2) + flaser(3, 90)))
    assert [len(o.scan.ranges_m) for o in source] == [90, 180, 180, 90]
    assert source.report.malformed == 0


def test_strict_stops_at_the_first_malformed_line(write):
    path = write(flaser(0) + flaser(1) + BAD + flaser(2))
    with pytest.raises(SourceError) as raised:
        list(open_log(path, strict=True))
    assert str(raised.value) == f"{path}:3: FLASER of 180 beams has 5 fields, expected 191"


@pytest.mark.parametrize("end", ["", "\n", "\n\n"])
def test_a_last_line_that_is_cut_off_is_reported_not_malformed(write, end):
    path = write(CARMEN + flaser(6)[:300] + end)
    source = open_log(path)
    assert len(list(source)) == 6
    assert source.report.truncated_last_line is True
    assert source.report.malformed == 0
    assert any("cut off; it was read up to there: some" in w for w in source.report.warnings())
    with pytest.raises(SourceError, match=r":18: "):
        list(open_log(path, strict=True))


def test_a_complete_last_line_needs_no_line_feed(write):
    source = open_log(write(CARMEN.rstrip("\n")), strict=True)
    assert len(list(source)) == 6
    assert source.report.truncated_last_line is False


def test_a_wrong_last_line_is_malformed_not_truncated(write):
    source = open_log(write(CARMEN + "???\n"))
    list(source)
    assert source.report.malformed == 1
    assert source.report.truncated_last_line is False


def test_a_gzip_stream_that_is_cut_off_is_read_up_to_there(write):
    rng = np.random.default_rng(1)  # noise, so that the compressed file spans many blocks
    text = "".join(flaser(k, x=rng.random()) for k in range(2000))
    whole = gzip.compress(text.encode(), 1)
    cut = open_log(write(whole[: len(whole) // 2]))
    half = len(list(cut))
    assert 0 < half < 2000
    assert cut.report.truncated_last_line is True
    with pytest.raises(SourceError, match="the gzip stream is cut off"):
        list(open_log(cut.path, strict=True))


def test_a_damaged_gzip_stream_is_read_up_to_the_damage(write):
    whole = gzip.compress("".join(flaser(k) for k in range(40)).encode())
    wrong_sum = bytearray(whole)
    wrong_sum[-6] ^= 0xFF
    source = open_log(write(bytes(wrong_sum)))
    assert len(list(source)) == 40
    assert "gzip stream is damaged" in source.report.truncation
    with pytest.raises(SourceError, match="the gzip stream is damaged"):
        list(open_log(source.path, strict=True))
    wrong_byte = bytearray(whole)
    wrong_byte[len(whole) // 2 :] = bytes(len(whole) - len(whole) // 2)
    source = open_log(write(bytes(wrong_byte)))
    assert 0 < len(list(source)) < 40
    assert source.report.truncated_last_line is True


def test_gzip_members_in_a_row_and_padding_are_one_log(write):
    parts = [gzip.compress(flaser(k).encode()) for k in range(3)]
    source = open_log(write(b"".join(parts) + b"\0" * 512))
    assert len(list(source)) == 3
    assert source.report.truncated_last_line is False


def test_a_line_without_end_is_malformed_and_costs_no_memory(write):
    path = write(flaser(0) + "FLASER 9 " + "1 " * 2_000_000 + "\n" + flaser(1) + flaser(2))
    source = open_log(path)
    assert len(list(source)) == 3
    assert source.report.malformed == 1
    assert max(map(len, LineReader(path))) < 1_100_000


@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_truncation_at_any_byte_survives(tmp_path_factory, data):
    name = data.draw(st.sampled_from(sorted(SAMPLES)))
    zipped = data.draw(st.booleans())
    raw = SAMPLES[name][0].encode()
    raw = gzip.compress(raw) if zipped else raw
    path = tmp_path_factory.mktemp("cut") / "cut.log"
    path.write_bytes(raw[: data.draw(st.integers(0, len(raw) - 1))])
    try:
        source = open_log(path)
        scans = list(source)
    except SourceError:
        return
    assert 0 < len(scans) <= SAMPLES[name][1]
    assert source.report.malformed == 0
    assert source.report.truncated_last_line or len(scans) == SAMPLES[name][1] or not zipped


GOOD_LINES = [line.encode() for text, _ in SAMPLES.values() for line in text.splitlines()]
GARBAGE = st.one_of(
    st.binary(max_size=60),
    st.sampled_from(GOOD_LINES),
    st.builds(
        lambda line, at, new: line[: at % len(line)] + new + line[at % len(line) + 1 :],
        st.sampled_from([line for line in GOOD_LINES if line]),
        st.integers(0, 5000),
        st.sampled_from([b"", b" ", b"-", b"e999", b"nan", b"\xff", b"\0", b"9" * 30, b"\n"]),
    ),
)


@settings(max_examples=150, deadline=None)
@given(lines=st.lists(GARBAGE, max_size=12), name=st.sampled_from(["auto", *SAMPLES]))
def test_garbage_gives_observations_or_a_source_error_and_nothing_else(
    tmp_path_factory, lines, name
):
    path = tmp_path_factory.mktemp("garbage") / "garbage.log"
    path.write_bytes(b"\n".join(lines))
    try:
        source = open_log(path, format=name)
        observations = list(source)
    except SourceError:
        return
    assert observations
    for before, after in itertools.pairwise(observations):
        assert after.t_s > before.t_s
    for seen in observations:
        assert isinstance(seen, Observation)
        assert np.isfinite([seen.pose.x_m, seen.pose.y_m, seen.pose.theta_rad, seen.t_s]).all()
        assert not (seen.scan.ranges_m <= 0).any()
        assert seen.scan.angle_increment_rad > 0
    assert source.report.warnings() == source.report.warnings()


# laziness


def long_log(path, scans):
    """Write 30-beam scans that gzip shrinks two hundredfold."""
    start = flaser(0, 30).split(" 0.0 0.5", 1)[0]
    with gzip.open(path, "wt", 1) as file:
        file.writelines(f"{start} {k} 0 0 0 0 0 {k * 0.1:.1f} h 0\n" for k in range(scans))


def test_memory_does_not_grow_with_the_log(tmp_path):
    peaks = []
    for scans in (2000, 20_000):
        long_log(tmp_path / "long.log.gz", scans)
        source = open_log(tmp_path / "long.log.gz")
        tracemalloc.start()
        assert sum(1 for _ in source) == scans
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < peaks[0] * 1.1 + 50_000
    assert peaks[1] < 4_000_000  # 500 scans ahead and one inflated block


def test_no_more_than_the_look_ahead_is_read_before_the_first_observation(write):
    source = open_log(write("".join(flaser(k) for k in range(3000))))
    stream = iter(source)
    next(stream)
    assert source.report.lines <= 501
    assert 0 < source.progress < 0.5
    assert source.report.scans == 1


def test_warnings_come_also_from_a_pass_that_was_left_early(write):
    source = open_log(write(DPSLAM))
    stream = iter(source)
    next(stream)
    stream.close()
    assert any("where the laser sits" in text for text in source.report.warnings())
