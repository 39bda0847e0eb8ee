//! Lines that show the quality of a surface: highlight lines, reflection lines, isophotes.
//!
//! With a family of parallel linear lights `A + c C + s B` (B the direction of the lights, C their spacing)
//! the line from X in direction D meets the light `c = (B x D).(X - A) / ((B x D).C)`; stripes are level sets
//! of c. With D the normal they are highlight lines (Beier and Chen, Computer-Aided Design 26(4), 1994), with
//! the view reflected in the normal reflection lines (Klass, Computer-Aided Design 12(2), 1980). Isophotes
//! are level sets of the brightness n.L (Poeschl, Computer Aided Geometric Design 1(2), 1984). On a surface
//! of class G^k such lines are of class k-1: a jump of curvature is a kink.

use nalgebra::{Point3, Vector3};

/// Parallel linear lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lights {
    /// A point of the light number 0.
    pub origin: Point3<f64>,
    /// The direction of all lights.
    pub direction: Vector3<f64>,
    /// From one light to the next.
    pub spacing: Vector3<f64>,
}

impl Lights {
    /// The number of the light that the line from a point in a direction meets; not finite if it meets none.
    pub fn met(&self, point: &Point3<f64>, direction: &Vector3<f64>) -> f64 {
        let across = self.direction.cross(direction);
        across.dot(&(point - self.origin)) / across.dot(&self.spacing)
    }

    /// The highlight line through a point with a normal.
    pub fn highlight(&self, point: &Point3<f64>, normal: &Vector3<f64>) -> f64 {
        self.met(point, normal)
    }

    /// The reflection line through a point, seen from the direction `eye`.
    pub fn reflection(&self, point: &Point3<f64>, normal: &Vector3<f64>, eye: &Vector3<f64>) -> f64 {
        self.met(point, &(normal * (2.0 * normal.dot(eye)) - eye))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a cylinder whose axis is parallel to the lights every line is a generator.
    #[test]
    fn lines_on_a_cylinder_are_its_generators() {
        let lights = Lights {
            origin: Point3::new(0.0, 0.0, 5.0),
            direction: Vector3::x(),
            spacing: Vector3::y(),
        };
        for turn in [0.4, 1.0, 2.0] {
            let normal = Vector3::new(0.0, f64::cos(turn), f64::sin(turn));
            let at = |x: f64| lights.highlight(&Point3::from(Vector3::new(x, 0.0, 0.0) + normal), &normal);
            assert!((at(0.0) - at(3.0)).abs() < 1e-15);
            // the normal's line from the axis meets the plane of lights at height 5
            assert!((at(0.0) - 5.0 * f64::cos(turn) / f64::sin(turn)).abs() < 1e-12);
        }
        // straight above, the reflected view is the view
        let c = lights.reflection(&Point3::new(0.0, 0.3, 0.0), &Vector3::z(), &Vector3::z());
        assert!((c - 0.3).abs() < 1e-15);
    }
}
