//! Characteristic maps: where the eigenvectors of the subdominant eigenvalues take the plane around a vertex.
//!
//! All edges of a spoke have the interval of the first, as they have after a level, so that the rules are
//! those of all further levels. Of NURSS the map has the eigenvectors of two eigenvalues that mostly differ,
//! of an eigen-polyhedron the polyhedron, of HNUSS the regular polygon and what [Lemma 3](crate::lemmas)
//! makes of it. Further points follow from `S P = lambda P`.

use crate::{EigenPolyhedron, Error, Limits, Net, Outside, Refinement, Scheme, Spokes, Star, lemmas, nurss};
use eigenring_scheme::{Complex, Scalar};
use eigenring_spectral::Block;
use eigenring_surface::Topology;
use nalgebra::{DMatrix, DVector};

/// Rings of points: the patches of the first two are known from them.
const RINGS: usize = 3;
/// Rings of faces that are drawn.
const DRAWN: usize = 2;

/// A characteristic map on the faces of a refined net.
#[derive(Clone, Debug)]
pub struct CharacteristicMap {
    /// The eigenvalues of both coordinates.
    pub factors: [f64; 2],
    /// Faces of the two rings around the vertex, by their corners in the plane.
    pub cells: Vec<[[f64; 2]; 4]>,
    /// For each of them the mean of the Jacobian by natural parameters.
    pub jacobians: Vec<f64>,
    /// Edges of the net before all levels.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// The control net of three rings, which is the natural configuration: its points, around the limit of
    /// the vertex at the origin, and the ends of its edges.
    pub control: (Vec<[f64; 2]>, Vec<[u32; 2]>),
}

impl CharacteristicMap {
    /// The map for the intervals of the spokes, on a net after so many levels.
    ///
    /// # Errors
    /// Those of the scheme's matrices; [`Error::ZeroSpokes`] for zero intervals, where faces have no area.
    pub fn new(scheme: Scheme, d: &[f64], levels: usize) -> Result<Self, Error> {
        let spokes = Spokes::stationary(d.to_vec())?;
        if d.contains(&0.0) {
            return Err(Error::Range {
                what: "knot interval",
                given: "0".to_owned(),
                accepted: "above 0: faces without width have no Jacobian".to_owned(),
            });
        }
        let star = Star::new(&d.iter().map(|&d| vec![d]).collect::<Vec<_>>(), RINGS)?;
        let mut refinement = Refinement::new(star.mesh(), scheme, Outside::Simple)?.at_a_later_level();
        let (factors, points) = match scheme {
            Scheme::Hnuss(_) => ([0.5; 2], polygon(&spokes, refinement.net(), &star)?),
            _ => vertex_map(scheme, &spokes, &star)?,
        };
        let coarse = refinement.net().clone();
        for _ in 0..levels {
            refinement.refine().map_err(Error::of_spokes)?;
        }
        let limits = Limits::new(&refinement)?.of(&refinement.apply(&points)?)?;
        let limits: Vec<[f64; 2]> = limits.into_iter().map(|[point, ..]| point).collect();
        let faces = star.mesh().face_count();
        let topology = coarse.topology();
        let edges = (0..topology.edge_count() as u32).map(|edge| topology.edge_points(edge));
        let mut map = drawn(&coarse, refinement.net(), &limits, faces, levels, factors);
        map.control = (points, edges.collect());
        Ok(map)
    }
}

