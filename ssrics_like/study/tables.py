"""The tables of a study's database."""

from __future__ import annotations

from sqlalchemy import (
    Column,
    Float,
    ForeignKey,
    Integer,
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
)

VERSION = 1

metadata = MetaData()

study = Table(
    "ssrics_study",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("version", Integer, nullable=False),
    Column("title", Text, nullable=False),
    Column("outline", Text, nullable=False),
)
"""One row: which study the answers belong to."""

participants = Table(
    "ssrics_participants",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("name", String(200), nullable=False, unique=True),
    Column("token", String(64), nullable=False, unique=True),
    Column("trials", Text, nullable=False),
    Column("position", Integer, nullable=False),
    Column("replay_ms", Float, nullable=False),
    Column("began", String(40), nullable=False),
    Column("finished", String(40), nullable=False),
)
"""One row a participant; `token` is a digest, `trials` is JSON in the order that they are met."""

responses = Table(
    "ssrics_responses",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("participant", ForeignKey(participants.c.id), nullable=False, index=True),
    Column("key", String(64), nullable=False),
    Column("trial", String(40), nullable=False),
    Column("kind", String(20), nullable=False),
    Column("position", Integer, nullable=False),
    Column("event", String(20), nullable=False),
    Column("mark", String(64), nullable=False),
    Column("x_m", Float),
    Column("y_m", Float),
    Column("label", Text, nullable=False),
    Column("pressed", String(1), nullable=False),
    Column("t_ms", Float, nullable=False),
    Column("replay_ms", Float),
    Column("client_ms", Float, nullable=False),
    Column("server_time", String(40), nullable=False),
    UniqueConstraint("participant", "key"),
)
"""One row a response, never changed: what stands at the end is worked out from all of them."""
