"""From a study file, its Markdown, maps, robots and routes to a study."""

from __future__ import annotations

from pathlib import Path

from ssrics_like import library, settings
from ssrics_like.errors import (
    LibraryError,
    MapError,
    ResultsError,
    SettingsError,
    SsricsError,
    choices,
    nearest,
)
from ssrics_like.maps import load_building
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.scenarios.place import place_of
from ssrics_like.scenarios.schema import at
from ssrics_like.scenarios.world_settings import WorldSettings
from ssrics_like.settings import Document, Key
from ssrics_like.study.replay import Replay, drive, faultless, replay_of_run
from ssrics_like.study.settings import StudySettings, TrialSettings
from ssrics_like.study.study import Study, Trial
from ssrics_like.world.building import Building

TEXTS = ("consent", "instructions", "thanks")
STUDIES, MAPS = "studies", "maps"


def study_file(name: str) -> Path:
    """Return the file of a study: a path, or an entry of scenarios/studies.

    Raises
    ------
    LibraryError
        No entry or file has this name.
    """
    return _entry(STUDIES, name, "study")


def map_file(name: str) -> Path:
    """Return the file of a map: a path, or an entry of scenarios/maps; raises as `study_file`."""
    return _entry(MAPS, name, "map")


def _entry(folder: str, name: str, what: str) -> Path:
    """Find an entry of a folder below scenarios, by its name; a path leads to a file."""
    if "/" in name or "\\" in name or name.endswith(library.SUFFIXES):
        path = Path(name)
        if path.is_file():
            return path
        raise LibraryError(f"{path}: {'is a folder' if path.is_dir() else 'no such file'}")
    files = (library.folder("scenarios") / folder).glob("*.yaml")
    known = {file.stem: file for file in files if not file.name.endswith(".plan.yaml")}
    if name in known:
        return known[name]
    raise LibraryError(
        f"no {what} '{name}'{nearest(name, known)}; the library has {choices(known)} "
        "(a path ends in .yaml)"
    )


def read_study(path: Path) -> Study:
    """Read and check a study, drive its routes and read its runs.

    Raises
    ------
    SettingsError
        With one line for each thing that is wrong, in the file or in what it names.
    """
    document = settings.read_document(path)
    problems = [*_texts(document), *_twice(document)]
    try:
        said = settings.validated(StudySettings, document)
    except SettingsError as e:
        problems += str(e).splitlines()
        raise SettingsError("\n".join(settings.in_order(problems))) from None
    practice = _trials("practice", said.practice, document, problems)
    trials = _trials("trials", said.trials, document, problems)
    if problems:
        raise SettingsError("\n".join(settings.in_order(problems)))
    return Study(path, said, practice, trials)


def _texts(document: Document) -> list[str]:
    """Put the content of Markdown files in the place of their names."""
    problems = []
    for key in TEXTS:
        name = document.data.get(key)
        if not isinstance(name, str) or not name.endswith(".md") or len(name.split()) != 1:
            continue
        file = document.path.parent / name
        try:
            document.data[key] = file.read_text(encoding="utf-8").strip() or " "
        except (OSError, UnicodeDecodeError) as e:
            why = e.strerror if isinstance(e, OSError) else "it is not UTF-8"
            problems.append(f"{document.where((key,))}: {key}: {file}: cannot be read ({why})")
    return problems


def _twice(document: Document) -> list[str]:
    """Complain of ids that stand twice."""
    first: dict[str, tuple[str, str]] = {}
    problems = []
    for part in ("practice", "trials"):
        entries = document.data.get(part)
        for i, entry in enumerate(entries if isinstance(entries, list) else []):
            name = entry.get("id") if isinstance(entry, dict) else None
            if not isinstance(name, str):
                continue
            where = document.where((part, i, "id"))
            before, at_first = first.setdefault(name.casefold(), (name, where))
            if at_first == where:
                continue
            line = at_first.removeprefix(f"{document.path}:").partition(":")[0]
            said = (
                f"'{name}' stands twice (first in line {line})"
                if before == name
                else f"'{name}' names the same files as '{before}' in line {line} where case "
                "does not count"
            )
            problems.append(f"{where}: {part}.{i}.id: {said}")
    return problems


