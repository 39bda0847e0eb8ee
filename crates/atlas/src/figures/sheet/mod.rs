//! Sampled maps: the patches of the characteristic and second-order maps, annulus by annulus.
//!
//! The characteristic map `X = (x, y)` and the second-order map z over it are scaled by refinement: with
//! parameters `u` counted in steps of the net from the centre, `X(u/2) = lambda X(u)` and `z(u/2) = mu z(u)`
//! (Reif 1995). So one annulus of patches is sampled, and the ones inside it are copies with three
//! [`Factors`]. By the chain rule
//!
//! * the Jacobian `det X'` with respect to u has the factor `4 lambda^2` from one annulus to the next;
//! * the Hessian of z over the plane has the factor `s = mu / lambda^2`, and `K* = z_xx z_yy - z_xy^2`, the
//!   numerator of the Gauss curvature (Ma, Wang and Ma 2023, Eq. 14), has `s^2`.
//!
//! Values are given relative to their mean over the first annulus (over the parameters for the Jacobian, over
//! the area and of `|K*|` for K*): a parametrisation by equal areas has the Jacobian 1, a quadratic cup has
//! K* = 1 and a quadratic saddle K* = -1.
//!
//! A patch is a grid of `cells x cells`. An annulus further in has half as many cells along an edge, so that
//! its outer points are inner points of the annulus around it and no seams open.

use crate::error::Error;
use eigenring_scheme::{Lattice, Scheme};
use eigenring_spectral::{Annulus, Graph, LocalSystem, Maps, Natural, PatchIndex};
use eigenring_spline::Jet;

/// A point of a map with the value that is shown there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapPoint {
    /// The characteristic map; its first point of ring 1 is (1, 0).
    pub x: f64,
    /// The characteristic map.
    pub y: f64,
    /// The second-order map, 0 without one.
    pub z: f64,
    /// Jacobian or K*, relative to its mean.
    pub value: f64,
}

impl MapPoint {
    /// The point below.
    pub fn plane(self) -> [f64; 2] {
        [self.x, self.y]
    }

    fn scaled(self, factors: &Factors, times: i32) -> MapPoint {
        MapPoint {
            x: self.x * factors.plane.powi(times),
            y: self.y * factors.plane.powi(times),
            z: self.z * factors.height.powi(times),
            value: self.value * factors.value.powi(times),
        }
    }

    fn between(self, other: MapPoint, t: f64) -> MapPoint {
        let mix = |a: f64, b: f64| a + t * (b - a);
        MapPoint {
            x: mix(self.x, other.x),
            y: mix(self.y, other.y),
            z: mix(self.z, other.z),
            value: mix(self.value, other.value),
        }
    }
}

/// A rotation of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    cos: f64,
    sin: f64,
}

impl Turn {
    /// Turns the bisector of sector 0 of so many up. Around a vertex the x axis is spoke 0, around a face it
    /// is the bisector itself: the first point of ring 1 lies on it.
    pub fn upright(lattice: Lattice, sectors: usize) -> Self {
        let bisector = match lattice {
            Lattice::Vertex => 1.0 / sectors as f64,
            Lattice::Face => 0.0,
        };
        let (sin, cos) = (std::f64::consts::PI * (0.5 - bisector)).sin_cos();
        Turn { cos, sin }
    }

    /// The turned point of the plane.
    pub fn plane(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }
}

/// What refinement does to coordinates and values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// lambda.
    pub plane: f64,
    /// mu.
    pub height: f64,
    /// `4 lambda^2` of the Jacobian, `(mu / lambda^2)^2` of K*.
    pub value: f64,
}

/// One patch: `(cells + 1)^2` points, the first parameter running fastest.
#[derive(Clone, Debug)]
pub struct Tile {
    /// Which patch.
    pub patch: PatchIndex,
    /// Its points.
    pub points: Vec<MapPoint>,
}

/// One annulus of patches, sampled.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Around a vertex or a face.
    pub lattice: Lattice,
    /// Its inner radius m; the outer one is 2m.
    pub inner: usize,
    /// Cells along an edge of a patch.
    pub cells: usize,
    /// How the next annulus follows from this one.
    pub factors: Factors,
    /// The patches of all sectors.
    pub tiles: Vec<Tile>,
}