/// The faces of the first rings and the edges between them.
fn drawn(
    coarse: &Net,
    net: &Net,
    points: &[[f64; 2]],
    faces: usize,
    levels: usize,
    factors: [f64; 2],
) -> CharacteristicMap {
    let topology = net.topology();
    let mut map = CharacteristicMap {
        factors,
        cells: Vec::new(),
        jacobians: Vec::new(),
        lines: Vec::new(),
        control: Default::default(),
    };
    // the faces of a star come first, sector by sector and row by row, and each is followed by its parts
    let children = 4_usize.pow(levels as u32);
    let inside = |face: usize| face % RINGS < DRAWN && face / RINGS % RINGS < DRAWN;
    for face in (0..faces * children).filter(|face| inside(face / children)) {
        let half = topology.face_halves(face as u32).start;
        let cell = [0, 1, 2, 3].map(|k| points[topology.origin(half + k) as usize]);
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let area = 0.5 * (0..4).map(|k| cross(cell[k], cell[(k + 1) % 4])).sum::<f64>();
        map.cells.push(cell);
        map.jacobians.push(area / (net.interval(half) * net.interval(half + 1)));
    }
    // vertices keep their numbers
    let count = coarse.topology().vertex_count() as u32;
    for face in (0..faces).filter(|&face| inside(face)) {
        for half in coarse.topology().face_halves(face as u32) {
            map.lines
                .push(line(topology, count, coarse.topology().ends(half), points));
        }
    }
    map
}

/// The points of an edge of the net before all levels.
fn line(topology: &Topology, count: u32, [from, to]: [u32; 2], points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    for mut half in topology.fan(from).spokes {
        let mut found = vec![points[from as usize]];
        loop {
            let head = topology.head(half);
            found.push(points[head as usize]);
            if head < count {
                break;
            }
            let next = topology.next(half);
            half = topology.twin(next).map_or(next, |twin| topology.next(twin));
        }
        if topology.head(half) == to {
            return found;
        }
    }
    Vec::new()
}

/// The points of a hybrid star: corners, and sectors from Lemma 3.
fn polygon(spokes: &Spokes, net: &Net, star: &Star) -> Result<Vec<[f64; 2]>, Error> {
    let n = spokes.valence();
    let beta = crate::NGon::new(spokes.intervals())?.beta().to_vec();
    let corner = |i: usize| {
        [
            f64::cos_turn((i % n) as i64, n as i64),
            f64::sin_turn((i % n) as i64, n as i64),
        ]
    };
    let mut centre = [0.0; 2];
    for (i, weight) in beta.iter().enumerate() {
        let at = corner(i);
        centre = [centre[0] + weight * at[0], centre[1] + weight * at[1]];
    }
    let minus = |a: [f64; 2]| [a[0] - centre[0], a[1] - centre[1]];
    // E_i lies on the edge of corners i and i+1
    let edge = |i: usize| {
        let (own, other) = (spokes.d(i as isize), spokes.d(i as isize + 2));
        let (p, q) = (corner(i), corner(i + 1));
        minus([0, 1].map(|k| (own * q[k] + other * p[k]) / (own + other)))
    };
    let parts = lemmas::sector_points();
    let topology = net.topology();
    let mut points = vec![[0.0; 2]; topology.vertex_count()];
    for face in 0..star.mesh().face_count() {
        let (sector, b, a) = (face / (RINGS * RINGS), face / RINGS % RINGS, face % RINGS);
        let [p, v, w] = [minus(corner(sector)), edge(sector + n - 1), edge(sector)];
        let half = topology.face_halves(face as u32).start;
        for (k, (j, l)) in [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)].into_iter().enumerate() {
            let [x, y, z] = parts[j + 1][l + 1].each_ref().map(<f64 as Scalar>::rational);
            points[topology.origin(half + k as u32) as usize] =
                [0, 1].map(|axis| x * p[axis] + y * v[axis] + z * w[axis]);
        }
    }
    Ok(points)
}

