"""What a trace tells of real runs: the production that fired is the one that nothing kept back."""

import csv
import json

import pytest
from viewer_runs import results

from ssrics_like.productions import Rule
from ssrics_like.productions.syntax import parse_rule
from ssrics_like.viewer.judging import BUSY, ERROR, FREE, HOLDS, UNKNOWN
from ssrics_like.viewer.manifest import said_in
from ssrics_like.viewer.story import Confidence, answers_of, told
from ssrics_like.viewer.telling import said_of, story_data
from ssrics_like.viewer.trace import Event, read_trace


def story_of(folder):
    manifest = json.loads((folder / "manifest.json").read_text())
    rules = said_in(folder, manifest).rules
    with (folder / "decisions.csv").open() as lines:
        decided = [
            Confidence(row["rule"], float(row["confidence"]) if row["confidence"] else None)
            for row in csv.DictReader(lines)
            if row["decision"] != "overwritten"
        ]
    start_s = manifest["runs"][0]["start_s"]
    events = read_trace(folder / "trace" / "run-000.jsonl", start_s)
    return rules, events, told(events, rules, decided)


@pytest.mark.parametrize("name", ["demo", "errand"])
def test_of_every_firing_no_condition_fails_and_of_no_other_rule_that_would_go_before(name):
    rules, events, story = story_of(results(name))
    fired = [event.name for event in events if event.action == "production-fired"]
    assert [firing.rule for firing in story.firings] == fired
    assert len(set(fired)) >= 5
    order = {rule.name: (-rule.utility, place) for place, rule in enumerate(rules)}
    for resolution in story.resolutions:
        kinds = {
            rule.name: verdict.kind
            for rule, verdict in zip(rules, resolution.verdicts, strict=True)
        }
        matched = [rule for rule, kind in kinds.items() if kind == HOLDS]
        assert UNKNOWN not in kinds.values()
        assert resolution.selected == min(matched, key=order.get, default="")


@pytest.mark.parametrize("name", ["demo", "errand"])
def test_each_firing_leads_to_the_resolution_that_selected_it(name):
    rules, _, story = story_of(results(name))
    for firing in story.firings:
        resolution = story.resolutions[firing.resolution]
        assert resolution.selected == firing.rule
        assert 0.0 < firing.t_s - resolution.t_s < 0.0501  # rule_firing
    (last,) = {len(resolution.verdicts) for resolution in story.resolutions}
    assert last == len(rules)


def rule(name, text, utility=0.0):
    return Rule(name, "", parse_rule(text), text, utility, 1)


ASK = rule("ask", "=g> isa task\n==>\n+retrieval> isa landmark")
DECIDE = rule(
    "decide", "?retrieval> confidence_above 0.5\n==>\n+landmark> isa mark\noutcome unsure\nevent =e"
)
BOTH = rule(
    "both",
    "=g> isa task\n==>\n+retrieval> isa landmark\n+landmark> isa mark\noutcome unsure\nevent =e",
)


def fired(name, t_s=0.0):
    return Event(t_s, "production-fired", name, None)


RETRIEVAL = Event(0.0, "start-retrieval", "", None)


def test_a_decision_tells_how_sure_the_answer_before_it_was():
    events = [fired("ask"), RETRIEVAL, fired("ask"), RETRIEVAL, fired("decide"), fired("decide")]
    rows = [Confidence("decide", 0.9), Confidence("decide", None)]
    assert answers_of(events, [ASK, DECIDE], rows) == {1: 0.9}


def test_a_rule_that_decides_and_asks_at_once_tells_nothing():
    events = [fired("ask"), RETRIEVAL, fired("both"), RETRIEVAL]
    assert answers_of(events, [ASK, BOTH], [Confidence("both", 0.9)]) == {}


def test_tables_of_another_trace_tell_nothing():
    events = [fired("ask"), RETRIEVAL, fired("decide")]
    assert answers_of(events, [ASK, DECIDE], [Confidence("declare", 0.9)]) == {}


def test_states_follow_requests_answers_and_failures():
    mark = {"isa": "landmark", "id": "L1"}
    events = [
        Event(1.0, "module-request", "retrieval", None),
        Event(1.0, "clear-buffer", "retrieval", None),
        RETRIEVAL,
        Event(1.2, "retrieval-failure", "", None),
        Event(2.0, "module-request", "landmark", None),
        Event(2.0, "clear-buffer", "landmark", None),
        Event(2.0, "set-buffer-chunk", "landmark", mark),
        Event(3.0, "module-request", "landmark", None),
        Event(3.0, "clear-buffer", "landmark", None),
        Event(3.0, "conflict-resolution", "", None),
        Event(4.0, "clear-buffer", "retrieval", None),
    ]
    seen = [(c.t_s, c.buffer, c.standing.state) for c in told(events, [], []).changes]
    assert seen == [
        (1.0, "retrieval", BUSY), (1.0, "retrieval", BUSY), (1.2, "retrieval", ERROR),
        (2.0, "landmark", BUSY), (2.0, "landmark", BUSY), (2.0, "landmark", FREE),
        (3.0, "landmark", BUSY), (3.0, "landmark", BUSY), (3.0, "landmark", ERROR),
        (4.0, "retrieval", FREE),
    ]  # fmt: skip


def test_rules_that_matched_and_lost_say_why():
    rules = [
        rule("high", "=g> isa task\n==>\n~g>", 1.0),
        rule("low", "=g> isa task\n==>\n~g>"),
        rule("high-too", "=g> isa task\n==>\n~g>", 1.0),
    ]
    events = [
        Event(0.0, "set-buffer-chunk", "g", {"isa": "task"}),
        Event(0.0, "conflict-resolution", "", None),
        Event(0.0, "production-selected", "high", None),
    ]
    story = told(events, rules, [])
    (resolution,) = story.resolutions
    assert [verdict.found for verdict in said_of(resolution, rules)] == [
        "",
        "high has the greater utility, 1 over 0",
        "high was chosen: it stands first in the rule set",
    ]
    data = story_data(story, rules)
    assert data["resolutions"] == [[0.0, 0, 0]]
    assert data["chunks"] == [["task", []]]
    assert data["buffers"] == {"g": [[0.0, 0, "free"]]}
