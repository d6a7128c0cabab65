"""Profiles: the settings, their limits, and those that ship with the package."""

from pathlib import Path

import pytest
import yaml
from pydantic import ValidationError

from ssrics_like.perception import PerceptionProfile

LIBRARY = Path(__file__).parents[1] / "perception"


def load(name):
    text = (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8")
    return PerceptionProfile.model_validate(yaml.safe_load(text))


def test_the_reports_profile_has_the_reports_values():
    profile = load("report")
    assert (profile.gradient, profile.interval, profile.threshold) == (0.99, 50, 0.75)
    assert (profile.advance, profile.mark, profile.anchor) == ("tumbling", "every", "newest")
    assert (profile.sector_rule, profile.repair_window) == ("maximum", 0)


def test_the_defaults_are_those_of_the_human_like_profile_but_for_what_it_looks_along():
    plain = {
        "title": "",
        "source": "",
        "along": "scans",
        "egomotion": "odometry",
        "doorways": "",
        "structure": "",
        "view": "scan",
        "interval": 20,
    }
    assert load("human-like").model_copy(update=plain) == PerceptionProfile()


def test_a_cue_needs_places_along_the_way():
    for key in ("doorways", "structure"):
        with pytest.raises(ValidationError, match=f"{key}: .* set along: metres"):
            PerceptionProfile(**{key: "one"})


def test_every_key_of_a_shipped_profile_is_described_in_its_readme():
    readme = (LIBRARY / "README.md").read_text(encoding="utf-8")
    for key in PerceptionProfile.model_fields:
        assert f"`{key}`" in readme
    for file in LIBRARY.glob("*.yaml"):
        assert load(file.stem).title
        assert f"`{file.stem}`" in readme


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("interval", 1, "greater than or equal to 2"),
        ("interval", 50.5, "valid integer"),
        ("interval", "50", "valid integer"),
        ("interval", True, "valid integer"),
        ("gradient", 99.0, "less than 1"),
        ("gradient", 0.0, "greater than 0"),
        ("threshold", 75, "less than 1"),
        ("prominence", 0, "greater than 0"),
        ("range_cap_m", -8.0, "greater than 0"),
        ("range_cap_m", float("inf"), "finite"),
        ("repair_window", 4, "an odd number of beams, 3 or more"),
        ("repair_window", 1, "expected 0"),
        ("advance", "slide", "'tumbling' or 'sliding'"),
        ("mark", "all", "'every', 'onset' or 'peak'"),
        ("anchor", "last", "'newest', 'middle' or 'oldest'"),
        ("sector_rule", "median", "'maximum' or 'robust'"),
        ("view_beams", 1, "greater than or equal to 2"),
        ("intervall", 50, "Extra inputs are not permitted"),
    ],
)
def test_a_wrong_setting_is_refused_by_name(key, value, message):
    with pytest.raises(ValidationError, match=message) as caught:
        PerceptionProfile.model_validate({key: value})
    assert caught.value.errors()[0]["loc"] == (key,)


def test_whole_numbers_do_for_fractions_of_metres_and_a_profile_is_frozen():
    profile = PerceptionProfile.model_validate({"range_cap_m": 8})
    with pytest.raises(ValidationError, match="frozen"):
        profile.interval = 3
