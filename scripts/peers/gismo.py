#!/usr/bin/env python3
"""eigenring beside G+Smo (pygismo): points and derivatives of a bicubic B-spline surface.

A regular mesh under Catmull-Clark's scheme is a bicubic B-spline with uniform knots, which G+Smo evaluates
as a tensor product. Install pygismo from the package index (pip install pygismo).
"""

import peers

given = peers.arguments(__doc__)

import eigenring
import numpy as np

try:
    import pygismo as gs
except ImportError:
    peers.skip("pygismo is not installed: pip install pygismo")

print(f"eigenring {eigenring.__version__} with {given.threads} thread(s); pygismo {getattr(gs, '__version__', '')}")
report = peers.Report("G+Smo")
side, count = 12, 200_000
random = np.random.default_rng(7)
net = random.uniform(-1, 1, (side, side, 3))
at = lambda i, j: i * side + j
faces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(side - 1) for j in range(side - 1)]
mesh = eigenring.Mesh(net.reshape(-1, 3), faces)
cells, u, v = random.integers(1, side - 2, (count, 2)), random.uniform(0, 1, count), random.uniform(0, 1, count)
face = cells[:, 0] * (side - 1) + cells[:, 1]

knots = gs.nurbs.gsKnotVector(np.arange(-2.0, side + 2), 3)
basis = gs.nurbs.gsTensorBSplineBasis2(knots, knots)
# the first parameter runs fastest there
surface = gs.nurbs.gsTensorBSpline2(basis, np.ascontiguousarray(net.transpose(1, 0, 2).reshape(-1, 3)))
where = np.asfortranarray(np.stack([cells[:, 0] + u, cells[:, 1] + v]))
times, found = peers.timed(
    given.repeat,
    lambda: mesh.limit("catmull-clark", face, u, v),
    lambda: (surface.eval(where), surface.deriv(where), surface.deriv2(where)),
)
ours, (points, first, second) = found
what = f"{count} points with first and second derivatives (ours: curvatures too)"
# G+Smo lists derivatives by coordinate: x_u, x_v, y_u, ..; x_uu, x_vv, x_uv, y_uu, ..
first = first.reshape(3, 2, count).transpose(2, 1, 0)
second = second.reshape(3, 3, count).transpose(2, 1, 0)[:, [0, 2, 1]]
difference = max(abs(a - b).max() for a, b in [(ours.points, points.T), (ours.first, first), (ours.second, second)])
report.row(what, *times, difference, 1e-11)
report.end()
