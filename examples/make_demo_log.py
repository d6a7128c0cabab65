"""Draw a small building, drive a robot through it and write what its laser saw.

The log that ships comes from this script, unchanged:

    python examples/make_demo_log.py -o scenarios/logs/demo.log.gz
    python examples/make_demo_log.py --truth        # where the doorways really are

Same seed, same text. 180 beams over 180 degrees ten times a second; 81.83 m means
that nothing came back. Poses in the log are the odometry's, which drifts a little.
"""

import argparse
import gzip
import math
from pathlib import Path

import numpy as np

SEED = 2006
STEP_S = 0.1
SPEED, TURN_RATE, ACCELERATION = 0.9, 0.9, 0.6  # m/s, rad/s, m/s^2
NOISE_M, DROPOUT, NO_RETURN_M = 0.015, 0.003, 81.83
WALL_M = 0.12

DOORWAYS = [  # name, middle, width; "-" in a wall along x, "|" in one along y
    ("A", 3.0, 2.0, 0.90, "-"), ("B", 9.0, 2.0, 0.95, "-"), ("C", 17.5, 2.0, 0.88, "-"),
    ("D", 4.5, 0.0, 0.92, "-"), ("E", 12.5, 0.0, 0.90, "-"), ("BC", 13.0, 5.2, 0.95, "|"),
]  # fmt: skip
WALLS = [  # centre lines: the corridor's sides, then the partitions between rooms
    (0.0, 2.0, 24.0, 2.0), (0.0, 0.0, 24.0, 0.0), (6.0, 2.0, 6.0, 7.0),
    (13.0, 2.0, 13.0, 7.0), (9.0, -5.0, 9.0, 0.0), (17.0, -5.0, 17.0, 0.0),
]  # fmt: skip
OUTER = (0.0, -5.0, 24.0, 7.0)
FURNITURE = [  # boxes: x0, y0, x1, y1
    (0.3, 4.8, 1.1, 6.7), (4.5, 5.9, 5.7, 6.6), (4.9, 2.3, 5.7, 3.1),
    (8.4, 4.3, 10.4, 5.2), (6.3, 2.4, 6.8, 3.9), (12.1, 2.3, 12.8, 3.9),
    (15.0, 3.2, 15.6, 4.0), (18.4, 4.2, 20.2, 5.0), (22.9, 5.0, 23.7, 6.8), (14.2, 6.5, 17.0, 6.85),
    (5.9, -3.4, 7.0, -2.4), (0.3, -4.7, 2.6, -4.1), (0.3, -1.6, 0.8, -0.4),
    (12.0, -3.3, 14.0, -2.5), (16.0, -4.8, 16.8, -3.9), (9.3, -4.8, 10.1, -4.2),
]  # fmt: skip
ROUTE = [  # x, y, seconds to stand still on arrival
    (9.0, 1.0, 0), (9.0, 3.2, 1.5), (7.5, 4.2, 0), (7.6, 6.0, 0), (11.4, 6.0, 0), (11.8, 5.2, 0),
    (14.3, 5.2, 0), (17.4, 5.7, 1.0), (20.8, 5.7, 0), (20.8, 3.2, 0), (17.5, 3.2, 0),
    (17.5, 1.0, 0), (12.5, 1.0, 0), (12.5, -1.3, 0), (10.6, -2.2, 0), (11.0, -4.1, 0),
    (15.0, -3.9, 0), (15.0, -1.5, 1.0), (12.5, -1.3, 0), (12.5, 1.0, 0), (9.0, 1.0, 0),
    (9.0, 3.3, 0), (10.4, 3.4, 1.5), (9.0, 3.2, 0), (9.0, 1.0, 0), (4.5, 1.0, 0), (4.5, -1.4, 0),
    (3.4, -2.0, 2.0), (4.5, -1.4, 0), (4.5, 1.0, 0), (3.0, 1.0, 0), (3.0, 3.4, 0), (2.5, 4.4, 1.5),
    (3.0, 3.4, 0), (3.0, 1.0, 0), (1.2, 1.0, 1.0),
]  # fmt: skip
START = (1.2, 1.0, 0.0)


def box(x0: float, y0: float, x1: float, y1: float) -> list[tuple[float, float, float, float]]:
    """Return the four sides of a box."""
    return [(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)]


def building() -> np.ndarray:
    """Return every surface as segments x0, y0, x1, y1, shape (segments, 4)."""
    sides = [side for corners in [OUTER, *FURNITURE] for side in box(*corners)]
    for x0, y0, x1, y1 in WALLS:
        along = 0 if y0 == y1 else 1  # the coordinate that runs along the wall
        across = (y0, x0)[along]
        cuts = [(x0, y0)[along]]
        for _, x, y, width, kind in DOORWAYS:
            if kind == "-|"[along] and (y, x)[along] == across:
                cuts += [(x, y)[along] - width / 2, (x, y)[along] + width / 2]
        cuts.append((x1, y1)[along])
        for a, b in zip(cuts[::2], cuts[1::2], strict=True):
            low, high = across - WALL_M / 2, across + WALL_M / 2
            sides += box(a, low, b, high) if along == 0 else box(low, a, high, b)
    return np.array(sides)


