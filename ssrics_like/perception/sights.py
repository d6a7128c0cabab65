"""What stands out along the robot's way: doorways, and where novelty is highest.

Everything is indexed by metres travelled and compensated for turns, so that neither speed nor
scan rate nor turning on the spot matters, and a robot that stands still perceives nothing new.
"""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.doorways import APART_M, DoorwayWatch, SeenDoorway
from ssrics_like.perception.gap import FEATURES
from ssrics_like.perception.novelty_watch import Moment
from ssrics_like.perception.panorama import panorama
from ssrics_like.perception.structure import StructureWatch, corridor_or_room
from ssrics_like.perception.surroundings import UNSEEN, Described, Surroundings

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.doorways import DoorwayCue
    from ssrics_like.perception.novelty_watch import NoveltyWatch
    from ssrics_like.perception.observation import Pose
    from ssrics_like.perception.sensed import Sensed
    from ssrics_like.perception.structure import StructureCue

DOORWAY = "doorway"
NECK_M = 0.4
"""A doorway is sought so far from where it looks most like one, as far as that is known by then."""
WIDEST_M = 1.4
"""A gap that is no wider is the doorway, even if the robot turns back in it."""
ASIDE_M = 0.5
"""Through one that is wider the robot went: its middle cannot lie farther from the way."""
BEFORE_M, THROUGH_M = 0.5, 0.5
"""From so far before such a gap to so far after it, the robot got so much farther through, or it
turned back; then the gap that it turned in says nothing of where the doorway is."""
KEPT = 20  # places: two metres, more than anything is decided late
WIDTH = FEATURES.index("width_m")


