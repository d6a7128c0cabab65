"""The documentation: its examples run, its links lead somewhere."""

import doctest
import re
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = ("productions", "perception", "memory", "scenarios")
READMES = [ROOT / name / "README.md" for name in FOLDERS]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *READMES])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_that_are_there(page):
    for link in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
        if "://" not in link:
            assert (page.parent / link).exists(), link


@pytest.mark.parametrize("page", sorted(ROOT.glob("docs/*.md")), ids=lambda page: page.name)
def test_interactive_examples_say_what_they_print(page):
    assert doctest.testfile(str(page), module_relative=False).failed == 0


def test_the_readmes_python_runs(tmp_path, monkeypatch, capsys):
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    shutil.copy(ROOT / "scenarios" / "logs" / "demo.log.gz", tmp_path / "robot.log")
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(code, names)
    assert "declared L1 declare" in capsys.readouterr().out
    assert len(names["tau"]) == 1642 - 49


def test_every_command_of_the_command_line_is_in_the_readme_or_docs():
    from ssrics_like.cli import app

    text = "".join(page.read_text() for page in PAGES)
    for command in app:
        if not command.startswith("-"):
            assert f"ssrics {command}" in text, command
