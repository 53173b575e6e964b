"""Meshes from arrays and files, and what is refused."""

import numpy as np
import pytest

import hemilux
from scenes import UNIT_SQUARES, room, squares

SQUARE = np.array(UNIT_SQUARES["floor"], dtype=float)


def test_patches_have_the_areas_and_normals_of_their_faces():
    mesh = squares("floor", "wall", max_edge=0.5)
    patches = mesh.patches()
    assert len(mesh) == 8
    assert np.bincount(patches["face"], patches["area"]) == pytest.approx([1, 1])
    assert patches["normal"][patches["face"] == 1] == pytest.approx(np.tile([1, 0, 0], (4, 1)))
    assert patches["centre"].mean(axis=0) == pytest.approx([0.25, 0.5, 0.25])
    assert [mesh.groups[g] for g in patches["group"]] == ["floor"] * 4 + ["wall"] * 4


def test_colours_of_faces_come_back_by_patch():
    patches = room().patches()
    assert patches["reflectance"][2] == pytest.approx([.6, .3, .3])
    assert patches["emission"][:, 0] == pytest.approx([0, 1, 0, 0, 0, 0])
    grey = squares("floor", "wall", reflectance=[.25, .75], emission=[1, 2, 3])
    assert grey.patches()["reflectance"] == pytest.approx(np.repeat([[.25], [.75]], 3, axis=1))
    assert grey.patches()["emission"] == pytest.approx(np.tile([1, 2, 3], (2, 1)))


def test_a_face_may_be_a_concave_polygon_or_a_triangle_among_others():
    vertices = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [1, 2, 0], [0, 2, 0], [5, 0, 0]]
    mesh = hemilux.Mesh(vertices, [[0, 1, 2, 3, 4, 5], [1, 6, 2, -1, -1, -1]])
    patches = mesh.patches()
    assert np.bincount(patches["face"], patches["area"]) == pytest.approx([3, 1.5])


def test_two_sided_faces_have_patches_on_their_backs():
    assert squares("floor", "wall", two_sided=[True, False]).patches()["back"].tolist() == \
        [False, True, False]


@pytest.mark.parametrize("arguments, message", [
    (dict(vertices=SQUARE[:, :2]), r"vertices: expected an array of shape \(n, 3\)"),
    (dict(vertices=np.where(SQUARE == 1, np.nan, SQUARE)), r"vertices\[1, 0\]: expected finite"),
    (dict(vertices=SQUARE.astype(str)), "vertices: expected numbers"),
    (dict(faces=[[0, 1, 2, 4]]), r"faces\[0\]: expected vertices between 0 and 3, found 4"),
    (dict(faces=[[0, -1, 2, 3]]), r"faces\[0\]: expected vertices between 0 and 3, found -1"),
    (dict(faces=[[0, 1, -1, -1]]), r"faces\[0\]: expected vertices between 0 and 3, found -1"),
    (dict(faces=[0, 1, 2]), r"faces: expected an array of shape \(m, k\)"),
    (dict(faces=[[0.0, 1.0, 2.0]]), "faces: expected whole numbers"),
    (dict(faces=[[0, 1, 1]]), "none of the faces has an area"),
    (dict(group=["a", "b"]), "group: expected 1 names"),
    (dict(group=[1.5]), "group: expected names or whole numbers"),
    (dict(reflectance=1.5), "reflectance: expected numbers from 0 to 1, found 1.5"),
    (dict(reflectance=[[.1, .2]]), "reflectance: expected a number, a colour"),
    (dict(emission=-1), "emission: expected numbers of at least 0"),
    (dict(emission=np.inf), "emission.*: expected finite numbers"),
    (dict(two_sided=[True, False]), "two_sided: expected True, False, or 1 of them"),
    (dict(two_sided=1), "two_sided: expected True"),
    (dict(max_edge=-1), "max_edge: expected a length"),
    (dict(max_edge=1e-9), "max-edge"),
    (dict(up="w"), "up: expected 'x', 'y' or 'z'"),
])
def test_what_is_wrong_is_named(arguments, message):
    with pytest.raises(ValueError, match=message):
        hemilux.Mesh(**{"vertices": SQUARE, "faces": [[0, 1, 2, 3]], **arguments})


def test_three_numbers_for_three_faces_are_refused_as_they_mean_two_things():
    with pytest.raises(ValueError, match="may be a colour or greys"):
        squares("floor", "wall", "ceiling", reflectance=[.1, .2, .3])


def test_faces_without_area_are_left_out_with_a_warning():
    with pytest.warns(UserWarning, match="1 of the faces have no area and are left out.* is 1"):
        mesh = hemilux.Mesh(SQUARE, [[0, 1, 2], [0, 1, 1], [0, 2, 3]])
    assert mesh.patches()["face"].tolist() == [0, 2]


def test_large_arrays_of_other_types_and_strides_are_taken():
    wide = np.zeros((4, 6), dtype=np.float32)
    wide[:, ::2] = SQUARE
    mesh = hemilux.Mesh(wide[:, ::2], np.arange(4, dtype=np.uint16)[None])
    assert mesh.patches()["area"] == pytest.approx([1])


def test_read_takes_a_file_and_other_colours(tmp_path):
    path = tmp_path / "square.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng tiles\nf 1 2 3 4\n")
    mesh = hemilux.read(path, reflectance={"*": .25}, emission={"*": [1, 2, 3]})
    assert (mesh.groups, mesh.up, len(mesh)) == (["tiles"], "z", 1)
    assert mesh.patches()["emission"] == pytest.approx(np.array([[1, 2, 3]]))
    assert len(hemilux.read(path, two_sided=True, max_edge=.5)) == 8


def test_the_program_says_what_is_wrong_with_a_file(tmp_path):
    path = tmp_path / "bad.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n")
    with pytest.raises(ValueError, match=r"bad.obj:4: expected a vertex between 1 and 3"):
        hemilux.read(path)
    with pytest.raises(ValueError, match="nowhere.obj"):
        hemilux.read(tmp_path / "nowhere.obj")
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
    with pytest.raises(ValueError, match="lihgt"):
        hemilux.read(path, emission={"lihgt": 1})
    with pytest.raises(ValueError, match="reflectance of '\\*': expected numbers from 0 to 1"):
        hemilux.read(path, reflectance={"*": 2})
