"""People's landmarks and robots' beside each other: agreement, consensus, the human ceiling."""

from ssrics_like.people.beside import Beside, compare_people
from ssrics_like.people.files import write_people
from ssrics_like.people.folders import Folders, read_folders
from ssrics_like.people.markers import Marker, people_of, runs_of
from ssrics_like.people.settings import Settings
from ssrics_like.people.simulated import Participants, simulated_choices

__all__ = [
    "Beside",
    "Folders",
    "Marker",
    "Participants",
    "Settings",
    "compare_people",
    "people_of",
    "read_folders",
    "runs_of",
    "simulated_choices",
    "write_people",
]
