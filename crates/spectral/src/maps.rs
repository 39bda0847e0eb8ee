//! Natural configuration, characteristic map and second-order maps.
//!
//! The mode of the subdominant eigenvalue lambda in Fourier index 1, read as points of the complex plane, is
//! the natural configuration; the surface of which it is the net is the characteristic map (Reif 1995),
//! determined by its patches on the [`Annulus`]. The modes of the subsubdominant eigenvalue mu as a third
//! coordinate z make it a second-order map: the cup (index 0) and two saddles (index 2 and N-2). At N = 3
//! index 2 is the conjugate of index 1 and mu its second eigenvalue; at N = 4 both saddles lie in block 2, an
//! edge mode (`E_i = (-1)^i, F_i = 0`) and a face mode.
//!
//! All maps here have `E_0 = 1` (the cup too, the face mode `F_0 = 1`): other normalisations are factors. z
//! as a function of (x, y) has the derivatives of [`Graph`], by the chain rule through the Jacobian.

use crate::{Annulus, Error, LocalSystem, Mode, Natural, PatchIndex, SecondOrder};
use eigenring_scheme::{Complex, Scheme};
use eigenring_spline::Jet;

/// The maps of a scheme: nets over the annulus's numbering.
#[derive(Clone, Debug)]
pub struct Maps {
    /// Where the patches are.
    pub annulus: Annulus,
    /// The subdominant eigenvalue.
    pub lambda: f64,
    /// The natural configuration: x and y of each point.
    pub natural: [Vec<f64>; 2],
    /// The eigenvalues of the second-order maps: cup, first and second saddle.
    pub mu: [f64; 3],
    /// The third coordinates: cup, real part and imaginary part of the saddle mode (N = 4: edge mode, face
    /// mode).
    pub second_order: [Vec<f64>; 3],
}

/// A function given over the plane by a parametric surface (x, y, z): its derivatives with respect to x and
/// y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Graph {
    /// The point below.
    pub x: f64,
    /// The point below.
    pub y: f64,
    /// The height of the map.
    pub z: f64,
    /// The Jacobian `x_u y_v - x_v y_u` of the parametrisation.
    pub jacobian: f64,
    /// First derivatives: by x, by y.
    pub gradient: [f64; 2],
    /// Second derivatives: xx, xy, yy.
    pub hessian: [f64; 3],
}

impl Graph {
    /// The graph at a point from the jets of x, y and z. Not finite where the Jacobian vanishes.
    pub fn new(x: &Jet<f64>, y: &Jet<f64>, z: &Jet<f64>) -> Self {
        let ([xu, xv], [yu, yv]) = (x.first, y.first);
        let jacobian = xu * yv - xv * yu;
        // rows of the inverse Jacobian: derivatives of u and v by x and y
        let (ux, uy, vx, vy) = (yv / jacobian, -xv / jacobian, -yu / jacobian, xu / jacobian);
        let gradient = [z.first[0] * ux + z.first[1] * vx, z.first[0] * uy + z.first[1] * vy];
        // the second derivatives of z that the curvature of the parametrisation does not explain
        let own: [f64; 3] =
            std::array::from_fn(|i| z.second[i] - gradient[0] * x.second[i] - gradient[1] * y.second[i]);
        let form = |(a, b): (f64, f64), (c, d): (f64, f64)| own[0] * a * c + own[1] * (a * d + b * c) + own[2] * b * d;
        let (by_x, by_y) = ((ux, vx), (uy, vy));
        Graph {
            x: x.value,
            y: y.value,
            z: z.value,
            jacobian,
            gradient,
            hessian: [form(by_x, by_x), form(by_x, by_y), form(by_y, by_y)],
        }
    }

    /// `z_xx z_yy - z_xy^2`, the numerator of the Gauss curvature.
    pub fn gauss(&self) -> f64 {
        self.hessian[0] * self.hessian[2] - self.hessian[1] * self.hessian[1]
    }
}

fn real(mode: &Mode) -> Vec<f64> {
    mode.values.iter().map(|v| v.re).collect()
}

fn imaginary(mode: &Mode) -> Vec<f64> {
    mode.values.iter().map(|v| v.im).collect()
}

impl Maps {
    /// The maps of the scheme's limit level, on its innermost regular annulus.
    ///
    /// # Errors
    /// As [`Maps::on`].
    pub fn new(scheme: &Scheme<f64>) -> Result<Self, Error> {
        Maps::on(scheme, Annulus::new(scheme)?)
    }

