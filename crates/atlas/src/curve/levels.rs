//! Levels of refinement as tables, within what a table can hold.

use super::MOST_POINTS;
use crate::error::Error;
use crate::table::Table;
use eigenring_spline::curve::{Axis, Curve, Ends};

/// Levels beyond this are closer to the limit than its rounding errors.
const MOST_LEVELS: u32 = 30;

/// The number of points after some levels, as a float: it need not fit.
pub fn count_after(axis: &Axis, levels: u32) -> f64 {
    let beyond = match axis.ends() {
        Ends::Open | Ends::Clamped => axis.order() - 1,
        Ends::Closed => 0,
    };
    f64::from(levels).exp2() * axis.intervals() as f64 + beyond as f64
}

/// Refuses more levels than a table of all their points holds; `count` is the number of points after so many
/// levels.
pub fn check(levels: usize, count: impl Fn(u32) -> f64) -> Result<u32, Error> {
    let fits = |level: &u32| count(*level) <= MOST_POINTS as f64;
    let Some(most) = (0..=MOST_LEVELS).rev().find(fits) else {
        return Err(Error::Range {
            what: "number of control points",
            given: count(0).to_string(),
            accepted: format!("at most {MOST_POINTS}"),
        });
    };
    match u32::try_from(levels) {
        Ok(levels) if levels <= most => Ok(levels),
        _ => Err(Error::Range {
            what: "number of levels",
            given: levels.to_string(),
            accepted: format!("0 to {most} for {} control points", count(0)),
        }),
    }
}

/// Refuses more samples per interval than a table holds.
pub fn check_samples(samples: usize, intervals: usize) -> Result<(), Error> {
    let most = (MOST_POINTS / intervals.max(1)).max(1);
    if (1..=most).contains(&samples) {
        return Ok(());
    }
    Err(Error::Range {
        what: "number of samples",
        given: samples.to_string(),
        accepted: format!("1 to {most} per interval for {intervals} intervals"),
    })
}

/// The names of coordinates.
pub fn coordinates(dimension: usize) -> Vec<String> {
    match dimension {
        1..=3 => ["x", "y", "z"].into_iter().take(dimension).map(str::to_owned).collect(),
        _ => (1..=dimension).map(|i| format!("x{i}")).collect(),
    }
}

/// Level, parameter and coordinates of all points of these levels.
pub fn points(levels: &[Curve]) -> Table {
    let dimension = levels.first().map_or(0, Curve::dimension);
    let names = ["level".to_owned(), "parameter".to_owned()];
    let mut table = Table::new(names.into_iter().chain(coordinates(dimension)));
    for curve in levels {
        for (i, point) in curve.points().enumerate() {
            let mut row = vec![(curve.axis().level() as usize).into(), curve.axis().parameter(i).into()];
            row.extend(point.iter().map(|&x| x.into()));
            table.push(row);
        }
    }
    table
}

/// Parameter and coordinates of points of the limit.
pub fn limit(points: &[(f64, Vec<f64>)]) -> Table {
    let dimension = points.first().map_or(0, |(_, point)| point.len());
    let mut table = Table::new(["parameter".to_owned()].into_iter().chain(coordinates(dimension)));
    for (t, point) in points {
        table.push([*t].iter().chain(point).map(|&x| x.into()).collect());
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_refinement() {
        for (order, ends) in [
            (3, Ends::Open),
            (6, Ends::Open),
            (2, Ends::Clamped),
            (6, Ends::Clamped),
            (5, Ends::Closed),
        ] {
            let u0 = if ends == Ends::Clamped { 1.0 } else { 0.5 };
            let mut curve = Curve::new(order, u0, ends, &[[0.0]; 8]).unwrap();
            let axis = curve.axis().clone();
            for level in 0..5 {
                assert_eq!(curve.points().len() as f64, count_after(&axis, level));
                curve = curve.refine().unwrap();
            }
        }
    }

    #[test]
    fn tables_stay_within_memory() {
        let axis = Axis::new(4, 1.0, Ends::Closed, 8).unwrap();
        let levels = |levels| check(levels, |level| count_after(&axis, level));
        assert_eq!(levels(17).unwrap(), 17);
        for bad in [18, 64, usize::MAX] {
            assert_eq!(
                levels(bad).unwrap_err().accepted().unwrap(),
                "0 to 17 for 8 control points"
            );
        }
        assert!(check(0, |_| 1e9).is_err());
        assert!(check_samples(16, 5).is_ok() && check_samples(1, usize::MAX).is_ok());
        assert!(check_samples(0, 5).is_err() && check_samples(MOST_POINTS, 2).is_err());
    }
}
