#!/usr/bin/env python3
"""Draws docs/overview.svg, the overview picture of the tuned lambda-schemes.

Run it from anywhere, with nothing but Python's standard library:

    python3 scripts/overview.py

It reads the published results (results/lambda/: samples.csv, knots.csv,
table1_featured_lambda.csv, table5_f2_coefficients.csv, table6_f3_coefficients.csv)
and rewrites docs/overview.svg; equal results give equal bytes.

Three panels, all for the unified lambda-subdivision of Ma, Wang and Ma 2023 (ACM TOG 42(6) 209):

(a) f2(lambda) and f3(lambda) at valence 6: the tuned optima and the cubic B-splines fitted to them;
(b) the featured subdominant eigenvalues against the valence, with the values the paper prints;
(c) natural configurations at valence 5. A natural configuration is the control net of the
    characteristic map: refinement shrinks it by lambda. With w = exp(2 pi i/N), rotational symmetry
    writes the point (a, b) of sector i as v(a, b) w^i, a complex number x + iy. The scheme's rules
    fix ring 1: v(1,0) = 1, v(1,1) = f2 (1 + w)/(lambda - f3). The regular bicubic rule governs the
    rings outside: ring 2 takes part in its own refinement and solves a 4 x 4 system; ring 3 is the
    refined ring 1..2 divided by lambda.
"""

import cmath
import csv
import math
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "results" / "lambda"
OUTPUT = ROOT / "docs" / "overview.svg"

WIDTH, HEIGHT = 1000, 780
CURVE_VALENCE, NET_VALENCE = 6, 5
# Okabe and Ito's colours, the blue darkened so that it stays apart from the vermillion in grey.
BLUE, RED, GREEN, PURPLE = "#004c86", "#d55e00", "#009e73", "#a0558a"
INK, GRID, SHADE = "#222222", "#d9d9d9", "#e6f2ea"
RING_FILL = ["#9ec3e0", "#cfe1f0", "#ebf3f9"]


# ---- data ----------------------------------------------------------------------------------------


