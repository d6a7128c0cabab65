"""Secrets: made unguessable, stored as digests, compared in constant time."""

from __future__ import annotations

import hashlib
import hmac
import os
import secrets
from pathlib import Path

from ssrics_like.errors import StudyError

BYTES = 24
TOKEN_MIN = 12
ID_LETTERS = "23456789abcdefghjkmnpqrstuvwxyz"
"""Without those that are taken for others when read aloud or copied."""
ID_LENGTH = 10


def new_token() -> str:
    """Return a token of 192 random bits."""
    return secrets.token_urlsafe(BYTES)


def new_id() -> str:
    """Return an id for a participant: 49 random bits that are easily read."""
    return "p-" + "".join(secrets.choice(ID_LETTERS) for _ in range(ID_LENGTH))


def digest(token: str) -> str:
    """Return what is stored of a token; it cannot be turned back."""
    return hashlib.sha256(token.encode("utf-8", "surrogatepass")).hexdigest()


def same(given: str, wanted: str) -> bool:
    """Tell whether a token is the wanted one, in a time that does not tell how much is right."""
    return hmac.compare_digest(digest(given), digest(wanted))


def kept_token(file: Path) -> str:
    """Return the token that a file keeps; made, readable by its owner only, if it is not there.

    Raises
    ------
    StudyError
        The file cannot be read or written, or holds no token.
    """
    try:
        handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        return _read(file)
    except OSError as e:
        raise StudyError(f"{file}: cannot be written ({e.strerror})") from None
    token = new_token()
    with os.fdopen(handle, "w", encoding="ascii") as opened:
        opened.write(token + "\n")
    return token


def _read(file: Path) -> str:
    try:
        token = file.read_text(encoding="ascii").strip()
    except (OSError, UnicodeDecodeError) as e:
        why = e.strerror if isinstance(e, OSError) else "it is not ASCII"
        raise StudyError(f"{file}: cannot be read ({why})") from None
    if len(token) < TOKEN_MIN:
        raise StudyError(f"{file}: holds no token of {TOKEN_MIN} characters or more; delete it")
    return token
