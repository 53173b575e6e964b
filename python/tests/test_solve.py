"""Solutions, comparisons, rays and densities."""

import os
import subprocess
import warnings

import numpy as np
import pytest

import hemilux
from scenes import boxes, furnace, room, squares

PROGRAM = os.environ.get("HEMILUX_PROGRAM")
SCENE = os.path.join(os.path.dirname(__file__), "../../examples/scenes/cornell_box.obj")


def test_a_closed_room_keeps_its_energy():
    found = hemilux.solve(room(max_edge=.5), error=0.01)
    assert found.radiosity.shape == found.standard_error.shape == (24, 3)
    assert 0 < found.estimated_error <= 0.01
    emitted, absorbed = found.energy["emitted"], found.energy["absorbed"]
    assert absorbed == pytest.approx(emitted, rel=0.02)
    assert not found.energy["escaped"].any()
    assert (np.diff(found.steps["rays"].astype(float)) > 0).all()
    assert ("tests of visibility", "nothing stands in a convex enclosure") in \
        [left[:2] for left in hemilux.solve(room(), "matrix", steps=1).left_out]
    assert not hemilux.solve(room(), "matrix", steps=1, keep_all=True).left_out


def test_a_white_furnace_has_the_same_light_everywhere():
    mesh = furnace(reflectance=0.5)
    for method in ("matrix", "stored-transport", "hemisphere", "progressive-monte-carlo"):
        found = hemilux.solve(mesh, method, rays=256, steps=4)
        assert found.radiosity == pytest.approx(np.full((6, 3), 2), rel=0.1)


