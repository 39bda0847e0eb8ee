//! Hatched areas: parallel lines instead of a colour, so that two areas show through each other without a
//! third colour, which nothing would explain.

/// Distance of the lines and their width, in millimetres.
const APART: f64 = 1.1;
pub(crate) const WIDTH: f64 = 0.14;

/// Rising lines in a polygon on the page: the parts of `x + y = c` inside, by the even-odd rule. The same c
/// serve all polygons of a page, so that the lines of neighbours meet.
pub(crate) fn hatch(corners: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let step = APART * std::f64::consts::SQRT_2;
    let sums = || corners.iter().map(|[x, y]| (x + y) / step);
    let (low, high) = (
        sums().fold(f64::INFINITY, f64::min),
        sums().fold(f64::NEG_INFINITY, f64::max),
    );
    if !(low.is_finite() && high.is_finite()) {
        return Vec::new();
    }
    let mut lines = Vec::new();
    for k in low.ceil() as i64..=high.floor() as i64 {
        let beyond = |[x, y]: [f64; 2]| x + y - k as f64 * step;
        let next = corners.iter().cycle().skip(1);
        let crossings = corners.iter().zip(next).filter_map(|(&a, &b)| {
            let (from, until) = (beyond(a), beyond(b));
            let t = from / (from - until);
            ((from < 0.0) != (until < 0.0)).then(|| [0, 1].map(|i| a[i] + t * (b[i] - a[i])))
        });
        let mut crossings: Vec<[f64; 2]> = crossings.collect();
        crossings.sort_by(|a, b| a[0].total_cmp(&b[0]));
        lines.extend(crossings.chunks_exact(2).map(<[_]>::to_vec));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_long_as_the_area_over_their_distance() {
        // a square with a square hole, joined by a slit
        let (outer, inner) = (30.0, 10.0);
        let corners = [
            [0.0, 0.0],
            [outer, 0.0],
            [outer, outer],
            [0.0, outer],
            [0.0, 0.0],
            [5.0, 5.0],
            [5.0, 5.0 + inner],
            [5.0 + inner, 5.0 + inner],
            [5.0 + inner, 5.0],
            [5.0, 5.0],
        ];
        let lines = hatch(&corners);
        let length: f64 = lines.iter().map(|l| (l[0][0] - l[1][0]).hypot(l[0][1] - l[1][1])).sum();
        let expected = (outer * outer - inner * inner) / APART;
        assert!((length / expected - 1.0).abs() < 0.02, "{length} {expected}");
        let in_hole = |p: &[f64; 2]| p.iter().all(|c| (5.0 + 1e-9..15.0 - 1e-9).contains(c));
        assert!(
            lines
                .iter()
                .all(|l| !in_hole(&[(l[0][0] + l[1][0]) / 2.0, (l[0][1] + l[1][1]) / 2.0]))
        );
        assert!(hatch(&[]).is_empty() && hatch(&[[f64::NAN, 0.0]; 3]).is_empty());
    }
}
