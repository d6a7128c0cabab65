"""Learning what doorways and other structure look like, in buildings made up at random.

Nothing here is needed to run the model: a training ends with a cue in a file.
"""

from ssrics_like.training.examples import Example, described, example
from ssrics_like.training.labels import labels
from ssrics_like.training.settings import TrainingSettings
from ssrics_like.training.structure_training import StructureTraining, train_structure
from ssrics_like.training.threshold import choose_threshold
from ssrics_like.training.training import Training, train_doorways

__all__ = [
    "Example",
    "StructureTraining",
    "Training",
    "TrainingSettings",
    "choose_threshold",
    "described",
    "example",
    "labels",
    "train_doorways",
    "train_structure",
]
