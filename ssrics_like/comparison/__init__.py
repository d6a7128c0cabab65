"""Human and robot choices of landmarks: matching, agreement, chance."""

from ssrics_like.comparison.folder import FolderScores, building_of, score_folder, score_records
from ssrics_like.comparison.scores import Drive, PlaceScore, Scores, score_runs
from ssrics_like.comparison.tally import Tally
from ssrics_like.comparison.writing import write_scores

__all__ = [
    "Drive",
    "FolderScores",
    "PlaceScore",
    "Scores",
    "Tally",
    "building_of",
    "score_folder",
    "score_records",
    "score_runs",
    "write_scores",
]
