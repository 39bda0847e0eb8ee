//! Corners whose rules reproduce the coordinates of the plane.
//!
//! Where four sectors meet, or fewer of an open fan, the net of a tensor-product spline lies in the plane
//! with its sectors as quadrants: point `(a, b)` of sector s at the blossoms of the coordinates (Greville
//! 1967), `a` and `b` intervals along the axes. Halving intervals halves the coordinates: they are two
//! eigenvectors of 1/2, exactly, wherever rules have linear precision. Such a double eigenvalue is
//! semisimple, and no interval can tell that.

use eigenring_scheme::{BigRational, Corner, Exact, Fan, Level, Numbering, Site};
use num_traits::Zero;

/// The coordinates of the points of a numbering, if the rules are proven to halve them.
pub fn coordinates(level: &Level<Exact>, corner: &Corner, numbering: Numbering) -> Option<[Vec<BigRational>; 2]> {
    let sites = numbering.sites();
    let plane = Plane::new(corner)?;
    let points: Vec<[BigRational; 2]> = sites.iter().map(|&site| plane.place(site)).collect();
    let rows = level.rows(&sites).ok()?;
    let two = BigRational::from_integer(2.into());
    for (row, point) in rows.iter().zip(&points) {
        let mut sums = [BigRational::zero(), BigRational::zero()];
        for (&source, weight) in row {
            let (weight, source) = (weight.as_rational()?, &points[numbering.index(source)?]);
            for (sum, coordinate) in sums.iter_mut().zip(source) {
                *sum += &weight * coordinate;
            }
        }
        if (0..2).any(|axis| &sums[axis] * &two != point[axis]) {
            return None;
        }
    }
    Some([0, 1].map(|axis| points.iter().map(|point| point[axis].clone()).collect()))
}

/// Two axes with knot intervals in their four directions.
struct Plane {
    intervals: Vec<BigRational>,
    /// Whether the knots run on across the centre.
    closed: bool,
}

impl Plane {
    fn new(corner: &Corner) -> Option<Self> {
        let spokes = corner.spokes();
        let closed = corner.sectors() == Fan::Closed(4);
        if !(closed || !corner.sectors().is_closed() && spokes.len() <= 4) {
            return None;
        }
        let intervals = spokes.iter().map(|spoke| BigRational::from_float(spoke.interval));
        Some(Plane {
            intervals: intervals.collect::<Option<_>>()?,
            closed,
        })
    }

    /// Along the direction of a spoke, so many steps out.
    fn along(&self, spoke: usize, steps: i32) -> BigRational {
        let own = &self.intervals[spoke % self.intervals.len()];
        if steps > 0 || !self.closed {
            return own * BigRational::from_integer(steps.into());
        }
        // the mean of the three knots around the middle one
        let opposite = &self.intervals[(spoke + 2) % 4];
        (own - opposite) / BigRational::from_integer(3.into())
    }

    fn place(&self, site: Site) -> [BigRational; 2] {
        let s = site.sector;
        // the direction of spoke i is the i-th quarter turn of the first axis
        let (a, b) = (self.along(s, site.x / 2), self.along(s + 1, site.y / 2));
        match s % 4 {
            0 => [a, b],
            1 => [-b, a],
            2 => [-a, -b],
            _ => [b, -a],
        }
    }
}
