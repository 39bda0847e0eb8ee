"""Meshes of other libraries: the surface is that of their arrays; these libraries need not be there."""

from types import SimpleNamespace

import numpy as np
import pytest

import eigenring

POINTS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
TRIANGLES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def block(kind, data):
    return SimpleNamespace(type=kind, data=np.array(data))


def same(mesh, faces):
    expected = eigenring.Mesh(POINTS, faces)
    assert mesh.vertices.tolist() == POINTS.tolist()
    listed = lambda faces: [list(face) for face in faces]
    assert listed(mesh.faces) == listed(expected.faces) == listed(faces)
    fine = [part.subdivide("catmull-clark", 2).vertices.tolist() for part in (mesh, expected)]
    assert fine[0] == fine[1]


def test_objects_by_their_attributes():
    same(eigenring.Mesh(SimpleNamespace(vertices=POINTS, faces=QUADS)), QUADS)
    # whatever order and width those libraries keep
    same(eigenring.Mesh(SimpleNamespace(vertices=np.asfortranarray(POINTS, dtype=np.float32), faces=QUADS.astype(np.uint32))), QUADS)
    cells = [block("line", [[0, 1]]), block("quad", QUADS[:4]), block("vertex", [[3]]), block("triangle", TRIANGLES[8:])]
    same(eigenring.Mesh(SimpleNamespace(points=POINTS, cells=cells)), [*QUADS[:4].tolist(), *TRIANGLES[8:].tolist()])


def test_a_mesh_of_a_mesh_keeps_its_marks():
    creased = eigenring.Mesh(POINTS, QUADS, creases={(0, 1): 2.0, (1, 3): 2.0})
    again = eigenring.Mesh(creased, corners={7: 5.0})
    both = eigenring.Mesh(POINTS, QUADS, creases={(0, 1): 2.0, (1, 3): 2.0}, corners={7: 5.0})
    fine = [mesh.subdivide("catmull-clark", 2).vertices.tolist() for mesh in (creased, again, both)]
    assert fine[1] == fine[2] != fine[0]


def test_trimesh():
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed")
    given = trimesh.Trimesh(POINTS, TRIANGLES, process=False)
    same(eigenring.Mesh(given), TRIANGLES)
    sphere = trimesh.creation.icosphere(1)
    limit = eigenring.Mesh(sphere).limit_mesh("catmull-clark", 3)
    # and back
    quads = trimesh.Trimesh(limit.vertices, limit.faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3))
    assert quads.is_watertight and quads.volume == pytest.approx(4 * np.pi / 3, rel=0.35)


def test_meshio(tmp_path):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    same(eigenring.Mesh(meshio.Mesh(POINTS, [("quad", QUADS)])), QUADS)
    mixed = [("quad", QUADS[:4]), ("triangle", TRIANGLES[8:])]
    meshio.write(tmp_path / "cube.vtk", meshio.Mesh(POINTS, mixed))
    same(eigenring.Mesh(meshio.read(tmp_path / "cube.vtk")), [*QUADS[:4].tolist(), *TRIANGLES[8:].tolist()])


@pytest.mark.parametrize(
    "given",
    [
        POINTS,
        None,
        3,
        SimpleNamespace(vertices=POINTS),
        SimpleNamespace(vertices=POINTS, faces=None),
        SimpleNamespace(vertices=POINTS[:, :2], faces=QUADS),
        SimpleNamespace(vertices=POINTS * 1j, faces=QUADS),
        SimpleNamespace(vertices=POINTS.astype(str), faces=QUADS),
        SimpleNamespace(vertices=np.full((8, 3), np.inf), faces=QUADS),
        SimpleNamespace(vertices=POINTS, faces=QUADS + 1),
        SimpleNamespace(vertices=POINTS, faces=QUADS.astype(float)),
        SimpleNamespace(points=POINTS, cells=[block("tetra", [[0, 1, 2, 4]])]),
        SimpleNamespace(points=POINTS, cells=3),
        SimpleNamespace(points=POINTS, cells=[3]),
    ],
)
def test_what_is_no_mesh_is_refused(given):
    with pytest.raises(eigenring.Error) as caught:
        eigenring.Mesh(given)
    assert caught.value.accepted
