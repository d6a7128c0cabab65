"""What each figure means, in words: they stand in the files and on the page beside the figures."""

from __future__ import annotations

DEFINITIONS = {
    "marker": "a participant, or a run of a model; what it marks twice counts once",
    "location": "a labelled place, or one found from people's marks; it is marked by whoever has a "
    "mark within the radius of it, nearer than to any other location",
    "route": "where the runs drove, cut in bins; a stretch driven again lies in the same bins, and "
    "what fewer than half of the runs came by is left out; a run that never came by a bin did not "
    "mark it",
    "unit": "what can be marked: a location on the route, or a bin of the route that lies within "
    "the radius of no location",
    "consensus": "the units that at least half of the people marked",
    "low, high": "95 % interval: of shares Wilson's; of other figures the bootstrap over "
    "participants and runs, participants being the sample",
    "precision": "share of the units a marker marked that are consensus; mean over the runs",
    "recall": "share of the consensus that a marker marked; mean over the runs",
    "f": "harmonic mean of precision and recall of each marker; mean over the runs",
    "f_chance": "f of as many marks at random along the driven path, uniform by length",
    "f_corrected": "(f - f_chance) / (1 - f_chance)",
    "kappa": "Cohen's kappa of a marker with the consensus, over all units; mean over the runs",
    "d_prime": "z(hit rate) - z(false alarm rate) against the consensus, log-linear correction",
    "criterion": "-(z(hit rate) + z(false alarm rate)) / 2; positive: marks little",
    "kappa_people": "Cohen's kappa with each person (of people, of every two of them); mean",
    "kappa_people_median": "the same; median",
    "fleiss": "Fleiss' kappa of the people; of a model, of the people and one run; mean over runs",
    "alpha": "Krippendorff's alpha, nominal, likewise",
    "consistency": "Cohen's kappa of every two runs of a model; mean",
    "precision_others, recall_others, f_others, kappa_others, d_prime_others, criterion_others":
        "the measure against the consensus of all people but one, that one being left out in turn; "
        "of people that person is measured (the human ceiling), of a model its runs; mean",
    "f_ceiling, kappa_ceiling": "the model's measure less the person's, held against the same "
    "others; mean over people: 0 is as near to the others as people are",
    "f_exceeds, kappa_exceeds": "share of people whom the mean of the model's runs exceeds",
    "difference": "first model less second; f and kappa with each person, mean over runs and "
    "people; locations: share of them about which at least half of the runs agree with the "
    "consensus",
    "p": "two-sided: changes of sign over people (f, kappa); McNemar's exact test (locations)",
    "p_holm": "p after Holm's correction for the number of pairs of models",
}  # fmt: skip