def _trials(
    part: str, entries: list[TrialSettings], document: Document, problems: list[str]
) -> tuple[Trial, ...]:
    found = []
    for i, entry in enumerate(entries):
        try:
            found.append(_trial(entry, (part, i), document))
        except SsricsError as e:
            problems += str(e).splitlines()
    return tuple(found)


def _trial(entry: TrialSettings, key: Key, document: Document) -> Trial:
    practice = key[0] == "practice"
    if entry.kind == "attention":
        return Trial(entry, practice)
    building = _building(entry, key, document)
    if entry.kind == "walk":
        return Trial(entry, practice, building, _route(entry, key, document, building))
    if entry.check is not None:
        known = [place.id for place in building.locations]
        if entry.check.location not in known:
            name = entry.check.location
            raise _complaint(
                document,
                (*key, "check", "location"),
                f"the map has no location '{name}'{nearest(name, known)}; it has "
                f"{choices(known) or 'none'}",
            )
    return Trial(entry, practice, building)


def _building(entry: TrialSettings, key: Key, document: Document) -> Building:
    try:
        return load_building(_map_file(entry, document))
    except (LibraryError, MapError) as e:
        raise _complaint(document, (*key, "map" if entry.map else "results"), str(e)) from None


def _map_file(entry: TrialSettings, document: Document) -> Path:
    base = document.path.parent
    if entry.map is None:
        assert entry.results is not None
        return base / entry.results / "map" / "map.yaml"
    return map_file(at(base, entry.map))


def _route(entry: TrialSettings, key: Key, document: Document, building: Building) -> Replay:
    base = document.path.parent
    try:
        robot = load_robot(at(base, entry.robot))
    except (LibraryError, SettingsError) as e:
        raise _complaint(document, (*key, "robot"), str(e)) from None
    if entry.results is not None:
        try:
            replay = replay_of_run(base / entry.results, entry.run or 0, robot)
        except ResultsError as e:
            raise _complaint(document, (*key, "results"), str(e)) from None
        _check_on_map(replay, building, key, document)
        return replay

    world = WorldSettings.model_validate(
        {
            "map": str(_map_file(entry, document).resolve()),
            "start": entry.start,
            "waypoints": entry.waypoints,
        }
    )
    # What is wrong with the places is said of keys of this file, not of a scenario's.
    dotted = ".".join(map(str, key))

    def where(at_key: Key) -> str:
        return document.where((*key, *at_key[1:]))

    try:
        place = place_of(world, faultless(robot), {"world.map": Path()}, where)
        replay, warnings = drive(place)
    except SettingsError as e:
        raise SettingsError(str(e).replace(": world.", f": {dotted}.")) from None
    except ResultsError as e:
        raise _complaint(document, (*key, "waypoints"), str(e)) from None
    if warnings:
        raise _complaint(document, (*key, "waypoints"), "; ".join(warnings))
    return replay


def _check_on_map(replay: Replay, building: Building, key: Key, document: Document) -> None:
    """Complain of a run that leads where the map has no free floor: it is of another map."""
    grid = building.grid
    off = [
        (x, y)
        for (x, y), (gx, gy) in zip(
            replay.poses[:, :2].tolist(),
            grid.points_in_grid(replay.poses[:, :2]).tolist(),
            strict=True,
        )
        if not grid.is_free(gx, gy)
    ]
    if off:
        x, y = off[0]
        raise _complaint(
            document,
            (*key, "results"),
            f"the run leads through ({x:.2f}, {y:.2f}), which is not free on the map; is it of "
            "another map?",
        )


def _complaint(document: Document, key: Key, text: str) -> SettingsError:
    dotted = ".".join(map(str, key))
    before = f"{document.where(key)}: {dotted}: "
    return SettingsError("\n".join(before + line for line in text.splitlines()))