/// The hole that is left in the middle, relative to the rim: a millimetre in a panel as wide as a third of a
/// page. For more than five sectors, whose patches are narrower, it is larger in proportion.
const HOLE: f64 = 0.035;
/// The most annuli: with lambda = 0.9 they leave a hole of 0.06, which is closed by a fan of triangles.
const MOST: usize = 24;

/// Three Gauss points: exact for the Jacobians of bicubic maps.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 4.0 / 9.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// The smallest inner radius at which the annuli of all these schemes are regular, so that they are compared
/// on the same one.
pub fn common_inner<'a>(schemes: impl IntoIterator<Item = &'a Scheme<f64>>) -> Result<usize, Error> {
    let mut inner = 1;
    for scheme in schemes {
        inner = inner.max(Annulus::new(scheme)?.inner);
    }
    Ok(inner)
}

impl Sheet {
    /// The characteristic map with its Jacobian, on an annulus of at least this inner radius. It needs no
    /// second-order maps, which some schemes lack.
    pub fn characteristic(scheme: &Scheme<f64>, inner: usize, cells: usize) -> Result<Sheet, Error> {
        let annulus = Annulus::at_least(scheme, inner)?;
        let system = LocalSystem::new(scheme.limit(), annulus.numbering.rings)?;
        let Natural { lambda, points: [x, y] } = shrinking(&system)?;
        let factors = Factors {
            plane: lambda,
            height: 1.0,
            value: 4.0 * lambda * lambda,
        };
        let value = |x: &Jet<f64>, y: &Jet<f64>, _: &Jet<f64>| {
            let jacobian = x.first[0] * y.first[1] - x.first[1] * y.first[0];
            (jacobian, 1.0)
        };
        let flat = vec![0.0; x.len()];
        Ok(Sheet::sampled(&annulus, [&x, &y, &flat], factors, cells, value))
    }

    /// The three second-order maps with their K*: cup and two saddles.
    pub fn second_order(scheme: &Scheme<f64>, inner: usize, cells: usize) -> Result<[Sheet; 3], Error> {
        let maps = Maps::on(scheme, Annulus::at_least(scheme, inner)?)?;
        let [x, y] = &maps.natural;
        Ok(std::array::from_fn(|which| {
            let mu = maps.mu[which];
            let factors = Factors {
                plane: maps.lambda,
                height: mu,
                value: (mu / (maps.lambda * maps.lambda)).powi(2),
            };
            let value = |x: &Jet<f64>, y: &Jet<f64>, z: &Jet<f64>| {
                let graph = Graph::new(x, y, z);
                (graph.gauss(), graph.jacobian)
            };
            Sheet::sampled(&maps.annulus, [x, y, &maps.second_order[which]], factors, cells, value)
        }))
    }

