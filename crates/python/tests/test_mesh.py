"""Meshes and surfaces: the command on the same file, closed forms, and what is refused."""

import numpy as np
import pytest

import eigenring

CUBE = (
    [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
)
TURNS = np.arange(5) * (2 * np.pi / 5)
SPOKES = np.stack([np.cos(TURNS), np.sin(TURNS), 0 * TURNS], axis=1)
FAN = (
    np.concatenate([np.zeros((1, 3)), SPOKES, SPOKES + np.roll(SPOKES, -1, axis=0)]),
    [[0, 1 + k, 6 + k, 1 + (k + 1) % 5] for k in range(5)],
)
SQUARE = ([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])


@pytest.fixture
def cube(tmp_path):
    mesh = eigenring.Mesh(*CUBE)
    mesh.write(tmp_path / "cube.obj")
    return mesh, str(tmp_path / "cube.obj")


@pytest.mark.parametrize("spec", ["catmull-clark", "doo-sabin", "lambda:optimal"])
def test_refined_meshes_are_those_of_the_command(command, cube, spec):
    mesh, path = cube
    printed = command("subdivide", path, "--scheme", spec, "--levels", "2", "--format", "json")
    refined = mesh.subdivide(spec, 2)
    assert len(refined.vertices) == printed["vertices"] and len(refined.faces) == printed["faces"]
    assert refined.vertices.min(axis=0).tolist() == printed["bounds"][0]
    assert np.allclose(refined.vertices.sum(axis=0), printed["position_sum"], atol=1e-12)


def test_limit_points_are_those_of_the_command(command, cube):
    mesh, path = cube
    printed = command("limit", path, "--scheme", "catmull-clark", "--per-face", "3", "--derivatives", "2", "--format", "json")
    rows = printed["points"] if isinstance(printed, dict) else printed
    take = lambda *names: np.array([[row[name] for name in names] for row in rows])
    faces = take("face")[:, 0].astype(int)
    found = mesh.limit("catmull-clark", faces, take("s")[:, 0].copy(), take("t")[:, 0].copy())
    assert found.points.tolist() == take("x", "y", "z").tolist()
    assert found.first.reshape(-1, 6).tolist() == take("xs", "ys", "zs", "xt", "yt", "zt").tolist()
    assert found.normals.tolist() == take("nx", "ny", "nz").tolist()
    assert found.gauss.tolist() == take("gauss")[:, 0].tolist()


def test_curvature_is_that_of_the_command(command, cube):
    mesh, path = cube
    printed = command("curvature", path, "--scheme", "catmull-clark", "--format", "json")
    assert mesh.curvature("catmull-clark") == printed
    assert printed["total_gauss"] == pytest.approx(4 * np.pi, rel=1e-3)


def test_the_limit_mesh_is_where_refinement_goes():
    """The oracle is subdivision itself: a fine mesh lies near the surface."""
    limit = eigenring.Mesh(*CUBE).limit_mesh("catmull-clark", 4)
    assert limit.faces.shape == (6 * 16, 4)
    fine = eigenring.Mesh(*CUBE).subdivide("catmull-clark", 5).vertices
    distances = np.linalg.norm(limit.vertices[:, None] - fine[None], axis=2).min(axis=1)
    assert distances.max() < 0.02


def test_marks_change_the_surface():
    edges = {tuple(sorted((face[i], face[i - 1]))): np.inf for face in CUBE[1] for i in range(4)}
    sharp = eigenring.Mesh(*CUBE, creases=edges).subdivide("catmull-clark", 3).vertices
    assert abs(abs(sharp).max() - 1) < 1e-15
    assert abs(eigenring.Mesh(*CUBE).subdivide("catmull-clark", 3).vertices).max() < 0.9


def test_numpy_faces_of_any_integers():
    for kind in (np.int32, np.int64, np.uint8):
        faces = np.array(CUBE[1], dtype=kind)
        assert eigenring.Mesh(np.array(CUBE[0], dtype=float), faces).faces.tolist() == CUBE[1]


def test_pictures(cube):
    picture = cube[0].render("catmull-clark", "highlight", size=64)
    assert picture.png() == picture._repr_png_() and picture.png()[1:4] == b"PNG"
    [figure] = eigenring.figure("characteristic-map", schemes=["catmull-clark"], valences=[5])
    assert figure._repr_svg_() == figure.svg()
    assert all(len(column) for table in figure.data().values() for column in table.values())


@pytest.mark.parametrize(
    "call",
    [
        lambda: eigenring.Mesh(np.zeros((4, 2)), SQUARE[1]),
        lambda: eigenring.Mesh(np.zeros((4, 3), dtype=np.float32), SQUARE[1]),
        lambda: eigenring.Mesh(np.zeros((3, 4)).T[:, :3], SQUARE[1]),
        lambda: eigenring.Mesh(np.full((4, 3), np.inf), SQUARE[1]),
        lambda: eigenring.Mesh([["a"]], SQUARE[1]),
        lambda: eigenring.Mesh(SQUARE[0], [[0, 1, 2, 4]]),
        lambda: eigenring.Mesh(SQUARE[0], [[0, 1, 2, -1]]),
        lambda: eigenring.Mesh(SQUARE[0], [[0, 1, 2.0, 3]]),
        lambda: eigenring.Mesh(SQUARE[0], np.zeros((1, 4))),
        lambda: eigenring.Mesh(SQUARE[0], [[0, 1, 1, 2]]),
        lambda: eigenring.Mesh(SQUARE[0], 3),
        lambda: eigenring.Mesh(*SQUARE, creases={(0, 1): float("nan")}),
        lambda: eigenring.Mesh(*SQUARE, creases={(0, 2): 1.0}),
        lambda: eigenring.Mesh(*SQUARE, boundary="round"),
        lambda: eigenring.Mesh(*SQUARE).subdivide("catmull-clark", 40),
        lambda: eigenring.Mesh(*SQUARE).subdivide("catmul"),
        lambda: eigenring.Mesh(*SQUARE).limit("catmull-clark", 1, 0.5, 0.5),
        lambda: eigenring.Mesh(*SQUARE).limit("catmull-clark", 0, 1.5, 0.5),
        lambda: eigenring.Mesh(*SQUARE).limit("catmull-clark", 0, float("nan"), 0.5),
        lambda: eigenring.Mesh(*SQUARE).limit("catmull-clark", 0, [0.5, 0.5], [0.5]),
        lambda: eigenring.Mesh(*SQUARE).limit("catmull-clark", 0, np.zeros(4)[::2], np.zeros(2)),
        lambda: eigenring.Mesh(*SQUARE).limit_mesh("catmull-clark", 10**9),
        lambda: eigenring.Mesh(*SQUARE).curvature("catmull-clark", per_face=0),
        lambda: eigenring.Mesh(*SQUARE).render("catmull-clark", "art"),
        lambda: eigenring.Mesh(*SQUARE).render("catmull-clark", size=10**6),
        lambda: eigenring.Mesh.read("/nowhere/mesh.obj"),
        lambda: eigenring.Mesh(*SQUARE).write("/nowhere/mesh.xyz"),
        lambda: eigenring.figure("art"),
        lambda: eigenring.figure("characteristic-map", valences=[2]),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(eigenring.Error) as caught:
        call()
    assert str(caught.value)


def timeless(found):
    """The same without what differs from run to run, and without the name of the file."""
    levels = [{key: value for key, value in level.items() if key != "seconds"} for level in found["levels"]]
    return {**found, "levels": levels, "mesh": None}


@pytest.mark.parametrize(
    "shape, problem, arguments, options",
    [
        ("fan", "poisson", {"solution": "sin"}, ["--solution", "sin"]),
        ("fan", "poisson", {"bc": "neumann", "gauss": 5}, ["--bc", "neumann", "--gauss", "5"]),
        ("fan", "poisson", {"dirichlet": "nitsche", "solver": "cholesky"}, ["--dirichlet", "nitsche", "--solver", "cholesky"]),
        ("fan", "l2", {"boundary": "natural", "depth": 6, "tail": "scaled"}, "--boundary natural --depth 6 --tail scaled".split()),
        ("fan", "biharmonic", {}, []),
        ("fan", "patch-test", {}, []),
        ("fan", "spectrum", {"bc": "dirichlet", "count": 5}, ["--bc", "dirichlet", "--count", "5"]),
        ("cube", "poisson", {"bc": "closed", "sphere": True}, ["--bc", "closed", "--sphere"]),
        ("cube", "spectrum", {"bc": "closed"}, ["--bc", "closed"]),
    ],
)
def test_model_problems_have_the_numbers_of_the_command(command, tmp_path, shape, problem, arguments, options):
    path = str(tmp_path / "mesh.obj")
    mesh = eigenring.Mesh(*(FAN if shape == "fan" else CUBE))
    mesh.write(path)
    printed = command("iga", problem, path, "--scheme", "catmull-clark", "--levels", "2", "--format", "json", *options)
    found = mesh.solve("catmull-clark", problem, levels=2, **arguments)
    assert timeless(found) == timeless(printed)
    for wrong in ({"solver": "magic"}, {"bc": "open"}, {"levels": 0}, {"boundary": ""}, {"gauss": 99}):
        with pytest.raises(eigenring.Error) as error:
            mesh.solve("catmull-clark", problem, **{**arguments, **wrong})
        assert error.value.accepted
