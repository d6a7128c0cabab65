"""``ssrics run``: a scenario."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.cli.options import Flag, Jobs, MemoryFrom, Out, Overrides, Quiet, Runs


def run(
    scenario: str,
    *,
    out: Out = None,
    set_: Overrides = (),
    runs: Runs = None,
    memory_from: MemoryFrom = None,
    jobs: Jobs = None,
    resume: Flag = False,
    quiet: Quiet = False,
) -> None:
    """Run a scenario: its runs, one results folder, a report.

    For example:

        ssrics run demo -o out/
        ssrics run complex --jobs 2
        ssrics run my-scenario.yaml -n 100 -o out/ --set perception.mark=onset
        ssrics run demo -o out/second/ --memory-from out/first/

    Parameters
    ----------
    scenario
        An entry of the library, or a path ending in .yaml.
    out
        Folder for the results; out/NAME-OF-THE-SCENARIO if left out.
    set_
        Override one value, key=value; may be given again.
    runs
        Number of runs, instead of the scenario's.
    memory_from
        Begin with what is remembered from an earlier run: a results folder (run 3 goes on from
        its run 3, all from the only one) or a file of memory.
    jobs
        How many runs at the same time; as many as there are cores if left out. The results are
        the same.
    resume
        Keep finished runs that are in the folder.
    quiet
        Print nothing but errors.
    """
    import json

    from ssrics_like import library
    from ssrics_like.cli.execute import execute, execute_variants
    from ssrics_like.scenarios.checking import expect_scenario
    from ssrics_like.scenarios.resolving import resolve
    from ssrics_like.scenarios.schema import read_scenario
    from ssrics_like.scenarios.variants import resolve_variants
    from ssrics_like.workers import cores

    path = library.find("scenarios", scenario)
    expect_scenario(path)
    read, document = read_scenario(path)
    overrides = [*set_, *([] if runs is None else [f"runs={runs}"])]
    if memory_from is not None:
        overrides.append(f"memory_from={json.dumps(str(memory_from))}")  # quoted as YAML has it
    folder = out or Path("out") / path.stem
    workers = cores() if jobs is None else jobs
    if read.factors or read.variants:
        each = resolve_variants(read, path.parent, overrides, where=document.where)
        execute_variants(read, each, folder, resume=resume, jobs=workers, quiet=quiet)
        return
    resolved = resolve(read, path.parent, overrides, where=document.where)
    execute(resolved, folder, resume=resume, jobs=workers, quiet=quiet)
