"""``ssrics map``, used as a user would, mistakes included."""

import shutil

import numpy as np
import pytest
from PIL import Image

from ssrics_like.cli import main
from ssrics_like.library import folder
from ssrics_like.maps import load_building, load_plan
from ssrics_like.world.buildings.plan import build

MAPS = folder("scenarios") / "maps"


def run(capsys, *arguments):
    """Return exit status, standard output and standard error of a command."""
    with pytest.raises(SystemExit) as stopped:
        main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def test_a_plan_is_drawn_beside_itself_or_where_it_is_wanted(capsys, tmp_path):
    plan = tmp_path / "flat.plan.yaml"
    shutil.copy(MAPS / "simple.plan.yaml", plan)
    status, said, complained = run(capsys, "map", "draw", plan)
    assert (status, complained) == (0, "")
    assert said == f"{tmp_path / 'flat.yaml'}: 'Simple map', 18 x 11 m, 3 locations\n"
    run(capsys, "map", "draw", plan, "-o", tmp_path / "deep" / "other.yaml", "--cell", "0.1")
    assert load_building(tmp_path / "deep" / "other.yaml").grid.cells.shape == (110, 180)
    assert run(capsys, "map", "draw", plan, "-o", tmp_path / "deep")[0] == 0
    assert sorted(p.name for p in (tmp_path / "deep").iterdir()) == [
        "flat.png", "flat.yaml", "other.png", "other.yaml",
    ]  # fmt: skip


def test_generated_buildings_are_the_same_for_the_same_seed(capsys, tmp_path):
    def files(name, *arguments):
        status, said, _ = run(capsys, "map", "generate", "-o", tmp_path / name, *arguments)
        assert status == 0
        return said, {p.name: p.read_bytes() for p in sorted((tmp_path / name).iterdir())}

    said, one = files("one", "--seed", "7", "--rooms", "5")
    assert "map.yaml: 'Generated: 5 rooms, hallways" in said
    assert ", seed 7'" in said
    assert sorted(one) == ["map.plan.yaml", "map.png", "map.yaml"]
    assert files("two", "--seed", "7", "--rooms", "5")[1] == one
    _, many = files(
        "many", "--seed", "6", "--count", "2", "--rooms", "5", "--name", "flat",
        "--doorway", "1", "1.1", "--clutter", "0", "--leaves", "0",
    )  # fmt: skip
    assert [name for name in many if name.endswith(".png")] == ["flat-6.png", "flat-7.png"]
    building = load_building(tmp_path / "one" / "map.yaml")
    again = build(load_plan(tmp_path / "one" / "map.plan.yaml"))
    assert np.array_equal(building.grid.cells, again.grid.cells)
    assert building.locations == again.locations


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_a_picture_is_drawn_of_a_map_and_of_a_plan(capsys, tmp_path, ending):
    one, two = tmp_path / f"one.{ending}", tmp_path / f"two.{ending}"
    assert run(capsys, "map", "show", MAPS / "complex.yaml", "-o", one)[0] == 0
    assert run(capsys, "map", "show", MAPS / "complex.plan.yaml", "-o", two)[0] == 0
    assert one.read_bytes() == two.read_bytes()
    if ending == "png":
        with Image.open(one) as picture:
            assert picture.width == 1600
            # Walls, floor, furniture and four kinds of places have colours of their own.
            assert len(picture.convert("RGB").getcolors(1 << 20)) > 7


def test_a_picture_may_show_other_places(capsys, tmp_path):
    (tmp_path / "doors.csv").write_text("id,x_m,y_m\nFRONT,3,3\n")
    out = tmp_path / "a.svg"
    run(
        capsys,
        "map",
        "show",
        MAPS / "simple.yaml",
        "-o",
        out,
        "--locations",
        tmp_path / "doors.csv",
    )
    assert "doorway (1)" in out.read_text()


def test_a_turned_map_and_one_without_places_are_drawn(capsys, tmp_path):
    Image.fromarray(np.full((20, 4), 254, np.uint8)).save(tmp_path / "a.png")
    (tmp_path / "a.yaml").write_text("image: a.png\nresolution: 0.5\norigin: [3, 4, 0.7]\n")
    assert run(capsys, "map", "show", tmp_path / "a.yaml", "-o", tmp_path / "b.png")[0] == 0


