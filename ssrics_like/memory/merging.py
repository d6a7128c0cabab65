"""Makes one memory of two: what both know is one thing, the rest stands side by side.

Both count as saved at the same moment. Landmarks of the same origin are one landmark; nothing
else is taken to be the same place, however alike it looks, so that nothing is joined that was
not joined before.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, replace
from itertools import count

from ssrics_like.memory.base_level import HALF_TICK_S
from ssrics_like.memory.chunks import Chunk, Value
from ssrics_like.memory.landmark import Landmark, number_of
from ssrics_like.memory.saved import RememberedChunk, SavedMemory


@dataclass(frozen=True)
class Merged:
    """Two memories made one.

    Attributes
    ----------
    memory : SavedMemory
        Both.
    joined : dict of str to str
        Landmarks of the second that were in the first -> their names there.
    renamed : dict of str to str
        The other landmarks of the second -> their names now.
    """

    memory: SavedMemory
    joined: dict[str, str]
    renamed: dict[str, str]


@dataclass(frozen=True)
class _SharedPast:
    """The last run that both memories have been through; None where there is none.

    A reference from before its end stands in both, at the same time before that end. Counted
    twice it would make a landmark stronger than it is.
    """

    ended_ago_s: tuple[float, float] | None

    @classmethod
    def of(cls, one: SavedMemory, other: SavedMemory) -> _SharedPast:
        ends = {run.id: run.ended_ago_s for run in one.runs}
        shared = [(run.ended_ago_s, ends[run.id]) for run in other.runs if run.id in ends]
        if not shared:
            return cls(None)
        ago_other_s, ago_one_s = min(shared)
        return cls((ago_one_s, ago_other_s))

    def new_in(self, ages_s: tuple[float, ...], mine_s: tuple[float, ...]) -> tuple[float, ...]:
        """Return the ages, of the second memory, of references that the first has not."""
        if self.ended_ago_s is None:
            return ages_s
        ago_one_s, ago_other_s = self.ended_ago_s
        known_s = sorted(mine_s)

        def is_known(age_s: float) -> bool:
            if age_s < ago_other_s - HALF_TICK_S:
                return False
            there_s = age_s - ago_other_s + ago_one_s
            at = bisect_left(known_s, there_s - HALF_TICK_S)
            return at < len(known_s) and known_s[at] <= there_s + HALF_TICK_S

        return tuple(age_s for age_s in ages_s if not is_known(age_s))


def merge(one: SavedMemory, other: SavedMemory) -> Merged:
    """Add a memory to another.

    Parameters
    ----------
    one : SavedMemory
        Keeps its names.
    other : SavedMemory
        Its landmarks that `one` has too, by their origin, are joined to those: all references,
        those from before the two parted once; the slots and labels of whichever was there last;
        the larger number of visits, and of opportunities missed. Its others get the next free
        numbers, in their names and wherever a slot holds these. Arcs of both are kept; of one that
        both have, the estimate with more traversals, since how much of it is from before they
        parted is not known. Home is that of `one`, if it has one.

    Returns
    -------
    Merged

    Raises
    ------
    ValueError
        If their positions are in different frames, or their views of different lengths.
    """
    if one.landmarks:
        other.check_frame(one.frame)
    if one.view_length is not None and other.view_length not in (None, one.view_length):
        raise ValueError(
            f"its views have {other.view_length} numbers, the others {one.view_length}"
        )
    joined, renamed = _names(one, other)
    names = {**joined, **renamed}
    landmarks = {landmark.id: landmark for landmark in one.landmarks}
    for landmark in other.landmarks:
        name = names[landmark.id]
        here = replace(landmark, id=name)
        landmarks[name] = _together(landmarks[name], here) if name in landmarks else here
    arcs = {(arc.from_id, arc.to_id): arc for arc in one.arcs}
    for arc in other.arcs:
        ends = names[arc.from_id], names[arc.to_id]
        there = replace(arc, from_id=ends[0], to_id=ends[1])
        if ends not in arcs or arcs[ends].traversals < there.traversals:
            arcs[ends] = there
    known = {run.id for run in one.runs}
    runs = [*one.runs, *(run for run in other.runs if run.id not in known)]
    memory = SavedMemory(
        saved_s=one.saved_s,
        frame=one.frame if one.landmarks else other.frame,
        runs=tuple(sorted(runs, key=lambda run: -run.ended_ago_s)),
        chunks=_chunks(one, other, names, set(renamed)),
        landmarks=tuple(landmarks.values()),
        arcs=tuple(arcs.values()),
        origins={**{names[k]: origin for k, origin in other.origins.items()}, **one.origins},
        home=one.home or (other.home and replace(other.home, landmark=names[other.home.landmark])),
    )
    return Merged(memory, joined, renamed)


def _names(one: SavedMemory, other: SavedMemory) -> tuple[dict[str, str], dict[str, str]]:
    """Return what the landmarks of the second are called in the first, and the new ones."""
    of_origin = {origin: name for name, origin in one.origins.items()}
    taken = [*of_origin.values(), *(each.chunk.name for each in one.chunks)]
    taken += [each.chunk.name for each in other.chunks if each.chunk.name not in other.origins]
    numbers = count(max(map(number_of, taken), default=0) + 1)
    joined, renamed = {}, {}
    for landmark in other.landmarks:
        known = of_origin.get(other.origins[landmark.id])
        if known is not None:
            joined[landmark.id] = known
        else:
            renamed[landmark.id] = f"L{next(numbers)}"
    return joined, renamed


def _together(one: Landmark, other: Landmark) -> Landmark:
    older, newer = sorted((other, one), key=lambda known: known.last_visit_s)
    # What one of them missed after its last visit counts as before that of the other, which saw it.
    seen_later = older.last_visit_s < newer.last_visit_s
    return replace(
        newer,
        visits=max(one.visits, other.visits),
        missed=max(newer.missed, older.missed + (older.missed_since if seen_later else 0)),
        missed_since=max(newer.missed_since, 0 if seen_later else older.missed_since),
    )


def _chunks(
    one: SavedMemory, other: SavedMemory, names: dict[str, str], new: set[str]
) -> tuple[RememberedChunk, ...]:
    """Put the chunks of both together."""
    past = _SharedPast.of(one, other)
    chunks = {each.chunk.name: each for each in one.chunks}
    of_content = {_content(each.chunk): each.chunk.name for each in one.chunks}
    for each in other.chunks:
        here = _renamed(each.chunk, names)
        mine = chunks.get(here.name)
        if each.chunk.name in new:
            same = None
        elif each.chunk.name in names:
            same = here.name if mine is not None else None
        elif mine is not None and _is_same(mine, here, each.ages_s, past):
            same = here.name
        else:  # as declarative memory merges equal chunks
            same = of_content.get(_content(here))
        if same is not None:
            chunks[same] = _strengthened(chunks[same], here, each.ages_s, past)
            continue
        if mine is not None:
            here = Chunk(_free(here.type, chunks), here.type, here.slots)
        chunks[here.name] = RememberedChunk(here, each.ages_s)
    return tuple(chunks.values())


def _renamed(chunk: Chunk, names: dict[str, str]) -> Chunk:
    """Give a chunk its new name, and the landmarks that its slots name theirs."""
    slots: dict[str, Value] = {
        slot: _renamed_word(value, names) if isinstance(value, str) else value
        for slot, value in chunk.slots.items()
    }
    return Chunk(names.get(chunk.name, chunk.name), chunk.type, slots)


def _renamed_word(word: str, names: dict[str, str]) -> str:
    """Rename a landmark, by itself or in a handle: L3, place-of-L3."""
    before, of, owner = word.rpartition("-of-")
    return f"{before}{of}{names[owner]}" if of and owner in names else names.get(word, word)


def _is_same(
    mine: RememberedChunk, here: Chunk, ages_s: tuple[float, ...], past: _SharedPast
) -> bool:
    """Tell whether a chunk that is no landmark was made before the two memories parted."""
    return mine.chunk.type == here.type and max(ages_s) not in past.new_in(ages_s, mine.ages_s)


def _strengthened(
    mine: RememberedChunk, here: Chunk, ages_s: tuple[float, ...], past: _SharedPast
) -> RememberedChunk:
    newer = here if min(ages_s) < min(mine.ages_s) else mine.chunk
    chunk = Chunk(mine.chunk.name, mine.chunk.type, newer.slots)
    together = [*mine.ages_s, *past.new_in(ages_s, mine.ages_s)]
    return RememberedChunk(chunk, tuple(sorted(together, reverse=True)))


def _content(chunk: Chunk) -> tuple[str, frozenset[tuple[str, Value]]]:
    return chunk.type, frozenset(chunk.slots.items())


def _free(kind: str, taken: dict[str, RememberedChunk]) -> str:
    """Return the first name of the kind that the model gives chunks without one: task-3."""
    return next(name for n in count() if (name := f"{kind}-{n}") not in taken)
