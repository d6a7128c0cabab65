"""``ssrics schema``: JSON Schemas, for editors that check YAML while it is typed."""

from __future__ import annotations


def schema(kind: str) -> None:
    """Print the JSON Schema of a kind of file.

    For example:

        ssrics schema scenario > scenario.schema.json

    Parameters
    ----------
    kind
        scenario, perception, memory, productions, robot, plan or study.
    """
    import json

    from ssrics_like.scenarios.checking import json_schema
    from ssrics_like.study.settings import StudySettings

    print(json.dumps(json_schema(kind, StudySettings), indent=2))
