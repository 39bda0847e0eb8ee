//! What is counted over many sets of knot intervals: maxima of blending functions, where eigen-polyhedra
//! exist, and how near the eigenvalues of HNUSS come to 1/2.

use super::blending::{ALL, SHARE};
use crate::error::Error;
use crate::progress::{Progress, each};
use crate::table::{Cell, Table};
use eigenring_nonuniform::{Blending, EigenPolyhedron, NGon, Spokes, safe_ratio};

/// Whether a pattern, of which bit i is spoke i, is the least of its turns and reflections.
fn is_least(pattern: u32, n: usize) -> bool {
    let bit = |p: u32, i: usize| p >> (i % n) & 1;
    let image = |f: &dyn Fn(usize) -> usize| (0..n).fold(0, |q, i| q | bit(pattern, f(i)) << i);
    (0..n).all(|k| image(&|i| i + k) >= pattern && image(&|i| 2 * n + k - i) >= pattern)
}

/// All sets of the intervals 1 and `ratio` at n spokes in which both occur, up to turns and reflections.
pub fn patterns(n: usize, ratio: f64) -> Vec<Vec<f64>> {
    let both = 1..(1_u32 << n) - 1;
    let intervals = |p: u32| (0..n).map(|i| if p >> i & 1 == 1 { ratio } else { 1.0 }).collect();
    both.filter(|&p| is_least(p, n)).map(intervals).collect()
}

/// Valences and ratios over all of whose patterns maxima are counted, and the levels of the nets.
const VALENCES: [usize; 5] = [3, 5, 6, 7, 8];
const RATIOS: [f64; 2] = [3.0, 10.0];
const LEVELS: usize = 4;

/// For each valence, ratio and scheme: how many patterns there are, for how many the scheme exists, under how
/// many of them the blending function has two maxima or more, and the greatest depth of a second one as a
/// share of the highest value. Next intervals are 1.
///
/// # Errors
/// Those of the schemes, but that of intervals for which there is none.
pub fn maxima(progress: &dyn Progress) -> Result<Table, Error> {
    let mut table = Table::new([
        "valence",
        "ratio",
        "scheme",
        "patterns",
        "exists",
        "several_maxima",
        "deepest",
    ]);
    let mut sets = Vec::new();
    for (n, ratio) in VALENCES.into_iter().flat_map(|n| RATIOS.map(|ratio| (n, ratio))) {
        sets.extend(patterns(n, ratio).into_iter().map(|d| (n, ratio, d)));
    }
    let found = each(progress, "blending functions", &sets, |(n, _, d)| {
        let spokes = Spokes::new(d.clone(), vec![1.0; *n])?;
        let shares = ALL.map(|scheme| match Blending::new(scheme, &spokes, LEVELS) {
            Ok(blending) => {
                let others = blending.others(SHARE).map(|peak| peak.depth / blending.peaks[0].value);
                Ok(Some(others.fold(0.0, f64::max)))
            }
            Err(eigenring_nonuniform::Error::OutsideDomain { .. }) => Ok(None),
            Err(error) => Err(Error::from(error)),
        });
        shares.into_iter().collect::<Result<Vec<Option<f64>>, Error>>()
    })?;
    for (n, ratio) in VALENCES.into_iter().flat_map(|n| RATIOS.map(|ratio| (n, ratio))) {
        for (k, scheme) in ALL.into_iter().enumerate() {
            let own = sets.iter().zip(&found).filter(|((m, r, _), _)| (*m, *r) == (n, ratio));
            let depths: Vec<Option<f64>> = own.map(|(_, shares)| shares[k]).collect();
            let several: Vec<f64> = depths.iter().flatten().copied().filter(|depth| *depth > 0.0).collect();
            let deepest = several.iter().copied().reduce(f64::max);
            table.push(vec![
                n.into(),
                ratio.into(),
                scheme.to_string().into(),
                depths.len().into(),
                depths.iter().flatten().count().into(),
                several.len().into(),
                deepest.map_or(Cell::Empty, Cell::from),
            ]);
        }
    }
    Ok(table)
}

