"""Every designator, and the whole model, on the same drives: one table and its curves.

An outer layer, as `ssrics_like.scenarios` is.
"""

from ssrics_like.bench.candidates import Candidate, candidate_names, make_candidates
from ssrics_like.bench.courses import Course, course_names, make_courses
from ssrics_like.bench.curves import curves_svg
from ssrics_like.bench.outputs import bench_data, markdown, write_bench
from ssrics_like.bench.running import Bench, Figures, run_bench
from ssrics_like.bench.scoring import Result, score_marks
from ssrics_like.bench.settings import BenchSettings
from ssrics_like.bench.tuned import Tuned, read_tuned, tuned_data
from ssrics_like.bench.tuning import tune_designators

__all__ = [
    "Bench",
    "BenchSettings",
    "Candidate",
    "Course",
    "Figures",
    "Result",
    "Tuned",
    "bench_data",
    "candidate_names",
    "course_names",
    "curves_svg",
    "make_candidates",
    "make_courses",
    "markdown",
    "read_tuned",
    "run_bench",
    "score_marks",
    "tune_designators",
    "tuned_data",
    "write_bench",
]
