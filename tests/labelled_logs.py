"""A labelled log built by hand: a straight drive of 120 m, 0.1 m a scan, and marks on it."""

from pathlib import Path

from results_folders import build

SCANS = 1201
TRUTH = """\
id,kind,confidence,crossed,x_m,y_m,jamb_ax_m,jamb_ay_m,jamb_bx_m,jamb_by_m,note
D1,doorway,sure,1,3.2,0.0,3.2,-0.5,3.2,0.5,
D2,doorway,sure,1,8.0,0.0,8.0,-0.5,8.0,0.5,"wide, a door"
W1,doorway,sure,0,5.0,0.1,4.5,0.6,5.5,0.6,seen in passing
J1,junction,unsure,1,20.0,0.0,,,,,
"""
CROSSINGS = """\
id,scan,t_s
D1,32,3.2
D2,80,8.0
J1,200,20.0
D1,900,90.0
"""


def write_truth(folder: Path, truth: str = TRUTH, crossings: str = CROSSINGS) -> Path:
    """Write the labels. The laser drives along the x axis."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "truth.csv").write_text(truth)
    (folder / "crossings.csv").write_text(crossings)
    poses = "".join(f"{i},{i / 10},{i / 10},0.0,0.0\n" for i in range(SCANS))
    (folder / "poses.csv").write_text("scan,t_s,x_m,y_m,theta_rad\n" + poses)
    return folder


def build_log(folder: Path, **kind) -> Path:
    """Write the results folder: reflex k perceived scan 10 k, so that it is at k metres.

    Reflexes 0 to 5 are declared; 7, 9 and 11 recognised; 6, 8 and 10 dismissed.
    """
    return build(folder, poses=SCANS, laps=2.0, **kind)
