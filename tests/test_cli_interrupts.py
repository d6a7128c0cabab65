"""Ctrl-C, whenever it comes: one line at most, never a traceback."""

import subprocess
import sys

import pytest

INTERRUPTED = (130, -2)  # Python may hand the signal on, which a shell shows as 130 too

AT_AN_IMPORT = """
import os, signal, sys

class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == WANTED:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
"""
OF_AN_ERROR = """
import signal
import ssrics_like.cli

def run():
    try:
        signal.raise_signal(signal.SIGINT)
    except KeyboardInterrupt:
        raise ValueError("a library's word for it") from None

ssrics_like.cli.main = run
"""
AT_THE_END = """
import atexit, signal

atexit.register(signal.raise_signal, signal.SIGINT)
"""
IGNORED = """
import signal

signal.signal(signal.SIGINT, signal.SIG_IGN)
"""
MAIN = "from ssrics_like.__main__ import main\nmain()\n"


def run(before, *arguments):
    command = [sys.executable, "-c", before + MAIN, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    "module",
    [
        "ssrics_like.cli",
        "cyclopts",
        "ssrics_like.cli.view",
        "ssrics_like.library",
        "yaml",
        "pydantic",
    ],
)
def test_an_interrupt_amid_imports_is_one_line(module):
    status, _, complaint = run(f"WANTED = {module!r}\n{AT_AN_IMPORT}", "list", "memory")
    assert status in INTERRUPTED
    assert complaint == "ssrics: interrupted\n"


def test_an_error_that_a_library_made_of_an_interrupt_is_an_interrupt():
    status, _, complaint = run(OF_AN_ERROR)
    assert status in INTERRUPTED
    assert complaint == "ssrics: interrupted\n"


def test_an_interrupt_after_the_last_word_is_no_traceback():
    status, said, complaint = run(AT_THE_END, "--version")
    assert status in INTERRUPTED
    assert said
    assert complaint == "ssrics: interrupted\n"


def test_a_bug_keeps_its_traceback():
    status, _, complaint = run(OF_AN_ERROR.replace("signal.raise_signal(signal.SIGINT)", "1 / 0")
                               .replace("except KeyboardInterrupt", "except ZeroDivisionError"))  # fmt: skip
    assert status == 1
    assert "Traceback" in complaint


def test_who_ignores_interrupts_goes_on_ignoring_them():
    before = IGNORED + f"WANTED = 'ssrics_like.library'\n{AT_AN_IMPORT}"
    status, said, complaint = run(before, "list", "memory")
    assert (status, complaint) == (0, "")
    assert "act-r" in said


def test_the_module_and_the_command_are_the_same():
    command = [sys.executable, "-m", "ssrics_like", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == (run("", "--version")[1], "")
