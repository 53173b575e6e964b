"""View factors against closed forms, the program, and themselves."""

import os
import subprocess

import numpy as np
import pytest
import scipy.sparse

import hemilux
from scenes import PARALLEL, UNIT_SQUARES, boxes, perpendicular, squares

PROGRAM = os.environ.get("HEMILUX_PROGRAM")


def test_parallel_and_perpendicular_squares_have_their_closed_forms():
    found = hemilux.view_factors(squares("floor", "ceiling", "wall"))
    edge = perpendicular(1, 1, 1)
    expected = [[0, PARALLEL, edge], [PARALLEL, 0, edge], [edge, edge, 0]]
    assert found.matrix.toarray() == pytest.approx(np.array(expected), abs=1e-9)
    assert not found.standard_error.data.any()
    assert found.sky[0] == pytest.approx(1 - PARALLEL - edge, abs=1e-9)
    assert (found.name, found.area.tolist()) == (["0", "1", "2"], [1, 1, 1])


@pytest.mark.parametrize("height", [0.5, 1, 3])
def test_the_sky_of_a_street_is_what_its_walls_leave(height):
    w, length = 10, 200
    h = height * w
    vertices = [[x, y, z] for z in (0, h) for y in (0, length) for x in (0, w)]
    mesh = hemilux.Mesh(vertices, [[0, 1, 3, 2], [0, 2, 6, 4], [1, 5, 7, 3]],
                        ["street", "west", "east"])
    found = hemilux.view_factors(mesh, by="group")
    assert found.name == ["street", "west", "east"]
    assert found.sky[0] == pytest.approx(1 - 2 * perpendicular(w, h, length), abs=1e-8)


def test_hidden_factors_keep_to_their_errors_and_to_reciprocity():
    mesh = boxes(3)
    with_other_seed = [hemilux.view_factors(mesh, seed=seed) for seed in (1, 2)]
    a, b = (found.matrix.toarray() for found in with_other_seed)
    error = np.hypot(*(found.standard_error.toarray() for found in with_other_seed))
    sampled = error > 0
    assert sampled.sum() > 50
    assert np.abs((a - b)[sampled] / error[sampled]).max() < 6
    found = with_other_seed[0]
    exchange = found.area[:, None] * a
    assert exchange == pytest.approx(exchange.T, rel=1e-12)
    total = a.sum(axis=1) + found.sky + found.ground + found.back
    assert total == pytest.approx(np.ones(len(found)), abs=1e-9)
    assert found.audit["reciprocity"] < 1e-12
    assert 0 < found.audit["error"] < 0.01


def test_the_number_of_threads_changes_no_byte():
    results = [hemilux.view_factors(boxes(4), threads=threads) for threads in (1, 2)]
    for part in ("data", "indices", "indptr"):
        one, two = (getattr(found.matrix, part).tobytes() for found in results)
        assert one == two
    assert results[0].sky.tobytes() == results[1].sky.tobytes()
    assert results[0].standard_error.data.tobytes() == results[1].standard_error.data.tobytes()


def test_sums_over_groups_are_those_of_the_program():
    groups = np.repeat(["a", "b", "c", "d"], [10, 15, 20, 1])
    mesh = boxes(3, group=groups, max_edge=2)
    grouped = hemilux.view_factors(mesh, by="group")
    summed = hemilux.view_factors(mesh).by(groups)
    assert summed.name == grouped.name
    assert summed.area == pytest.approx(grouped.area)
    for name in ("matrix", "standard_error"):
        assert getattr(summed, name).toarray() == \
            pytest.approx(getattr(grouped, name).toarray(), rel=1e-9)
    for name in ("sky", "ground", "back", "sky_standard_error", "unlisted_bound"):
        assert getattr(summed, name) == pytest.approx(getattr(grouped, name), rel=1e-9)
    with pytest.raises(ValueError, match="ids: expected 46 names"):
        hemilux.view_factors(mesh).by(groups[:-1])


