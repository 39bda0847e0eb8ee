//! Schemes, meshes and options.

use eigenring_iga::{Dirichlet, Domain, Ends, Options, Study};
use eigenring_nonuniform::{FirstLevel, Outside, Scheme};
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::{Mesh, Point3, Rules, shapes};

pub fn rules(name: &str) -> Rules {
    Rules::new(Definition::Family(name.parse::<Spec>().expect("a scheme")))
}

pub fn warped(mesh: Mesh) -> Mesh {
    shapes::warped(mesh, 0.08)
}

/// Unit squares of n x n faces, the corner of each given.
pub fn squares(n: u32, corners: &[[f64; 2]]) -> Mesh {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for [x, y] in corners {
        let start = points.len() as u32;
        let at = |i: u32, j: u32| start + j * (n + 1) + i;
        for j in 0..=n {
            points.extend((0..=n).map(|i| {
                let (s, t) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                Point3::new(x + s, y + t, 0.0)
            }));
        }
        let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
        faces.extend(cells.flat_map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    }
    Mesh::of_quads(points, faces)
}

/// Nitsche's terms in the place of values at the boundary.
pub fn nitsche() -> Options {
    Options {
        dirichlet: Dirichlet::Nitsche,
        ..Options::default()
    }
}

/// Natural ends.
pub fn natural() -> Options {
    Options {
        ends: Ends::Natural,
        ..Options::default()
    }
}

/// Studies of HNUSS in the plane.
pub fn of_hnuss(mesh: &Mesh) -> Study<'static> {
    let scheme = Scheme::Hnuss(FirstLevel::Improved);
    Study::with_intervals(mesh, scheme, Outside::Error, Domain::Planar).expect("a study")
}
