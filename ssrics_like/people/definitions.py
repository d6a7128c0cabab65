"""What each figure is called in tables, and what every word of them means."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.people.resampling import LEAST


@dataclass(frozen=True, slots=True)
class Row:
    """A figure as tables name it.

    Attributes
    ----------
    key : str
        Its name in files.
    term : str
        What it is.
    against : str
        Against what, or with whom; a term, too.
    """

    key: str
    term: str
    against: str


ALL, EACH, RUN = "people and one run", "each person", "each other run"
OTHERS, CONSENSUS = "others' consensus", "consensus"

FIGURES = (
    Row("alpha", "Krippendorff's α", ALL),
    Row("fleiss", "Fleiss' κ", ALL),
    Row("kappa_people", "κ", EACH),
    Row("kappa_people_median", "κ, median", EACH),
    Row("consistency", "κ", RUN),
    Row("precision_others", "precision", OTHERS),
    Row("recall_others", "recall", OTHERS),
    Row("f_others", "F", OTHERS),
    Row("f_ceiling", "F less a person's", OTHERS),
    Row("f_exceeds", "people exceeded in F", OTHERS),
    Row("kappa_others", "κ", OTHERS),
    Row("kappa_ceiling", "κ less a person's", OTHERS),
    Row("kappa_exceeds", "people exceeded in κ", OTHERS),
    Row("d_prime_others", "d′", OTHERS),
    Row("criterion_others", "criterion c", OTHERS),
    Row("precision", "precision", CONSENSUS),
    Row("recall", "recall", CONSENSUS),
    Row("f", "F", CONSENSUS),
    Row("f_chance", "F of chance", CONSENSUS),
    Row("f_corrected", "F above chance", CONSENSUS),
    Row("kappa", "κ", CONSENSUS),
    Row("d_prime", "d′", CONSENSUS),
    Row("criterion", "criterion c", CONSENSUS),
)
"""Every figure, in the order of the table of figures."""

TERMS = {
    "marker": "a participant, or a run of a model; what it marks twice counts once",
    "location": "a labelled place, or one found from people's marks; it is marked by whoever has a "
    "mark within the radius of it, nearer than to any other location",
    "kind": "what the map says that the location is",
    "route": "where the runs drove, cut in bins; a stretch driven again lies in the same bins, and "
    "what fewer than half of the runs came by is left out; a run that never came by a bin did not "
    "mark it",
    "unit": "what can be marked: a location on the route, or a bin of the route that lies within "
    "the radius of no location",
    CONSENSUS: "the units that at least half of the people marked; runs are held against it",
    OTHERS: "the units that at least half of all people but one marked, each being left out in "
    "turn. That person is held against it, of which the mean is the human ceiling; and so is each "
    "run, in the person's place",
    EACH: "what one person marked, for each in turn: the runs, and of people all others, are held "
    "against it",
    RUN: "every two runs of a model are held against each other",
    ALL: "all people together; of a model, all people and one of its runs as one more of them, "
    "mean over the runs",
    "interval": "95 %, in brackets. Of shares it is Wilson's. Of figures it is the bootstrap: "
    f"people and runs are drawn anew. There is none for fewer than {LEAST} people (of κ against "
    f"each other run, {LEAST} runs), and none where every draw gives the same: then nothing is "
    "known of how much a figure would waver",
    "marks": "how many marks a participant made, on the route or off it",
    "precision": "share of the marked units that should be marked; mean over runs, or people",
    "recall": "share of the units that should be marked that are; mean over runs, or people",
    "F": "harmonic mean of precision and recall of each marker, 0 to 1; mean over runs, or people",
    "κ": "Cohen's kappa: of how many units two sides say the same, corrected for chance, over all "
    "units; 0 is chance, 1 perfect agreement; mean over runs, or people",
    "κ, median": "the same; median instead of mean",
    "Fleiss' κ": "agreement of many markers at once, corrected for chance",
    "Krippendorff's α": "agreement of many markers at once, corrected for chance, nominal; "
    "corrected for few units, too",
    "d′": "sensitivity: z(hit rate) − z(false alarm rate), with log-linear correction; 0 is "
    "guessing; mean over runs, or people",
    "criterion c": "−(z(hit rate) + z(false alarm rate)) / 2; positive for whoever marks little",
    "F of chance": "F of as many marks at random along the driven path, uniform by length",
    "F above chance": "(F − F of chance) / (1 − F of chance)",
    "F less a person's": "F of the model less that of the person, against the same others; mean "
    "over people: 0 is as near to the others as people are",
    "κ less a person's": "likewise of κ",
    "people exceeded in F": "share of people whose F is less than the mean F of the runs against "
    "the same others",
    "people exceeded in κ": "likewise of κ",
    "locations right": "share of the locations on the route about which at least half of the runs "
    "agree with the consensus",
    "first less second": "difference of the two models; mean over runs and people",
    "p": "probability of such a difference if the models were alike, two-sided: signs are changed "
    "over people; of locations right, McNemar's exact test",
    "p over runs": "likewise, runs being exchanged between the models: it is small only if what is "
    "found holds for further runs, too",
    "p, Holm": "the larger of both, corrected for the number of pairs of models",
}
"""What each word of the page, each heading and each row of its tables means."""

WORDS = ("marker", "location", "route", "unit", "interval")
"""Terms that text uses; every other one stands in a table."""


def file_definitions() -> dict[str, str]:
    """Return what each figure and column of the files means, by its name there."""
    found = {word: TERMS[word] for word in (*WORDS, CONSENSUS)}
    found |= {
        row.key: f"{row.term} ({row.against}): {TERMS[row.term]}. {row.against}: "
        f"{TERMS[row.against]}"
        for row in FIGURES
    }
    found["low, high"] = TERMS["interval"]
    columns = {
        "difference": "first less second", "p": "p", "p_runs": "p over runs", "p_holm": "p, Holm",
    }  # fmt: skip
    return found | {name: TERMS[term] for name, term in columns.items()}
