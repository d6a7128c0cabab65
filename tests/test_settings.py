"""YAML files and overrides: all errors of a file at once, each with its place."""

from pathlib import Path
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, ConfigDict, Field

from ssrics_like import settings
from ssrics_like.errors import LibraryError, SettingsError
from ssrics_like.library import KINDS, entries, find, folder


class Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Inner(Strict):
    decay: float = Field(default=0.5, gt=0)
    rule: Literal["robust", "maximum"] = "robust"


class Outer(Strict):
    title: str = ""
    runs: int = 1
    inner: Inner = Inner()
    optional: Inner | None = None
    weights: dict[str, float] = {}


def load(tmp_path: Path, text: str) -> Outer:
    path = tmp_path / "file.yaml"
    path.write_text(text)
    return settings.validated(Outer, settings.read_document(path))


def complaints(tmp_path: Path, text: str) -> list[str]:
    with pytest.raises(SettingsError) as caught:
        load(tmp_path, text)
    return [line.removeprefix(f"{tmp_path}/file.yaml") for line in str(caught.value).splitlines()]


def test_a_good_file_becomes_settings(tmp_path):
    got = load(tmp_path, "title: x\nruns: 3\ninner:\n  decay: 0.25\noptional: {rule: maximum}\n")
    assert got.runs == 3
    assert got.inner.decay == 0.25
    assert got.optional is not None
    assert got.optional.rule == "maximum"


def test_all_errors_come_at_once_with_line_and_column_in_order(tmp_path):
    found = complaints(
        tmp_path,
        "titel: x\nruns: many\ninner:\n  decay: -1\n  rule: robst\nruns: 2\noptional:\n  deca: 1\n",
    )
    assert found == [
        ":1:1: unknown key 'titel'; did you mean 'title'?",
        ":2:1: runs: 'many' where a whole number was expected",
        ":4:3: inner.decay: -1: expected greater than 0",
        ":5:3: inner.rule: 'robst' where 'robust' or 'maximum' was expected; did you mean 'robust'?",
        ":6:1: key 'runs' stands twice (first in line 2)",
        ":8:3: unknown key 'optional.deca'; did you mean 'decay'?",
    ]


def test_numbers_may_be_written_with_an_exponent(tmp_path):
    assert load(tmp_path, "inner:\n  decay: 1e-3\n").inner.decay == 0.001
    assert settings.parse_override("a=2e3") == ("a", 2000.0)


def test_an_unknown_key_that_resembles_nothing_lists_the_known_ones(tmp_path):
    (found,) = complaints(tmp_path, "inner:\n  zzz: 1\n")
    assert found == ":2:3: unknown key 'inner.zzz'; known keys: decay, rule"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the file is empty"),
        ("# only a comment\n", "the file is empty"),
        ("- a\n- b\n", ":1:1: expected keys and values"),
        ("just words\n", ":1:1: expected keys and values"),
        ("a: [1, 2\n", ":2:1: not valid YAML"),
        ("a: 1\n b: 2\n", "not valid YAML"),
        ("a: &x\n  b: *x\n", "contains itself"),
        ("a: \x00\n", "not valid YAML"),
        ("title: 2024-13-45\n", ":1:8: '2024-13-45' cannot be read as"),
        ("runs: !foo 3\n", ":1:7: '3' cannot be read as !foo"),
        ("? [a, b]\n: 1\n", ":1:3: a key must be a word"),
        ("a: " + "[" * 3000 + "]" * 3000 + "\n", "nested too deeply"),
        (
            "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n"
            + "".join(f"a{i}: &a{i} [{','.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 9)),
            "more than 100000 values",
        ),
    ],
)
def test_what_is_no_settings_file_is_one_clear_line(tmp_path, text, said):
    found = complaints(tmp_path, text)
    assert len(found) == 1
    assert said in found[0]


def test_a_missing_file_a_folder_and_a_binary_are_one_clear_line(tmp_path):
    (tmp_path / "binary.yaml").write_bytes(b"\xff\xfe\x00\x01\x80")
    for path, said in [
        (tmp_path / "none.yaml", "no such file"),
        (tmp_path, "is a folder"),
        (tmp_path / "binary.yaml", "cannot be read as text"),
    ]:
        with pytest.raises(SettingsError, match=said) as caught:
            settings.read_document(path)
        assert "\n" not in str(caught.value)


