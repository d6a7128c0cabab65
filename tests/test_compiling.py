"""Importing is quick, and the kernels work where nothing can be cached."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import ssrics_like
import ssrics_like.perception


def python(code, folder, **environment):
    """Run `code` in `folder`, from where it imports first."""
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_importing_perception_does_not_import_numba():
    done = python(
        "import sys, ssrics_like.perception as p; p.PerceptionProfile();"
        "print([m for m in sys.modules if m.split('.')[0] in ('numba', 'llvmlite', 'scipy')])",
        Path(ssrics_like.__file__).parents[1],
    )
    assert (done.stdout, done.stderr) == ("[]\n", "")


def test_kernels_run_where_no_cache_can_be_written(tmp_path):
    package = tmp_path / "ssrics_like"
    shutil.copytree(
        Path(ssrics_like.__file__).parent, package, ignore=shutil.ignore_patterns("__pycache__")
    )
    # A file in the place of the cache folder stops even the superuser.
    (package / "perception" / "__pycache__").write_text("")
    nowhere = "/dev/null/none"
    done = python(
        "import ssrics_like; from ssrics_like.perception import condition;"
        "print(ssrics_like.__file__, condition([1, 0, 1], 8, 3).ranges_m.tolist())",
        tmp_path,
        PYTHONDONTWRITEBYTECODE="1",
        HOME=nowhere,
        XDG_CACHE_HOME=nowhere,
        NUMBA_CACHE_DIR="",
    )
    found = package / "__init__.py"
    assert (done.stdout, done.stderr) == (f"{found} [1.0, 1.0, 1.0]\n", "")


def test_public_names_are_there():
    for name in ssrics_like.perception.__all__:
        assert hasattr(ssrics_like.perception, name)
    assert ssrics_like.perception.__all__ == sorted(ssrics_like.perception.__all__)