    /// The maps of the scheme's limit level on an annulus of it.
    ///
    /// # Errors
    /// [`Error::NotSymmetric`] for rules that differ from sector to sector; [`Error::Multiplicity`] or
    /// [`Error::Defective`] where an eigenspace is not what the maps need, [`Error::Scaling`] if a block has
    /// no second eigenvalue.
    pub fn on(scheme: &Scheme<f64>, annulus: Annulus) -> Result<Self, Error> {
        let system = LocalSystem::new(scheme.limit(), annulus.numbering.rings)?;
        if !system.symmetric() {
            return Err(Error::NotSymmetric);
        }
        // the real eigenvalues of a block, by falling modulus, each as often as it has eigenvectors to give
        let eigenvalues = |k: usize| -> Result<Vec<f64>, Error> {
            Ok(system.blocks()[k]
                .eigenvalues()?
                .iter()
                .filter(|e| e.value.im == 0.0)
                .map(|e| e.value.re)
                .collect())
        };
        let Natural {
            lambda,
            points: natural,
        } = system.natural()?;
        let value = |of: SecondOrder, which: usize| -> Result<f64, Error> {
            let values = eigenvalues(of.block)?;
            let found = values.get(of.before + which).copied();
            found.ok_or(Error::Scaling {
                value: 0.0,
                fourier: of.block,
            })
        };
        let [cups, saddles] = SecondOrder::of(system.valence());
        let cup_value = value(cups, 0)?;
        let cup = system.single(cups.block, cup_value)?;
        let first = value(saddles, 0)?;
        let mut saddle_values = [first, first];
        let [re, im] = if saddles.copies == 1 {
            let mode = system.single(2, first)?;
            [real(&mode), imaginary(&mode)]
        } else {
            let mut modes = system.modes(2, Complex::real(first))?;
            if modes.len() == 1 {
                saddle_values[1] = value(saddles, 1)?;
                modes.push(system.single(2, saddle_values[1])?);
            }
            [real(&modes[0]), real(&modes[1])]
        };
        Ok(Maps {
            annulus,
            lambda,
            natural,
            mu: [cup_value, saddle_values[0], saddle_values[1]],
            second_order: [real(&cup), re, im],
        })
    }