@given(st.text(max_size=200))
def test_any_text_gives_settings_or_a_settings_error(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("any") / "file.yaml"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    try:
        settings.validated(Outer, settings.read_document(path))
    except SettingsError as error:
        assert str(error)  # noqa: PT017 - any text may also happen to be good


@given(
    st.dictionaries(
        st.sampled_from(["title", "runs", "inner", "optional", "weights", "other", "9"]),
        st.recursive(
            st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
            lambda inner: (
                st.lists(inner, max_size=3)
                | st.dictionaries(st.sampled_from(["decay", "rule", "x"]), inner, max_size=3)
            ),
            max_leaves=6,
        ),
    )
)
def test_any_data_gives_settings_or_one_line_a_problem(data):
    document = settings.Document(Path("f.yaml"), data)
    try:
        settings.validated(Outer, document)
    except SettingsError as error:
        assert all(line.startswith("f.yaml: ") for line in str(error).splitlines())  # noqa: PT017


def test_overrides_are_checked_like_the_file():
    outer = Outer()
    changed = settings.override(outer, {"inner.decay": 0.3, "weights.g": 2}, "x.")
    assert changed.inner.decay == 0.3
    assert changed.weights == {"g": 2.0}
    assert outer.inner.decay == 0.5
    for change, said in [
        ({"inner.decya": 1}, "--set x.inner.decya: unknown key 'decya'; did you mean 'decay'?"),
        ({"inner.decay": -2}, "--set x.inner.decay: -2: expected greater than 0"),
        ({"runs.deep": 1}, "--set x.runs.deep: unknown key 'deep'"),
        ({"nothing": 1}, "--set x.nothing: unknown key 'nothing'; known keys: "),
    ]:
        with pytest.raises(SettingsError) as caught:
            settings.override(outer, change, "x.")
        assert str(caught.value).startswith(said)


def test_every_wrong_override_is_said_at_once_each_with_its_own_place():
    changes = {"inner.decya": 1, "inner.decay": -2, "runs": "many"}
    lines = {"inner.decya": "f:1: ", "inner.decay": "f:2: ", "runs": "f:3: "}
    with pytest.raises(SettingsError) as caught:
        settings.override(Outer(), changes, "x.", lines.__getitem__)
    assert [line.split(": ")[:2] for line in str(caught.value).splitlines()] == [
        ["f:1", "x.inner.decya"], ["f:2", "x.inner.decay"], ["f:3", "x.runs"],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a.b=0.3", ("a.b", 0.3)),
        ("a=x=y", ("a", "x=y")),
        ("a=[1]", ("a", [1])),
    ],
)
def test_an_override_is_split_at_its_first_equals_sign(text, expected):
    assert settings.parse_override(text) == expected


@pytest.mark.parametrize("text", ["", "a", "=3", "a=", "a=[1"])
def test_an_override_that_is_none_is_refused(text):
    with pytest.raises(SettingsError, match="--set"):
        settings.parse_override(text)


def test_the_library_finds_entries_and_paths(tmp_path):
    mine = tmp_path / "mine.yaml"
    mine.write_text("a: 1")
    assert find("productions", "landmark").name == "landmark.yaml"
    assert find("productions", str(mine)) == mine
    assert find("productions", mine) == mine
    for kind in KINDS:
        assert entries(kind), kind
        assert (folder(kind) / "README.md").is_file()


@pytest.mark.parametrize(
    ("kind", "name", "said"),
    [
        ("productions", "landmrk", "no productions entry 'landmrk'; did you mean 'landmark'?"),
        ("production", "landmark", "did you mean 'productions'?"),
        ("memory", "none.yaml", "none.yaml: no such file"),
        ("memory", "./none", "none: no such file"),
    ],
)
def test_the_library_names_the_nearest_entry(kind, name, said):
    with pytest.raises(LibraryError) as caught:
        find(kind, name)
    assert said in str(caught.value)
