"""``ssrics run``: a scenario."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.cli.options import Flag, Out, Overrides, Quiet


def run(
    scenario: str,
    *,
    out: Out = None,
    set_: Overrides = (),
    resume: Flag = False,
    quiet: Quiet = False,
) -> None:
    """Run a scenario: its runs, one results folder, a report.

    For example:

        ssrics run demo -o out/
        ssrics run my-scenario.yaml -o out/ --set runs=3

    Parameters
    ----------
    scenario
        An entry of the library, or a path ending in .yaml.
    out
        Folder for the results; out/NAME-OF-THE-SCENARIO if left out.
    set_
        Override one value, key=value; may be given again.
    resume
        Keep finished runs that are in the folder.
    quiet
        Print nothing but errors.
    """
    from ssrics_like import library
    from ssrics_like.cli.execute import execute
    from ssrics_like.scenarios.schema import load_scenario, resolve

    path = library.find("scenarios", scenario)
    resolved = resolve(load_scenario(path), path.parent, list(set_))
    execute(resolved, out or Path("out") / path.stem, resume=resume, quiet=quiet)
