"""Tells what kind a file is and checks it as that kind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from ssrics_like import settings
from ssrics_like.cues import read_any_cue
from ssrics_like.errors import SettingsError, choices, nearest
from ssrics_like.library import SUFFIXES
from ssrics_like.maps import load_building, load_plan
from ssrics_like.maps.map_file import MapFile
from ssrics_like.maps.plan_file import PlanFile
from ssrics_like.memory import load_memory_file
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.memory.saved_file import FORMAT as MEMORY
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.perception.structure import KINDS as KINDS_OF_STRUCTURE
from ssrics_like.productions.rulebook import RuleFile, load_rulebook
from ssrics_like.results.checking import check_results
from ssrics_like.results.counts import counted
from ssrics_like.results.listing import has_variants, read_listing
from ssrics_like.results.manifest import MANIFEST, unfinished
from ssrics_like.scenarios.feeds import open_source
from ssrics_like.scenarios.resolving import load_resolved
from ssrics_like.scenarios.schema import Scenario, read_scenario
from ssrics_like.scenarios.variants import resolve_variants
from ssrics_like.sources import open_log
from ssrics_like.world.robot import RobotProfile


def check_file(
    path: Path,
    progress: Callable[[float], None] = lambda _: None,
    study: Callable[[Path], str] | None = None,
) -> str:
    """Check one file or results folder and say in a line what it is.

    Parameters
    ----------
    path : Path
        The file.
    progress : callable
        Called now and then with the share of a log that has been read.
    study : callable or None
        Checks a study, which is of an outer layer, and says what it is.

    Raises
    ------
    SettingsError, RuleError, LibraryError, CueError, MapError, SourceError, ResultsError
        What is wrong with it.
    MemoryFileError
        What is wrong with a saved memory.
    """
    if has_variants(path):
        return _variants(path, progress)
    if path.is_dir():
        manifest = check_results(path)
        far = unfinished(manifest) or counted(len(manifest["runs"]), "run")
        return f"results, {far}; frame {manifest['frame']}"
    if path.suffix == ".json":
        return _json(path)
    if path.suffix in SUFFIXES:
        kind = _kind(path)
        check = study if kind == "study" else YAML_KINDS[kind]
        if check is None:
            raise SettingsError(f"{path}: is a study, expected a {choices(KINDS)}")
        return f"{kind}, {check(path)}"
    return _log(path, progress)


def _json(path: Path) -> str:
    """Check a saved memory, if the file begins as one, or a cue."""
    if path.is_file():
        with path.open("rb") as file:
            if MEMORY.encode() in file.read(HEAD_BYTES):
                memory = load_memory_file(path)
                landmarks = counted(len(memory.landmarks), "landmark")
                return f"memory, {landmarks}, {counted(len(memory.runs), 'run')}"
    cue = read_any_cue(path)
    if isinstance(cue, DoorwayCue):
        return f"doorway cue, threshold {cue.threshold:g}"
    return "structure cue, thresholds " + ", ".join(
        f"{cue.thresholds[kind]:g} for {kind}" for kind in KINDS_OF_STRUCTURE
    )


def _variants(path: Path, progress: Callable[[float], None]) -> str:
    listed = read_listing(path).variants
    unlike = []
    for done, variant in enumerate(listed, 1):
        folder = path / variant.name
        if (folder / MANIFEST).is_file():
            far = unfinished(check_results(folder))
            unlike += [f"{variant.name}: {far}"] if far else []
        else:
            unlike.append(f"{variant.name}: no run is complete; --resume goes on")
        progress(done / len(listed))
    said = counted(len(listed), "variant")
    return f"results of {said}" + (f", not finished: {', '.join(unlike)}" if unlike else "")


def expect_scenario(path: Path) -> None:
    """Say of a file that is no scenario at all what it is, instead of complaining of each key.

    Raises
    ------
    SettingsError
        It is something else, or cannot be read.
    """
    if path.is_file() and path.suffix not in SUFFIXES:
        raise SettingsError(
            f"{path}: is no YAML file, expected a scenario (ssrics replay takes logs)"
        )
    kind = _kind_of(path)
    if kind not in ("", "scenario"):
        raise SettingsError(f"{path}: is a {kind}, expected a scenario")


def _kind(path: Path) -> str:
    """Tell a YAML file's kind."""
    kind = _kind_of(path)
    if not kind:
        raise SettingsError(f"{path}: none of its keys is known; expected a {choices(KINDS)}")
    return kind


