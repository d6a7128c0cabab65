"""People's choices written by hand, and what tests ask of a comparison with them."""

import csv

import pytest
from results_folders import DOORS

from ssrics_like.cli import main
from ssrics_like.people import Settings, compare_people, read_folders
from ssrics_like.results.files import csv_text

HEADER = ("participant", "landmark", "x_m", "y_m", "label", "t_s")


def write_choices(path, marks):
    """Write choices: participant -> places, with or without a time."""
    rows = [
        [who, f"m{n}", place[0], place[1], "", place[2] if len(place) > 2 else None]
        for who, places in marks.items()
        for n, place in enumerate(places, 1)
    ]
    path.write_text(csv_text(HEADER, rows))
    return path


def near(door, off=0.2):
    return DOORS[door][0] + off, DOORS[door][1] - off


def at_doors(people=5):
    """Everybody marks the first three doors; the second to the fourth person one more each."""
    return {
        f"p{k}": [near(door, 0.1 * k) for door in (0, 1, 2, *([2 + k] if 1 <= k <= 3 else []))]
        for k in range(people)
    }


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as stopped:
        main(["compare", *map(str, arguments)])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def rows(file):
    with file.open(newline="") as lines:
        return list(csv.DictReader(lines))


def compared(folders, choices, locations=None, **settings):
    chosen = Settings(resamples=200, **settings)
    read = read_folders(folders, choices, locations, chosen.radius_m)
    return compare_people(
        read.people, read.models, read.locations, chosen, clustered=read.clustered
    )