    /// Samples nets over an annulus; `value` gives the value and the weight of its mean.
    fn sampled(
        annulus: &Annulus,
        nets: [&Vec<f64>; 3],
        factors: Factors,
        cells: usize,
        value: impl Fn(&Jet<f64>, &Jet<f64>, &Jet<f64>) -> (f64, f64),
    ) -> Sheet {
        let cells = cells.max(1);
        let n = annulus.numbering.fan.sectors();
        let (mut total, mut weights) = (0.0, 0.0);
        let mut tiles = Vec::new();
        for patch in (0..n).flat_map(|sector| annulus.patches(sector)) {
            let surfaces = nets.map(|net| annulus.patch(net, patch));
            let at = |u: f64, v: f64| {
                let [x, y, z] = surfaces.each_ref().map(|surface| surface.jet(u, v));
                let (value, weight) = value(&x, &y, &z);
                let point = MapPoint {
                    x: x.value,
                    y: y.value,
                    z: z.value,
                    value,
                };
                (point, weight)
            };
            for (u, in_u) in GAUSS {
                for (v, in_v) in GAUSS {
                    let (point, weight) = at(u, v);
                    total += in_u * in_v * weight * point.value.abs();
                    weights += in_u * in_v * weight;
                }
            }
            let grid = |k: usize| k as f64 / cells as f64;
            let points = (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j)));
            tiles.push(Tile {
                patch,
                points: points.map(|(i, j)| at(grid(i), grid(j)).0).collect(),
            });
        }
        let mean = total / weights;
        for point in tiles.iter_mut().flat_map(|tile| &mut tile.points) {
            point.value /= mean;
        }
        Sheet {
            lattice: annulus.numbering.lattice,
            inner: annulus.inner,
            cells,
            factors,
            tiles,
        }
    }

    /// The largest distance from the centre, in the plane.
    pub fn radius(&self) -> f64 {
        let points = self.tiles.iter().flat_map(|tile| &tile.points);
        points.map(|point| point.x.hypot(point.y)).fold(0.0, f64::max)
    }

    /// The smallest and the largest height.
    pub fn heights(&self) -> (f64, f64) {
        let points = self.tiles.iter().flat_map(|tile| &tile.points);
        points.fold((0.0, 0.0), |(low, high), point| (point.z.min(low), point.z.max(high)))
    }

    /// The number of sectors.
    pub fn sectors(&self) -> usize {
        self.tiles.len() / (3 * self.inner * self.inner)
    }

    /// The rotation that turns the bisector of sector 0 up, for upright pictures.
    pub fn upright(&self) -> Turn {
        Turn::upright(self.lattice, self.sectors())
    }

    /// The points of sector 0 with their parameters: steps of the net along its own and along the next spoke.
    /// Points that patches share are given once, those on the rim not at all.
    pub fn sector_points(&self) -> impl Iterator<Item = (f64, f64, MapPoint)> + '_ {
        let (cells, width) = (self.cells, self.cells + 1);
        let tiles = self.tiles.iter().filter(|tile| tile.patch.sector == 0);
        tiles.flat_map(move |tile| {
            let places = (0..cells).flat_map(move |j| (0..cells).map(move |i| (i, j)));
            let parameter = move |start: usize, k: usize| start as f64 + k as f64 / cells as f64;
            places.map(move |(i, j)| {
                (
                    parameter(tile.patch.p, i),
                    parameter(tile.patch.q, j),
                    tile.points[i + j * width],
                )
            })
        })
    }

    /// The annulus `times` further in, with 2^times fewer cells: the next smaller divisor, at least one.
    pub fn inward(&self, times: usize) -> Sheet {
        let wanted = self.cells.checked_shr(times as u32).unwrap_or(0).max(1);
        let cells = (1..=wanted)
            .rev()
            .find(|&cells| self.cells.is_multiple_of(cells))
            .unwrap_or(1);
        self.scaled(times, cells)
    }

    /// The annulus `times` further in, with so many cells, a divisor of its own, along the edge of a patch.
    fn scaled(&self, times: usize, cells: usize) -> Sheet {
        let step = self.cells / cells;
        let tiles = self.tiles.iter().map(|tile| {
            let at = |i: usize, j: usize| tile.points[step * (i + j * (self.cells + 1))];
            let points = (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j)));
            Tile {
                patch: tile.patch,
                points: points
                    .map(|(i, j)| at(i, j).scaled(&self.factors, times as i32))
                    .collect(),
            }
        });
        Sheet {
            cells,
            tiles: tiles.collect(),
            ..*self
        }
    }

    /// So many annuli, this one first, with the same cells.
    pub fn first(&self, count: usize) -> Vec<Sheet> {
        (0..count).map(|times| self.scaled(times, self.cells)).collect()
    }

    /// This annulus and those inside it, until the patches cannot be told apart.
    pub fn all(&self) -> Vec<Sheet> {
        let hole = HOLE * (self.sectors() as f64 / 5.0).max(1.0);
        let needed = (hole.ln() / self.factors.plane.abs().ln()).ceil();
        let count = if needed >= 1.0 { needed as usize } else { MOST };
        (0..count.min(MOST)).map(|times| self.inward(times)).collect()
    }

    /// The cells of all patches, corners in turn.
    pub fn quads(&self) -> impl Iterator<Item = [MapPoint; 4]> + '_ {
        let (cells, width) = (self.cells, self.cells + 1);
        self.tiles.iter().flat_map(move |tile| {
            let at = move |i: usize, j: usize| tile.points[i + j * width];
            let places = (0..cells).flat_map(move |j| (0..cells).map(move |i| (i, j)));
            places.map(move |(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        })
    }

    /// Triangles from the inner boundary to the centre, the last corner twice, all with the boundary's mean
    /// value.
    pub fn fan(&self) -> Vec<[MapPoint; 4]> {
        let edges: Vec<Vec<MapPoint>> = self.inner_edges().collect();
        let count = edges.iter().map(Vec::len).sum::<usize>() as f64;
        let value = edges.iter().flatten().map(|point| point.value).sum::<f64>() / count;
        let centre = MapPoint {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            value,
        };
        let pairs = edges.iter().flat_map(|edge| edge.windows(2));
        let triangles = pairs.map(|pair| {
            [
                MapPoint { value, ..pair[0] },
                MapPoint { value, ..pair[1] },
                centre,
                centre,
            ]
        });
        triangles.collect()
    }

    fn line(&self, tile: &Tile, along_u: bool, at: usize) -> Vec<MapPoint> {
        let width = self.cells + 1;
        let index = |k: usize| if along_u { k + at * width } else { at + k * width };
        (0..width).map(|k| tile.points[index(k)]).collect()
    }

    fn inner_edges(&self) -> impl Iterator<Item = Vec<MapPoint>> + '_ {
        let inner = self.inner;
        self.tiles.iter().filter_map(move |tile| match tile.patch {
            PatchIndex { p, q, .. } if p == inner && q < inner => Some(self.line(tile, false, 0)),
            PatchIndex { p, q, .. } if q == inner && p < inner => Some(self.line(tile, true, 0)),
            _ => None,
        })
    }

    /// The boundaries of patches, each once except for the inner boundary, which is the outer one of the next
    /// annulus.
    pub fn edges(&self) -> Vec<Vec<MapPoint>> {
        let mut edges = Vec::new();
        for tile in &self.tiles {
            let PatchIndex { p, q, .. } = tile.patch;
            let outer = 2 * self.inner - 1;
            // a spoke is the lower edge of its own sector only
            if q != self.inner || p >= self.inner {
                edges.push(self.line(tile, true, 0));
            }
            if p != 0 && (p != self.inner || q >= self.inner) {
                edges.push(self.line(tile, false, 0));
            }
            if p == outer {
                edges.push(self.line(tile, false, self.cells));
            }
            if q == outer {
                edges.push(self.line(tile, true, self.cells));
            }
        }
        edges
    }

    /// Isoparametric lines inside the patches, `parts` - 1 each way; none where the grid has no such lines.
    pub fn isolines(&self, parts: usize) -> Vec<Vec<MapPoint>> {
        if parts == 0 || !self.cells.is_multiple_of(parts) {
            return Vec::new();
        }
        let inside = (1..parts).map(|k| k * self.cells / parts);
        let lines = self.tiles.iter().flat_map(|tile| {
            inside
                .clone()
                .flat_map(move |at| [self.line(tile, true, at), self.line(tile, false, at)])
        });
        lines.collect()
    }

    /// Where the value is zero: the boundary of the region where `sign` times the value is negative, cell by
    /// cell, with linear interpolation along the cells' edges.
    pub fn zero_lines(&self, sign: f64) -> Vec<[MapPoint; 2]> {
        let mut segments = Vec::new();
        for corners in self.quads() {
            let wrong = corners.map(|corner| sign * corner.value < -ZERO);
            let mut crossings = Vec::new();
            for k in 0..4 {
                let (a, b) = (corners[k], corners[(k + 1) % 4]);
                if wrong[k] != wrong[(k + 1) % 4] {
                    crossings.push(a.between(b, (a.value / (a.value - b.value)).clamp(0.0, 1.0)));
                }
            }
            match crossings[..] {
                [a, b] => segments.push([a, b]),
                // opposite corners are wrong: each of them is cut off by itself
                [a, b, c, d] if wrong[0] => segments.extend([[d, a], [b, c]]),
                [a, b, c, d] => segments.extend([[a, b], [c, d]]),
                _ => {}
            }
        }
        segments
    }
}

/// Values below this times the mean are zero up to rounding: second derivatives lose half of the digits at
/// worst.
const ZERO: f64 = 1e-8;

/// The natural configuration on the system's net, whose annuli shrink toward the centre.
///
/// # Errors
/// Those of [`LocalSystem::natural`]; [`eigenring_spectral::Error::Scaling`] unless `0 < lambda < 1`.
pub fn shrinking(system: &LocalSystem) -> Result<Natural, Error> {
    let natural = system.natural()?;
    if natural.lambda > 0.0 && natural.lambda < 1.0 {
        return Ok(natural);
    }
    Err(eigenring_spectral::Error::Scaling {
        value: natural.lambda,
        fourier: 1,
    }
    .into())
}

#[cfg(test)]
mod tests;
