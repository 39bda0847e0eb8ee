#!/usr/bin/env python3
"""eigenring beside numpy and scipy: eigenvalues, refinement, points of a B-spline surface.

The other side is written here with numpy and scipy alone, so that its results are a check too:
eigenvalues by numpy.linalg.eigvals of the local matrix, which is given to it; Catmull-Clark's scheme
with arrays of faces and edges; points by scipy.interpolate.NdBSpline.
"""

import peers

given = peers.arguments(__doc__, levels=5)

import eigenring
import numpy as np

try:
    import scipy
    from scipy.interpolate import NdBSpline
except ImportError:
    peers.skip("scipy is not installed: pip install scipy")

print(f"eigenring {eigenring.__version__} with {given.threads} thread(s); numpy {np.__version__}, scipy {scipy.__version__}")
report = peers.Report("numpy/scipy")

for spec, valence in [("catmull-clark", 5), ("catmull-clark", 64), ("tension:order=8,u0=1", 12), ("tension:order=12,u0=1", 12)]:
    at = eigenring.Scheme(spec).at(valence)
    matrix = at.matrix()
    moduli = lambda values: np.sort(abs(values))[::-1][:6]
    times, found = peers.timed(given.repeat, lambda: at.spectrum().eigenvalues, lambda: np.linalg.eigvals(matrix))
    what = f"eigenvalues of {spec}, N = {valence}, {len(matrix)} points"
    report.row(what, *times, abs(moduli(found[0]) - moduli(found[1])).max(), 1e-9)


def catmull_clark(points, faces):
    """One level on a closed mesh of quads."""
    count = len(points)
    centres = points[faces].mean(axis=1)
    halves = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    edges, of_half = np.unique(np.sort(halves, axis=1), axis=0, return_inverse=True)
    of_half = of_half.ravel()
    owner = np.repeat(np.arange(len(faces)), 4)
    middles = np.zeros((len(edges), 3))
    np.add.at(middles, of_half, centres[owner])
    middles = (middles + points[edges].sum(axis=1)) / 4
    valence = np.bincount(faces.ravel(), minlength=count)[:, None]
    ring = np.zeros((count, 3))
    np.add.at(ring, faces.ravel(), np.repeat(centres, 4, axis=0))
    np.add.at(ring, edges[:, 0], points[edges[:, 1]])
    np.add.at(ring, edges[:, 1], points[edges[:, 0]])
    corners = points * (valence - 2) / valence + ring / valence**2
    numbers = count + of_half.reshape(-1, 4)
    middle = np.repeat(count + len(edges) + np.arange(len(faces)), 4).reshape(-1, 4)
    finer = np.stack([faces, numbers, middle, np.roll(numbers, 1, axis=1)], axis=2).reshape(-1, 4)
    return np.concatenate([corners, middles, centres]), finer


control = peers.control(given.mesh)
if not isinstance(control.faces, np.ndarray):
    # the other side knows quads only
    control = control.subdivide("catmull-clark")


def by_arrays():
    points, faces = control.vertices, control.faces
    for _ in range(given.levels):
        points, faces = catmull_clark(points, faces)
    return points


times, found = peers.timed(given.repeat, lambda: control.subdivide("catmull-clark", given.levels).vertices, by_arrays)
report.row(f"Catmull-Clark, {given.levels} levels to {len(found[1])} vertices", *times, peers.apart(*found), 1e-12)

side, count = 12, 200_000
random = np.random.default_rng(7)
net = random.uniform(-1, 1, (side, side, 3))
at = lambda i, j: i * side + j
faces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(side - 1) for j in range(side - 1)]
mesh = eigenring.Mesh(net.reshape(-1, 3), faces)
cells, u, v = random.integers(1, side - 2, (count, 2)), random.uniform(0, 1, count), random.uniform(0, 1, count)
face = cells[:, 0] * (side - 1) + cells[:, 1]
knots = np.arange(-2.0, side + 2)
spline = NdBSpline((knots, knots), net, 3)
where = np.stack([cells[:, 0] + u, cells[:, 1] + v], axis=1)
times, found = peers.timed(given.repeat, lambda: mesh.limit("catmull-clark", face, u, v).points, lambda: spline(where))
what = f"{count} points of a bicubic surface (ours: derivatives and curvatures too)"
report.row(what, *times, abs(found[0] - found[1]).max(), 1e-12)
report.end()