def _kind_of(path: Path) -> str:
    """Tell a YAML file's kind: the one that knows most of its keys; empty if none knows any."""
    data = settings.read_document(path).data
    # `source` is a log's in a scenario, and a line of text everywhere else.
    keys = {key for key in data if key != "source" or isinstance(data[key], dict)}
    known = {
        "rule set": {"rules", "chunk_types", "goal", "harvest"},
        "scenario": set(Scenario.model_fields) - {"title"},
        "perception profile": set(PerceptionProfile.model_fields) - {"title", "source"},
        "memory profile": set(MemoryProfile.model_fields) - {"title", "source"},
        "map": set(MapFile.model_fields) - {"title", "locations"},
        "plan": set(PlanFile.model_fields) - {"title", "locations"},
        "robot": set(RobotProfile.model_fields) - {"title", "source"},
        "study": STUDY_KEYS,
    }
    best = max(known, key=lambda kind: len(known[kind] & keys))
    return best if known[best] & keys else ""


def _rules(path: Path) -> str:
    book = load_rulebook(path)
    return f"'{book.title}', {counted(len(book.rules), 'rule')}"


def _scenario(path: Path) -> str:
    scenario, document = read_scenario(path)
    if scenario.factors or scenario.variants:
        variants = resolve_variants(scenario, path.parent, where=document.where)
        each = counted(scenario.runs, "run")
        return f"'{scenario.title}', {counted(len(variants), 'variant')} of {each}"
    resolved = load_resolved(path)
    if resolved.log:
        open_source(resolved)
    return f"'{scenario.title}', {counted(scenario.runs, 'run')} of {resolved.source_name}"


def _map(path: Path) -> str:
    building = load_building(path)
    width_m, height_m = building.grid.size_m
    places = counted(len(building.locations), "labelled place")
    return f"'{building.title}', {width_m:g} x {height_m:g} m, {places}"


def _plan(path: Path) -> str:
    plan = load_plan(path)
    size = f"{plan.width_m:g} x {plan.height_m:g} m"
    return f"'{plan.title}', {size}, {counted(len(plan.locations), 'labelled place')}"


def _profile(
    kind: type[PerceptionProfile | MemoryProfile | RobotProfile],
) -> Callable[[Path], str]:
    def check(path: Path) -> str:
        return f"'{settings.validated(kind, settings.read_document(path)).title}'"

    return check


def _log(path: Path, progress: Callable[[float], None]) -> str:
    source = open_log(path)
    scans = 0
    for scans, _ in enumerate(source, 1):
        if scans % PROGRESS_EVERY == 0:
            progress(source.progress)
    said = "; ".join(source.report.warnings())
    what = f"{source.format} log, {counted(scans, 'scan')}, frame {source.frame}"
    return f"{what}; {said}" if said else what


def json_schema(kind: str, study: type[BaseModel] | None = None) -> dict[str, Any]:
    """Return the JSON Schema of a kind of YAML file.

    Parameters
    ----------
    kind : str
        Which.
    study : type of BaseModel or None
        What a study may say, which is of an outer layer.

    Raises
    ------
    SettingsError
        There is no such kind.
    """
    models: dict[str, type[BaseModel]] = {
        "scenario": Scenario,
        "perception": PerceptionProfile,
        "memory": MemoryProfile,
        "robot": RobotProfile,
        "productions": RuleFile,
        "plan": PlanFile,
        **({} if study is None else {"study": study}),
    }
    if kind not in models:
        raise SettingsError(
            f"no schema of '{kind}'{nearest(kind, models)}; there are {choices(models)}"
        )
    return models[kind].model_json_schema()


YAML_KINDS: dict[str, Callable[[Path], str]] = {
    "rule set": _rules,
    "scenario": _scenario,
    "perception profile": _profile(PerceptionProfile),
    "memory profile": _profile(MemoryProfile),
    "robot": _profile(RobotProfile),
    "map": _map,
    "plan": _plan,
}
KINDS = (*YAML_KINDS, "doorway cue", "structure cue", "memory", "log", "results folder")
STUDY_KEYS = {
    "consent", "instructions", "thanks", "participant", "order", "practice", "trials",
    "next_participant", "participants_max", "responses_max",
}  # fmt: skip
PROGRESS_EVERY = 256  # scans
HEAD_BYTES = 256
