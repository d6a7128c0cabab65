"""What is left of a run: both memories as values, on a clock whose zero is the moment of saving.

A later run goes on from them whatever its own clock: references have ages, landmarks' times are 0
or less.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import TypeVar

from ssrics_like.memory.chunks import Chunk, View
from ssrics_like.memory.declarative import DeclarativeMemory
from ssrics_like.memory.home import Home
from ssrics_like.memory.landmark import Arc, Landmark, finite, length
from ssrics_like.memory.topological import TopologicalMemory

Timed = TypeVar("Timed", Landmark, Arc)


@dataclass(frozen=True)
class RememberedChunk:
    """A chunk and how long ago it was used.

    Attributes
    ----------
    chunk : Chunk
        The chunk.
    ages_s : tuple of float
        Age of each reference at that moment, seconds, 0 or more, in the order of arrival.
    """

    chunk: Chunk
    ages_s: tuple[float, ...]


@dataclass(frozen=True)
class PastRun:
    """A run that this memory has been through.

    Attributes
    ----------
    id : str
        Names it among all runs.
    ended_ago_s : float
        How long before the moment of saving it ended, seconds.
    """

    id: str
    ended_ago_s: float


@dataclass(frozen=True)
class SavedMemory:
    """Declarative and topological memory at one moment.

    Attributes
    ----------
    saved_s : float
        That moment on the source's clock of the run that was saved, seconds.
    frame : str
        Frame of all positions.
    runs : tuple of PastRun
        The runs it has been through, the last one last.
    chunks : tuple of RememberedChunk
        In the order in which they came.
    landmarks : tuple of Landmark
        Their times are seconds since the moment of saving, 0 or less.
    arcs : tuple of Arc
        Between them.
    origins : mapping of str to str
        By landmark: the run that declared it and its name there, ``RUN/L3``; whatever it is
        called since, it is the same landmark.
    home : Home or None
        Where the first run began; None where that is not known.

    Raises
    ------
    ValueError
        For a name that stands twice, an age that is negative or not finite, views of several
        lengths, a landmark without origin, or an arc or home that belongs to no landmark.
    """

    saved_s: float
    frame: str
    runs: tuple[PastRun, ...]
    chunks: tuple[RememberedChunk, ...]
    landmarks: tuple[Landmark, ...]
    arcs: tuple[Arc, ...]
    origins: Mapping[str, str]
    home: Home | None = None

    def __post_init__(self) -> None:
        finite("saved_s", self.saved_s)
        _once("run", (run.id for run in self.runs))
        for run in self.runs:
            length(f"run '{run.id}': ended_ago_s", run.ended_ago_s)
        _once("chunk", (each.chunk.name for each in self.chunks))
        for each in self.chunks:
            if not each.ages_s:
                raise ValueError(f"chunk '{each.chunk.name}' has no reference")
            for age_s in each.ages_s:
                if not 0.0 <= age_s < math.inf:
                    raise ValueError(
                        f"chunk '{each.chunk.name}': an age is {age_s!r}; expected 0 or more"
                    )
        lengths = sorted({len(view.descriptor) for view in self._views()})
        if len(lengths) > 1:
            raise ValueError(f"views have {lengths[0]} and {lengths[1]} numbers; expected one size")
        _once("landmark", (landmark.id for landmark in self.landmarks))
        _once("origin", self.origins.values())
        names = {landmark.id for landmark in self.landmarks}
        if odd := sorted(names ^ self.origins.keys()):
            missing = "has no origin" if odd[0] in names else "has an origin but is not there"
            raise ValueError(f"landmark '{odd[0]}' {missing}")
        for arc in self.arcs:
            if not {arc.from_id, arc.to_id} <= names:
                raise ValueError(f"arc from '{arc.from_id}' to '{arc.to_id}' joins no landmarks")
        if self.home is not None and self.home.landmark not in names:
            raise ValueError(f"home: landmark '{self.home.landmark}' is not there")

    @classmethod
    def of(
        cls,
        declarative: DeclarativeMemory,
        topological: TopologicalMemory,
        *,
        run: str,
        before: SavedMemory | None = None,
        now_s: float,
        start_s: float,
        frame: str,
        home: Home | None = None,
    ) -> SavedMemory:
        """Take down what two memories hold.

        Parameters
        ----------
        declarative, topological
            The memories.
        run : str
            Names this run among all runs.
        before : SavedMemory, optional
            What it began with.
        now_s : float
            The moment, on the clock of `declarative`: seconds since the run began.
        start_s : float
            The beginning on the clock of `topological`.
        frame : str
            Frame of the positions.
        home : Home, optional
            Where the first run began.

        Raises
        ------
        ValueError
            If memory has been through a run of this name before.
        """
        came_from = before.aged(now_s) if before else None
        known = came_from.origins if came_from else {}
        saved_s = start_s + now_s
        return cls(
            saved_s=saved_s,
            frame=frame,
            runs=(*(came_from.runs if came_from else ()), PastRun(run, 0.0)),
            chunks=tuple(
                # A reference counts as made now though the engine's clock rounds it upwards.
                RememberedChunk(
                    chunk,
                    tuple(max(0.0, now_s - t_s) for t_s in times.tolist()),
                )
                for chunk, times in declarative.histories()
            ),
            landmarks=tuple(_later(landmark, -saved_s) for landmark in topological.nodes),
            arcs=tuple(_later(arc, -saved_s) for arc in topological.arcs),
            origins={
                landmark.id: known.get(landmark.id, f"{run}/{landmark.id}")
                for landmark in topological.nodes
            },
            home=home,
        )

    def aged(self, seconds: float) -> SavedMemory:
        """Return the memory as it is some time later, if nothing happens meanwhile.

        Raises
        ------
        ValueError
            If the time is negative or not finite.
        """
        length("seconds", seconds)
        return replace(
            self,
            runs=tuple(replace(run, ended_ago_s=run.ended_ago_s + seconds) for run in self.runs),
            chunks=tuple(
                RememberedChunk(each.chunk, tuple(age_s + seconds for age_s in each.ages_s))
                for each in self.chunks
            ),
            landmarks=tuple(_later(landmark, -seconds) for landmark in self.landmarks),
            arcs=tuple(_later(arc, -seconds) for arc in self.arcs),
        )

    def recall_into(self, declarative: DeclarativeMemory, now_s: float = 0.0) -> None:
        """Put all chunks into a declarative memory whose clock shows `now_s`."""
        for each in self.chunks:
            declarative.restore(each.chunk, [now_s - age_s for age_s in each.ages_s])

    def topological(self, now_s: float = 0.0) -> TopologicalMemory:
        """Return the topological memory, on a clock that shows `now_s`."""
        return TopologicalMemory.restored(
            (_later(landmark, now_s) for landmark in self.landmarks),
            (_later(arc, now_s) for arc in self.arcs),
        )

    @property
    def view_length(self) -> int | None:
        """How many numbers each view has; None without any view."""
        return next((len(view.descriptor) for view in self._views()), None)

    def check_views(self, numbers: int | None) -> None:
        """Check that views of so many numbers, None for any, can be compared with those here.

        Raises
        ------
        ValueError
            If they have another length, or a word stands where a view should.
        """
        for each in self.chunks:
            view = each.chunk.slots.get("view")
            if view is not None and not isinstance(view, View):
                raise ValueError(f"chunk '{each.chunk.name}': view is {view!r}; expected a view")
        if numbers is not None and self.view_length not in (None, numbers):
            raise ValueError(
                f"its views have {self.view_length} numbers, those of this model {numbers} "
                "(perception.view and view_beams)"
            )

    def check_frame(self, frame: str) -> None:
        """Check that positions in a frame can be compared with those here.

        Raises
        ------
        ValueError
            If they are in another frame.
        """
        if self.landmarks and self.frame != frame:
            raise ValueError(
                f"its positions are in the frame '{self.frame}', those of this run in '{frame}'"
            )

    def _views(self) -> Iterable[View]:
        for each in self.chunks:
            for value in each.chunk.slots.values():
                if isinstance(value, View):
                    yield value


def _later(what: Timed, by_s: float) -> Timed:
    """Move every time of a landmark or arc; those are its fields in seconds."""
    times = {f.name: getattr(what, f.name) + by_s for f in fields(what) if f.name.endswith("_s")}
    return replace(what, **times) if times else what


def _once(what: str, names: Iterable[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise ValueError(f"{what} '{name}' stands in it twice")
        seen.add(name)
