"""What each figure means, in words: they stand in the files beside the figures."""

from __future__ import annotations

DEFINITIONS = {
    "mark": "a reflex that was called a landmark (declared, recognised, or unsure which), at its "
    "true position where that is known",
    "designated": "the places that should be found: the doorways of a map; of a labelled log those "
    "that the robot went through",
    "found": "a place is found by one mark at most, a mark finds one place at most, within the "
    "radius; as many pairs as can be, and of these the shortest",
    "recall": "place recall: designated places found, over all runs and designated places",
    "low, high": "Wilson score interval of recall at the level stated",
    "chance": "recall of as many marks at random along the driven path, uniform by length; mean "
    "of the draws",
    "clock": "recall of as many marks at equal intervals of time, from a random moment on; mean of "
    "the draws",
    "corrected_recall": "(recall - chance) / (1 - chance)",
    "passages": "the times that the robot went through a designated place",
    "passed": "passages found: as places are, but by the metres of path between mark and passage",
    "pass_recall": "passages found, over all passages of all runs",
    "pass_low, pass_high": "Wilson score interval of pass_recall at the level stated",
    "pass_chance, pass_clock": "pass_recall of the marks of chance, and of those of clock",
    "corrected_pass_recall": "(pass_recall - pass_chance) / (1 - pass_chance)",
    "precision": "marks within the radius of an earlier one are merged; share of what is left "
    "that lies at a labelled place of any kind, one to one, within the radius",
    "precision_chance, precision_clock": "of these marks; over the draws, the mean of what is "
    "right over the mean of what is left after merging",
    "f": "harmonic mean of pass_recall and precision",
    "f_chance, f_clock": "harmonic mean of pass_chance and precision_chance; the same of the clock",
    "f_place": "harmonic mean of recall and precision",
    "f_place_chance, f_place_clock": "harmonic mean of chance and precision_chance; the same of "
    "the clock",
    "marks_per_100_m": "marks, repetitions included, per 100 m driven",
    "duplicates": "marks at a designated place that was found, but for the one that found it, "
    "per place found",
    "delay_m": "metres driven from the place of a mark to where the robot decided to mark it; mean "
    "over the marks",
    "consistency": "two runs agree about a designated place if both found it or both missed it; "
    "mean share of agreement over all pairs of runs",
}