def test_sky_and_ground_are_columns_where_that_is_asked_for():
    mesh = squares("floor", "ceiling")
    found = hemilux.view_factors(mesh, sky=True, ground=True)
    assert found.matrix.shape == (4, 4)
    assert found.matrix[:2, 2].toarray().ravel() == pytest.approx(found.sky)
    assert found.matrix[:2, 3].toarray().ravel() == pytest.approx(found.ground)
    assert found.matrix.nnz == 4 and found.standard_error.nnz == 4
    assert len(found) == 2 and found.by(["x", "x"]).matrix.shape == (3, 3)


@pytest.mark.parametrize("division, first", [(3, "sky 0-30"), ("tregenza", "sky 1")])
def test_bands_of_the_sky_sum_to_it_and_are_columns(tmp_path, division, first):
    found = hemilux.view_factors(squares("floor", "wall"), sky_bands=division, ground=True,
                                 points=[[.5, .5, .2, 0, 0, 1]])
    count = len(found.bands)
    assert count == (145 if division == "tregenza" else division)
    assert next(iter(found.bands)) == first
    for rows in (found, found.points, found.by(["x", "y"])):
        assert np.sum(list(rows.bands.values()), axis=0) == pytest.approx(rows.sky, abs=1e-12)
        assert all((error > 0).all() for error in rows.bands_standard_error.values())
    assert found.matrix.shape == (3 + count, 3 + count)
    assert found.matrix[:2, 2].toarray().ravel() == pytest.approx(found.bands[first])
    found.save(tmp_path / "factors.npz")
    again = hemilux.ViewFactors.load(tmp_path / "factors.npz")
    assert list(again.bands) == list(found.bands)
    assert again.bands[first].tobytes() == found.bands[first].tobytes()
    assert (again.matrix != found.matrix).nnz == 0
    found.save(tmp_path / "factors.npy")
    assert np.load(tmp_path / "factors.npy") == pytest.approx(found.matrix.toarray(), abs=0)
    assert hemilux.view_factors(squares("floor")).bands == {}


@pytest.mark.parametrize("of, asked", [("rows", 0.01), ("largest", 0.05), ("sky", 0.05),
                                       ("pair:20,45", 0.01), ("above:1%", 0.01)])
def test_errors_are_those_of_what_was_asked(of, asked):
    found = hemilux.view_factors(boxes(3), asked, of=of)
    assert 0 < found.audit["error"] <= asked
    assert (found.matrix.nnz == 0) == (of == "sky")


def test_a_file_gives_back_what_was_saved(tmp_path):
    found = hemilux.view_factors(boxes(2), sky=True)
    found.save(tmp_path / "factors.npz")
    again = hemilux.ViewFactors.load(tmp_path / "factors.npz")
    assert (again.matrix != found.matrix).nnz == 0
    assert again.standard_error.data.tobytes() == found.standard_error.data.tobytes()
    assert again.name == found.name and again.audit == found.audit
    for name in ("area", "sky", "ground", "back", "back_standard_error", "unlisted_bound"):
        assert getattr(again, name).tobytes() == getattr(found, name).tobytes()
    assert (scipy.sparse.load_npz(tmp_path / "factors.npz") != found.matrix).nnz == 0
    found.save(tmp_path / "factors.csv")
    rows = np.loadtxt(tmp_path / "factors.csv", delimiter=",", skiprows=1)
    assert len(rows) == found.matrix.nnz
    assert rows[:, 2] == pytest.approx(found.matrix.data, rel=0, abs=0)
    found.save(tmp_path / "factors.npy")
    assert (np.load(tmp_path / "factors.npy") == found.matrix.toarray()).all()
    found.save(tmp_path / "svf.inp.001")
    assert np.loadtxt(tmp_path / "svf.inp.001") == pytest.approx(found.sky, abs=1e-8)
    with pytest.raises(ValueError, match="expected .npz"):
        found.save(tmp_path / "factors.txt")
    for name in ("no/factors.npz", "no/factors.csv"):
        with pytest.raises(OSError):
            found.save(tmp_path / name)


