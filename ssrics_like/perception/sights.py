"""What stands out along the robot's way: doorways, and where novelty is highest.

Everything is indexed by metres travelled and compensated for turns, so that neither speed nor
scan rate nor turning on the spot matters, and a robot that stands still perceives nothing new.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.perception.doorways import APART_M, DoorwayWatch, SeenDoorway
from ssrics_like.perception.novelty_watch import Moment
from ssrics_like.perception.panorama import panorama
from ssrics_like.perception.structure import corridor_or_room
from ssrics_like.perception.surroundings import Described, Surroundings

if TYPE_CHECKING:
    from ssrics_like.perception.doorways import DoorwayCue
    from ssrics_like.perception.novelty_watch import NoveltyWatch
    from ssrics_like.perception.sensed import Sensed


class Sights:
    """Looks at the places along the way.

    Parameters
    ----------
    watch : NoveltyWatch
        Its intervals count places, 0.1 m apart.
    cue : DoorwayCue, optional
        What was learned of doorways; without it no structure is perceived.
    """

    def __init__(self, watch: NoveltyWatch, cue: DoorwayCue | None) -> None:
        self._watch = watch
        self._surroundings: Surroundings[Sensed] = Surroundings()
        self._doorways: DoorwayWatch[Sensed] | None = None if cue is None else DoorwayWatch(cue)
        self._doorway_m = -math.inf

    def update(self, sensed: Sensed) -> list[Moment]:
        """Take what was sensed; return the moments that stand out, mostly none.

        A doorway is one moment: the peak of novelty beside it is its own, and none comes with it.
        """
        observation = sensed.observation
        novel: list[Moment] = []
        doorways: list[Moment] = []
        for described in self._surroundings.update(
            observation.pose, observation.scan.bearings_rad, sensed.ranges_m, sensed
        ):
            here = described.place.nearest
            if self._doorways is not None:
                here = here._replace(structure=corridor_or_room(described.measures))
            scan = here.observation.scan
            novel += self._watch.update(
                here,
                panorama(here.ranges_m, scan.bearings_rad, here.observation.pose.theta_rad),
            )
            if self._doorways is not None:
                doorways += [self._moment(seen) for seen in self._doorways.update(described)]
        return doorways or [moment for moment in novel if not self._at_a_doorway(moment)]

    def flush(self) -> list[Moment]:
        """Return the moments kept back so far, as at the end of a log."""
        novel = self._watch.flush()
        doorways = [] if self._doorways is None else self._doorways.flush()
        found = [self._moment(seen) for seen in doorways]
        found += [moment for moment in novel if not self._at_a_doorway(moment)]
        return sorted(found, key=lambda moment: moment.anchor.travelled_m)

    def _at_a_doorway(self, moment: Moment) -> bool:
        return abs(moment.anchor.travelled_m - self._doorway_m) < APART_M

    def _moment(self, seen: SeenDoorway[Sensed]) -> Moment:
        described: Described[Sensed] = seen.place
        self._doorway_m = described.place.nearest.travelled_m
        novelty = self._watch.novelty_at(described.place.at_m)
        return Moment(
            described.place.nearest._replace(structure="doorway"),
            0.0 if novelty is None else novelty,
        )
