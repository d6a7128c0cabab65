"""``ssrics study simulate``: choices of participants of whom everything is known."""

from __future__ import annotations

from ssrics_like.cli.options import NeededOut, Whole

COUNT, SENSITIVITY, CRITERION, NOISE_M, SHARED = 12, 3.0, 1.8, 0.3, 0.3
COLUMNS = ("participant", "landmark", "x_m", "y_m", "label", "t_s")
PEOPLE_MAX = 10_000


def simulate(
    map: str,  # noqa: A002 - it is the argument's name
    *,
    participants: Whole = COUNT,
    sensitivity: float = SENSITIVITY,
    criterion: float = CRITERION,
    noise: float = NOISE_M,
    shared: float = SHARED,
    seed: Whole = 1,
    out: NeededOut,
) -> None:
    """Let simulated participants mark landmarks on a map, by signal detection.

    They stand at each labelled location, and every 2 m on the rest of the floor. Targets are the
    doorways; where none is labelled, all locations. The evidence is normal with variance 1; a
    place is marked where it is greater than the criterion.

    For example:

        ssrics study simulate complex -o people.csv --participants 20

    Parameters
    ----------
    map
        An entry of scenarios/maps, or a map's YAML file; it labels locations.
    participants
        How many.
    sensitivity
        d': how far the mean of the evidence at a target lies above that elsewhere.
    criterion
        What the evidence must exceed, measured from its mean elsewhere.
    noise
        Standard deviation of a mark about its place along either axis, metres.
    shared
        Share of the variance of the evidence that all participants have in common, 0 to 1.
    seed
        Of everything that is drawn.
    out
        The CSV file of choices to write.
    """
    import numpy as np

    from ssrics_like.errors import MapError, SettingsError
    from ssrics_like.maps import load_building
    from ssrics_like.people.places import standing_places
    from ssrics_like.people.simulated import Participants, simulated_choices
    from ssrics_like.results.files import csv_text, write_atomically
    from ssrics_like.study.reading import map_file

    for name, value, right, expected in (
        ("participants", participants, 1 <= participants <= PEOPLE_MAX, f"1 to {PEOPLE_MAX}"),
        ("sensitivity", sensitivity, np.isfinite(sensitivity), "a number"),
        ("criterion", criterion, np.isfinite(criterion), "a number"),
        ("noise", noise, 0.0 <= noise < np.inf, "metres, 0 or more"),
        ("shared", shared, 0.0 <= shared <= 1.0, "a share, 0 to 1"),
        ("seed", seed, seed >= 0, "0 or more"),
    ):
        if not right:
            raise SettingsError(f"--{name}: {value}: expected {expected}")
    file = map_file(map)
    building = load_building(file)
    if not building.locations:
        raise MapError(f"{file}: locations: no place is labelled, expected at least one")
    who = Participants(participants, sensitivity, criterion, noise, shared)
    found = simulated_choices(who, *standing_places(building), np.random.default_rng(seed))
    if not found:
        raise SettingsError(
            f"--criterion: {criterion:g}: nobody marked anything; expected a lower one"
        )
    rows = ((c.participant, c.landmark, c.x_m, c.y_m, c.label, c.t_s) for c in found)
    text = csv_text(COLUMNS, rows)
    out.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(out, text)
    silent = participants - len({choice.participant for choice in found})
    rest = f"; {silent} marked nothing and are not in it" if silent else ""
    print(f"{out}: {len(found)} marks of {participants - silent} participants{rest}")