def test_maps_and_plans_are_checked(capsys, tmp_path):
    status, said, _ = run(capsys, "check", *sorted(MAPS.glob("*.yaml")))
    assert status == 0
    assert f"{MAPS / 'complex.yaml'}: ok: map, 'Complex map', 24 x 16 m, 12 " in said
    assert f"{MAPS / 'simple.plan.yaml'}: ok: plan, 'Simple map', 18 x 11 m, 3 " in said
    bad = tmp_path / "bad.yaml"
    bad.write_text("image: nope.png\nresolution: -1\n")
    status, _, complained = run(capsys, "check", bad)
    assert status == 1
    assert f"{bad}:1:1: image: {tmp_path / 'nope.png'}: no such file" in complained
    assert f"{bad}:2:1: resolution: -1: expected greater than 0" in complained


def test_the_schema_of_plans_knows_the_keys(capsys):
    status, said, _ = run(capsys, "schema", "plan")
    assert status == 0
    assert '"passages"' in said


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["map", "drw"], 'Did you mean "draw"?'),
        (["map", "draw"], "requires an argument"),
        (["map", "draw", "nope.yaml"], "nope.yaml: no such file"),
        (["map", "draw", "."], ".: is a folder"),
        (["map", "draw", MAPS / "simple.yaml"], "is a map already drawn"),
        (["map", "draw", MAPS / "simple.plan.yaml", "-o", "x.png"], "x.png: expected a name ending in .yaml"),
        (["map", "draw", MAPS / "simple.plan.yaml", "-o", "x.yaml", "--cell", "0"], "cell: 0: expected metres"),
        (["map", "draw", MAPS / "simple.plan.yaml", "-o", "x.yaml", "--cell", "0.001"], "198000000 cells"),
        (["map", "draw", "copy.yaml"], "the map would take the plan's place"),
        (["map", "show", MAPS / "simple.yaml"], "requires an argument"),
        (["map", "show", MAPS / "simple.yaml", "-o", "x.jpg"], "ending in .png, .svg, .pdf"),
        (["map", "show", "nope.yaml", "-o", "x.png"], "nope.yaml: no such file"),
        (["map", "show", "copy.yaml", "-o", "x.png", "--locations", "no.csv"], "no.csv: no such file"),
        (["map", "generate"], "requires an argument"),
        (["map", "generate", "-o", "g", "--rooms", "nine"], "'nine': expected a whole number"),
        (["map", "generate", "-o", "g", "--rooms", "1"], "rooms: 1: expected greater than or equal to 2"),
        (["map", "generate", "-o", "g", "--rooms", "3", "--hallways", "ring"], "expected at least 7"),
        (["map", "generate", "-o", "g", "--hallways", "rign"], "did you mean 'ring'?"),
        (["map", "generate", "-o", "g", "--doorway", "0.5", "1"], "within 0.85 and 1.8"),
        (["map", "generate", "-o", "g", "--clutter", "lots"], "lots"),
        (["map", "generate", "-o", "g", "--count", "0"], "count: expected 1 or more"),
        (["map", "generate", "-o", "g", "--seed", "-1"], "seed: expected 0 or more"),
        (["map", "generate", "-o", "g", "--name", "a/b"], "without a folder"),
        (["map", "generate", "-o", "copy.yaml", "--rooms", "4"], "copy.yaml/map.yaml: cannot be written"),
    ],
)  # fmt: skip
def test_a_users_mistake_is_one_clear_line_and_status_1(
    capsys, tmp_path, monkeypatch, arguments, said
):
    monkeypatch.chdir(tmp_path)
    shutil.copy(MAPS / "simple.plan.yaml", tmp_path / "copy.yaml")
    status, printed, complained = run(capsys, *arguments)
    assert status == 1
    assert printed == ""
    assert len(complained.splitlines()) == 1, complained
    assert said in complained
    assert [p.name for p in tmp_path.iterdir()] == ["copy.yaml"]


def test_a_picture_never_takes_the_place_of_the_maps_own(capsys, tmp_path):
    for name in ("simple.yaml", "simple.png"):
        shutil.copy(MAPS / name, tmp_path / name)
    before = (tmp_path / "simple.png").read_bytes()
    status, _, complained = run(
        capsys, "map", "show", tmp_path / "simple.yaml", "-o", tmp_path / "simple.png"
    )
    assert status == 1
    assert "belongs to the map itself" in complained
    assert (tmp_path / "simple.png").read_bytes() == before
