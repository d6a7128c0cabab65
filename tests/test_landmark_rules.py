"""The rule set `landmark`: which structure passes by, and how a modeller has it marked."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

from ssrics_like import CognitiveModel, LaserScan, Observation, Pose
from ssrics_like.library import find
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rulebook import load_rulebook

PERCEPTION = PerceptionProfile(
    interval=2, advance="tumbling", mark="every", anchor="newest", repair_window=0, view_beams=12
)
MEMORY = MemoryProfile(retrieval_threshold=-6.5, latency_factor=0.001, activation_noise=0.0)
DOCS = Path(__file__).parents[1] / "docs" / "rules.md"
PASSING = ("corridor", "room", "opening", "junction", "corner")


def decided(rules, structures):
    """Have a model meet one novel place after another, each said to have a structure."""
    model = CognitiveModel(PERCEPTION, load_rulebook(rules), MEMORY)
    perceive = model.perception.update
    names = iter(structures)
    model.perception.update = lambda observation: [
        replace(reflex, structure=next(names)) for reflex in perceive(observation)
    ]
    decisions = []
    for i in range(2 * len(structures)):
        ranges = 2.0 + np.random.default_rng(i).random(60)
        scan = LaserScan(ranges, -math.pi / 2, math.pi / 60)
        decisions += model.observe(Observation(i, 5.0 * i, Pose(10.0 * i, 0.0, 0.0), scan))
    return [(d.structure, d.decision, d.rule) for d in decisions + model.finish()]


def test_doorways_and_the_unknown_are_attended_to_and_all_else_passes_by():
    found = decided(find("productions", "landmark"), ["doorway", *PASSING, "unknown"])
    assert found == [
        ("doorway", "declared", "declare"),
        *((word, "dismissed", f"pass-{word}") for word in PASSING),
        ("unknown", "declared", "declare"),
    ]


RULES = find("productions", "landmark").read_text()
BY_THE_REFLEX = RULES.replace(
    "          structure corner\n", "      ?orienting>\n          salience_above 0.1\n"
)
BY_WHAT_WAS_ASKED_FOR = RULES.replace(
    "          confidence_above 0.7\n", "          salience_below 0.1\n"
).replace("          confidence_below 0.7\n", "          salience_above 0.1\n")


@pytest.mark.parametrize(
    ("rules", "last"), [(BY_THE_REFLEX, "pass-corner"), (BY_WHAT_WAS_ASKED_FOR, "wonder")]
)
def test_rules_can_decide_by_how_surprising_a_view_is(tmp_path, rules, last):
    mine = tmp_path / "mine.yaml"
    mine.write_text(rules)
    found = decided(mine, ["doorway", "doorway"])
    # There is nothing that the first could be unlike; the second is unlike the first.
    assert [rule for *_, rule in found] == ["declare", last]


def test_the_rule_that_docs_give_as_an_example_declares_nothing_among_the_first_places(tmp_path):
    (text,) = re.findall(
        r"## What a landmark is worth.*?```yaml\n(.*?)```", DOCS.read_text(), re.DOTALL
    )
    rules = yaml.safe_load(RULES)
    (example,) = yaml.safe_load(text)
    rules["rules"] = [r if r["name"] != example["name"] else example for r in rules["rules"]]
    mine = tmp_path / "mine.yaml"
    mine.write_text(yaml.safe_dump(rules, sort_keys=False))
    assert decided(mine, ["doorway"]) == []


@pytest.mark.parametrize("word", PASSING)
def test_without_its_passing_rule_a_structure_is_marked_as_doorways_are(tmp_path, word):
    """What docs/rules.md tells a modeller to do."""
    rules = yaml.safe_load(find("productions", "landmark").read_text())
    rules["rules"] = [rule for rule in rules["rules"] if rule["name"] != f"pass-{word}"]
    mine = tmp_path / "mine.yaml"
    mine.write_text(yaml.safe_dump(rules, sort_keys=False))
    found = decided(mine, ["doorway", *PASSING])
    assert [(s, d) for s, d, _ in found] == [
        ("doorway", "declared"),
        *((other, "declared" if other == word else "dismissed") for other in PASSING),
    ]
