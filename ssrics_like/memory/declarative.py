"""Declarative memory: chunks that fade, and requests that find the most active one."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import nearest
from ssrics_like.memory.candidates import Candidates, Retrieval, most_active
from ssrics_like.memory.chunks import Chunk, Request, Value
from ssrics_like.memory.noise import activation_noise
from ssrics_like.memory.parameters import MemoryParameters
from ssrics_like.memory.similarity import SlotSimilarity
from ssrics_like.memory.spreading import spreading_activation
from ssrics_like.memory.table import ChunkTable

MS_PER_S = 1000


class DeclarativeMemory:
    """ACT-R 7's declarative module, in columns so that it stays quick when it is large.

    Parameters
    ----------
    parameters : MemoryParameters
        How it forgets, matches and is timed.
    rng : numpy.random.Generator, optional
        Where noise comes from; needed when `parameters.activation_noise` is not 0.
    similarities : mapping of str to SlotSimilarity, optional
        How the values of a slot compare, by slot. The values of other slots are equal
        or different.

    Raises
    ------
    ValueError
        If there is to be noise but nothing to draw it from.

    Notes
    -----
    Time is in seconds on any one clock. Nothing is ever removed.

    References
    ----------
    Bothell, ACT-R 7.27+ Reference Manual, "Declarative module". Where this class departs
    from it is listed in docs/memory.md.
    """

    def __init__(
        self,
        parameters: MemoryParameters,
        rng: np.random.Generator | None = None,
        similarities: Mapping[str, SlotSimilarity] | None = None,
    ) -> None:
        if parameters.activation_noise > 0 and rng is None:
            raise ValueError("activation_noise above 0 needs a random generator (rng)")
        self.parameters = parameters
        self._rng = rng
        self._similarities = dict(similarities or {})
        self._tables: dict[str, ChunkTable] = {}
        self._where: dict[str, tuple[ChunkTable, int]] = {}
        self._name_of: dict[tuple[str, frozenset[tuple[str, Value]]], str] = {}
        self._fan: dict[str, int] = {}

    def __len__(self) -> int:
        return len(self._where)

    def __contains__(self, name: object) -> bool:
        return name in self._where

    def __getitem__(self, name: str) -> Chunk:
        table, row = self._find(name)
        return table.chunks[row]

    def _find(self, name: str) -> tuple[ChunkTable, int]:
        try:
            return self._where[name]
        except KeyError:
            hint = nearest(name, self._where)
            raise KeyError(f"no chunk '{name}' in declarative memory{hint}") from None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all chunks, in the order in which they came."""
        return tuple(self._where)

    def references(self, name: str) -> NDArray[np.float64]:
        """Return when a chunk was added and strengthened, in that order; seconds, shape (n,)."""
        table, row = self._find(name)
        return table.references.of(row)

    def add(self, chunk: Chunk, t_s: float) -> str:
        """Put a chunk in memory, or strengthen the one that equals it.

        Parameters
        ----------
        chunk : Chunk
            Merged with a chunk of the same type and equal slots, whatever its name.
        t_s : float
            When, seconds.

        Returns
        -------
        str
            Name of the chunk in memory: that of `chunk`, or of the one it merged with.

        Raises
        ------
        ValueError
            If another chunk has the name, a view has not the length of the others, or
            the time is not finite.
        TypeError
            If a value does not suit its slot.
        """
        if (known := self._name_of.get(_content(chunk))) is not None:
            self.strengthen(known, t_s)
            return known
        self._append(chunk, t_s)
        return chunk.name

    def restore(self, chunk: Chunk, references_s: Sequence[float]) -> None:
        """Put a chunk in memory as another memory had it: with its history, and never merged.

        Parameters
        ----------
        chunk : Chunk
            One that equals it stays a chunk of its own, as after `replace`.
        references_s : sequence of float
            When it was added and strengthened, seconds; below 0 is before this memory's time.

        Raises
        ------
        ValueError, TypeError
            As for :meth:`add`; or there is no reference.
        """
        if not references_s:
            raise ValueError(f"chunk '{chunk.name}' has no reference; expected one or more")
        first_s, *later_s = map(_finite, references_s)
        self._append(chunk, first_s)
        table, row = self._where[chunk.name]
        for t_s in later_s:
            table.references.add_reference(row, t_s)

    def histories(self) -> list[tuple[Chunk, NDArray[np.float64]]]:
        """Return every chunk with the times of its references, in the order of `names`."""
        times = {id(table): table.references.by_chunk() for table in self._tables.values()}
        return [(table.chunks[row], times[id(table)][row]) for table, row in self._where.values()]

    def _append(self, chunk: Chunk, t_s: float) -> None:
        if chunk.name in self._where:
            raise ValueError(f"another chunk is called '{chunk.name}' already: {self[chunk.name]}")
        table = self._tables.get(chunk.type) or ChunkTable(self.parameters, self._similarities)
        row = table.append(chunk, _finite(t_s), len(self))
        self._tables[chunk.type] = table
        self._where[chunk.name] = table, row
        self._name_of.setdefault(_content(chunk), chunk.name)
        for value in chunk.slots.values():
            if isinstance(value, str):
                self._fan[value] = self._fan.get(value, 0) + 1

    def strengthen(self, name: str, t_s: float) -> None:
        """Add one reference to a chunk.

        Raises
        ------
        KeyError
            If there is no such chunk.
        """
        table, row = self._find(name)
        table.references.add_reference(row, _finite(t_s))

    def replace(self, name: str, slot: str, value: Value) -> None:
        """Change the value of a continuous slot (view, place); not a reference.

        For a landmark that is met again: its estimated place is the newest one.

        Raises
        ------
        KeyError
            If there is no such chunk.
        ValueError
            If the chunk lacks the slot, or the slot is not continuous.
        """
        table, row = self._find(name)
        old = _content(table.chunks[row])
        table.replace(row, slot, value)
        if self._name_of.get(old) == name:
            del self._name_of[old]
        self._name_of.setdefault(_content(table.chunks[row]), name)

    def base_level(self, name: str, t_s: float) -> float:
        """Return the base level of one chunk; -inf before its first reference."""
        table, row = self._find(name)
        wanted = np.zeros(len(table), np.bool_)
        wanted[row] = True
        return float(table.base_levels(t_s, wanted)[row])

    def activations(self, t_s: float) -> NDArray[np.float64]:
        """Return the base levels of all chunks at one moment, in the order of `names`.

        Parameters
        ----------
        t_s : float
            Seconds. May lie in the past: only references up to then count.

        Returns
        -------
        ndarray, shape (n,)
            -inf for a chunk that was not there yet.
        """
        result = np.empty(len(self))
        for table in self._tables.values():
            result[table.positions.used] = table.base_levels(t_s)
        return result

    def likeness(
        self, chunk_type: str, slot: str, value: Value, *, without: str | None = None
    ) -> NDArray[np.float64]:
        """Return how well the values of a slot would do for one, as partial matching weighs them.

        Parameters
        ----------
        chunk_type, slot : str
            Where the values stand.
        value : Value
            What they are compared with.
        without : str, optional
            A chunk of that type that is left out.

        Returns
        -------
        ndarray, shape (m,)
            ``min(0, P (M_i - max_similarity))`` for each chunk that has the slot, P being the
            mismatch penalty, or 1 where there is none.

        Raises
        ------
        TypeError, ValueError
            If the value does not suit the slot.
        """
        table = self._tables.get(chunk_type)
        if table is None:
            return np.empty(0)
        return table.likeness(slot, value, None if without is None else self._find(without)[1])

    def retrieve(
        self,
        request: Request,
        t_s: float,
        sources: Mapping[str, Sequence[str]] | None = None,
    ) -> Retrieval:
        """Find the most active chunk that fits; it is not strengthened by that.

        Parameters
        ----------
        request : Request
            What is sought.
        t_s : float
            When, seconds. Only what was in memory by then is found.
        sources : mapping of str to sequence of str, optional
            The symbols in each buffer, for spreading activation.

        Returns
        -------
        Retrieval
            The chunk whose total activation is greatest, if that reaches the threshold;
            of equal ones the first by name. The latency is ``F exp(-f A)``, with the
            threshold for A after a failure, to the whole millisecond.

        Raises
        ------
        TypeError
            If a requested value does not suit its slot.
        ValueError
            If a requested view has not the length of those in memory, or the time is
            not finite.
        """
        _finite(t_s)
        parts = [
            self._candidates(table, request, t_s, sources or {}) for table in self._asked(request)
        ]
        names = np.concatenate([np.empty(0, np.object_), *(part[0] for part in parts)])
        terms = np.hstack([np.empty((3, 0)), *(part[1] for part in parts)])
        noise = self._noise(len(names))
        total = terms.sum(axis=0) + noise
        winner = most_active(names, total)
        parameters = self.parameters
        candidates = Candidates(
            names=names,
            base_level=terms[0],
            spreading=terms[1],
            partial_match=terms[2],
            noise=noise,
            total=total,
            threshold=parameters.retrieval_threshold if parameters.subsymbolic else -math.inf,
            winner=winner,
        )
        if winner is None or total[winner] < candidates.threshold:
            latency_s = self._latency_s(parameters.retrieval_threshold)
            return Retrieval(None, latency_s, math.nan, candidates)
        activation = float(total[winner])
        return Retrieval(self[names[winner]], self._latency_s(activation), activation, candidates)

    def _asked(self, request: Request) -> list[ChunkTable]:
        if request.type is None:
            return list(self._tables.values())
        return [self._tables[request.type]] if request.type in self._tables else []

    def _candidates(
        self, table: ChunkTable, request: Request, t_s: float, sources: Mapping[str, Sequence[str]]
    ) -> tuple[NDArray[np.object_], NDArray[np.float64]]:
        """Return the candidates of a table: names, and base level, spreading, partial match."""
        parameters = self.parameters
        partial = parameters.subsymbolic and parameters.mismatch_penalty is not None
        fitting = table.fits(request, partial=partial)
        base_levels = table.base_levels(t_s, None if fitting.all() else fitting)
        rows = np.flatnonzero(base_levels > -np.inf)
        terms = np.zeros((3, len(rows)))
        terms[0] = base_levels[rows]
        if parameters.subsymbolic and len(rows) > 0:
            spread = spreading_activation(
                sources, parameters, table.occurrences, self._fan_of, len(table)
            )
            terms[1] = spread[rows]
            terms[2] = table.partial_match(request)[rows]
        return table.names.used[rows], terms

    def _fan_of(self, symbol: str) -> int:
        return self._fan.get(symbol, 0) + 1

    def _noise(self, count: int) -> NDArray[np.float64]:
        scale = self.parameters.activation_noise
        if self._rng is None or scale == 0 or not self.parameters.subsymbolic:
            return np.zeros(count)
        return activation_noise(self._rng, scale, count)

    def _latency_s(self, activation: float) -> float:
        parameters = self.parameters
        if not parameters.subsymbolic:
            return 0.0
        factor_ms = round(MS_PER_S * parameters.latency_factor)
        return round(factor_ms * math.exp(-parameters.latency_exponent * activation)) / MS_PER_S


def _content(chunk: Chunk) -> tuple[str, frozenset[tuple[str, Value]]]:
    return chunk.type, frozenset(chunk.slots.items())


def _finite(t_s: float) -> float:
    if not math.isfinite(t_s):
        raise ValueError(f"time is {t_s!r}; expected finite seconds")
    return t_s
