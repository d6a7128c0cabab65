"""``ssrics check``: is a file what it should be?"""

from __future__ import annotations

import sys
from pathlib import Path


def check(*files: Path) -> int:
    """Check files before they are used: logs, rule sets, profiles, scenarios, studies, results.

    Every problem of every file is reported; the exit status is 1 if there is any.

    For example:

        ssrics check robot.log my-rules.yaml

    Parameters
    ----------
    files
        The files.
    """
    from ssrics_like.cli.execute import progress_bar
    from ssrics_like.errors import SsricsError, choices
    from ssrics_like.scenarios.checking import KINDS, check_file

    if not files:
        known = choices((*KINDS, "study"))
        raise SsricsError(f"check: name at least one file; it may be {known}")
    wrong = 0
    for path in files:
        try:
            with progress_bar(quiet=False) as bar:
                task = bar.add_task(path.name, total=1.0)
                said = check_file(
                    path,
                    lambda share: bar.update(task, completed=share),  # noqa: B023
                    _study,
                )
            print(f"{path}: ok: {said}")
        except SsricsError as error:
            wrong += 1
            for line in str(error).splitlines():
                print(f"ssrics: {line}", file=sys.stderr)
    return 1 if wrong else 0


def _study(path: Path) -> str:
    from ssrics_like.results.counts import counted
    from ssrics_like.study.reading import read_study

    study = read_study(path)
    practice = f", {len(study.practice)} of practice" if study.practice else ""
    return f"'{study.settings.title}', {counted(len(study.trials), 'trial')}{practice}"
