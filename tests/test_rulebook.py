"""Rule files: what is read, and that every mistake has its line."""

from pathlib import Path

import pytest

from ssrics_like.errors import RuleError
from ssrics_like.library import entries
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.productions.syntax import RuleSyntaxError, parse_rule

HEAD = """\
title: Test
chunk_types:
  reflex: [event, sector]
  landmark: [id, sector]
  mark: [outcome, event, landmark]
  task: [state, last]
goal: {isa: task, state: watch, last: none}
rules:
"""
FIRST_RULE_LINE = HEAD.count("\n") + 1
GOOD = """\
  - name: attend
    why: look
    rule: |
      =g>
          isa task
          state watch
      =orienting>
          isa reflex
          event =event
      ==>
      +landmark>
          isa mark
          outcome declared
          event =event
      ~orienting>
"""


def write(tmp_path: Path, rules: str, head: str = HEAD) -> Path:
    path = tmp_path / "rules.yaml"
    path.write_text(head + rules)
    return path


def problems(tmp_path: Path, rules: str, head: str = HEAD) -> list[str]:
    path = write(tmp_path, rules, head)
    with pytest.raises(RuleError) as caught:
        load_rulebook(path)
    return [line.removeprefix(f"{path}:") for line in str(caught.value).splitlines()]


@pytest.mark.parametrize("path", entries("productions").values(), ids=lambda path: path.stem)
def test_every_rule_set_of_the_library_is_valid(path):
    book = load_rulebook(path)
    assert book.rules
    assert all(rule.why for rule in book.rules)


def test_a_rule_is_taken_apart_with_the_line_of_each_word():
    text = parse_rule("=g>\n  isa task # a comment\n  last ~=x\n==>\n~g>", first_line=10)
    (test,) = text.tests
    assert (test.sign, test.buffer, test.chunk_type, test.line) == ("=", "g", "task", 10)
    (pair,) = test.pairs
    assert (pair.slot, pair.word, pair.variable, pair.negated, pair.line) == (
        "last", "x", True, True, 12,
    )  # fmt: skip
    assert [str(clause) for clause in text.actions] == ["~g>"]