def test_points_have_rows_of_their_own():
    x, y = np.meshgrid([.2, .5], [.3, .5])
    places = np.stack([x, y, 0 * x, 0 * x, 0 * x, 0 * x + 2], -1).reshape(-1, 6)
    found = hemilux.view_factors(squares("ceiling", "wall"), points=places).points
    assert (found.matrix.shape, len(found)) == ((4, 2), 4)
    corner = 0.5 / np.sqrt(1.25)
    assert found.matrix[3, 0] == pytest.approx(4 / np.pi * corner * np.arctan(corner), abs=1e-12)
    total = np.asarray(found.matrix.sum(axis=1)).ravel() + found.sky + found.ground + found.back
    assert total == pytest.approx(np.ones(4), abs=1e-12)
    assert not found.standard_error.data.any() and not found.unlisted_bound.any()
    assert not found.sky_standard_error.any()
    assert hemilux.view_factors(squares("ceiling")).points is None


@pytest.mark.skipif(not PROGRAM, reason="the program is not named by HEMILUX_PROGRAM")
def test_the_program_finds_the_same_bytes(tmp_path):
    corners = np.concatenate(list(UNIT_SQUARES.values()) + [[[.3, .3, .5], [.7, .3, .5],
                                                             [.7, .7, .5], [.3, .7, .5]]])
    (tmp_path / "scene.obj").write_text(
        "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
        + "".join(f"g g{i}\nf {4 * i + 1} {4 * i + 2} {4 * i + 3} {4 * i + 4}\n" for i in range(4)))
    subprocess.run([PROGRAM, "viewfactors", tmp_path / "scene.obj", "-q", "--sky", "--seed", "7",
                    "-o", tmp_path / "factors.npz"], check=True)
    of_program = hemilux.ViewFactors.load(tmp_path / "factors.npz")
    of_array = hemilux.view_factors(hemilux.Mesh(corners, np.arange(16).reshape(4, 4)), sky=True,
                                    seed=7)
    of_file = hemilux.view_factors(hemilux.read(tmp_path / "scene.obj"), sky=True, seed=7)
    for found in (of_array, of_file):
        assert found.matrix.data.tobytes() == of_program.matrix.data.tobytes()
        assert found.standard_error.data.tobytes() == of_program.standard_error.data.tobytes()
        assert found.area.tobytes() == of_program.area.tobytes()
        assert found.sky.tobytes() == of_program.sky.tobytes()
    assert of_program.ground is None


