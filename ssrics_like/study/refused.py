"""What a participant is told who may not do something."""

from __future__ import annotations


class Refused(Exception):  # noqa: N818 - it is an answer, not a failure
    """Something that a participant may not do, said in a few words.

    Parameters
    ----------
    status : int
        Of HTTP.
    why : str
        For the participant.
    """

    def __init__(self, status: int, why: str) -> None:
        super().__init__(why)
        self.status = status
        self.why = why
