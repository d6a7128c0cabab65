"""The command ``ssrics``: one module a command, parsing only, then one call inward.

Nothing heavy is imported before a command runs, so that help is quick.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from cyclopts import App, CycloptsError, Parameter

import ssrics_like
from ssrics_like.cli import (
    bench,
    check,
    compare,
    library,
    maps,
    memory,
    replay,
    report,
    run,
    schema,
    study,
    study_simulate,
    train,
    view,
)
from ssrics_like.errors import SsricsError

USER_ERROR = 1
INTERRUPTED = 130

app = App(
    name="ssrics",
    help="Let a robot mark landmarks the way people do.",
    help_epilogue="""For example:

    ssrics replay robot.log -o out/
    ssrics run demo -o out/

ssrics COMMAND --help tells more.""",
    help_format="plaintext",
    version=ssrics_like.__version__,
    version_flags=["--version"],
    result_action="return_value",
    suppress_keyboard_interrupt=False,
)
app.command(replay.replay, help_epilogue="")
app.command(run.run, help_epilogue="")
app.command(check.check, help_epilogue="")
app.command(compare.compare, help_epilogue="")
app.command(library.list_entries, name="list", help_epilogue="")
app.command(library.show, help_epilogue="")
app.command(report.report, help_epilogue="")
app.command(view.view, help_epilogue="")
app.command(schema.schema, help_epilogue="")
app.command(train.train, help_epilogue="")
several = Parameter(consume_multiple=True, negative="")
app.command(bench.bench, help_epilogue="", default_parameter=several)
map_app = App(
    name="map",
    help="Draw floor plans, make buildings up, look at maps.",
    help_epilogue="""For example:

    ssrics map generate -o maps/ --seed 7
    ssrics map show maps/map.yaml -o picture.png""",
)
map_app.command(maps.draw, help_epilogue="")
map_app.command(maps.generate, help_epilogue="")
map_app.command(maps.show, help_epilogue="")
app.command(map_app)
memory_app = App(
    name="memory",
    help="Look at what runs have left in memory, merge it, hand it on.",
    help_epilogue="""For example:

    ssrics memory show out/demo/
    ssrics run demo -o out/second/ --memory-from out/demo/""",
)
memory_app.command(memory.show, help_epilogue="")
memory_app.command(memory.merge, help_epilogue="")
memory_app.command(memory.export, help_epilogue="")
app.command(memory_app)
study_app = App(
    name="study",
    help="Collect people's choices of landmarks on a web page.",
    help_epilogue="""For example:

    ssrics study serve complex
    ssrics study export complex -o answers/""",
)
study_app.command(study.new, help_epilogue="")
study_app.command(study.serve, help_epilogue="")
study_app.command(study.export, help_epilogue="")
study_app.command(study.import_choices, name="import", help_epilogue="")
study_app.command(study_simulate.simulate, help_epilogue="")
app.command(study_app)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit; a user's error is one line a problem, and status 1."""
    _prepare_streams()
    try:
        status = app(arguments, exit_on_error=False, print_error=False)
        sys.stdout.flush()
    except CycloptsError as error:
        _complain(" ".join(str(error).split()) + " (see ssrics --help)")
        status = USER_ERROR
    except SsricsError as error:
        _complain(str(error))
        status = USER_ERROR
    except BrokenPipeError:
        # Whoever read our output has enough, as `ssrics list | head` does.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = 0
    except OSError as error:  # the disk is full, a file may not be read: nothing we can mend
        said = error.strerror or str(error)
        _complain(f"{error.filename}: {said}" if error.filename else said)
        status = USER_ERROR
    except KeyboardInterrupt as stop:
        _complain(": ".join(["interrupted", *map(str, stop.args)]))
        status = INTERRUPTED
    sys.exit(status or 0)


def _prepare_streams() -> None:
    """See to it that messages can be written, whatever the terminal's encoding, even to none."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by the caller, as by `2>&-`
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115, PTH123
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def _complain(text: str) -> None:
    for line in text.splitlines():
        print(f"ssrics: {line}", file=sys.stderr)
