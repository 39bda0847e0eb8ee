//! Control meshes to begin with.

use crate::features::edge;
use crate::{Mesh, Topology};
use nalgebra::Point3;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// A mesh of faces that name their points correctly.
fn mesh(points: Vec<Point3<f64>>, faces: impl IntoIterator<Item = Vec<u32>>) -> Mesh {
    let mut mesh = Mesh::of_points(points);
    for face in faces {
        mesh.push_corners(&face);
    }
    mesh
}

fn on_circle(radius: f64, turn: f64, z: f64) -> Point3<f64> {
    let (sin, cos) = (TAU * turn).sin_cos();
    Point3::new(radius * cos, radius * sin, z)
}

/// The surface of a set of unit cubes, each named by its least corner. Cubes must not touch along an edge or
/// in a point only.
fn cubes(filled: impl IntoIterator<Item = [i32; 3]>) -> Mesh {
    let filled: BTreeSet<[i32; 3]> = filled.into_iter().collect();
    let mut numbers: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for &cube in &filled {
        for axis in 0..3 {
            for side in [-1, 1] {
                let mut beside = cube;
                beside[axis] += side;
                if filled.contains(&beside) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut corners: Vec<u32> = [(0, 0), (1, 0), (1, 1), (0, 1)]
                    .into_iter()
                    .map(|(a, b)| {
                        let mut corner = cube;
                        corner[axis] += i32::from(side > 0);
                        corner[u] += a;
                        corner[v] += b;
                        *numbers.entry(corner).or_insert_with(|| {
                            points.push(Point3::from(corner.map(f64::from)));
                            points.len() as u32 - 1
                        })
                    })
                    .collect();
                if side < 0 {
                    corners.reverse();
                }
                faces.push(corners);
            }
        }
    }
    mesh(points, faces)
}

/// A cube of side 2 around the origin.
pub fn cube() -> Mesh {
    let mut cube = cubes([[0, 0, 0]]);
    for point in cube.points_mut() {
        *point = Point3::from(point.coords * 2.0 - nalgebra::Vector3::repeat(1.0));
    }
    cube
}

/// A tetrahedron on the corners of a cube of side 2.
pub fn tetrahedron() -> Mesh {
    let points = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    mesh(points.map(Point3::from).to_vec(), faces.map(|face| face.to_vec()))
}

