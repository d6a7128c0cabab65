"""A generated building, explored by a simulated robot, and what the default model marks there.

Run it with `python examples/explore_a_building.py`.
"""

from __future__ import annotations

import numpy as np

from ssrics_like import CognitiveModel, load_memory, load_perception, load_productions
from ssrics_like.comparison.matching import match
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.buildings.generator import BuildingSettings, generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.reachable import roomiest
from ssrics_like.world.simulation import Simulation

SEED = 3


def main() -> None:
    """Explore, and compare the marks with the doorways that the generator put in."""
    building = build(generate(np.random.default_rng(SEED), BuildingSettings(rooms=4)))
    doorways = [(p.x_m, p.y_m) for p in building.locations if p.kind == "doorway"]
    drive = Simulation(
        building.grid,
        load_robot("pioneer-dx"),
        roomiest(building.grid),
        [Exploration()],
        np.random.SeedSequence(SEED),
    )
    model = CognitiveModel(
        load_perception("human-like"), load_productions("landmark"), load_memory("act-r"), seed=SEED
    )
    decisions = [decision for observation in drive for decision in model.observe(observation)]
    decisions += model.finish()
    marks = [
        (d.true_pose.x_m, d.true_pose.y_m)
        for d in decisions
        if d.decision in ("declared", "recognised") and d.true_pose is not None
    ]
    found = int((match(marks, doorways, 1.0) >= 0).sum())
    width_m, height_m = building.grid.size_m
    print(f"a building of {width_m:.0f} x {height_m:.0f} m with {len(doorways)} doorways")
    print(f"ended: {drive.ended}, {100 * drive.coverage:.0f} % of the reachable space seen")
    print(f"landmarks and doorways: {len(model.topological) > 0}, {found > 0}")


if __name__ == "__main__":
    main()