class Sights:
    """Looks at the places along the way.

    Parameters
    ----------
    watch : NoveltyWatch
        Its intervals count places, 0.1 m apart.
    cue : DoorwayCue, optional
        What was learned of doorways; without it none is perceived.
    structure : StructureCue, optional
        What was learned of other structure; without it corridors are told from rooms by their
        width if doorways are perceived, and else no structure is perceived.
    around : bool
        Whether moments are handed out with what surrounds their place.

    Attributes
    ----------
    around : bool
        The same.
    """

    def __init__(
        self,
        watch: NoveltyWatch,
        cue: DoorwayCue | None,
        structure: StructureCue | None = None,
        *,
        around: bool = False,
    ) -> None:
        self._watch = watch
        self.around = around
        layout = structure is not None
        self._surroundings: Surroundings[Sensed] = Surroundings(
            wide=layout or around, layout=layout
        )
        self._structure = None if structure is None else StructureWatch(structure, watch.longest)
        self._doorways: DoorwayWatch[Sensed] | None = None if cue is None else DoorwayWatch(cue)
        self._doorway_m = -math.inf
        self._recent: deque[Described[Sensed]] = deque(maxlen=KEPT)

    def update(self, sensed: Sensed) -> list[Moment]:
        """Take what was sensed; return the moments that stand out, mostly none.

        A doorway is one moment: the peak of novelty beside it is its own, and none comes with it.
        """
        observation = sensed.observation
        novel: list[Moment] = []
        doorways: list[Moment] = []
        for described in self._surroundings.update(
            observation.pose, observation.scan.bearings_rad, sensed.ranges_m, sensed,
            observation.scan.ranges_m if self.around else None,
        ):  # fmt: skip
            self._recent.append(described)
            here = described.place.nearest
            if self._structure is not None:
                self._structure.update(here.travelled_m, described.layout)
            elif self._doorways is not None:
                here = here._replace(structure=corridor_or_room(described.measures))
            scan = here.observation.scan
            novel += self._watch.update(
                here,
                panorama(here.ranges_m, scan.bearings_rad, here.observation.pose.theta_rad),
            )
            if self._doorways is not None:
                doorways += [self._moment(seen) for seen in self._doorways.update(described)]
        return self._looked_round(doorways or self._elsewhere(novel))

    def flush(self) -> list[Moment]:
        """Return the moments kept back so far, as at the end of a log."""
        novel = self._watch.flush()
        doorways = [] if self._doorways is None else self._doorways.flush()
        found = [self._moment(seen) for seen in doorways]
        found += self._elsewhere(novel)
        return self._looked_round(sorted(found, key=lambda moment: moment.anchor.travelled_m))

    def _looked_round(self, moments: list[Moment]) -> list[Moment]:
        """Add what surrounds the places, if that is wanted."""
        if not self.around:
            return moments
        return [
            moment._replace(anchor=moment.anchor._replace(around=self._view_of(moment.anchor)))
            for moment in moments
        ]

    def view_of(self, place: Pose, *, far: bool = True) -> NDArray[np.float32]:
        """Describe what surrounds a place near the robot, frame of odometry; needs `around`."""
        return self._surroundings.view_of(place, far=far)

    def _view_of(self, anchor: Sensed) -> NDArray[np.float32]:
        """Look round; from a doorway without a direction there is nothing to begin with."""
        if anchor.gap is None and anchor.structure == DOORWAY:
            return UNSEEN
        return self._surroundings.view_of(anchor.gap or anchor.observation.pose)

    def _elsewhere(self, novel: list[Moment]) -> list[Moment]:
        """Return the moments that belong to no doorway, with the words for their places."""
        away = [
            moment
            for moment in novel
            if abs(moment.anchor.travelled_m - self._doorway_m) >= APART_M
        ]
        if self._structure is None:
            return away
        words = [self._structure.word_at(moment.anchor.travelled_m) for moment in away]
        return [
            moment._replace(anchor=moment.anchor._replace(structure=word))
            for moment, word in zip(away, words, strict=True)
        ]

    def _moment(self, seen: SeenDoorway[Sensed]) -> Moment:
        described: Described[Sensed] = seen.place
        self._doorway_m = described.place.nearest.travelled_m
        novelty = self._watch.novelty_at(described.place.at_m)
        return Moment(
            described.place.nearest._replace(structure=DOORWAY, gap=self._doorway(described)),
            0.0 if novelty is None else novelty,
        )

    def _doorway(self, seen: Described[Sensed]) -> Pose | None:
        """Return where the doorway is that was seen, if its surroundings tell.

        They do not where the robot was carried away since, where nothing stands on both sides of
        its way, and where a gap is wider than a doorway and the robot did not go through.
        """
        if seen.place.at_m < self._surroundings.since_m:
            return None
        near = [
            described
            for described in self._known
            if abs(described.place.at_m - seen.place.at_m) <= NECK_M
        ]
        neck = min(near, key=lambda described: float(described.measures[WIDTH]))
        way_m = np.array([(each.place.x_m, each.place.y_m) for each in near])
        found = self._surroundings.doorway_on(_denser(way_m), neck.gap.theta_rad)
        if found is None:
            return None
        middle = found.middle
        if found.width_m <= WIDEST_M:
            return middle
        aside_m = np.hypot(*(way_m - (middle.x_m, middle.y_m)).T).min()
        return middle if aside_m <= ASIDE_M and self._went_through(seen, middle) else None

    @property
    def _known(self) -> list[Described[Sensed]]:
        """The last places, as far as they lie in the map."""
        since_m = self._surroundings.since_m
        return [described for described in self._recent if described.place.at_m >= since_m]

    def _went_through(self, seen: Described[Sensed], gap: Pose) -> bool:
        """Tell whether the robot went on through a gap, and did not turn back in it."""
        before, after = (
            min(self._known, key=lambda each: abs(each.place.at_m - at_m)).place
            for at_m in (seen.place.at_m - BEFORE_M, seen.place.at_m + BEFORE_M)
        )
        cos, sin = math.cos(gap.theta_rad), math.sin(gap.theta_rad)
        return cos * (after.x_m - before.x_m) + sin * (after.y_m - before.y_m) >= THROUGH_M


def _denser(way_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Add to a way the places midway between those of it."""
    steps = np.arange(0.0, len(way_m) - 0.75, 0.5)
    index = np.arange(len(way_m))
    return np.stack([np.interp(steps, index, column) for column in way_m.T], axis=1)
