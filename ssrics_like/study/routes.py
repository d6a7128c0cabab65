"""Participants' pages, and the interface that these use."""

# No annotations of the future here: FastAPI reads them, and some are local to a function.
import gzip
from functools import cache
from typing import Annotated

from fastapi import APIRouter, Cookie, Depends, Header, Request, Response
from fastapi.responses import HTMLResponse, JSONResponse
from pydantic import BaseModel, ConfigDict, Field

from ssrics_like.study.conduct import Conduct
from ssrics_like.study.events import Incoming, Progress
from ssrics_like.study.frames import frames_of
from ssrics_like.study.limits import RateLimit
from ssrics_like.study.pages import page, step_page
from ssrics_like.study.participant import Participant
from ssrics_like.study.plan_picture import picture_of
from ssrics_like.study.refused import Refused
from ssrics_like.study.study import Trial

COOKIE = "ssrics_study"
KEPT_S = 60 * 86_400
PER_S, AT_ONCE = 10.0, 100.0
JOINS_PER_S, JOINS_AT_ONCE = 5.0, 200.0
NO_STORE = {"Cache-Control": "no-store"}


class Joining(BaseModel):
    """What the first page sends once somebody has consented.

    Attributes
    ----------
    participant : str or None
        The id that was typed or came with the address.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    participant: Annotated[str, Field(pattern=r"^[A-Za-z0-9._][A-Za-z0-9._@-]{0,63}$")] | None = (
        None
    )


def participant_routes(conduct: Conduct) -> APIRouter:
    """Return the routes that participants use."""
    router = APIRouter()
    study = conduct.study
    rate = RateLimit(PER_S, AT_ONCE)
    joins = RateLimit(JOINS_PER_S, JOINS_AT_ONCE)

    def session(ssrics_study: Annotated[str | None, Cookie()] = None) -> Participant:
        person = conduct.who(ssrics_study)
        if person is None:
            raise Refused(401, "There is no such session; open the study's first page.")
        if not rate.allows(str(person.number)):
            raise Refused(429, "Too many requests at once.")
        return person

    Session = Annotated[Participant, Depends(session)]  # noqa: N806 - it is a type

    @router.get("/", response_class=HTMLResponse)
    def show(ssrics_study: Annotated[str | None, Cookie()] = None) -> HTMLResponse:
        person = conduct.who(ssrics_study)
        if person is None:
            return HTMLResponse(page("welcome", study), headers=NO_STORE)
        steps = len(person.trials)
        text = step_page(study, conduct.trial(person), person.position, steps, person.name)
        return HTMLResponse(text, headers=NO_STORE)

    @router.get("/declined", response_class=HTMLResponse)
    def declined() -> HTMLResponse:
        return HTMLResponse(page("declined", study), headers=NO_STORE)

    @router.post("/api/join")
    def join(
        request: Request, said: Joining, ssrics_study: Annotated[str | None, Cookie()] = None
    ) -> Response:
        answer = JSONResponse({}, headers=NO_STORE)
        if conduct.who(ssrics_study) is not None:  # sent twice: the session goes on
            return answer
        if not joins.allows("all"):
            raise Refused(429, "Too many people begin at once; try again in a minute.")
        answer.set_cookie(
            COOKIE, conduct.join(said.participant), max_age=KEPT_S, path="/", httponly=True,
            samesite="lax", secure=request.url.scheme == "https",
        )  # fmt: skip
        return answer

    @router.post("/api/leave")
    def leave(person: Session) -> Response:
        if not (study.settings.next_participant and person.is_done):
            raise Refused(409, "The study is not done yet.")
        answer = JSONResponse({}, headers=NO_STORE)
        answer.delete_cookie(COOKIE, path="/")
        return answer

    @router.get("/api/state")
    def state(person: Session) -> JSONResponse:
        return JSONResponse(conduct.state(person), headers=NO_STORE)

    @router.post("/api/responses")
    def respond(person: Session, incoming: Incoming) -> JSONResponse:
        after = conduct.take(person, incoming)
        return JSONResponse({"step": after.position}, headers=NO_STORE)

    @router.post("/api/progress")
    def progress(person: Session, said: Progress) -> JSONResponse:
        conduct.progress(person, said)
        return JSONResponse({}, headers=NO_STORE)

    @cache
    def picture(trial: Trial) -> bytes:
        assert trial.building is not None
        return picture_of(trial.building.grid)

    @cache
    def frames(trial: Trial) -> bytes:
        assert trial.building is not None
        assert trial.replay is not None
        packed = frames_of(trial.replay, trial.building.grid).packed()
        return gzip.compress(packed, 6, mtime=0)

    def present(person: Participant, step: int, kind: str) -> Trial:
        trial = conduct.trial(person)
        if trial is None or trial.kind != kind or step != person.position:
            raise Refused(404, "There is nothing of that kind at this step.")
        return trial

    @router.get("/api/plan/{step}")
    def plan(person: Session, step: int) -> Response:
        found = picture(present(person, step, "plan"))
        return Response(found, media_type="image/png", headers=NO_STORE)

    @router.get("/api/walk/{step}")
    def walk(
        person: Session, step: int, accept_encoding: Annotated[str, Header()] = ""
    ) -> Response:
        found = frames(present(person, step, "walk"))
        if "gzip" not in accept_encoding:
            return Response(
                gzip.decompress(found), media_type="application/octet-stream", headers=NO_STORE
            )
        return Response(
            found,
            media_type="application/octet-stream",
            headers={**NO_STORE, "Content-Encoding": "gzip"},
        )

    return router