/// The points of a star under the schemes around vertices, and the eigenvalues.
fn vertex_map(scheme: Scheme, spokes: &Spokes, star: &Star) -> Result<([f64; 2], Vec<[f64; 2]>), Error> {
    let n = spokes.valence();
    let (factors, near): ([f64; 2], Vec<[f64; 2]>) = match scheme {
        Scheme::EigenPolyhedron => {
            let polyhedron = EigenPolyhedron::new(spokes.intervals())?;
            // the fixed point of the scheme is V-/(1 - lambda)
            let fixed = polyhedron.centre.map(|x| x / (1.0 - polyhedron.lambda));
            let points = polyhedron.points().into_iter();
            let relative = points.map(|p| [p[0] - fixed[0], p[1] - fixed[1]]);
            ([polyhedron.lambda; 2], relative.collect())
        }
        _ => by_eigenvectors(spokes)?,
    };
    let net = Net::new(star.mesh())?;
    let step = match scheme {
        Scheme::EigenPolyhedron => crate::eigen_polyhedron_step(&net),
        _ => crate::nurss_step(&net),
    }
    .map_err(Error::of_spokes)?;
    let topology = net.topology();
    // the row of the point that is point (a, b) of a sector at the next level
    let row = |i: usize, a: usize, b: usize| -> usize {
        let corner = star.point(i, a / 2, b / 2);
        let (right, above) = (star.point(i, a / 2 + a % 2, b / 2), star.point(i, a / 2, b / 2 + b % 2));
        let (vertices, edges) = (topology.vertex_count(), topology.edge_count());
        let between = |from: u32, to: u32| {
            let edges = (0..edges as u32).find(|&edge| {
                let ends = topology.edge_points(edge);
                ends == [from, to] || ends == [to, from]
            });
            vertices + edges.expect("points of a star are joined") as usize
        };
        match (a % 2, b % 2) {
            (0, 0) => corner as usize,
            (1, 0) => between(corner, right),
            (0, _) => between(corner, above),
            _ => vertices + edges + i * RINGS * RINGS + (b / 2) * RINGS + a / 2,
        }
    };
    let places = |ring: usize| (1..=ring).flat_map(move |a| (0..=ring).map(move |b| (a, b)));
    let mut points = vec![[0.0; 2]; star.mesh().points().len()];
    points[0] = near[0];
    let mut unknown = Vec::new();
    for i in 0..n {
        points[star.point(i, 1, 0) as usize] = near[1 + i];
        points[star.point(i, 1, 1) as usize] = near[1 + n + i];
        let further = places(RINGS).filter(|&(a, b)| (a, b) != (1, 0) && (a, b) != (1, 1));
        unknown.extend(further.map(|(a, b)| (star.point(i, a, b), row(i, a, b))));
    }
    let size = unknown.len();
    let place = |point: usize| unknown.iter().position(|(at, _)| *at as usize == point);
    for (axis, factor) in factors.into_iter().enumerate() {
        let (mut system, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (k, &(_, row)) in unknown.iter().enumerate() {
            system[(k, k)] += factor;
            for (at, weight) in step.table.row(row) {
                match place(at) {
                    Some(column) => system[(k, column)] -= *weight,
                    None => right[k] += weight * points[at][axis],
                }
            }
        }
        // further eigenvalues are 1/8 and less
        if let Some(solved) = system.lu().solve(&right) {
            for (k, &(point, _)) in unknown.iter().enumerate() {
                points[point as usize][axis] = solved[k];
            }
        }
    }
    Ok((factors, points))
}

/// Eigenvectors of NURSS, each of largest coordinate 1, such that spokes turn counter-clockwise.
fn by_eigenvectors(spokes: &Spokes) -> Result<([f64; 2], Vec<[f64; 2]>), Error> {
    let block = Block::Real(nurss::matrix::<f64>(spokes)?);
    let mut values: Vec<f64> = block.eigenvalues()?.iter().map(|value| value.value.re).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
    for &value in values.iter().skip(1) {
        if found.len() < 2 {
            let space = block.eigenspace(Complex::real(value), 0)?;
            for vector in space.right {
                let vector: Vec<f64> = vector.into_iter().map(|entry| entry.re).collect();
                let size = vector.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                found.push((value, vector.into_iter().map(|x| x / size).collect()));
            }
        }
    }
    let [(first, x), (second, y), ..] = found.as_slice() else {
        return Err(Error::Range {
            what: "subdominant eigenvalue",
            given: "complex".to_owned(),
            accepted: "a real one, or two".to_owned(),
        });
    };
    let n = spokes.valence();
    let at = |i: usize| [x[1 + i % n] - x[0], y[1 + i % n] - y[0]];
    let turns: f64 = (0..n).map(|i| at(i)[0] * at(i + 1)[1] - at(i)[1] * at(i + 1)[0]).sum();
    let sign = turns.signum();
    Ok((
        [*first, *second],
        x.iter().zip(y).map(|(x, y)| [*x, sign * y]).collect(),
    ))
}
