"""``ssrics study``: people's choices of landmarks, collected on a web page."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.cli.options import Columns, Flag, NeededOut, Out, Pair, Trials, Whole

DATABASE = ".sqlite"
BESIDE = ".token"  # ending of the file that keeps the admin token
PORT_MAX = 65_535
OPEN = (
    "ssrics: warning: {host} can be reached from other machines, over plain HTTP; put a server "
    "with TLS before it outside of a network that you trust"
)


def new(name: str, *, out: Out = None) -> None:
    """Write a study to start from: an example with comments.

    For example:

        ssrics study new my-study

    Parameters
    ----------
    name
        What it is called; the file is NAME.yaml.
    out
        Folder to write it to; here if left out.
    """
    from ssrics_like.errors import StudyError
    from ssrics_like.scenarios.schema import NAME
    from ssrics_like.study.reading import study_file

    stem = name.removesuffix(".yaml")
    if not NAME.fullmatch(stem):
        raise StudyError(f"'{name}': expected a name of letters, digits, dots and dashes")
    path = (out or Path()) / f"{stem}.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(study_file("complex").read_text(encoding="utf-8"))
    except FileExistsError:
        raise StudyError(f"{path}: is there already") from None
    print(f"{path}: change it, then: ssrics study serve {path}")


def serve(
    study: str,
    *,
    database: str | None = None,
    host: str = "127.0.0.1",
    port: Whole = 8000,
    admin_token: str | None = None,
) -> None:
    """Serve a study: the page on which people mark landmarks. Ctrl-C ends it; nothing is lost.

    For example:

        ssrics study serve complex
        ssrics study serve my-study.yaml --host 0.0.0.0 --port 8080
        ssrics study serve my-study.yaml --database postgresql://user@host/study

    Parameters
    ----------
    study
        A study file, or an entry of scenarios/studies.
    database
        SQLite file or SQLAlchemy URL of the answers; STUDY.sqlite in this folder if left out.
    host
        Address to bind to. Only this machine reaches 127.0.0.1.
    port
        Of the address; 0 for any that is free.
    admin_token
        Opens the experimenter's page. Made and kept in a file beside the database if left out.
    """
    import sys

    from ssrics_like.errors import StudyError
    from ssrics_like.study.packages import needed
    from ssrics_like.study.reading import read_study, study_file
    from ssrics_like.study.tokens import TOKEN_MIN

    for package in ("fastapi", "uvicorn", "sqlalchemy", "markdown_it"):
        needed(package)
    from ssrics_like.study.app import make_app
    from ssrics_like.study.conduct import Conduct
    from ssrics_like.study.serving import address_of, bound, is_loopback, until_interrupted
    from ssrics_like.study.serving import serve as serve_app
    from ssrics_like.study.store import Store

    if not 0 <= port <= PORT_MAX:
        raise StudyError(f"--port {port}: expected 0 to {PORT_MAX}")
    if admin_token is not None and not (len(admin_token) >= TOKEN_MIN and admin_token.isascii()):
        raise StudyError(f"--admin-token: expected {TOKEN_MIN} or more ASCII characters")
    path = study_file(study)
    content = read_study(path)
    name = database or path.stem + DATABASE
    listening = bound(host, port)
    try:
        store = Store(name)
        try:
            conduct = Conduct(content, store)
            token = admin_token or _token_beside(name, path)
            app = make_app(conduct, token)
            with until_interrupted():
                address = address_of(listening, host)
                suffix = "?pid=ID" if content.settings.participant == "url" else ""
                print(f"participants: {address}{suffix}")
                print(f"experimenter: {address}admin#token={token}")
                print(f"answers:      {store.name}", flush=True)
                if not is_loopback(host):
                    print(OPEN.format(host=host), file=sys.stderr)
                serve_app(app, listening)
        finally:
            store.close()
    finally:
        listening.close()


def export(answers: str, *, out: NeededOut, trial: Trials = (), finished: Flag = False) -> None:
    """Write what was answered as tables: choices.csv, responses.csv, participants.csv.

    For example:

        ssrics study export complex -o answers/
        ssrics study export my-study.sqlite -o answers/ --trial walk
        ssrics compare out/complex answers/choices.csv

    Parameters
    ----------
    answers
        The database, as --database of serve; or the study, for the database that it has by default.
    out
        Folder for the tables; made if it is not there.
    trial
        Only the choices of this trial; may be given several times.
    finished
        Only people who did the whole study.
    """
    from ssrics_like.errors import StudyError
    from ssrics_like.results.counts import counted
    from ssrics_like.results.files import write_atomically
    from ssrics_like.study.packages import needed

    needed("sqlalchemy")
    from ssrics_like.study.export import outdated, read_answers, tables_of
    from ssrics_like.study.records import Records

    records = Records(_database_of(answers))
    try:
        with records.complaining():
            found = read_answers(records)
    finally:
        records.close()
    if finished:
        found = found.of_finished()
    tables = tables_of(found, trial)
    if out.exists() and not out.is_dir():
        raise StudyError(f"{out}: is a file, expected a folder")
    out.mkdir(parents=True, exist_ok=True)
    for name in outdated(found, tables):
        (out / name).unlink(missing_ok=True)
    for name, text in tables.items():
        write_atomically(out / name, text)
    people, done = len(found.participants), sum(p.is_done for p in found.participants)
    said = counted(people, "participant"), counted(len(found.responses), "response")
    print(f"{out}: {said[0]}, {done} finished, {said[1]}")
    for name, text in tables.items():
        print(f"{out / name}: {counted(_rows(text), 'row')}")
    if "choices.csv" not in tables:
        print("no choices.csv: the trials are on different maps; choose with --trial")


def import_choices(
    file: Path,
    *,
    columns: Columns,
    out: NeededOut,
    scale: Pair = (1.0, 1.0),
    offset: Pair = (0.0, 0.0),
    map: str | None = None,  # noqa: A002 - it is the option's name
    milliseconds: bool = False,
) -> None:
    """Make a table of choices from one that PsychoPy, jsPsych or another program wrote.

    For example:

        ssrics study import clicks.csv --columns participant=pid,x_m=x,y_m=y -o choices.csv
        ssrics study import clicks.csv --columns participant=pid,x_m=px,y_m=py \
            --map complex -o choices.csv

    Parameters
    ----------
    file
        CSV with a header. Rows without a place are passed over.
    columns
        Which column is which: participant, x_m and y_m, and if there are such landmark, label, t_s.
    out
        The table of choices.
    scale
        Metres for one unit of the table in x and y; negative where its axis runs the other way.
    offset
        Where its zero lies in the frame of the map, metres.
    map
        A map: places are pixels of its picture, counted from the top left.
    milliseconds
        Times of the table are milliseconds, not seconds.
    """
    import math

    from ssrics_like.errors import StudyError
    from ssrics_like.results.counts import counted
    from ssrics_like.results.files import write_atomically
    from ssrics_like.study.importing import Units, imported, read_mapping

    if not all(math.isfinite(number) for number in (*scale, *offset)):
        raise StudyError("--scale, --offset: expected finite numbers")
    if 0.0 in scale:
        raise StudyError("--scale: 0 would put everybody in one place")
    mapping = read_mapping(columns)
    if out.exists() and file.exists() and out.samefile(file):
        raise StudyError(f"{out}: is the table itself; name another file")
    if out.is_dir():
        raise StudyError(f"{out}: is a folder, expected a file")
    pixels = None
    if map is not None:
        from ssrics_like.maps import load_building
        from ssrics_like.study.reading import map_file

        if scale != (1.0, 1.0) or offset != (0.0, 0.0):
            raise StudyError("--map says what a pixel is; --scale and --offset do not go with it")
        pixels = load_building(map_file(map)).grid
    units = Units(*scale, *offset, scale_t=0.001 if milliseconds else 1.0)
    text = imported(file, mapping, units, pixels)
    write_atomically(out, text)
    print(f"{out}: {counted(_rows(text), 'choice')}")


def _rows(table: str) -> int:
    """Count the rows of a table below its header; a cell may hold several lines."""
    import csv
    import io

    return sum(1 for _ in csv.reader(io.StringIO(table, newline=""))) - 1


def _token_beside(database: str, study: Path) -> str:
    """Return the token that is kept beside the database; here, if that is on a server."""
    from ssrics_like.study.database import is_url
    from ssrics_like.study.tokens import kept_token

    return kept_token(Path(study.stem + BESIDE if is_url(database) else database + BESIDE))


def _database_of(answers: str) -> str:
    """Return the database that is meant: a URL, a file, or that of a study."""
    from ssrics_like import library
    from ssrics_like.errors import StudyError
    from ssrics_like.study.database import is_url
    from ssrics_like.study.reading import study_file

    if is_url(answers):
        return answers
    path = Path(answers)
    if not path.is_file() or path.suffix in library.SUFFIXES:
        if path.suffix not in (*library.SUFFIXES, ""):
            raise StudyError(f"{path}: {'is a folder' if path.is_dir() else 'no such file'}")
        path = Path(study_file(answers).stem + DATABASE)
        if not path.is_file():
            raise StudyError(f"{path}: no such file; name the database that serve was given")
    return str(path)
