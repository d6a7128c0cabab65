"""Memory used over a log that is repeated until it has a million scans.

Usage: python benchmarks/bench_flat.py [--scans N]
"""

from __future__ import annotations

import argparse
import gzip
import resource
import tempfile
import time
from pathlib import Path

from ssrics_like.library import folder
from ssrics_like.scenarios.resolving import resolve
from ssrics_like.scenarios.runner import run_scenario
from ssrics_like.scenarios.schema import make_scenario

STEPS = 10


def peak_mib() -> float:
    """Return the most memory that this process has held so far, MiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    """Print peak memory at each tenth of the way."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scans", type=int, default=1_000_000)
    scans_wanted = parser.parse_args().scans
    demo = (folder("scenarios") / "logs" / "demo.log.gz").read_bytes()
    in_one = gzip.decompress(demo).count(b"\nFLASER")
    with tempfile.TemporaryDirectory() as place:
        log = Path(place) / "repeated.log.gz"
        with log.open("wb") as file:
            for _ in range(-(-scans_wanted // in_one)):
                file.write(demo)  # members of a gzip file may follow one another
        resolved = resolve(make_scenario({"source": {"log": str(log)}}), Path.cwd())
        start, reached = time.perf_counter(), 0

        def progress(_run: int, share: float) -> None:
            nonlocal reached
            if share * STEPS >= reached + 1:
                reached = int(share * STEPS)
                print(
                    f"{share:4.0%} of {log.stat().st_size / 2**20:.0f} MiB: "
                    f"peak {peak_mib():.0f} MiB after {time.perf_counter() - start:.0f} s"
                )

        manifest = run_scenario(resolved, Path(place) / "out", progress=progress)
    entry = manifest["runs"][0]
    print(f"{entry['scans']} scans, {entry['landmarks']} landmarks, {entry['decisions']}")


if __name__ == "__main__":
    main()
