"""Imports point inward only, and foreign engines are touched where that is said."""

import ast
from pathlib import Path

PACKAGE = Path(__file__).parents[1] / "ssrics_like"
MIND = ("perception", "productions", "memory")
INNER = {  # layer -> the layers of the package that it may use, itself aside
    "compiling": set(),
    "atomic": set(),
    "poses": set(),
    "workers": {"errors"},
    "perception": {"errors", "compiling", "poses"},
    "world": {"errors", "compiling", "perception"},
    "designators": {"errors", "settings", "perception"},
    "maps": {"errors", "settings", "atomic", "world"},
    "memory": {"errors", "compiling", "poses"},
    "productions": {"errors", "library", "settings"},
    "sources": {"errors", "perception"},
    "arriving": {"perception", "memory"},
    "expecting": {"perception", "memory", "poses"},
    "modules": {"errors", "arriving", "decision", "expecting", "poses", *MIND},
    "cues": {"errors", "atomic", "perception"},
    "wayfinding": {"errors", "modules", "poses", *MIND},
    "model": {"errors", "cues", "library", "decision", "modules", "wayfinding", *MIND},
    "results": {"errors", "atomic", "decision", "model", *MIND},
    "comparison": {"errors", "results", "world", "maps"},
    "people": {"errors", "results", "world", "maps", "comparison"},
    "bench": {
        "errors",
        "settings",
        "library",
        "decision",
        "model",
        "perception",
        "world",
        "maps",
        "sources",
        "comparison",
        "designators",
        "results",
        "report",
        "scenarios",
        "training",
        "workers",
    },
    "study": {"errors", "settings", "library", "results", "scenarios", "maps", "world"},
    "training": {"errors", "workers", "perception", "world", "comparison", "scenarios"},
    "scenarios": {
        "errors",
        "library",
        "settings",
        "cues",
        "model",
        "wayfinding",
        "results",
        "sources",
        "world",
        "maps",
        "comparison",
        "workers",
        *MIND,
    },
    "report": {"errors", "memory", "results", "comparison", "people", "maps", "world"},
    "viewer": {
        "errors",
        "perception",
        "productions",
        "memory",
        "results",
        "comparison",
        "report",
        "sources",
        "world",
    },
}


def imports(path):
    """Names of the modules that a file imports, anywhere in it."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            yield node.module
            if node.module == "ssrics_like":
                yield from (f"ssrics_like.{alias.name}" for alias in node.names)


def layer(path):
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def test_imports_point_inward_only():
    for path in PACKAGE.rglob("*.py"):
        allowed = INNER.get(layer(path))
        if allowed is None:
            continue
        for name in imports(path):
            parts = name.split(".")
            if parts[0] == "ssrics_like" and len(parts) > 1 and parts[1] != layer(path):
                assert parts[1] in allowed, f"{path.relative_to(PACKAGE)} imports {name}"


def test_each_foreign_engine_has_its_own_files():
    homes = {
        "numba": {"compiling.py"},
        "pyactr": {"productions/engine.py", "productions/buffers.py"},
        "networkx": {"memory/topological.py", "memory/store.py"},
        "cyclopts": {"cli/__init__.py", "cli/options.py"},
        "sqlalchemy": {
            "study/records.py",
            "study/tables.py",
            "study/database.py",
            "study/store.py",
            "study/app.py",
        },
        "fastapi": {"study/app.py", "study/routes.py", "study/admin.py", "study/serving.py"},
    }
    for path in PACKAGE.rglob("*.py"):
        here = str(path.relative_to(PACKAGE))
        for name in imports(path):
            top = name.split(".")[0]
            if top in homes:
                assert here in homes[top], f"{here} imports {name}"


def test_the_mind_prints_nothing_and_opens_no_files():
    for kind in ("perception", "memory", "world"):
        for path in (PACKAGE / kind).rglob("*.py"):
            calls = {
                node.func.id
                for node in ast.walk(ast.parse(path.read_text()))
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
            }
            assert not calls & {"print", "open", "input"}, path.name