@pytest.mark.parametrize(
    ("rule", "line", "said"),
    [
        ("", 1, "is empty"),
        ("=g> isa task", 1, "expected one '==>'"),
        ("=g> isa task\n==>\n==>\n~g>", 3, "found 2"),
        ("==> ~g>", 1, "before '==>'"),
        ("=g> isa task ==>", 1, "after '==>'"),
        ("g> isa task ==> ~g>", 1, "expected a sign"),
        ("isa task ==> ~g>", 1, "expected a buffer"),
        ("=g> isa task state\n==> ~g>", 1, "'state' after '=g>' has no value"),
        ("=g> isa task\nstate $x ==> ~g>", 2, "'$x' for 'state'"),
        ("=g> isa task\n==>\n!g> show state", 3, "unknown action '!'"),
        ("=g> isa task\n==>\n~g>\nstate idle", 4, "takes nothing more"),
    ],
)
def test_grammar_errors_name_their_line(rule, line, said):
    with pytest.raises(RuleSyntaxError) as caught:
        parse_rule(rule)
    assert said in str(caught.value)
    assert caught.value.line == line


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("=orienting>", "=orientin>", 7, "unknown buffer 'orientin'; did you mean 'orienting'?"),
        ("isa reflex", "isa reflexx", 7, "unknown chunk type 'reflexx'; did you mean 'reflex'?"),
        ("state watch", "stat watch", 6, "unknown slot 'stat'; did you mean 'state'?"),
        ("event =event\n      ==>", "event =evnt\n      ==>", 14, "variable '=event' of slot 'event' is not bound"),
        ("outcome declared", "outcome declard", 13, "unknown outcome 'declard'; did you mean 'declared'?"),
        ("      ~orienting>\n", "      ~orienting>\n      ~orienting>\n", 16, "stands twice"),
        ("+landmark>", "=landmark>", 11, "cannot be modified"),
        ("~orienting>", "+orienting> isa reflex", 15, "takes no requests"),
        ("=g>\n", "?retrieval> stat free\n      =g>\n", 4, "unknown query 'stat'; did you mean 'state'?"),
        ("=g>\n", "?retrieval> state fre\n      =g>\n", 4, "did you mean 'free'?"),
        ("=g>\n", "?orienting> novelty_above much\n      =g>\n", 4, "where a number of 0 to 1 was expected"),
        ("=g>\n", "?retrieval> confidence_above 2\n      =g>\n", 4, "where a number of 0 to 1 was expected"),
        ("=g>\n", "?orienting> confidence_above 0.5\n      =g>\n", 4, "unknown query"),
        ("=g>\n", "?retrieval> permanence_below 1.5\n      =g>\n", 4, "where a number of 0 to 1 was expected"),
        ("=g>\n", "?retrieval> salience_above -1\n      =g>\n", 4, "where a number of 0 or more was expected"),
        ("=g>\n", "?retrieval> relevance_below inf\n      =g>\n", 4, "where a number of 0 or more was expected"),
        ("=g>\n", "?retrieval> relevance_below nan\n      =g>\n", 4, "where a number of 0 or more was expected"),
        ("=g>\n", "?retrieval> salience_abov 2\n      =g>\n", 4, "unknown query 'salience_abov'; did you mean 'salience_above'?"),
        ("=g>\n", "?orienting> relevance_above 2\n      =g>\n", 4, "unknown query 'relevance_above'"),
        ("=g>\n", "?orienting> novelty_above 0.5\n      =g>\n", 4, "chunk type 'reflex' has no slot 'novelty'"),
        ("=g>\n", "?orienting> salience_above 2\n      =g>\n", 4, "chunk type 'reflex' has no slot 'view'"),
        ("      =orienting>", "      =g> isa task\n      =orienting>", 7, "'=g>' stands twice"),
        ("          outcome declared\n", "", 11, "slot 'outcome' is missing"),
        ("outcome declared", "outcome recognised", 11, "slot 'landmark' is missing"),
        ("          event =event\n      ~", "          event ~=event\n      ~", 14, "only a retrieval"),
        ("isa task\n          state", "state", 4, "names no chunk type"),
        ("~orienting>", "=imaginal> isa task", 15, "does not test"),
    ],
)  # fmt: skip
def test_mistakes_in_a_rule_name_line_rule_and_word(tmp_path, old, new, line, said):
    assert old in GOOD
    # `line` counts from the entry's first line; the mistake's own line is checked.
    found = problems(tmp_path, GOOD.replace(old, new, 1))
    matching = [text for text in found if said in text]
    assert matching, found
    assert matching[0].startswith(f"{FIRST_RULE_LINE + line - 1}: rule 'attend': "), found


def test_all_problems_of_a_file_come_at_once_in_order_of_lines(tmp_path):
    found = problems(
        tmp_path,
        GOOD.replace("state watch", "stat watch").replace("declared", "declard") + GOOD,
    )
    assert len(found) == 3
    assert "stands twice" in found[2]
    lines = [int(text.split(":")[0]) for text in found]
    assert lines == sorted(lines)


def test_a_rule_that_nothing_leads_to_is_an_error(tmp_path):
    orphan = GOOD.replace("name: attend", "name: orphan").replace("watch", "wach")
    (found,) = problems(tmp_path, GOOD + orphan)
    assert "rule 'orphan': no other rule can lead to it" in found
    assert "nothing sets 'state' to 'wach'; did you mean 'watch'?" in found