def drive() -> list[tuple[float, float, float]]:
    """Return the true pose at every scan: x, y, theta."""
    x, y, theta = START
    speed, poses = 0.0, [START] * 15  # it stands for a moment before it sets off
    for goal_x, goal_y, rest_s in ROUTE:
        while (distance := math.hypot(goal_x - x, goal_y - y)) > 0.15:
            off = math.remainder(math.atan2(goal_y - y, goal_x - x) - theta, math.tau)
            turn = max(-TURN_RATE, min(TURN_RATE, 2.5 * off))
            wanted = SPEED * max(0.0, math.cos(2.0 * off)) if abs(off) < math.pi / 4 else 0.0
            wanted = min(wanted, 0.3 + 1.2 * distance)
            change = min(ACCELERATION * STEP_S, wanted - speed)
            speed += max(-2 * ACCELERATION * STEP_S, change)
            theta += turn * STEP_S
            x += speed * STEP_S * math.cos(theta)
            y += speed * STEP_S * math.sin(theta)
            poses.append((x, y, theta))
        speed = 0.0 if rest_s else speed
        poses += [(x, y, theta)] * round(rest_s / STEP_S)
    return poses


def scan(sides: np.ndarray, x: float, y: float, theta: float) -> np.ndarray:
    """Return the exact range of 180 beams, right to left from -90 degrees, shape (180,)."""
    rays = [theta + math.radians(beam - 90) for beam in range(180)]
    cos = np.array([[math.cos(ray)] for ray in rays])  # math: the same digits on every machine
    sin = np.array([[math.sin(ray)] for ray in rays])
    ax, ay = sides[:, 0] - x, sides[:, 1] - y
    ex, ey = sides[:, 2] - sides[:, 0], sides[:, 3] - sides[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):  # beams along a wall miss it
        across = cos * ey - sin * ex
        ranges = (ax * ey - ay * ex) / across
        where = (ax * sin - ay * cos) / across
        hit = (ranges > 0) & (where >= 0) & (where <= 1)
    nearest: np.ndarray = np.where(hit, ranges, np.inf).min(axis=1)
    return nearest


def log_lines(rng: np.random.Generator) -> list[str]:
    """Return the log: comments, parameters, then an ODOM and a FLASER line a scan."""
    lines = ["# made by examples/make_demo_log.py", "PARAM robot_frontlaser_offset 0.0 demo 0"]
    sides, true = building(), drive()
    ox, oy, otheta = true[0]
    for k, (now, before) in enumerate(zip(true, true[:1] + true, strict=False)):
        moved, turned = math.dist(now[:2], before[:2]), now[2] - before[2]
        noise = rng.standard_normal(2)
        otheta += turned * 1.001 + 0.0002 * moved + 0.001 * math.sqrt(moved) * noise[0]
        measured = moved * (1.003 + 0.01 * noise[1])
        ox += measured * math.cos(otheta)
        oy += measured * math.sin(otheta)
        ranges = scan(sides, *now) + NOISE_M * rng.standard_normal(180)
        ranges[rng.random(180) < DROPOUT] = NO_RETURN_M
        pose = f"{ox:.4f} {oy:.4f} {math.remainder(otheta, math.tau):.5f}"
        time = f"{k * STEP_S:.3f} demo {k * STEP_S:.3f}"
        lines.append(f"ODOM {pose} {moved / STEP_S:.3f} {turned / STEP_S:.3f} 0 {time}")
        readings = " ".join(f"{r:.2f}" for r in ranges.tolist())
        lines.append(f"FLASER 180 {readings} {pose} {pose} {time}")
    return lines


def main() -> None:
    """Write the log, or print the true doorways."""
    parser = argparse.ArgumentParser(description="Make the demonstration log.")
    parser.add_argument("-o", "--output", type=Path, default=Path("demo.log.gz"))
    parser.add_argument("--truth", action="store_true", help="print the doorways as CSV instead")
    asked = parser.parse_args()
    if asked.truth:
        rows = [f"{name},doorway,{x:.3f},{y:.3f}" for name, x, y, _, _ in DOORWAYS]
        print("id,kind,x_m,y_m", *rows, sep="\n")
        return
    text = "\n".join(log_lines(np.random.default_rng(SEED))) + "\n"
    asked.output.write_bytes(gzip.compress(text.encode("ascii"), 9, mtime=0))


if __name__ == "__main__":
    main()
