"""Pictures of every mode become grey levels; what is none becomes one clear error."""

import io
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from ssrics_like.errors import MapError
from ssrics_like.maps import image as module
from ssrics_like.maps.image import read_image

GREY = np.array([[0, 100, 254], [205, 255, 7]], np.uint8)


def written(tmp_path, picture, name="a.png", **options):
    path = tmp_path / name
    picture.save(path, **options)
    return read_image(path)


def png(*chunks):
    """Put a PNG file together from (type, data) pairs."""
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    )


@pytest.mark.parametrize("name", ["a.png", "a.pgm", "a.bmp"])
def test_grey_is_taken_as_it_is(tmp_path, name):
    got = written(tmp_path, Image.fromarray(GREY), name)
    assert got.levels.tolist() == GREY.tolist()
    assert (got.top, got.opaque) == (255, None)


def test_plain_pgm_may_have_comments_and_any_maximum(tmp_path):
    path = tmp_path / "a.pgm"
    path.write_text("P2\n# drawn by hand\n3 2\n100\n0 50 100\n # more\n25 75 100\n")
    got = read_image(path)
    assert got.levels.tolist() == [[0, 128, 255], [64, 191, 255]]


def test_sixteen_bits_keep_their_levels(tmp_path):
    deep = (GREY.astype(np.uint16) << 8) + 3
    got = written(tmp_path, Image.fromarray(deep))
    assert got.levels.tolist() == deep.tolist()
    assert got.top == 65535
    path = tmp_path / "a.pgm"
    path.write_bytes(b"P5 3 2 65535\n" + deep.astype(">u2").tobytes())
    assert read_image(path).levels.tolist() == deep.tolist()


def test_colours_are_summed_and_any_transparency_is_kept(tmp_path):
    colours = np.dstack([GREY, GREY[::-1], np.full_like(GREY, 9)])
    got = written(tmp_path, Image.fromarray(colours))
    assert got.levels.tolist() == colours.sum(2).tolist()
    assert (got.top, got.opaque) == (765, None)
    alpha = np.array([[255, 254, 0], [255, 1, 255]], np.uint8)
    opaque = (alpha == 255).tolist()
    seen = written(tmp_path, Image.fromarray(np.dstack([colours, alpha])))
    assert seen.levels.tolist() == colours.sum(2).tolist()
    assert seen.opaque.tolist() == opaque
    grey = written(tmp_path, Image.fromarray(np.dstack([GREY, alpha])))
    assert (grey.levels.tolist(), grey.top) == (GREY.tolist(), 255)
    assert grey.opaque.tolist() == opaque


def test_palettes_and_single_bits_become_what_they_show(tmp_path):
    palette = Image.fromarray(np.array([[0, 1], [2, 1]], np.uint8), mode=None).convert("P")
    palette.putpalette([10, 20, 30, 255, 255, 255, 0, 0, 0] + [0] * 759)
    got = written(tmp_path, palette)
    assert got.levels.tolist() == [[60, 765], [0, 765]]
    clear = written(tmp_path, palette, transparency=1)
    assert clear.opaque.tolist() == [[True, False], [True, False]]
    bits = written(tmp_path, Image.fromarray(np.array([[True, False]])))
    assert (bits.levels.tolist(), bits.top) == ([[255, 0]], 255)


def test_a_transparent_grey_level_is_transparent(tmp_path):
    got = written(tmp_path, Image.fromarray(GREY), transparency=254)
    assert got.opaque.tolist() == (GREY != 254).tolist()
    deep = GREY.astype(np.uint16)
    header = struct.pack(">IIBBBBB", 3, 2, 16, 0, 0, 0, 0)
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in deep)
    (tmp_path / "deep.png").write_bytes(
        png(
            (b"IHDR", header), (b"tRNS", struct.pack(">H", 205)), (b"IDAT", zlib.compress(rows)),
            (b"IEND", b""),
        )
    )  # fmt: skip
    got = read_image(tmp_path / "deep.png")
    assert got.levels.tolist() == deep.tolist()
    assert got.opaque.tolist() == (GREY != 205).tolist()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "is no picture in PNG, PGM, PPM or BMP format"),
        (b"Dear diary", "is no picture"),
        (b"GIF89a", "is no picture"),
        (b"P5 3 2 255\nabc", "cut off or damaged"),
        (b"P2 3 2 255\n1 2 3", "cut off or damaged"),
        (b"P5 0 2 255\n", "a.png: "),
        (b"P2 20000 20000 255\n0", "more than 100 million pixels"),
        (b"P5 10001 10000 255\n0", "more than 100 million pixels"),
        (
            png((b"IHDR", struct.pack(">IIBBBBB", 90000, 90000, 8, 0, 0, 0, 0)), (b"IDAT", b"")),
            "100 million",
        ),
    ],
)
def test_what_is_no_picture_is_one_clear_line(tmp_path, content, said):
    path = tmp_path / "a.png"
    path.write_bytes(content)
    with pytest.raises(MapError) as caught:
        read_image(path)
    assert said in str(caught.value)
    assert str(caught.value).startswith(f"{path}: ")
    assert len(str(caught.value).splitlines()) == 1


def test_a_picture_cut_off_anywhere_is_refused_or_whole(tmp_path):
    stream = io.BytesIO()
    noise = np.random.default_rng(0).integers(0, 256, (40, 50)).astype(np.uint8)
    Image.fromarray(noise).save(stream, "PNG")
    whole = stream.getvalue()
    path = tmp_path / "a.png"
    for end in range(0, len(whole) - 16, 97):
        path.write_bytes(whole[:end])
        with pytest.raises(MapError):
            read_image(path)


def test_missing_files_and_folders_are_named(tmp_path):
    with pytest.raises(MapError, match=r"nope\.png: no such file"):
        read_image(tmp_path / "nope.png")
    with pytest.raises(MapError, match="is a folder"):
        read_image(tmp_path)


MAGIC = st.sampled_from(
    [b"", b"P2 ", b"P5 2 2 255\n", b"P1 3 3 ", b"P6 ", b"Pf ", b"BM", b"\x89PNG\r\n\x1a\n"]
)


@given(MAGIC, st.binary(max_size=200))
@settings(max_examples=150, deadline=None)
def test_any_bytes_give_a_picture_or_a_map_error(tmp_path_factory, magic, rest):
    path = tmp_path_factory.mktemp("any") / "a.png"
    path.write_bytes(magic + rest)
    try:
        got = read_image(path)
    except MapError as error:
        assert str(error)  # noqa: PT017 - some bytes happen to be a picture
    else:
        assert got.levels.max() <= got.top


@given(st.data())
@settings(max_examples=100, deadline=None)
def test_a_damaged_png_gives_a_picture_or_a_map_error(tmp_path_factory, data):
    stream = io.BytesIO()
    mode = data.draw(st.sampled_from(["L", "LA", "RGBA", "P", "1"]))
    Image.fromarray(GREY).convert(mode).save(stream, "PNG")
    raw = bytearray(stream.getvalue())
    for _ in range(data.draw(st.integers(1, 4))):
        raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.mktemp("any") / "a.png"
    path.write_bytes(raw)
    try:
        read_image(path)
    except MapError as error:
        assert str(error)  # noqa: PT017


def test_the_limit_is_that_of_plans():
    from ssrics_like.world.buildings import plan

    assert module.CELLS_MAX is plan.CELLS_MAX