/// A torus of `around` by `across` quads with the radii 2 and 1.
pub fn torus(around: usize, across: usize) -> Mesh {
    let points = (0..around).flat_map(|i| {
        (0..across).map(move |j| {
            let (sin, cos) = (TAU * j as f64 / across as f64).sin_cos();
            on_circle(2.0 + cos, i as f64 / around as f64, sin)
        })
    });
    let at = |i: usize, j: usize| (i % around * across + j % across) as u32;
    let faces = (0..around)
        .flat_map(|i| (0..across).map(move |j| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    mesh(points.collect(), faces.collect::<Vec<_>>())
}

/// How a star is curved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StarKind {
    /// Like a bowl, `z = r^2 / (4 rings)`.
    Convex,
    /// Like a saddle, `z = (x^2 - y^2) / (4 rings)`.
    Saddle,
    /// In a plane.
    Flat,
}

/// Moves each coordinate of each point by at most `size`, the same for the same `seed`: the generator
/// SplitMix64 (Steele, Lea and Flood 2014).
pub fn disturbed(mut mesh: Mesh, size: f64, seed: u64) -> Mesh {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    for point in mesh.points_mut() {
        for k in 0..3 {
            point[k] += size * next();
        }
    }
    mesh
}

/// A disc of `rings` rings of quads around a vertex of valence `n`.
pub fn star(n: usize, rings: usize, kind: StarKind) -> Mesh {
    let mut points = vec![Point3::origin()];
    let mut numbers = BTreeMap::new();
    for sector in 0..n {
        let (own, next) = (
            on_circle(1.0, sector as f64 / n as f64, 0.0),
            on_circle(1.0, (sector + 1) as f64 / n as f64, 0.0),
        );
        for (a, b) in (1..=rings).flat_map(|a| (0..=rings).map(move |b| (a, b))) {
            let plane = own.coords * a as f64 + next.coords * b as f64;
            numbers.insert((sector, a, b), points.len() as u32);
            let square = match kind {
                StarKind::Convex => plane.norm_squared(),
                StarKind::Saddle => plane.x * plane.x - plane.y * plane.y,
                StarKind::Flat => 0.0,
            };
            points.push(Point3::new(plane.x, plane.y, square / (4 * rings) as f64));
        }
    }
    let at = |sector: usize, a: usize, b: usize| match (a, b) {
        (0, 0) => 0,
        (0, b) => numbers[&((sector + 1) % n, b, 0)],
        _ => numbers[&(sector, a, b)],
    };
    let mut faces = Vec::new();
    for (sector, a, b) in (0..n).flat_map(|s| (0..rings).flat_map(move |a| (0..rings).map(move |b| (s, a, b)))) {
        faces.push(vec![
            at(sector, a, b),
            at(sector, a + 1, b),
            at(sector, a + 1, b + 1),
            at(sector, a, b + 1),
        ]);
    }
    mesh(points, faces)
}

/// A box of `size` unit cubes.
pub fn brick(size: [usize; 3]) -> Mesh {
    let [x, y, z] = size.map(|n| n as i32);
    cubes((0..x).flat_map(|i| (0..y).flat_map(move |j| (0..z).map(move |k| [i, j, k]))))
}

/// A plate with three holes: genus 3.
pub fn triple_torus() -> Mesh {
    let hole = |i: i32, j: i32| j == 1 && i % 2 == 1;
    cubes(
        (0..7)
            .flat_map(|i| (0..3).map(move |j| [i, j, 0]))
            .filter(|&[i, j, _]| !hole(i, j)),
    )
}

/// A hub of `n` sides with a turned blade on each of them.
pub fn propeller(n: usize) -> Mesh {
    let turn = |i: usize| i as f64 / n as f64;
    let mut points = Vec::new();
    for z in [-0.3, 0.3] {
        points.extend((0..n).map(|i| on_circle(1.0, turn(i), z)));
    }
    // a blade's end is turned about its own axis
    for i in 0..n {
        let middle = (turn(i) + turn(i + 1)) / 2.0;
        let axis = on_circle(1.0, middle, 0.0).coords;
        let across = nalgebra::Vector3::z().cross(&axis);
        let tilted = (across + nalgebra::Vector3::z()).normalize();
        let thin = axis.cross(&tilted);
        for (a, b) in [(-0.5, -0.12), (0.5, -0.12), (0.5, 0.12), (-0.5, 0.12)] {
            points.push(Point3::from(axis * 3.0 + tilted * a + thin * b));
        }
    }
    let (low, high) = (|i: usize| (i % n) as u32, |i: usize| (n + i % n) as u32);
    let mut faces = vec![(0..n).rev().map(low).collect::<Vec<u32>>(), (0..n).map(high).collect()];
    for i in 0..n {
        let root = [low(i), low(i + 1), high(i + 1), high(i)];
        let end = [0, 1, 2, 3].map(|k| (2 * n + 4 * i + k) as u32);
        for k in 0..4 {
            let next = (k + 1) % 4;
            faces.push(vec![root[k], root[next], end[next], end[k]]);
        }
        faces.push(end.to_vec());
    }
    mesh(points, faces)
}

/// A wheel of `n` teeth with a hole.
pub fn gear(n: usize) -> Mesh {
    let count = 4 * n;
    let radius = |i: usize| if i % 4 < 2 { 3.0 } else { 2.2 };
    let mut points = Vec::new();
    for z in [-0.5, 0.5] {
        points.extend((0..count).map(|i| on_circle(radius(i), i as f64 / count as f64, z)));
        points.extend((0..count).map(|i| on_circle(1.0, i as f64 / count as f64, z)));
    }
    let at = |level: usize, inside: usize, i: usize| (level * 2 * count + inside * count + i % count) as u32;
    let mut faces = Vec::new();
    for i in 0..count {
        faces.push(vec![at(1, 1, i), at(1, 0, i), at(1, 0, i + 1), at(1, 1, i + 1)]);
        faces.push(vec![at(0, 1, i + 1), at(0, 0, i + 1), at(0, 0, i), at(0, 1, i)]);
        faces.push(vec![at(0, 0, i), at(0, 0, i + 1), at(1, 0, i + 1), at(1, 0, i)]);
        faces.push(vec![at(0, 1, i + 1), at(0, 1, i), at(1, 1, i), at(1, 1, i + 1)]);
    }
    mesh(points, faces)
}

/// A ring with a stone: a torus with a block of two by two quads raised from its outside, whose corners have
/// valence 5 below and 3 above. Knot intervals are 3 along and across the block, and 1 elsewhere.
pub fn ring() -> Mesh {
    let (around, across) = (16, 8);
    let point = |i: usize, j: usize| {
        let (turn, (sin, cos)) = (i as f64 / around as f64, (TAU * j as f64 / across as f64).sin_cos());
        on_circle(2.0 + 0.55 * cos, turn, 0.55 * sin)
    };
    let at = |i: usize, j: usize| (i % around * across + j % across) as u32;
    let mut points: Vec<Point3<f64>> = (0..around * across).map(|k| point(k / across, k % across)).collect();
    // the block stands on quads i = 0, 1 and j = -1, 0, of which the middle looks along the x axis
    let first = around - 1;
    let raised = |i: usize, j: usize| {
        let foot = points[at(first + i, across - 1 + j) as usize];
        Point3::new(3.15 - 0.1 * (foot.y.abs() + foot.z.abs()), 0.8 * foot.y, 0.8 * foot.z)
    };
    let top: Vec<Point3<f64>> = (0..9).map(|k| raised(k / 3, k % 3)).collect();
    let above = |i: usize, j: usize| (around * across + 3 * i + j) as u32;
    points.extend(top);
    let on_block = |i: usize, j: usize| (i == around - 1 || i == 0) && (j == across - 1 || j == 0);
    let mut faces = Vec::new();
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        if !on_block(i, j) {
            faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    for (i, j) in (0..2).flat_map(|i| (0..2).map(move |j| (i, j))) {
        faces.push(vec![above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1)]);
    }
    let foot = |i: usize, j: usize| at(first + i, across - 1 + j);
    // the rim of the block, counter-clockwise
    let rim = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
    for (k, &(i, j)) in rim.iter().enumerate() {
        let (a, b) = rim[(k + 1) % rim.len()];
        faces.push(vec![foot(i, j), foot(a, b), above(a, b), above(i, j)]);
    }
    let mut mesh = mesh(points, faces);
    for k in 0..2 {
        mesh.features
            .knots
            .insert(crate::features::edge(above(k, 0), above(k + 1, 0)), 3.0);
        mesh.features
            .knots
            .insert(crate::features::edge(above(0, k), above(0, k + 1)), 3.0);
    }
    mesh.without_unused()
}

/// A helmet: the upper part of a box with a crest, bent to a dome. Corners have valence 3, the ends of the
/// crest's foot valence 5. Knot intervals are 8 across the crest, and 1 elsewhere.
pub fn helmet() -> Mesh {
    let block = (0..6).flat_map(|i| (0..5).flat_map(move |j| (0..3).map(move |k| [i, j, k])));
    let crest = (1..5).map(|i| [i, 2, 3]);
    let mut mesh = cubes(block.chain(crest));
    let low = |mesh: &Mesh, face: &[u32]| face.iter().all(|&v| mesh.points()[v as usize].z == 0.0);
    let faces: Vec<Vec<u32>> = mesh
        .faces()
        .filter(|face| !low(&mesh, face))
        .map(<[u32]>::to_vec)
        .collect();
    let number = |mesh: &Mesh, p: [f64; 3]| mesh.points().iter().position(|q| *q == Point3::from(p));
    let knot = [2.0, 3.0].map(|y| number(&mesh, [2.0, y, 4.0]).unwrap_or(0) as u32);
    for p in mesh.points_mut() {
        let raised = (p.z - 3.0).max(0.0);
        // from a box to a ball: a direction and the largest coordinate
        let q = nalgebra::Vector3::new((p.x - 3.0) / 3.0, (p.y - 2.5) / 2.5, p.z.min(3.0) / 3.0);
        let ball = q.normalize() * q.amax();
        let bent = 0.25 * q + 0.75 * ball;
        let out = 1.0 + 0.16 * raised;
        *p = Point3::new(3.0 * bent.x * out, 2.3 * bent.y, 2.6 * bent.z * out);
    }
    let mut made = self::mesh(mesh.points().to_vec(), faces);
    made.features.knots.insert(crate::features::edge(knot[0], knot[1]), 8.0);
    made.without_unused()
}

/// Quads split `n x n`, bilinearly. Vertices keep their numbers.
fn split(coarse: &Mesh, n: usize) -> Mesh {
    let mut numbers: BTreeMap<Vec<(u32, usize)>, u32> = BTreeMap::new();
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for face in coarse.faces() {
        let mut at = |i: usize, j: usize| {
            let weights = [(n - i) * (n - j), i * (n - j), i * j, (n - i) * j];
            let mut key: Vec<(u32, usize)> = face.iter().copied().zip(weights).filter(|(_, w)| *w > 0).collect();
            key.sort_unstable();
            *numbers.entry(key).or_insert_with_key(|key| {
                let terms = key.iter().map(|&(v, w)| coarse.points()[v as usize].coords * w as f64);
                points.push(Point3::from(terms.sum::<nalgebra::Vector3<f64>>() / (n * n) as f64));
                points.len() as u32 - 1
            })
        };
        for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
            faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh(points, faces)
}

/// A regular n-gon of circumradius 1 around (0.3, 0.4), of n quads around its middle, each split in four.
pub fn fan(n: usize) -> Mesh {
    split_fan(n, 2)
}

/// The same, each quad split `parts x parts`.
pub fn split_fan(n: usize, parts: usize) -> Mesh {
    let centre = nalgebra::Vector3::new(0.3, 0.4, 0.0);
    let corner = |i: usize| on_circle(1.0, (i as f64 + 0.5) / n as f64, 0.0) + centre;
    let mut points = vec![Point3::from(centre)];
    points.extend((0..n).map(corner));
    points.extend((0..n).map(|i| nalgebra::center(&corner(i), &corner(i + n - 1))));
    let at = |i: usize| (1 + i % n) as u32;
    let middle = |i: usize| (1 + n + i % n) as u32;
    split(
        &mesh(points, (0..n).map(|i| vec![0, middle(i), at(i), middle(i + 1)])),
        parts,
    )
}

/// [`fan`] with these knot intervals on the edges at its middle, in turn and counter-clockwise, repeated if
/// there are fewer than n; strips of other edges have 1.
pub fn uneven_fan(n: usize, intervals: &[f64]) -> Mesh {
    let mut mesh = fan(n);
    let topology = Topology::unchecked(&mesh);
    // splitting keeps the numbers of vertices, of which the middle is the first
    let spokes = topology.fan(0).spokes;
    let knots = spokes.iter().zip(intervals.iter().cycle());
    mesh.features.knots = knots
        .map(|(&spoke, &interval)| (edge(0, topology.head(spoke)), interval))
        .collect();
    mesh
}

/// The unit square with inner vertices of valence 5, 3, 5, 3: a 4 x 3 grid with one edge turned, inner
/// vertices moved to the mean of their neighbours, each face split 4 x 4.
pub fn square3355() -> Mesh {
    split_square3355(4)
}

/// The same, each face split `parts x parts`.
pub fn split_square3355(parts: usize) -> Mesh {
    let at = |i: u32, j: u32| j * 5 + i;
    let points = (0..4).flat_map(|j| (0..5).map(move |i| Point3::new(f64::from(i) / 4.0, f64::from(j) / 3.0, 0.0)));
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for (j, i) in (0..3).flat_map(|j| (0..4).map(move |i| (j, i))) {
        faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    // the edge between the two middle faces of the middle row joins other corners of their hexagon
    let (low, high) = (at(2, 1), at(2, 2));
    let hexagon = [at(1, 1), low, at(3, 1), at(3, 2), high, at(1, 2)];
    faces.retain(|face| !(face.contains(&low) && face.contains(&high)));
    faces.push(vec![hexagon[0], hexagon[1], hexagon[2], hexagon[3]]);
    faces.push(vec![hexagon[3], hexagon[4], hexagon[5], hexagon[0]]);
    let mut coarse = mesh(points.collect(), faces);
    let topology = crate::Topology::unchecked(&coarse);
    for _ in 0..2000 {
        let old = coarse.points().to_vec();
        for vertex in 0..old.len() as u32 {
            let fan = topology.fan(vertex);
            if fan.is_closed() {
                let sum: nalgebra::Vector3<f64> = fan
                    .spokes
                    .iter()
                    .map(|&spoke| old[topology.head(spoke) as usize].coords)
                    .sum();
                coarse.points_mut()[vertex as usize] = Point3::from(sum / fan.spokes.len() as f64);
            }
        }
    }
    split(&coarse, parts)
}

/// A planar mesh with curved lines: each vertex is moved by `size (sin(2y + 1), sin(3x - 1/2))`.
pub fn warped(mut mesh: Mesh, size: f64) -> Mesh {
    for p in mesh.points_mut() {
        let [x, y] = [p.x, p.y];
        p.x += size * (2.0 * y + 1.0).sin();
        p.y += size * (3.0 * x - 0.5).sin();
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Facts, Topology};

    #[test]
    fn shapes_are_surfaces_of_their_genus() {
        let check = |name: &str, mesh: Mesh, genus: i64, loops: usize| {
            let topology = Topology::new(&mesh).unwrap_or_else(|defects| panic!("{name}: {defects:?}"));
            let facts = Facts::of(&mesh, &topology);
            assert_eq!(
                (facts.genus, facts.boundary_loops.len(), facts.components),
                (genus, loops, 1),
                "{name}"
            );
            facts
        };
        check("cube", cube(), 0, 0);
        check("tetrahedron", tetrahedron(), 0, 0);
        check("torus", torus(12, 8), 1, 0);
        check("triple torus", triple_torus(), 3, 0);
        check("brick", brick([3, 2, 1]), 0, 0);
        check("propeller", propeller(3), 0, 0);
        check("gear", gear(8), 1, 0);
        for n in [3, 5, 8] {
            let facts = check("star", star(n, 2, StarKind::Saddle), 0, 1);
            assert_eq!(facts.valences.get(&n).copied().unwrap_or(0), 1);
            check("fan", fan(n), 0, 1);
        }
        let facts = check("square3355", square3355(), 0, 1);
        assert_eq!((facts.valences[&3], facts.valences[&5]), (2, 2));
        // outwards: the volume is positive
        for mesh in [
            cube(),
            tetrahedron(),
            torus(12, 8),
            triple_torus(),
            propeller(3),
            gear(8),
        ] {
            let volume: f64 = mesh
                .faces()
                .flat_map(|face| {
                    let p = |i: usize| mesh.points()[face[i] as usize].coords;
                    (1..face.len() - 1)
                        .map(move |i| p(0).dot(&p(i).cross(&p(i + 1))))
                        .collect::<Vec<_>>()
                })
                .sum();
            assert!(volume > 0.0);
        }
    }
}
