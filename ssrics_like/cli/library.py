"""``ssrics list`` and ``ssrics show``: what the library holds."""

from __future__ import annotations


def list_entries(kind: str | None = None) -> None:
    """List the entries of the library, with their titles.

    For example:

        ssrics list
        ssrics list productions

    Parameters
    ----------
    kind
        Only one kind: productions, perception, memory, scenarios, robots or studies.
    """
    from ssrics_like import library, settings

    kinds = (kind,) if kind else library.KINDS
    for name in kinds:
        found = library.entries(name)
        width = max(map(len, found), default=0)
        print(f"{name}/")
        for entry, path in found.items():
            title = settings.read_document(path).data.get("title", "")
            print(f"  {entry:<{width}}  {title}")


def show(kind: str, name: str) -> None:
    """Print an entry of the library.

    For example:

        ssrics show productions landmark
        ssrics show memory act-r > mine.yaml

    Parameters
    ----------
    kind
        productions, perception, memory, scenarios, robots or studies.
    name
        The entry.
    """
    from ssrics_like import library

    path = library.find(kind, name)
    print(f"# from the library of ssrics: {kind}/{path.name}")
    print(path.read_text(encoding="utf-8"), end="")
