"""Light that is gathered from a solution, and that of each lamp."""

import os
import subprocess

import numpy as np
import pytest

import hemilux
from scenes import furnace, room

PROGRAM = os.environ.get("HEMILUX_PROGRAM")
SCENE = os.path.join(os.path.dirname(__file__), "../../examples/scenes/cornell_box.obj")


def test_points_in_a_white_furnace_receive_what_it_sends():
    found = hemilux.solve(furnace(reflectance=0.5), steps=2)
    centre = found.points([[0.5, 0.5, 0, 0, 0, 1], [5, 5, 5, 0, 0, 1]], error=0.01)
    assert centre.irradiance[0] == pytest.approx([2, 2, 2], rel=0.05)
    assert centre.is_known.all()
    assert (centre.standard_error[0] < 0.1).all()
    assert centre.rays > 0


def test_points_are_within_their_errors():
    mesh = room(max_edge=.5)
    places = [[0.5, 0.5, 0, 0, 0, 1], [0.2, 0.7, 0, 0, 0, 1], [0.8, 0.3, 0, 0, 0, 1]]
    found = [hemilux.solve(mesh, error=0.01, seed=seed).points(places, 0.01, seed=seed)
             for seed in range(1, 7)]
    light = np.array([points.irradiance for points in found])
    error = np.array([points.standard_error for points in found])
    off = (light - light.mean(axis=0)) / error
    assert np.isfinite(off).all()
    assert np.sqrt((off**2).mean()) < 2
    assert all(0 < points.estimated_error <= points.error_bound for points in found)


@pytest.mark.skipif(not PROGRAM, reason="the program is not named by HEMILUX_PROGRAM")
def test_the_program_gathers_the_same_light(tmp_path):
    points = tmp_path / "points.txt"
    points.write_text("0.3,0,0.3,0,1,0\n0.2,0,0.4,0,1,0\n")
    subprocess.run([PROGRAM, "solve", SCENE, "-q", "--sides", "front", "--steps", "2", "--points",
                    points, "--points-output", tmp_path / "light.csv"], check=True)
    rows = np.genfromtxt(tmp_path / "light.csv", delimiter=",", names=True)
    found = hemilux.solve(hemilux.read(SCENE), steps=2)
    light = found.points([[0.3, 0, 0.3, 0, 1, 0], [0.2, 0, 0.4, 0, 1, 0]])
    assert (light.irradiance[:, 0] == rows["irradiance_r"]).all()
    assert (light.standard_error[:, 2] == rows["stderr_b"]).all()


def test_a_picture_shows_a_furnace_alike_everywhere():
    found = hemilux.solve(furnace(reflectance=0.5), steps=2)
    picture = found.picture([0.5, 0.5, 0.5, 0.5, 0.5, 0, 60, 0, 1, 0], (32, 24))
    assert picture.light.shape == (24, 32, 3)
    assert picture.light == pytest.approx(np.full((24, 32, 3), 2), rel=0.05)
    assert picture.camera[:3] == (0.5, 0.5, 0.5)
    assert picture.estimated_error <= picture.error_bound


def test_a_lightmap_has_places_for_all_faces():
    mesh = furnace(reflectance=0.5)
    lightmap = hemilux.solve(mesh, steps=2).lightmap(64)
    assert lightmap.light.shape == (64, 64, 3)
    assert set(lightmap.face) == set(range(6))
    assert lightmap.places.min() >= 0 and lightmap.places.max() <= 1
    middles = (lightmap.places.mean(axis=1) * 64).astype(int)
    assert lightmap.light[middles[:, 1], middles[:, 0]] == \
        pytest.approx(np.full((len(middles), 3), 2), rel=0.05)


def test_lamps_add_up_to_the_solution():
    found = hemilux.solve(room(max_edge=.5), steps=2)
    lamps = found.lamps()
    assert sum(lamp.radiosity for lamp in lamps) == pytest.approx(found.radiosity)
    with pytest.raises(ValueError, match="only stored-transport"):
        hemilux.solve(room(), "hemisphere", steps=1).lamps()


def test_what_is_wrong_is_named():
    found = hemilux.solve(furnace(reflectance=0.5), steps=1)
    for call, message in [(lambda: found.points([[0, 0, 0]]), "six numbers"),
                          (lambda: found.points([[0, 0, 0, 0, 0, 1]], error=0), "error: expected"),
                          (lambda: found.picture([0, 0, 0]), "camera: expected 6, 7 or 10"),
                          (lambda: found.picture(size=(0, 4)), "size: expected"),
                          (lambda: found.lightmap(2), "size: "),
                          (lambda: found.lamps("room"), "by: expected")]:
        with pytest.raises(ValueError, match=message):
            call()
    with pytest.raises(TypeError, match="unexpected keyword"):
        found.points([[0.5, 0.5, 0, 0, 0, 1]], accuracy=2)