def rows(name):
    with open(DATA / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def vector(name, valence, prefix, length):
    """The `length` numbers prefix1, prefix2, ... of one valence."""
    row = next(r for r in rows(name) if int(r["valence"]) == valence)
    return [float(row[f"{prefix}{k}"]) for k in range(1, length + 1)]


def featured():
    """(valence, name) -> (lambda, the paper's printed value or None)."""
    return {
        (int(r["valence"]), r["name"]): (float(r["lambda"]), float(r["paper"]) if r["paper"] else None)
        for r in rows("table1_featured_lambda.csv")
    }


class Stencil:
    """The splines f2(lambda), f3(lambda) of one valence."""

    def __init__(self, valence):
        self.knots = vector("knots.csv", valence, "xi", 21)
        self.f2 = vector("table5_f2_coefficients.csv", valence, "C", 17)
        self.f3 = vector("table6_f3_coefficients.csv", valence, "C", 17)

    def at(self, lam):
        return self.spline(self.f2, lam), self.spline(self.f3, lam)

    def spline(self, coefficients, x):
        """De Boor's algorithm for a cubic; the last span is closed on the right."""
        t = self.knots
        span = max(k for k in range(3, len(coefficients)) if t[k] < t[k + 1] and (t[k] <= x or k == 3))
        d = coefficients[span - 3 : span + 1]
        for r in (1, 2, 3):
            for j in range(3, r - 1, -1):
                left, right = t[j + span - 3], t[j + 1 + span - r]
                u = (x - left) / (right - left)
                d[j] = (1 - u) * d[j - 1] + u * d[j]
        return d[3]


# ---- natural configuration -----------------------------------------------------------------------


def refinement_row(a, b):
    """Regular bicubic rule: the refined point (a, b) as [(coarse a, coarse b, weight)]."""

    def line(k):
        if k % 2 == 0:
            return [(k // 2 - 1, 1 / 8), (k // 2, 6 / 8), (k // 2 + 1, 1 / 8)]
        return [(k // 2, 1 / 2), (k // 2 + 1, 1 / 2)]

    return [(p, q, u * v) for p, u in line(a) for q, v in line(b)]


def own_sector(a, b, w):
    """The point (a, b), possibly across a spoke, as (a', b', phase) with a' >= 1, b' >= 0."""
    if b < 0:
        return -b, a, 1 / w
    if a <= 0 and b > 0:
        return b, -a, w
    return a, b, 1


def solve(matrix, right):
    """Gaussian elimination with partial pivoting."""
    n = len(right)
    m = [row[:] + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(m[i][k]))
        m[k], m[pivot] = m[pivot], m[k]
        for i in range(k + 1, n):
            factor = m[i][k] / m[k][k]
            m[i] = [x - factor * y for x, y in zip(m[i], m[k])]
    x = [0j] * n
    for k in reversed(range(n)):
        x[k] = (m[k][n] - sum(m[k][j] * x[j] for j in range(k + 1, n))) / m[k][k]
    return x


def ring(r):
    return [(r, b) for b in range(r + 1)] + [(a, r) for a in range(1, r)]


def natural_configuration(valence, lam, f2, f3):
    """Rings 0..3 as a function (sector, a, b) -> complex."""
    w = cmath.exp(2j * math.pi / valence)
    v = {(0, 0): 0j, (1, 0): 1 + 0j, (1, 1): f2 * (1 + w) / (lam - f3)}

    unknown = ring(2)
    matrix, right = [], []
    for i, (a, b) in enumerate(unknown):
        row, value = [0j] * 4, 0j
        row[i] = complex(lam)
        for p, q, weight in refinement_row(a, b):
            p, q, phase = own_sector(p, q, w)
            if (p, q) in v:
                value += weight * phase * v[p, q]
            else:
                row[unknown.index((p, q))] -= weight * phase
        matrix.append(row)
        right.append(value)
    v.update(zip(unknown, solve(matrix, right)))

    for a, b in ring(3):
        terms = ((weight, own_sector(p, q, w)) for p, q, weight in refinement_row(a, b))
        v[a, b] = sum(weight * phase * v[p, q] for weight, (p, q, phase) in terms) / lam

    def point(sector, a, b):
        a, b, phase = own_sector(a, b, w)
        return v[a, b] * phase * w**sector

    return point


# ---- drawing -------------------------------------------------------------------------------------


class Picture:
    def __init__(self):
        self.lines = []

    def add(self, line):
        self.lines.append(line)

    def text(self, x, y, content, anchor="start", size=13, colour=INK, extra=""):
        """`content` may hold italic symbols with a subscript, written $f_2$."""
        out = ""
        for k, part in enumerate(content.split("$")):
            if k % 2 == 0:
                out += part
            else:
                symbol, _, sub = part.partition("_")
                out += f'<tspan font-style="italic">{symbol}</tspan>'
                if sub:
                    out += f'<tspan dy="4" font-size="{size - 3}">{sub}</tspan><tspan dy="-4">\u200b</tspan>'
        self.add(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" '
            f'fill="{colour}"{extra}>{out}</text>'
        )

    def segment(self, x1, y1, x2, y2, colour=INK, width=1, dash=""):
        dash = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(
            f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
            f'stroke="{colour}" stroke-width="{width}"{dash}/>'
        )

    def polyline(self, points, colour, width=1.8, dash=""):
        dash = f' stroke-dasharray="{dash}"' if dash else ""
        path = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
        self.add(
            f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}" '
            f'stroke-linejoin="round"{dash}/>'
        )

    def marker(self, shape, x, y, colour, r=3.6, width=1.4, fill="#ffffff"):
        style = f'fill="{fill}" stroke="{colour}" stroke-width="{width}"'
        if shape == "circle":
            self.add(f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{r}" {style}/>')
            return
        corners = {
            "square": [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            "triangle": [(0, -1.25), (1.15, 0.85), (-1.15, 0.85)],
            "diamond": [(0, -1.3), (1.3, 0), (0, 1.3), (-1.3, 0)],
        }[shape]
        self.add(f'<polygon points="{" ".join(f"{x + r * p:.2f},{y + r * q:.2f}" for p, q in corners)}" {style}/>')

    def cross(self, x, y, r=2.6):
        self.add(
            f'<path d="M{x - r:.2f} {y - r:.2f}L{x + r:.2f} {y + r:.2f}'
            f'M{x - r:.2f} {y + r:.2f}L{x + r:.2f} {y - r:.2f}" '
            f'stroke="#000000" stroke-width="1.1" fill="none"/>'
        )


class Axes:
    """A rectangle of the page (left, top, right, bottom) showing x_range by y_range."""

    def __init__(self, picture, box, x_range, y_range):
        self.picture, self.box, self.x_range, self.y_range = picture, box, x_range, y_range

    def x(self, value):
        (left, _, right, _), (low, high) = self.box, self.x_range
        return left + (value - low) / (high - low) * (right - left)

    def y(self, value):
        (_, top, _, bottom), (low, high) = self.box, self.y_range
        return bottom - (value - low) / (high - low) * (bottom - top)

    def grid(self, y_ticks):
        left, _, right, _ = self.box
        for value in y_ticks:
            self.picture.segment(left, self.y(value), right, self.y(value), GRID, 0.8)

    def frame(self, x_ticks, y_ticks, x_format, x_label, y_label):
        left, top, right, bottom = self.box
        p = self.picture
        p.add(
            f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" '
            f'fill="none" stroke="{INK}" stroke-width="1"/>'
        )
        for value in x_ticks:
            p.segment(self.x(value), bottom, self.x(value), bottom + 4)
            p.text(self.x(value), bottom + 18, x_format.format(value), "middle", 12)
        for value in y_ticks:
            p.segment(left - 4, self.y(value), left, self.y(value))
            p.text(left - 8, self.y(value) + 4, f"{value:.1f}", "end", 12)
        p.text((left + right) / 2, bottom + 37, x_label, "middle")
        x, y = left - 38, (top + bottom) / 2
        p.text(x, y, y_label, "middle", extra=f' transform="rotate(-90 {x:.1f} {y:.1f})"')


def heading(picture, x, y, letter, words):
    picture.text(x, y, f'<tspan font-weight="bold">({letter})</tspan> {words}', size=15)


def panel_stencil(picture, table):
    lam = {name: value for (valence, name), (value, _) in table.items() if valence == CURVE_VALENCE}
    stencil = Stencil(CURVE_VALENCE)
    low, high = stencil.knots[0], stencil.knots[-1]
    heading(picture, 18, 26, "a", f"Tuned weights against $λ$ at valence $N$ = {CURVE_VALENCE}")

    axes = Axes(picture, (66, 92, 540, 372), (low, high), (0, 0.75))
    _, top, _, bottom = axes.box
    x1, x2 = axes.x(lam["lambda_r1"]), axes.x(lam["lambda_r2"])
    picture.add(f'<rect x="{x1:.2f}" y="{top}" width="{x2 - x1:.2f}" height="{bottom - top}" fill="{SHADE}"/>')
    y_ticks = [k / 10 for k in range(8)]
    axes.grid(y_ticks[1:])
    for name in ("l", "M", "C"):
        x = axes.x(lam[f"lambda_{name}"])
        picture.segment(x, top, x, bottom, "#555555", 1, "5 3")
    for name in ("r1", "l", "M", "C", "r2"):
        x = axes.x(lam[f"lambda_{name}"])
        picture.segment(x, top - 4, x, top)
        picture.text(x, top - 9, f"$λ_{name}$", "middle")

    # Kinks of the spline are knots, so the knots join the abscissae of the polyline.
    abscissae = sorted({low + (high - low) * k / 300 for k in range(301)} | set(stencil.knots))
    samples = [r for r in rows("samples.csv") if int(r["valence"]) == CURVE_VALENCE]
    for name, colour in (("f2", BLUE), ("f3", RED)):
        for r in samples[::2]:
            picture.marker("circle", axes.x(float(r["lambda"])), axes.y(float(r[name])), colour, 2.7, 0.9)
        values = [(axes.x(x), axes.y(stencil.at(x)[name == "f3"])) for x in abscissae]
        picture.polyline(values, colour, 1.6)
    picture.text(axes.x(0.445), axes.y(0.315), "$f_2$", "end", 16, BLUE)
    picture.text(axes.x(0.755), axes.y(0.45), "$f_3$", "end", 16, RED)
    axes.frame([k / 10 for k in range(2, 10)], y_ticks, "{:.1f}", "subdominant eigenvalue $λ$", "weight")

    y = 54
    picture.marker("circle", 72, y - 4, INK, 2.7, 0.9)
    picture.text(81, y, "tuned optimum (every 2nd sample)", size=12)
    picture.segment(320, y - 4, 344, y - 4, INK, 1.6)
    picture.text(350, y, "cubic spline", size=12)
    swatch = f'fill="{SHADE}" stroke="#8aa596" stroke-width="0.8"'
    picture.add(f'<rect x="437" y="{y - 11}" width="22" height="13" {swatch}/>')
    picture.text(465, y, "recommended", size=12)


def panel_featured(picture, table):
    valences = sorted({valence for valence, _ in table})
    heading(picture, 580, 26, "b", "Featured $λ$ against valence")
    axes = Axes(picture, (628, 92, 936, 372), (valences[0] - 0.6, valences[-1] + 0.6), (0.3, 0.95))
    y_ticks = [k / 10 for k in range(3, 10)]
    axes.grid(y_ticks[1:])
    series = [
        ("r2", PURPLE, "diamond", "2 3"),
        ("CC", GREEN, "square", "7 3"),
        ("C", RED, "triangle", ""),
        ("l", BLUE, "circle", ""),
    ]
    for name, colour, _, dash in series:
        picture.polyline([(axes.x(n), axes.y(table[n, f"lambda_{name}"][0])) for n in valences], colour, 1.6, dash)
    for name, colour, shape, _ in series:
        for n in valences:
            picture.marker(shape, axes.x(n), axes.y(table[n, f"lambda_{name}"][0]), colour, 4)
    for name, colour, _, _ in series:
        for n in valences:
            printed = table[n, f"lambda_{name}"][1]
            if printed is not None:
                picture.cross(axes.x(n), axes.y(printed))
        last = table[valences[-1], f"lambda_{name}"][0]
        nudge = {"r2": -3, "l": 4}.get(name, 0)  # keeps the two uppermost labels apart
        picture.text(axes.box[2] + 8, axes.y(last) + 4 + nudge, f"$λ_{name}$", "start", 14, colour)
    axes.frame(range(4, valences[-1] + 1, 2), y_ticks, "{}", "valence $N$", "$λ$")

    y = 54
    for k, (_, colour, shape, _) in enumerate(series):
        picture.marker(shape, 634 + 12 * k, y - 4, colour, 4)
    picture.text(680, y, "computed", size=12)
    picture.cross(756, y - 4)
    picture.text(765, y, "printed by Ma, Wang and Ma 2023", size=12)


def panel_nets(picture, table):
    title = f"Natural configurations at valence $N$ = {NET_VALENCE}, rings 0 to 3, drawn to the same size"
    heading(picture, 18, 452, "c", title)
    stencil = Stencil(NET_VALENCE)
    optimum = table[NET_VALENCE, "lambda_C"][0]
    nets = [(0.39, "$λ_A$ = 0.39"), (0.5, "$λ_M$ = 0.5"), (optimum, f"$λ_C$ = {optimum:.4f}")]
    for column, (lam, label) in enumerate(nets):
        cx, cy, radius = 176 + 324 * column, 632, 130
        f2, f3 = stencil.at(lam)
        point = natural_configuration(NET_VALENCE, lam, f2, f3)
        sectors = range(NET_VALENCE)
        scale = radius / max(abs(point(0, a, b)) for a, b in ring(3))

        def place(*index):
            # The bisector of sector 0 points up, a spoke down.
            z = scale * point(*index) * cmath.exp(1j * (math.pi / 2 - math.pi / NET_VALENCE))
            return f"{cx + z.real:.2f} {cy - z.imag:.2f}"

        for r in (3, 2, 1):
            # Within a sector the ring runs out along a = r to its corner and back along b = r.
            side = [(r, b) for b in range(r + 1)] + [(a, r) for a in range(r - 1, 0, -1)]
            outline = [(i, a, b) for i in sectors for a, b in side]
            picture.add(f'<path d="M{"L".join(place(*k) for k in outline)}Z" fill="{RING_FILL[r - 1]}"/>')
        edges = []
        for i in sectors:
            edges += [[(i, a, b) for b in range(4)] for a in (1, 2, 3)]
            edges += [[(i, a, b) for a in range(4)] for b in range(4)]
        path = "".join("M" + "L".join(place(*k) for k in line) for line in edges)
        picture.add(f'<path d="{path}" fill="none" stroke="{BLUE}" stroke-width="1.1" stroke-linejoin="round"/>')
        for i in sectors:
            for a, b in ring(1) + ring(2) + ring(3):
                x, y = place(i, a, b).split()
                picture.add(f'<circle cx="{x}" cy="{y}" r="2.1" fill="{BLUE}"/>')
        picture.add(f'<circle cx="{cx}" cy="{cy}" r="4.2" fill="{RED}" stroke="#ffffff" stroke-width="1"/>')
        picture.text(cx, 484, label, "middle", 14)
        picture.text(cx, 764, f"$f_2$ = {f2:.4f}, $f_3$ = {f3:.4f}", "middle", 12)


def main():
    picture = Picture()
    picture.add(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
        f'viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" role="img">'
    )
    picture.add("<!-- Written by scripts/overview.py from results/lambda. -->")
    picture.add(
        "<title>Tuned lambda-schemes: stencil functions, featured eigenvalues and natural configurations</title>"
    )
    picture.add(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>')
    table = featured()
    panel_stencil(picture, table)
    panel_featured(picture, table)
    panel_nets(picture, table)
    picture.add("</svg>")
    OUTPUT.write_text("\n".join(picture.lines) + "\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
