"""The rule set `landmark`: which structure passes by, and how a modeller has it marked."""

import math
from dataclasses import replace

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