def test_a_lamp_that_faces_a_wall_is_warned_of():
    faces = [[[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],  # a lamp that looks up, at the next
             [[0, 0, 1.1], [1, 0, 1.1], [1, 1, 1.1], [0, 1, 1.1]],
             [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]
    mesh = hemilux.Mesh(np.concatenate(faces).astype(float), np.arange(12).reshape(-1, 4),
                        emission=[[1, 1, 1], [0, 0, 0], [0, 0, 0]])
    with pytest.warns(UserWarning, match="nothing is lit: .* fell on backs of faces"):
        found = hemilux.solve(mesh, steps=2)
    assert len(found.warnings) == 1 and found.warnings[0].startswith("nothing is lit")


def test_an_error_that_was_not_reached_is_warned_of():
    with pytest.warns(UserWarning, match="before the error of 0.01 % was reached"):
        hemilux.solve(room(max_edge=.5), error=1e-4, max_rays=10000)


def test_a_solution_as_asked_for_has_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not hemilux.solve(room(max_edge=.5), error=0.05).warnings


def test_all_methods_agree_with_the_matrix():
    mesh = room(max_edge=.5)
    reference = hemilux.solve(mesh, "matrix", error=0.002)
    for method in hemilux.methods():
        found = hemilux.solve(mesh, method, rays=256, steps=4, reference=reference)
        assert found.steps["true_error"][-1] < 0.1, method


@pytest.mark.skipif(not PROGRAM, reason="the program is not named by HEMILUX_PROGRAM")
@pytest.mark.parametrize("method", ["stored-transport", "hemisphere", "progressive"])
def test_the_program_finds_the_same_numbers(tmp_path, method):
    subprocess.run([PROGRAM, "solve", SCENE, "-q", "--sides", "front", "--method", method, "--steps",
                    "2", "--seed", "3", "-o", tmp_path / "light.csv"], check=True)
    rows = np.genfromtxt(tmp_path / "light.csv", delimiter=",", names=True)
    found = hemilux.solve(hemilux.read(SCENE), method, steps=2, seed=3)
    for name, values in (("radiosity", found.radiosity), ("stderr", found.standard_error)):
        table = np.stack([rows[f"{name}_{channel}"] for channel in "rgb"], axis=1)
        assert (values == table).all()


def test_the_number_of_threads_changes_no_byte():
    one, two = (hemilux.solve(room(max_edge=.25), "hemisphere", steps=3, threads=threads)
                for threads in (1, 2))
    assert one.radiosity.tobytes() == two.radiosity.tobytes()
    assert one.standard_error.tobytes() == two.standard_error.tobytes()


@pytest.mark.parametrize("arguments, error, message", [
    (dict(method="hemispere"), ValueError, "unknown method 'hemispere'; did you mean 'hemisphere'"),
    (dict(error=-1), ValueError, "error: expected a number above 0"),
    (dict(error="1%"), ValueError, "error: '1%' is not a number of the right kind"),
    (dict(steps=0), ValueError, "steps: expected a number"),
    (dict(steps=1.5), ValueError, "steps: 1.5 is not"),
    (dict(rays=0), ValueError, "rays: expected a number"),
    (dict(depth=6), ValueError, "depth: expected a whole number from 0 to 5"),
    (dict(method="matrix", literal=True), ValueError, "matrix has no printed rules"),
    (dict(rings=4), ValueError, "stored-transport has no option --rings"),
    (dict(reference=np.zeros((2, 3))), ValueError, "reference: expected a row for each of 6"),
    (dict(reference=np.zeros((6, 2))), ValueError, r"reference: expected an array of shape \(n, 3\)"),
])
def test_what_is_wrong_is_named(arguments, error, message):
    with pytest.raises(error, match=message):
        hemilux.solve(room(), **arguments)


def test_a_scene_without_light_is_refused():
    with pytest.raises(ValueError, match="nothing emits light"):
        hemilux.solve(squares("floor", "wall"))


def test_light_without_bounds_is_refused():
    with pytest.raises(ValueError, match="Mesh: "):
        hemilux.solve(furnace(reflectance=1))


def test_methods_are_compared_with_a_reference():
    found = hemilux.compare(room(max_edge=.5), ["hemisphere", "progressive-monte-carlo"],
                            max_rays=20_000, runs=2)
    assert [row["method"] for row in found.summary] == ["hemisphere", "progressive-monte-carlo"]
    for row in found.summary:
        assert row["runs"] == 2 and 15_000 < row["rays"] < 25_000 and 0 < row["true_error"] < 0.2
    rays, error = (found.of("hemisphere", name) for name in ("rays", "true_error"))
    assert len(rays) > 3 and (np.diff(rays.astype(float)) > 0).all() and error[-1] < error[0]
    again = hemilux.compare(room(max_edge=.5), ["hemisphere"], max_rays=20_000, runs=1,
                            reference=found.reference)
    assert again.rows["true_error"].tobytes() == error.tobytes()
    for arguments, message in ((dict(methods="hemisphere"), "a list of names"),
                               (dict(methods=[]), "a name at least"),
                               (dict(methods=["matrix"], runs=0), "runs"),
                               (dict(methods=["matrix"], max_rays=1, seconds=1), "one of the two")):
        with pytest.raises(ValueError, match=message):
            hemilux.compare(room(), **arguments)


def test_rays_meet_what_lies_before_them():
    tracer = hemilux.rays(squares("floor", "ceiling"))
    hits = tracer.closest([[.5, .5, .25], [.5, .5, .25], [.5, .5, 2], [.5, .5, -1]],
                          [[0, 0, -2], [0, 0, .1], [0, 0, 1], [0, 0, 1]])
    assert hits.face.tolist() == [0, 1, -1, 0] and hits.patch.tolist() == [0, 1, -1, -1]
    assert hits.distance == pytest.approx([.25, .75, np.inf, 1])
    assert hits.front.tolist() == [True, True, False, False]
    assert tracer.count([[.5, .5, -1], [.5, .5, .5], [3, 3, 3]], [[0, 0, 1]] * 3).tolist() == [2, 1, 0]
    for origins, directions, message in (([[0, 0, 0]], [[0, 0, 0]], "length 0"),
                                         ([[0, 0, 0]], [[0, 0, np.nan]], "finite"),
                                         ([[0, 0, 0]] * 2, [[0, 0, 1]], "as many of both"),
                                         ([0, 0, 0], [0, 0, 1], "shape")):
        with pytest.raises(ValueError, match=message):
            tracer.closest(origins, directions)


def test_rays_by_lamberts_law_give_the_view_factors():
    mesh = boxes(3)
    random = np.random.default_rng(1)
    n = 20_000
    ground = len(mesh) - 1
    starts = np.column_stack([random.uniform(-1, 6, (n, 2)), np.zeros(n)])
    angle, r = 2 * np.pi * random.random(n), np.sqrt(random.random(n))
    ways = np.column_stack([r * np.cos(angle), r * np.sin(angle), np.sqrt(1 - r * r)])
    hits = hemilux.rays(mesh).closest(starts, ways)
    outside = hemilux.rays(mesh).closest(starts + [0, 0, 20], np.tile([0., 0, -1], (n, 1))).face == ground
    share = (hits.face < 0).sum() / n
    found = hemilux.view_factors(mesh)
    # Under boxes nothing is seen but their open bottoms and backs.
    assert share == pytest.approx(found.sky[ground], abs=5 * .5 / np.sqrt(n))
    assert outside.mean() == pytest.approx(1 - 9 / 49, abs=0.02)


def test_a_hemisphere_is_divided_by_what_is_there():
    mesh = squares("floor", "ceiling", "wall")
    found = hemilux.density(mesh, 0)
    assert found.solid_angle.sum() == pytest.approx(2 * np.pi)
    assert found.power_share.sum() == pytest.approx(1)
    assert found.triangles.shape == (len(found.density), 3, 3)
    assert np.linalg.norm(found.triangles, axis=2) == pytest.approx(np.ones((len(found.density), 3)))
    assert found.bytes == len(found.directions) <= 41
    assert (found.directions[:, 2] > -1e-12).all()
    counted = hemilux.rays(mesh).count(np.tile([.5, .5, 1e-9], (found.bytes, 1)), found.directions)
    up = found.directions[:, 2] > 1e-3
    assert (counted[up] == found.surfaces[up]).all()
    assert len(hemilux.density(mesh, 0, threshold=255).density) == 4
    for arguments, message in ((dict(patch=3), "no patch 3"), (dict(patch=-1), "whole number"),
                               (dict(patch=0, depth=9), "depth"),
                               (dict(patch=0, threshold=-1), "threshold")):
        with pytest.raises(ValueError, match=message):
            hemilux.density(mesh, **arguments)
