"""The command line, used as a user would, mistakes included."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ssrics_like.cli import main
from ssrics_like.library import folder

DEMO = folder("scenarios") / "logs" / "demo.log.gz"


def run(capsys, *arguments):
    """Return exit status, standard output and standard error of a command."""
    with pytest.raises(SystemExit) as stopped:
        main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def test_replay_says_what_came_out_and_where_the_report_is(capsys, tmp_path):
    out = tmp_path / "out"
    status, said, complained = run(capsys, "replay", DEMO, "-o", out)
    assert (status, complained) == (0, "")
    assert "run 0: 1642 scans, 89.1 m" in said
    assert said.splitlines()[-1] == f"report: {out / 'report.html'}"
    assert (out / "report.html").is_file()


def test_the_same_command_twice_makes_the_same_bytes(capsys, tmp_path):
    def made(name):
        run(capsys, "replay", DEMO, "-o", tmp_path / name, "-q", "--seed", "4")
        return {
            path.relative_to(tmp_path / name): path.read_bytes()
            for path in sorted((tmp_path / name).rglob("*"))
            if path.is_file() and path.name != "manifest.json"
        }

    one = made("one")
    assert {path.suffix for path in one} >= {".html", ".svg", ".csv", ".jsonl", ".graphml", ".json"}
    assert made("two") == one


def test_json_schemas_know_the_keys(capsys):
    import json

    for kind, key in [
        ("scenario", "perception"), ("perception", "gradient"), ("memory", "decay"),
        ("productions", "chunk_types"),
    ]:  # fmt: skip
        status, printed, _ = run(capsys, "schema", kind)
        assert status == 0
        schema = json.loads(printed)
        assert key in schema["properties"]
        assert schema["additionalProperties"] is False


def test_what_is_not_kept_is_said_in_one_line_unless_quiet(capsys, tmp_path):
    out = tmp_path / "out"
    for quiet in (["-q"], []):
        run(capsys, "replay", DEMO, "-o", out, "--jobs", "1", "-q")
        (out / "path.csv").write_text("")
        status, _, complained = run(
            capsys, "replay", DEMO, "-o", out, "--runs", "2", "--resume", "--jobs", "1", *quiet
        )
        assert status == 0
        lines = complained.splitlines()
        assert len(lines) == (not quiet)
        assert all(line.startswith(f"ssrics: {out}: its runs are damaged") for line in lines)


def test_quiet_says_nothing_and_overrides_reach_the_manifest(capsys, tmp_path):
    status, said, complained = run(
        capsys, "replay", DEMO, "-o", tmp_path / "out", "-q", "--perception", "report",
        "--productions", "report", "--set", "memory.decay=0.3", "--set", "perception.interval=30",
    )  # fmt: skip
    assert (status, said, complained) == (0, "", "")
    manifest = (tmp_path / "out" / "manifest.json").read_text()
    assert '"decay": 0.3' in manifest
    assert '"interval": 30' in manifest


def test_a_scenario_of_the_library_runs_by_name(capsys, tmp_path):
    status, said, _ = run(capsys, "run", "demo", "-o", tmp_path / "out")
    assert status == 0
    assert "report.html" in said


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["replya", "x"], 'Did you mean "replay"?'),
        (["replay"], "requires an argument"),
        (["replay", "x.log", "--quite"], "Did you mean --quiet?"),
        (["replay", "no-such.log"], "no-such.log"),
        (["replay", DEMO, "--productions", "landmrk"], "did you mean 'landmark'?"),
        (["replay", DEMO, "--perception", "human_like"], "did you mean 'human-like'?"),
        (["replay", DEMO, "--memory", "mine.yaml"], "mine.yaml: no such file"),
        (["replay", DEMO, "--set", "memory.decya=1"], "did you mean 'decay'?"),
        (["replay", DEMO, "--set", "memry.decay=1"], "did you mean 'memory'?"),
        (["replay", DEMO, "--set", "memory.decay=-1"], "expected greater than 0"),
        (["replay", DEMO, "--set", "perception.interval=1"], "interval"),
        (["replay", DEMO, "--set", "memory"], "expected key=value"),
        (["replay", DEMO, "--set", "productions.parameters.rule_firin=1"], "'rule_firing'?"),
        (["replay", DEMO, "--set", "productions.rules=1"], "unknown key 'rules'"),
        (
            ["replay", DEMO, "--set", "memory.optimized_learning=maybe"],
            "true or false or a whole number",
        ),
        (["replay", DEMO, "--set", "memory.decay=yes"], "True where a number"),
        (
            ["replay", DEMO, "--set", "memory.source_activation={imagnal: 1}"],
            "did you mean 'imaginal'?",
        ),
        (["replay", DEMO, "--set", "title=2024-13-45"], "'2024-13-45' is not valid YAML"),
        (["schema", "scenari"], "did you mean 'scenario'?"),
        (["replay", DEMO, "--format", "carmn"], "did you mean 'carmen'?"),
        (["replay", DEMO, "--frame", "mapp"], "did you mean 'map'?"),
        (["replay", DEMO, "--runs", "0"], "runs"),
        (["replay", DEMO, "--runs", "many"], "many"),
        (["replay", DEMO, "--runs", "1.5"], "1.5"),
        (["replay", DEMO, "--fallback-rate", "0"], "fallback_rate_hz"),
        (["run", "dem"], "did you mean 'demo'?"),
        (["run", "none.yaml"], "none.yaml: no such file"),
        (["run", DEMO], "demo.log.gz: is no YAML file, expected a scenario (ssrics replay takes"),
        (["run", DEMO.parents[1] / "maps" / "simple.yaml"], "is a map, expected a scenario"),
        (["run", folder("memory") / "act-r.yaml"], "is a memory profile, expected a scenario"),
        (["run", "demo", "-n", "0"], 'Invalid value "0" for -n. Must be >= 1'),
        (["run", "demo", "-n", "nine"], "Invalid value for -n: 'nine': expected a whole number"),
        (["list", "productionz"], "did you mean 'productions'?"),
        (["show", "productions", "lndmark"], "did you mean 'landmark'?"),
        (["report", "nowhere"], "nowhere: no such folder"),
        (["check"], "name at least one file"),
        (["check", "none.yaml"], "none.yaml: no such file"),
        (["check", "none.log"], "none.log"),
    ],
)
def test_a_users_mistake_is_one_clear_line_and_status_1(
    capsys, tmp_path, monkeypatch, arguments, said
):
    monkeypatch.chdir(tmp_path)
    status, printed, complained = run(capsys, *arguments)
    assert status == 1
    assert printed == ""
    assert len(complained.splitlines()) == 1, complained
    assert complained.startswith("ssrics: ")
    assert said in complained
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("empty.log", b""),
        ("foreign.log", b"Dear diary,\ntoday was fine.\n" * 20),
        ("picture.log", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 20),
        ("noscan.log", b"ODOM 0 0 0 0 0 0 0 host 0\nODOM 1 0 0 0 0 0 1 host 1\n"),
        ("cut.log.gz", DEMO.read_bytes()[:12]),
    ],
)
def test_what_is_no_log_is_one_clear_line(capsys, tmp_path, name, content):
    log = tmp_path / name
    log.write_bytes(content)
    status, _, complained = run(capsys, "replay", log, "-o", tmp_path / "out")
    assert status == 1
    assert len(complained.splitlines()) == 1
    assert name in complained
    assert not (tmp_path / "out").exists()


def test_check_reports_every_problem_of_every_file(capsys, tmp_path):
    rules = tmp_path / "rules.yaml"
    rules.write_text(
        (folder("productions") / "landmark.yaml")
        .read_text()
        .replace("state free", "state fre")
        .replace("buffer failure", "bufer failure", 1)
    )
    memory = tmp_path / "memory.yaml"
    memory.write_text("decay: -1\nretrieval_treshold: 2\n")
    strange = tmp_path / "strange.yaml"
    strange.write_text("colour: blue\n")
    good = folder("perception") / "report.yaml"
    status, said, complained = run(capsys, "check", rules, good, memory, strange, DEMO)
    assert status == 1
    assert len(complained.splitlines()) == 5
    assert "did you mean 'free'?" in complained
    assert "did you mean 'buffer'?" in complained
    assert f"{memory}:1:1: decay: -1" in complained
    assert f"{memory}:2:1: unknown key 'retrieval_treshold'" in complained
    assert "none of its keys is known" in complained
    assert [line.split(": ")[1] for line in said.splitlines()] == ["ok", "ok"]
    assert "carmen log, 1642 scans" in said


def test_check_finds_damaged_results_and_scenarios_without_their_files(capsys, tmp_path):
    out = tmp_path / "out"
    run(capsys, "run", "demo", "-o", out, "-q")
    assert run(capsys, "check", out)[0] == 0
    table = (out / "decisions.csv").read_text()
    for damage, said in [
        (table[: len(table) // 2], "decisions.csv"),
        ("", "decisions.csv:1: the header"),
        (table + "1,2\n", "has 2 cells, expected 19"),
        ("\n".join(table.splitlines()[:-1]) + "\n", "rows of run 0, the manifest"),
    ]:
        (out / "decisions.csv").write_text(damage)
        status, _, complained = run(capsys, "check", out)
        assert status == 1
        assert said in complained
    scenario = tmp_path / "s.yaml"
    scenario.write_text("source: {log: nope.log}\nperception: reprot\nmemory: ./none.yaml\n")
    status, _, complained = run(capsys, "check", scenario)
    assert status == 1
    assert [line.split(": ")[1:3] for line in complained.splitlines()] == [
        [f"{scenario}:1:10", "source.log"],
        [f"{scenario}:2:1", "perception"],
        [f"{scenario}:3:1", "memory"],
    ]
    assert "did you mean 'report'?" in complained


def test_a_scenario_overrides_single_values(capsys, tmp_path):
    scenario = tmp_path / "s.yaml"
    scenario.write_text(
        f"source: {{log: {DEMO}}}\nset:\n  memory.decay: 0.3\n  perception.interval: 9\n"
    )
    run(capsys, "run", scenario, "-o", tmp_path / "out", "-q", "--set", "perception.interval=8")
    manifest = (tmp_path / "out" / "manifest.json").read_text()
    assert '"decay": 0.3' in manifest
    assert '"interval": 8' in manifest
    scenario.write_text(f"source: {{log: {DEMO}}}\nset: {{memry.decay: 0.3}}\n")
    status, _, complained = run(capsys, "run", scenario, "-o", tmp_path / "two")
    assert status == 1
    assert "did you mean 'memory'?" in complained


def test_every_entry_of_the_library_is_listed_shown_and_checked(capsys):
    status, listed, _ = run(capsys, "list")
    assert status == 0
    for kind in ("productions", "perception", "memory", "scenarios"):
        assert f"{kind}/" in listed
        for path in folder(kind).glob("*.yaml"):
            assert f"  {path.stem} " in listed
            assert run(capsys, "check", path)[0] == 0
            _, shown, _ = run(capsys, "show", kind, path.stem)
            assert shown == f"# from the library of ssrics: {kind}/{path.name}\n{path.read_text()}"


def test_help_shows_examples_and_imports_nothing_heavy():
    code = (
        "import sys\nfrom ssrics_like.cli import main\n"
        "try:\n    main(['replay', '--help'])\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'numba', 'pyactr', 'matplotlib', 'pydantic', 'networkx'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "ssrics replay robot.log -o out/" in done.stdout
    assert done.stdout.splitlines()[-1] == "[]"


def test_version(capsys):
    import ssrics_like

    assert run(capsys, "--version") == (0, f"{ssrics_like.__version__}\n", "")


def test_a_closed_pipe_is_no_error(tmp_path):
    command = f"{sys.executable} -m ssrics_like show productions landmark | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) == 1


def test_ctrl_c_ends_with_status_130_and_one_line(tmp_path):
    process = subprocess.Popen(
        [
            sys.executable, "-m", "ssrics_like", "replay", str(DEMO), "--runs", "500",
            "-o", str(tmp_path / "out"),
        ],
        stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    deadline = time.monotonic() + 60
    while not (tmp_path / "out" / "manifest.json").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    os.kill(process.pid, signal.SIGINT)
    _, complained = process.communicate(timeout=60)
    assert process.returncode == 130
    assert complained.splitlines() == [
        f"ssrics: interrupted: finished runs are kept in {tmp_path / 'out'}; --resume goes on"
    ]
    assert Path(tmp_path / "out" / "decisions.csv").is_file()