/// The ratio up to which eigen-polyhedra exist for all patterns of two intervals, by bisection, the first
/// pattern for which there is none, and the ratio that is documented as safe.
///
/// # Errors
/// None but those of a table.
pub fn thresholds(progress: &dyn Progress) -> Result<Table, Error> {
    let valences: Vec<usize> = (3..=12).collect();
    let found = each(progress, "thresholds", &valences, |&n| {
        let missing = |ratio: f64| {
            patterns(n, ratio)
                .into_iter()
                .find(|d| EigenPolyhedron::new(d).is_err())
        };
        let (mut low, mut high) = (1.0, 1e6);
        let Some(mut worst) = missing(high) else {
            return Ok::<_, Error>(None);
        };
        while high - low > 1e-9 * low {
            let middle = f64::sqrt(low * high);
            match missing(middle) {
                Some(d) => (high, worst) = (middle, d),
                None => low = middle,
            }
        }
        Ok(Some((low, worst)))
    })?;
    let mut table = Table::new(["valence", "threshold", "documented", "worst"]);
    for (&n, found) in valences.iter().zip(&found) {
        let safe = safe_ratio(n).filter(|ratio| ratio.is_finite());
        let (threshold, worst) = match found {
            // spokes of the larger interval
            Some((ratio, d)) => {
                let large: Vec<String> = (0..n).filter(|&i| d[i] > 1.0).map(|i| i.to_string()).collect();
                (Some(*ratio), large.join(" "))
            }
            None => (None, String::new()),
        };
        table.push(vec![n.into(), threshold.into(), safe.into(), worst.into()]);
    }
    Ok(table)
}

/// Sets of each ratio, of 3 to 20 spokes in turn.
const SETS: usize = 20_000;

/// A fixed sequence of numbers in [0, 1) (SplitMix64; Steele, Lea and Flood 2014).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 2_f64.powi(64)
    }
}

/// Lemma 1 on 10^5 sets: for each ratio the number of sets whose logarithms are uniform up to it, how many
/// have an eigenvalue after 1, 1/2, 1/2 that is not below 1/2 in modulus, the smallest gap `1/2 -
/// |lambda_4|`, its valence, and the least of the bounds that the lemma gives.
///
/// # Errors
/// Those of [`NGon::new`].
pub fn gaps(progress: &dyn Progress) -> Result<Table, Error> {
    let ratios = [2.0, 10.0, 100.0, 1e4, 1e6];
    let found = each(progress, "Lemma 1", &ratios, |&ratio: &f64| {
        let mut sequence = Sequence(2019);
        let (mut violations, mut smallest, mut bound) = (0, (f64::INFINITY, 0), f64::INFINITY);
        for n in (3..=20).cycle().take(SETS) {
            let d: Vec<f64> = (0..n).map(|_| ratio.powf(sequence.next())).collect();
            let ngon = NGon::new(&d)?;
            let gap = ngon.mu().iter().map(|mu| 0.5 - (0.5 - mu).abs()).fold(0.5, f64::min);
            violations += usize::from(gap <= 0.0);
            if gap < smallest.0 {
                smallest = (gap, n);
            }
            bound = f64::min(bound, ngon.gap_bound());
        }
        Ok::<_, Error>((violations, smallest, bound))
    })?;
    let mut table = Table::new(["ratio", "sets", "violations", "smallest_gap", "valence", "least_bound"]);
    for (&ratio, (violations, (gap, n), bound)) in ratios.iter().zip(&found) {
        table.push(vec![
            ratio.into(),
            SETS.into(),
            (*violations).into(),
            (*gap).into(),
            (*n).into(),
            (*bound).into(),
        ]);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bracelets of two colours, both used (OEIS A000029, less 2).
    #[test]
    fn patterns_are_counted_as_bracelets() {
        for (n, count) in [(3, 2), (4, 4), (5, 6), (6, 11), (7, 16), (8, 28), (12, 222)] {
            assert_eq!(patterns(n, 2.0).len(), count, "n = {n}");
        }
    }
}
