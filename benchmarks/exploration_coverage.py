"""How much of a building frontier exploration sees: floor plans x seeds, as a table.

    python benchmarks/exploration_coverage.py MAP.yaml ... [--seeds 5] [--generated 10] [--jobs 2]

The robot is the library's Pioneer DX, its start the roomiest place of each plan. Coverage is of
the space that its body can reach; beside it, of all free cells connected with its start.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from scipy import ndimage

from ssrics_like.library import folder
from ssrics_like.maps import is_plan, load_building
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.building import Building
from ssrics_like.world.buildings.generator import generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.reachable import roomiest
from ssrics_like.world.simulation import Simulation

LIMIT_S = 7200.0


def building_of(name: str) -> Building:
    """Read a map, or make the building that a number stands for."""
    if name.isdigit():
        return build(generate(np.random.default_rng(int(name))))
    return load_building(Path(name))


def explore(job: tuple[str, int]) -> tuple[str, float, float, float, float, int, str]:
    """Explore a building once: both coverages, seconds, metres, bumps, how it ended."""
    name, seed = job
    grid = building_of(name).grid
    start = roomiest(grid)
    drive = Simulation(
        grid, load_robot("pioneer-dx"), start, [Exploration()],
        np.random.SeedSequence(seed), time_limit_s=LIMIT_S,
    )  # fmt: skip
    for _ in drive:
        pass
    parts, _ = ndimage.label(~grid.solid)
    row, column = np.nonzero(parts == parts[grid.cell_of(start.x_m, start.y_m)])
    scale = grid.cell_m / drive.navigator.cell_m
    known = drive.navigator.explored.evidence != 0
    free = known[((row + 0.5) * scale).astype(int), ((column + 0.5) * scale).astype(int)].mean()
    return name, drive.coverage, float(free), drive.t_s, drive.way_m, drive.bumps, drive.ended


def row_of(said: str, results: list[tuple[str, float, float, float, float, int, str]]) -> str:
    """Return a row of the table."""
    coverage, free, seconds, metres, bumps = np.array([r[1:6] for r in results]).T
    return (
        f"| {said} | {len(results)} | {100 * coverage.min():.2f} | {100 * free.min():.2f} "
        f"| {seconds.mean():.0f} | {metres.mean():.0f} | {bumps.sum():.0f} "
        f"| {', '.join(sorted({r[6] for r in results}))} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("maps", nargs="*")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--generated", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    names = [*given.maps, *map(str, range(given.generated))]
    if not names:
        names = [str(path) for path in sorted((folder("scenarios") / "maps").glob("*.yaml"))
                 if not is_plan(path)]  # fmt: skip
    jobs = [(name, seed) for name in names for seed in range(given.seeds)]
    print(
        "| building | runs | least coverage, % | least of connected free space, % | mean s "
        "| mean m | bumps | ended |"
    )
    print("|---|---|---|---|---|---|---|---|")
    with ProcessPoolExecutor(given.jobs) as pool:
        results = list(pool.map(explore, jobs))
    for name in names:
        said = f"generated {name}" if name.isdigit() else "/".join(Path(name).parts[-2:])
        print(row_of(said, [result for result in results if result[0] == name]))
    print(row_of("all", results))


if __name__ == "__main__":
    main()
