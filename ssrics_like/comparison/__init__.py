"""Human and robot choices of landmarks: matching, agreement, chance."""

from ssrics_like.comparison.compared import Compared, compare_folder, truth_at
from ssrics_like.comparison.compared_files import write_comparison
from ssrics_like.comparison.drive import Drive, Marks, Passages
from ssrics_like.comparison.folder import FolderScores, building_of, score_folder, score_records
from ssrics_like.comparison.passages import passages_through, thresholds
from ssrics_like.comparison.scores import PlaceScore, Scores, score_runs
from ssrics_like.comparison.tally import Tally
from ssrics_like.comparison.truth import Truth, load_truth
from ssrics_like.comparison.way import Way
from ssrics_like.comparison.writing import write_scores

__all__ = [
    "Compared",
    "Drive",
    "FolderScores",
    "Marks",
    "Passages",
    "PlaceScore",
    "Scores",
    "Tally",
    "Truth",
    "Way",
    "building_of",
    "compare_folder",
    "load_truth",
    "passages_through",
    "score_folder",
    "score_records",
    "score_runs",
    "thresholds",
    "truth_at",
    "write_comparison",
    "write_scores",
]