    /// The second-order map `which` (0 cup, 1 and 2 saddles) at a point of a patch.
    pub fn graph(&self, which: usize, patch: PatchIndex, u: f64, v: f64) -> Graph {
        let jet = |values: &[f64]| self.annulus.patch(values, patch).jet(u, v);
        Graph::new(
            &jet(&self.natural[0]),
            &jet(&self.natural[1]),
            &jet(&self.second_order[which]),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenring_scheme::families::{catmull_clark, doo_sabin, tension};
    use eigenring_scheme::lambda::{Plane, Relaxation};

    fn points(annulus: &Annulus) -> Vec<(PatchIndex, f64, f64)> {
        let n = annulus.numbering.fan.sectors();
        let patches = (0..n).flat_map(|sector| annulus.patches(sector));
        patches
            .flat_map(|patch| [(0.1, 0.2), (0.5, 0.5), (0.9, 0.4)].map(|(u, v)| (patch, u, v)))
            .collect()
    }

    #[test]
    fn bicubic_splines_have_quadratic_second_order_maps() {
        let maps = Maps::new(&catmull_clark(4).unwrap()).unwrap();
        assert!((maps.lambda - 0.5).abs() < 1e-15);
        for (patch, u, v) in points(&maps.annulus) {
            // x = a + u in sector 0: the parametrisation is the identity there, and every Hessian is constant
            for (which, reference) in (0..3).map(|which| {
                let at = maps.annulus.patches(0).next().unwrap();
                (which, maps.graph(which, at, 0.5, 0.5).hessian)
            }) {
                let graph = maps.graph(which, patch, u, v);
                assert!((graph.jacobian - 1.0).abs() < 1e-12);
                for (found, expected) in graph.hessian.iter().zip(reference) {
                    assert!(
                        (found - expected).abs() < 1e-10,
                        "{which}: {:?} {reference:?}",
                        graph.hessian
                    );
                }
            }
        }
    }

    /// The characteristic map is regular at orders up to 22, even and odd.
    #[test]
    fn characteristic_maps_of_high_orders_are_regular() {
        for (valence, order) in [(3, 22), (7, 12), (3, 15)] {
            let maps = Maps::new(&tension(valence, order, 0.01).unwrap()).unwrap();
            let annulus = &maps.annulus;
            // one sector, by symmetry
            let mut smallest = f64::INFINITY;
            let mut largest = 0.0_f64;
            for patch in annulus.patches(0) {
                let [x, y] = [0, 1].map(|i| annulus.patch(&maps.natural[i], patch));
                for (u, v) in [(0.0, 0.0), (0.5, 0.5), (0.9, 0.1), (0.1, 0.9)] {
                    let (x, y) = (x.jet(u, v), y.jet(u, v));
                    let jacobian = x.first[0] * y.first[1] - x.first[1] * y.first[0];
                    smallest = smallest.min(jacobian);
                    largest = largest.max(jacobian);
                }
            }
            // measured: 0.49 at least
            assert!(
                smallest > 0.01 * largest,
                "N = {valence}, order {order}: {smallest} {largest}"
            );
        }
    }

    #[test]
    fn derivatives_are_differences_over_the_plane() {
        let plane = Relaxation::new(6).unwrap().plane(0.55).unwrap();
        let scheme = plane.stencil(0.25, 0.2).weights.scheme("lambda", 6).unwrap();
        let maps = Maps::new(&scheme).unwrap();
        assert_eq!(maps.annulus.inner, 2);
        let patch = maps.annulus.patches(2).nth(5).unwrap();
        let step = 1e-5;
        for which in 0..3 {
            let at = |u, v| maps.graph(which, patch, u, v);
            let (centre, du, dv) = (
                at(0.4, 0.6),
                [at(0.4 - step, 0.6), at(0.4 + step, 0.6)],
                [at(0.4, 0.6 - step), at(0.4, 0.6 + step)],
            );
            for pair in [du, dv] {
                let (dx, dy) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
                assert!((pair[1].z - pair[0].z - centre.gradient[0] * dx - centre.gradient[1] * dy).abs() < 1e-12);
                for i in 0..2 {
                    let expected = centre.hessian[i] * dx + centre.hessian[i + 1] * dy;
                    let found = pair[1].gradient[i] - pair[0].gradient[i];
                    assert!((found - expected).abs() < 1e-11);
                }
            }
        }
    }

    #[test]
    fn maps_are_self_similar() {
        // the net of a mode refined once is the mode times its eigenvalue: jets of the fine annulus are
        // scaled ones
        let plane = Plane::new(3, 0.5, 1.0).unwrap();
        for scheme in [
            plane.stencil(0.26, 0.33).weights.scheme("lambda", 3).unwrap(),
            tension(5, 6, 1.0).unwrap(),
            catmull_clark(7).unwrap(),
        ] {
            let maps = Maps::new(&scheme).unwrap();
            let numbering = maps.annulus.numbering;
            let nets = maps.natural.iter().map(|net| (net, maps.lambda));
            let nets = nets.chain(maps.second_order.iter().zip(maps.mu));
            for (values, factor) in nets {
                let net = eigenring_scheme::PointNet {
                    numbering,
                    points: values.iter().map(|&v| [v]).collect(),
                };
                let refined = eigenring_scheme::refine(scheme.limit(), &net, &numbering.sites()).unwrap();
                for (refined, value) in refined.iter().zip(values) {
                    assert!((refined[0] - factor * value).abs() < 1e-11, "{}", scheme.name());
                }
            }
        }
    }

    #[test]
    fn jacobians_of_standard_schemes_are_positive() {
        for valence in 3..=12 {
            for scheme in [catmull_clark::<f64>(valence).unwrap(), doo_sabin(valence).unwrap()] {
                let annulus = Annulus::new(&scheme).unwrap();
                let system = LocalSystem::new(scheme.limit(), annulus.numbering.rings).unwrap();
                let lambda = system.blocks()[1].eigenvalues().unwrap()[0].value.re;
                let mode = system.single(1, lambda).unwrap();
                for (patch, u, v) in points(&annulus) {
                    let (x, y) = (
                        annulus.patch(&real(&mode), patch).jet(u, v),
                        annulus.patch(&imaginary(&mode), patch).jet(u, v),
                    );
                    assert!(x.first[0] * y.first[1] - x.first[1] * y.first[0] > 0.0);
                }
            }
        }
    }
}