def test_a_rule_that_waits_for_a_module_nobody_asks_is_an_error(tmp_path):
    waiting = GOOD.replace("name: attend", "name: waiting").replace(
        "=orienting>\n          isa reflex\n          event =event",
        "=retrieval>\n          isa landmark\n          id =event",
    )
    (found,) = problems(tmp_path, GOOD + waiting)
    assert "nothing makes a request to 'retrieval'" in found


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("reflex: [event, sector]", "reflex: [event, sectr]", "unknown slot 'sectr'; did you mean 'sector'?"),
        ("task: [state, last]", "task: [state, last, last]", "slot 'last' stands twice"),
        ("isa: task", "isa: tsk", "unknown chunk type 'tsk'; did you mean 'task'?"),
        ("{isa: task, state", "{isa: task, stat", "unknown slot 'stat'; did you mean 'state'?"),
        ("isa: task, ", "", "'isa' is missing"),
        ("rules:", "harvest: [retrieva]\nrules:", "did you mean 'retrieval'?"),
        ("title: Test", "titel: Test", "unknown key 'titel'; did you mean 'title'?"),
        ("title: Test", "title: Test\ntitle: Two", "stands twice"),
    ],
)  # fmt: skip
def test_mistakes_outside_the_rules_are_found_too(tmp_path, old, new, said):
    found = problems(tmp_path, GOOD, HEAD.replace(old, new, 1))
    assert any(said in text for text in found), found


def test_text_beside_the_rule_key_keeps_its_line(tmp_path):
    one_line = "  - name: a\n    why: b\n    rule: =g> isa tsk ==> ~g>\n"
    (found,) = problems(tmp_path, one_line)
    assert found.startswith(f"{FIRST_RULE_LINE + 2}: ")


STEP = """\
  - name: set-out
    why: go
    rule: |
      =way>
          isa way
          event ordered
      ==>
      +way>
          isa step
          act choose
"""
EXTENDING = """\
title: More
extends: base.yaml
chunk_types:
  way: [event, goal]
  step: [act, to, outcome]
rules:
"""


def extending(tmp_path, rules=STEP, head=EXTENDING):
    base = tmp_path / "base.yaml"
    base.write_text(HEAD + GOOD)
    path = tmp_path / "more.yaml"
    path.write_text(head + rules)
    return path


def test_a_rule_set_can_extend_another(tmp_path):
    book = load_rulebook(extending(tmp_path))
    assert [rule.name for rule in book.rules] == ["attend", "set-out"]
    assert set(book.chunk_types) == {"reflex", "landmark", "mark", "task", "way", "step"}
    assert book.goal == {"isa": "task", "state": "watch", "last": "none"}
    assert book.title == "More"
    assert book.leads
    assert not load_rulebook(tmp_path / "base.yaml").leads


def test_what_the_extending_file_says_replaces_what_the_other_says(tmp_path):
    head = EXTENDING.replace(
        "rules:", "goal: {isa: task, state: watch, last: L1}\nharvest: [way]\nrules:"
    )
    book = load_rulebook(extending(tmp_path, head=head))
    assert book.goal["last"] == "L1"
    assert book.harvest == ("way",)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("nothing.yaml", r"more.yaml:2: extends: .*nothing.yaml.*no such file"),
        ("landmrk", r"more.yaml:2: extends: .*landmrk.*landmark"),
        ("more.yaml", r"more.yaml:2: extends: more.yaml extends this file in turn"),
    ],
)
def test_what_cannot_be_extended_is_said_with_its_line(tmp_path, name, said):
    with pytest.raises(RuleError, match=said):
        load_rulebook(extending(tmp_path, head=EXTENDING.replace("base.yaml", name)))


def test_a_name_that_the_extended_file_has_already_is_refused(tmp_path):
    with pytest.raises(RuleError, match=r"rule 'attend': the name stands twice"):
        load_rulebook(extending(tmp_path, STEP.replace("set-out", "attend")))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("event ordered", "event orderd", r"unknown event 'orderd'; did you mean 'ordered'"),
        ("act choose", "act chose", r"unknown act 'chose'; did you mean 'choose'"),
        ("act choose", "act drive", r"'\+way>': slot 'to' is missing"),
        ("act choose", "act end\n          outcome arrived", r"unknown outcome 'arrived'"),
        ("act choose", "to L1", r"'\+way>': slot 'act' is missing"),
    ],
)
def test_mistakes_about_the_way_are_found(tmp_path, old, new, said):
    with pytest.raises(RuleError, match=said):
        load_rulebook(extending(tmp_path, STEP.replace(old, new)))