@pytest.mark.skipif(not PROGRAM, reason="the program is not named by HEMILUX_PROGRAM")
def test_bands_of_the_program_are_read_and_points_left_out(tmp_path):
    (tmp_path / "floor.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    (tmp_path / "points.txt").write_text("0.5 0.5 1 0 0 -1\n0.5 0.5 1 1 0 0\n")
    subprocess.run([PROGRAM, "viewfactors", tmp_path / "floor.obj", "-q", "--sky-bands", "3",
                    "--ground", "--points", tmp_path / "points.txt", "-o", tmp_path / "f.npz"],
                   check=True)
    whole = scipy.sparse.load_npz(tmp_path / "f.npz")
    assert whole.shape == (1 + 3 + 1 + 2, 1 + 3 + 1)
    assert np.asarray(whole.sum(axis=1)).ravel() == pytest.approx([1, 0, 0, 0, 0, 1, 1])
    found = hemilux.ViewFactors.load(tmp_path / "f.npz")
    assert found.sky.tolist() == pytest.approx([1]) and found.sky_standard_error is None
    assert found.matrix.shape == (5, 5) and found.ground.tolist() == [0]
    own = hemilux.view_factors(hemilux.read(tmp_path / "floor.obj"), sky_bands=3, ground=True)
    assert list(found.bands) == list(own.bands) == ["sky 0-30", "sky 30-60", "sky 60-90"]
    for key, band in own.bands.items():
        assert found.bands[key].tobytes() == band.tobytes()
        assert found.bands_standard_error[key].tobytes() == own.bands_standard_error[key].tobytes()


def test_an_error_that_is_not_reached_is_reported():
    with pytest.warns(UserWarning, match="the error is .*, where 0.0001 was asked for") as warned:
        hemilux.view_factors(boxes(3), 1e-4)
    assert warned[0].filename == __file__


def test_turned_faces_are_named():
    mesh = squares("floor", "wall")
    turned = hemilux.Mesh([[-99, -99, 1], [99, -99, 1], [99, 99, 1], [-99, 99, 1],
                           *UNIT_SQUARES["floor"]], [[0, 1, 2, 3], [4, 5, 6, 7]])
    assert not hemilux.view_factors(mesh).back.any()
    with pytest.warns(UserWarning, match=r"1 of the surfaces see nothing but backs of faces \('1'\)"):
        assert hemilux.view_factors(turned).back[1] > 0.999


@pytest.mark.parametrize("arguments, message", [
    (dict(error=0), "error: expected a number above 0"),
    (dict(error=float("nan")), "error: expected a number above 0"),
    (dict(of="most"), "of: expected 'above:F'"),
    (dict(of="pair:floor,door"), "no surface is called 'floor'"),
    (dict(by="colour"), "by: expected 'face', 'group', 'material' or 'patch'"),
    (dict(rays=1000), "rays: expected a power of two"),
    (dict(rays=1024.0), "rays: expected a whole number"),
    (dict(threads=-1), "threads: expected a whole number from 0"),
    (dict(seed=-1), "seed: expected a whole number from 0"),
    (dict(time=0), "time: expected a number of seconds above 0"),
    (dict(points=[[0, 0, 0]]), "points: expected rows of six numbers"),
    (dict(points=[[0, 0, 0, 0, 0, 0]]), "points: expected a normal"),
    (dict(sky_bands=91), "sky_bands: expected a whole number from 1 to 90"),
    (dict(sky_bands="reinhart"), "sky_bands: expected a whole number from 1 to 90"),
    (dict(up="w"), "up: expected 'x', 'y' or 'z'"),
])
def test_what_is_wrong_is_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        hemilux.view_factors(squares("floor", "wall"), **arguments)


def test_factors_that_are_cut_short_say_how_exact_they_are():
    whole = hemilux.view_factors(boxes(4), 0.01, time=1000)
    assert whole.matrix.data.tobytes() == hemilux.view_factors(boxes(4), 0.01).matrix.data.tobytes()
    with pytest.warns(UserWarning, match="the error is"):
        cut = hemilux.view_factors(boxes(4), 1e-5, time=1e-3)
    assert cut.audit["error"] > 1e-5
    assert np.asarray(cut.matrix.sum(axis=1)).ravel() + cut.sky + cut.ground + cut.back == \
        pytest.approx(1, abs=1e-12)


def test_sunlit_shares_of_a_floor_below_a_plate():
    plate = [[.25, .25, 1], [.25, .75, 1], [.75, .75, 1], [.75, .25, 1]]
    mesh = hemilux.Mesh(np.concatenate([UNIT_SQUARES["floor"], plate]), [[0, 1, 2, 3], [4, 5, 6, 7]],
                        ["floor", "plate"], two_sided=True)
    suns = [[0, 0, -2], [.5, 0, -1], [0, 0, 1]]
    points = [[.5, .5, 0, 0, 0, 1], [.1, .1, 0, 0, 0, 1]]
    found = hemilux.sunlit(mesh, suns, points=points)
    floor = found.name.index("0")
    assert found.fraction.shape == (3, len(found.name)) and not found.standard_error.any()
    assert found.fraction[:, floor] == pytest.approx([.75, .875, 0], abs=1e-9)
    assert found.points.tolist() == [[0, 1], [1, 1], [0, 0]]
    with pytest.raises(ValueError, match="suns: expected directions that are not 0, 0, 0"):
        hemilux.sunlit(mesh, [[0, 0, 0]])
