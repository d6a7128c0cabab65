"""``ssrics replay``: a robot's log through the model."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.cli.options import Flag, Jobs, MemoryFrom, Out, Overrides, Quiet, Whole


def replay(
    log: Path,
    *,
    out: Out = None,
    perception: str = "human-like",
    productions: str = "landmark",
    memory: str = "act-r",
    memory_from: MemoryFrom = None,
    set_: Overrides = (),
    runs: Whole = 1,
    seed: Whole = 2006,
    format: str = "auto",  # noqa: A002 - the option's name
    frame: str | None = None,
    fallback_rate: float = 10.0,
    strict: Flag = False,
    jobs: Jobs = None,
    resume: Flag = False,
    quiet: Quiet = False,
) -> None:
    """Replay a robot's log: landmarks, a topological memory and a report come out.

    For example:

        ssrics replay robot.log -o out/
        ssrics replay robot.log.gz -o out/ --perception report --productions report
        ssrics replay robot.log -o out/ --set memory.decay=0.3
        ssrics replay tuesday.log --memory-from out/monday/ --set memory_pause_s=86400

    Parameters
    ----------
    log
        The log, plain or gzipped.
    out
        Folder for the results; out/NAME-OF-THE-LOG if left out.
    perception
        Perception profile: an entry of the library, or a path ending in .yaml.
    productions
        Rule set, likewise.
    memory
        Memory profile, likewise.
    memory_from
        Begin with what is remembered from an earlier run: a results folder (run 3 goes on from
        its run 3, all from the only one) or a file of memory.
    set_
        Override one value, key=value; may be given again.
    runs
        Number of runs; they differ in the memory's noise.
    seed
        Seed of all noise: same seed, same results.
    format
        Format of the log, if its content does not tell.
    frame
        Frame of the log's poses: map, odometry or corrected, if the log does not tell.
    fallback_rate
        Scans per second, assumed where the log's times are unusable.
    strict
        Stop at the first malformed line instead of counting and reporting it.
    jobs
        How many runs at the same time; as many as there are cores if left out.
    resume
        Keep finished runs that are in the folder.
    quiet
        Print nothing but errors.
    """
    from ssrics_like.cli.execute import execute
    from ssrics_like.scenarios.resolving import resolve
    from ssrics_like.scenarios.schema import make_scenario
    from ssrics_like.workers import cores

    scenario = make_scenario(
        {
            "title": log.name,
            "source": {
                "log": str(log.absolute()),
                "format": format,
                "strict": strict,
                "fallback_rate_hz": fallback_rate,
                "frame": frame,
            },
            "perception": perception,
            "productions": productions,
            "memory": memory,
            "memory_from": None if memory_from is None else str(memory_from),
            "runs": runs,
            "seed": seed,
        }
    )
    resolved = resolve(scenario, Path.cwd(), list(set_))
    name = log.name.split(".")[0] or "log"
    workers = cores() if jobs is None else jobs
    execute(resolved, out or Path("out") / name, resume=resume, jobs=workers, quiet=quiet)
