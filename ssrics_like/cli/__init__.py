"""The command ``ssrics``: one module a command, parsing only, then one call inward.

Nothing heavy is imported before a command runs, so that help is quick.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from cyclopts import App, CycloptsError

import ssrics_like
from ssrics_like.cli import check, library, replay, report, run
from ssrics_like.errors import SsricsError

USER_ERROR = 1
INTERRUPTED = 130

app = App(
    name="ssrics",
    help="""Let a robot mark landmarks the way people do.

    ssrics replay robot.log -o out/ : a robot's log in, landmarks and a report out.

    ssrics run demo -o out/ : a scenario from the library, or a file of your own.
    """,
    version=ssrics_like.__version__,
    version_flags=["--version"],
    result_action="return_value",
    suppress_keyboard_interrupt=False,
)
app.command(replay.replay)
app.command(run.run)
app.command(check.check)
app.command(library.list_entries, name="list")
app.command(library.show)
app.command(report.report)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit; a user's error is one line a problem, and status 1."""
    try:
        status = app(arguments, exit_on_error=False, print_error=False)
    except CycloptsError as error:
        _complain(" ".join(str(error).split()) + " (see ssrics --help)")
        status = USER_ERROR
    except SsricsError as error:
        _complain(str(error))
        status = USER_ERROR
    except KeyboardInterrupt:
        _complain("interrupted; finished runs are kept, --resume goes on from them")
        status = INTERRUPTED
    except BrokenPipeError:
        # Whoever read our output has enough, as `ssrics list | head` does.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = 0
    sys.exit(status or 0)


def _complain(text: str) -> None:
    for line in text.splitlines():
        print(f"ssrics: {line}", file=sys.stderr)
