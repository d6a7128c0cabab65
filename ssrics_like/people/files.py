"""Comparisons of people and models as files: tables, and everything in one JSON."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.comparison.matching import NONE
from ssrics_like.comparison.proportions import LEVEL
from ssrics_like.errors import ResultsError
from ssrics_like.people.beside import Beside
from ssrics_like.people.definitions import file_definitions
from ssrics_like.people.hits import MEASURES, hits
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.resampling import known_mean
from ssrics_like.people.settings import CONSENSUS
from ssrics_like.results.files import csv_text, json_text, write_atomically

FORMAT, VERSION = "ssrics-people-comparison", 1

Row = dict[str, Any]
LOCATIONS = (
    "location", "kind", "label", "x_m", "y_m", "on_route", "consensus", "group", "markers",
    "marked", "share", "low", "high",
)  # fmt: skip
MARKS = ("group", "marker", "mark", "x_m", "y_m", "t_s", "unit", "location")
AGREEMENT = ("first_group", "first", "second_group", "second", "kappa", "agreement")
MODELS = ("group", "markers", "figure", "value", "low", "high")
PAIRS = (
    "first",
    "second",
    "measure",
    "difference",
    "low",
    "high",
    "count",
    "p",
    "p_runs",
    "p_holm",
)
PEOPLE_COLUMNS = ("participant", "marks", "off_route", "measured", *MEASURES)


def write_people(
    made: Beside, sources: Mapping[str, Any], folder: Path, more: Mapping[str, str | bytes]
) -> list[Path]:
    """Write a comparison into a folder.

    Parameters
    ----------
    made : Beside
        The comparison.
    sources : mapping
        What was read, to stand in comparison.json.
    folder : Path
        Where to; made if it is not there.
    more : mapping of str to str or bytes
        Further files, by their names within the folder: the page and the pictures.

    Returns
    -------
    list of Path
        The files; the tables first.

    Raises
    ------
    ResultsError
        They cannot be written.
    """
    texts: dict[str, str | bytes] = {
        "locations.csv": _table(LOCATIONS, location_rows(made)),
        "marks.csv": _table(MARKS, mark_rows(made)),
        "agreement.csv": _table(AGREEMENT, agreement_rows(made)),
        "models.csv": _table(MODELS, model_rows(made)),
        "pairs.csv": _table(PAIRS, pair_rows(made)),
        "people.csv": _table(PEOPLE_COLUMNS, people_rows(made)),
        "comparison.json": json_text(comparison_data(made, sources)),
        **more,
    }
    try:
        for name, text in texts.items():
            file = folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(file, text)
    except OSError as e:
        raise ResultsError(f"{e.filename or folder}: cannot be written ({e.strerror})") from None
    return [folder / name for name in texts]


def location_rows(made: Beside) -> list[Row]:
    """Return a row for each location and group: Table 1."""
    on_route = dict(zip(made.units.locations, made.units.on_route.tolist(), strict=True))
    agreed = _agreed(made)
    return [
        {
            "location": one.location.id,
            "kind": one.location.kind,
            "label": one.location.label,
            "x_m": one.location.x_m,
            "y_m": one.location.y_m,
            "on_route": int(on_route[one.location]),
            "consensus": agreed.get(one.location.id),
            "group": one.group,
            "markers": one.markers,
            "marked": one.marked,
            "share": one.share,
            "low": one.interval[0],
            "high": one.interval[1],
        }
        for one in made.shares
    ]


def mark_rows(made: Beside) -> list[Row]:
    """Return a row for each mark, with the unit and the location that it falls on."""
    names = (*made.units.names, "")  # the last stands for none, as -1 does
    places = (*(place.id for place in made.units.locations), "")
    return [
        {
            "group": marker.group,
            "marker": marker.name,
            "mark": name,
            "x_m": x,
            "y_m": y,
            "t_s": t,
            "unit": names[unit],
            "location": places[place],
        }
        for marker in made.markers
        for name, (x, y), t, unit, place in zip(
            marker.names, marker.xy_m.tolist(), marker.t_s.tolist(),
            made.units.of(marker.xy_m).tolist(), made.units.locations_of(marker.xy_m).tolist(),
            strict=True,
        )
    ]  # fmt: skip


def agreement_rows(made: Beside) -> list[Row]:
    """Return a row for each pair of markers."""
    markers = made.markers
    table = np.vstack(list(made.marked.values()))
    share = hits(table, table).agreement
    return [
        {
            "first_group": markers[i].group,
            "first": markers[i].name,
            "second_group": markers[j].group,
            "second": markers[j].name,
            "kappa": float(made.kappa[i, j]),
            "agreement": float(share[i, j]),
        }
        for i in range(len(markers))
        for j in range(i + 1, len(markers))
    ]


def model_rows(made: Beside) -> list[Row]:
    """Return a row for each figure of the people, then of each model."""
    return [
        {
            "group": group,
            "markers": len(made.marked[group]),
            "figure": name,
            "value": figure.value,
            "low": figure.interval[0],
            "high": figure.interval[1],
        }
        for group, figures in made.figures.items()
        for name, figure in figures.items()
    ]


def pair_rows(made: Beside) -> list[Row]:
    """Return a row for each two models and measure."""
    return [
        {
            "first": pair.first,
            "second": pair.second,
            "measure": pair.measure,
            "difference": pair.difference.value,
            "low": pair.difference.interval[0],
            "high": pair.difference.interval[1],
            "count": pair.count,
            "p": pair.p,
            "p_runs": pair.p_runs,
            "p_holm": pair.p_holm,
        }
        for pair in made.pairs
    ]


def people_rows(made: Beside) -> list[Row]:
    """Return rows for each person: how they, and each model, meet the consensus of the others."""
    own = made.crowd.against_others
    theirs = {
        model.name: made.crowd.meet_others(made.marked[model.name]) for model in made.models
    }  # fmt: skip
    rows = []
    for i, person in enumerate(made.people):
        off = int((made.units.of(person.xy_m) == NONE).sum())
        about: Row = {"participant": person.name, "marks": len(person), "off_route": off}
        rows.append(
            {**about, "measured": PEOPLE, **{n: float(own.measure(n)[i]) for n in MEASURES}}
        )
        for name, found in theirs.items():
            means = {n: float(known_mean(found.measure(n)[i])) for n in MEASURES}
            rows.append({**about, "measured": name, **means})
    return rows


def comparison_data(made: Beside, sources: Mapping[str, Any]) -> Row:
    """Return a comparison as plain values, as they stand in comparison.json."""
    settings = made.settings
    return {
        "format": FORMAT,
        "version": VERSION,
        "sources": dict(sources),
        "settings": {
            "radius_m": settings.radius_m,
            "bin_m": settings.bin_m,
            "seed": settings.seed,
            "resamples": settings.resamples,
            "interval_level": LEVEL,
            "consensus_share": CONSENSUS,
            "locations": "found from people's marks" if made.clustered else "labelled",
        },
        "definitions": file_definitions(),
        "notes": list(made.notes),
        "units": {
            "all": len(made.units),
            "locations": len(made.units.location_of),
            "bins": len(made.units.bins_m),
            "bins_left_out": made.units.route.dropped,
            "consensus": [
                name
                for name, yes in zip(made.units.names, made.crowd.consensus.tolist(), strict=True)
                if yes
            ],
        },
        "groups": [
            {
                "group": group,
                "markers": len(made.marked[group]),
                "figures": {
                    name: {
                        "value": figure.value,
                        "low": figure.interval[0],
                        "high": figure.interval[1],
                    }
                    for name, figure in figures.items()
                },
            }
            for group, figures in made.figures.items()
        ],
        "pairs": pair_rows(made),
        "locations": location_rows(made),
        "people": people_rows(made),
        "agreement": {
            "markers": [f"{marker.group}: {marker.name}" for marker in made.markers],
            "kappa": [
                [None if math.isnan(value) else value for value in row]
                for row in made.kappa.tolist()
            ],
        },
    }


def _agreed(made: Beside) -> dict[str, int]:
    """Return by location on the route whether it is consensus."""
    count = len(made.units.location_of)
    values = made.crowd.consensus[:count].astype(int).tolist()
    return dict(zip(made.units.names[:count], values, strict=True))


def _table(columns: Sequence[str], rows: Iterable[Row]) -> str:
    return csv_text(columns, ([row[name] for name in columns] for row in rows))
