//! What is true of a scheme, with a margin, statement by statement.

use super::experiment::{Seen, experiment};
use super::local::{Block, Local, turn};
use super::model::{CENTRE, Model};
use super::number::double;
use super::regular::Regular;
use super::spline::{jacobian, winding};
use faer::c64;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Whether a statement is true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Yes, by a margin.
    Holds,
    /// No, by a margin.
    Fails,
    /// Doubles and samples cannot tell.
    Open,
}

/// A statement's truth, and the numbers that show it.
#[derive(Clone, Debug)]
pub struct Fact {
    /// Whether it is true.
    pub truth: Truth,
    /// Why.
    pub why: String,
}

/// An eigenvalue other than the 1 of the constants.
#[derive(Clone, Copy, Debug)]
pub struct Other {
    /// The eigenvalue.
    pub value: c64,
    /// Its Fourier index, at most `n/2`, where there is one.
    pub fourier: Option<usize>,
}

/// Everything that was found out about a scheme at one valence.
pub struct Facts {
    /// The local system.
    pub local: Local,
    /// All eigenvalues but the 1 of the constants, by falling modulus, as often as they occur.
    pub others: Vec<Other>,
    /// Smallest and largest Jacobian of the characteristic map, as parts of the largest modulus.
    pub jacobian: Option<[f64; 2]>,
    /// How often its outer boundary winds round the centre.
    pub winding: Option<i64>,
    /// The largest further eigenvalue over the square of the subdominant one.
    pub ratio: Option<f64>,
    /// What refinement of irregular data showed.
    pub seen: Vec<Seen>,
    facts: BTreeMap<&'static str, Fact>,
}

/// Rows that miss 1 by less may be read as rounded: a dozen weights, each rounded to 12 decimals.
pub const ROUNDED: f64 = 1e-11;
/// Eigenvalues that are farther apart, relatively, are different: a double defective one is only found within
/// some 1e-8.
const APART: f64 = 1e-6;
/// Eigenvalues that are nearer are equal, if they are not chosen to mislead: defective ones of higher order
/// are not.
const EQUAL: f64 = 1e-9;
/// A third eigenvalue between this part of the leading pair and all of it dies out too slowly for the
/// refinements that are made.
const SLOW: f64 = 0.97;
/// Weights with larger denominators may be rounded ones, whose eigenvalues come close without being equal.
const PLAIN: f64 = 1e8;
/// A Jacobian whose smallest sample is this part of the largest keeps its sign between the samples
/// (empirical, 9 x 9 of them).
const ONE_SIGN: f64 = 1e-2;

impl Facts {
    /// Finds out about the scheme of a file at a valence.
    ///
    /// # Errors
    /// A sentence if the file is not understood or its rules cannot be run.
    pub fn new(text: &str, n: usize) -> Result<Facts, String> {
        let local = Local::new(Model::parse(text, n)?)?;
        let blocks = local.blocks();
        let others = others(&blocks);
        let mut facts = Facts {
            local,
            others,
            jacobian: None,
            winding: None,
            ratio: None,
            seen: Vec::new(),
            facts: BTreeMap::new(),
        };
        let spline = facts.degree().filter(|&degree| degree >= 2);
        let map = facts.subdominant_map(&blocks);
        if let (Some(degree), Some(map)) = (spline, &map) {
            let sectors = if facts.local.rotation { 1 } else { n };
            let [low, high] = jacobian(&facts.local, degree, map, sectors, 8);
            let size = low.abs().max(high.abs()).max(1e-300);
            facts.jacobian = Some([low / size, high / size]);
            facts.winding = winding(&facts.local, degree, map, [0.0; 2]);
        }
        if let Some(degree) = spline {
            facts.seen = experiment(&facts.local, degree);
        }
        facts.rows();
        facts.dominant();
        facts.subdominant();
        facts.regular();
        facts.injective();
        facts.c1();
        facts.second_order(&blocks);
        if let Some(map) = map.filter(|_| spline.is_some()) {
            facts.corner(&map);
        }
        Ok(facts)
    }

    /// The degree of the regular part, if it is a B-spline.
    pub fn degree(&self) -> Option<usize> {
        match self.local.regular {
            Regular::Spline(degree) => Some(degree),
            Regular::Other(_) => None,
        }
    }

    /// Whether the regular part is C1 by polynomial patches: nothing is known of maps without.
    pub fn has_patches(&self) -> bool {
        self.degree().is_some_and(|degree| degree >= 2)
    }

    /// What is known of a statement, by the name of its check; `c1` is what refinement shows of the surface.
    pub fn of(&self, name: &str) -> Fact {
        let open = || Fact {
            truth: Truth::Open,
            why: "not looked at".into(),
        };
        self.facts.get(name).cloned().unwrap_or_else(open)
    }

    /// The truth alone.
    pub fn truth(&self, name: &str) -> Truth {
        self.of(name).truth
    }

    /// The largest modulus but the 1 of the constants.
    pub fn radius(&self) -> f64 {
        self.others.first().map_or(0.0, |other| other.value.norm())
    }

    fn say(&mut self, name: &'static str, holds: bool, fails: bool, why: String) {
        let truth = match (holds, fails) {
            (true, false) => Truth::Holds,
            (false, true) => Truth::Fails,
            _ => Truth::Open,
        };
        self.facts.insert(name, Fact { truth, why });
    }

    fn affine(&self) -> bool {
        double(&self.local.defect) <= ROUNDED
    }

    fn rows(&mut self) {
        let defect = double(&self.local.defect);
        self.say(
            "row_sums",
            defect == 0.0,
            defect > ROUNDED,
            format!("a row misses 1 by {defect:e}"),
        );
        let (least, point) = (double(&self.local.smallest.0), self.local.smallest.1);
        let margin = if defect == 0.0 { 0.0 } else { ROUNDED };
        self.say(
            "hull",
            least >= margin,
            least < -margin,
            format!("the smallest weight is {least:e}, in {point:?}"),
        );
    }

    fn dominant(&mut self) {
        let radius = self.radius();
        // an eigenvalue of one row alone is exact
        let fails = radius > 1.0 + EQUAL || self.others.iter().any(|other| other.value == c64::new(1.0, 0.0));
        let holds = radius < 1.0 - EQUAL && self.affine();
        self.say(
            "dominant",
            holds,
            fails,
            format!("the largest other eigenvalue has modulus {radius}"),
        );
    }

    /// The others that have the largest modulus within a relative distance.
    fn leading(&self, within: f64) -> &[Other] {
        let least = self.radius() * (1.0 - within);
        let count = self
            .others
            .iter()
            .take_while(|other| other.value.norm() >= least)
            .count();
        &self.others[..count]
    }

    fn subdominant(&mut self) {
        let (near, wide) = (self.leading(0.1 * APART).to_vec(), self.leading(APART).to_vec());
        let Some(first) = near.first().copied() else {
            return;
        };
        let size = first.value.norm();
        let positive = |other: &Other| other.value.re > 0.0 && other.value.im.abs() <= EQUAL * size;
        let other_sort = |other: &Other| other.value.re < 0.0 || other.value.im.abs() > APART * size;
        let text: Vec<String> = self
            .others
            .iter()
            .take(4)
            .map(|o| format!("{:.9} ({:?})", o.value, o.fourier))
            .collect();
        let why = format!("largest eigenvalues (Fourier index): {}", text.join(", "));
        let in_index = |k: usize| wide.iter().all(|other| other.fourier == Some(k));
        if self.distinct_pair().is_some() {
            self.say("subdominant", size > APART && self.affine(), false, why);
            return;
        }
        let holds = wide.len() == 2 && wide.iter().all(positive) && in_index(1) && self.local.mirror;
        let fails = near.iter().any(other_sort)
            || near.len() >= 3
            || wide.len() == 1
            || wide.len() == 2 && self.local.rotation && !in_index(1);
        self.say("subdominant", holds && size > APART && self.affine(), fails, why);
    }

    /// Two real positive values, apart from each other and from the rest, of rules that differ from sector to
    /// sector.
    fn distinct_pair(&self) -> Option<[f64; 2]> {
        let [first, second, rest @ ..] = self.others.as_slice() else {
            return None;
        };
        let real = |other: &Other| other.value.re > 0.0 && other.value.im == 0.0;
        let apart = |larger: f64, smaller: f64| smaller < larger * (1.0 - APART);
        let (a, b) = (first.value.re, second.value.re);
        let third = rest.first().map_or(0.0, |other| other.value.norm());
        let found = !self.local.rotation && real(first) && real(second) && apart(a, b) && apart(b, third);
        found.then_some([a, b])
    }

    /// The plane map of the leading pair: real and imaginary part of its eigenvector, or two real ones.
    fn subdominant_map(&self, blocks: &[Block]) -> Option<Vec<[f64; 2]>> {
        if let Some(pair) = self.distinct_pair() {
            let block = blocks.iter().find(|block| block.fourier.is_none())?;
            let vector = |value: f64| {
                let (sizes, vectors) = block.singular(c64::new(value, 0.0))?;
                let last = sizes.len() - 1;
                let rows = 0..self.local.points.len();
                // turned so that its largest entry is real
                let raw: Vec<c64> = rows.map(|i| vectors[(i, last)]).collect();
                let largest = raw.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
                Some(raw.iter().map(|entry| (entry / largest).re).collect::<Vec<f64>>())
            };
            let (x, y) = (vector(pair[0])?, vector(pair[1])?);
            return Some(x.into_iter().zip(y).map(|(x, y)| [x, y]).collect());
        }
        let wide = self.leading(APART);
        if wide.len() != 2 || self.radius() < APART {
            return None;
        }
        let first = wide[0];
        if wide[1].fourier != first.fourier {
            return None;
        }
        let block = blocks.iter().find(|block| block.fourier == first.fourier)?;
        let real = first.value.im.abs() <= EQUAL;
        // twice in one real block, or a pair of conjugates; in a complex block each stands for the conjugate
        // one beside it
        let (value, wanted) = match block.fourier {
            Some(_) if block.copies == 2 => (first.value, 1),
            Some(_) => return None,
            None if real => (0.5 * (wide[0].value + wide[1].value), 2),
            None => (first.value, 1),
        };
        let (sizes, vectors) = block.singular(value)?;
        let last = sizes.len() - 1;
        // the vectors of the eigenvalue, and no others
        if sizes[last + 1 - wanted] > 1e-9 || last >= wanted && sizes[last - wanted] < 1e-7 {
            return None;
        }
        let entry = |i: usize, column: usize| vectors[(i, column)];
        if wanted == 2 {
            let rows = 0..self.local.points.len();
            return Some(real_basis(rows.map(|i| [entry(i, last), entry(i, last - 1)]).collect()));
        }
        let Some(k) = block.fourier else {
            let rows = 0..self.local.points.len();
            return Some(rows.map(|i| [entry(i, last).re, entry(i, last).im]).collect());
        };
        let members = self.local.representatives(k);
        let mut map = vec![[0.0; 2]; self.local.points.len()];
        for (i, &member) in members.iter().enumerate() {
            let point = self.local.points[member];
            for sector in 0..self.local.model.n {
                let (re, im) = turn(k * sector, self.local.model.n);
                let value = entry(i, last) * c64::new(re, im);
                map[self.local.index[&self.local.model.turned(point, sector)]] = [value.re, value.im];
            }
        }
        debug_assert!(
            self.local
                .index
                .get(&CENTRE)
                .is_none_or(|&centre| map[centre] == [0.0; 2])
        );
        Some(map)
    }

    fn regular(&mut self) {
        let Some([low, high]) = self.jacobian else {
            return;
        };
        let fails = low < -APART && high > APART;
        let why = format!("the Jacobian is {low:e} to {high:e} of its largest modulus");
        self.say("regular", low > ONE_SIGN || high < -ONE_SIGN, fails, why);
    }

    fn injective(&mut self) {
        let Some(number) = self.winding else {
            return;
        };
        let once = number.abs() == 1;
        let regular = self.truth("regular");
        let why = format!("winding number {number}; {}", self.of("regular").why);
        self.say(
            "injective",
            once && regular == Truth::Holds,
            !once || regular == Truth::Fails,
            why,
        );
    }

    /// `c1`: normals converge, and the ring winds once, for irregular data.
    fn c1(&mut self) {
        if self.seen.is_empty() {
            return;
        }
        let settles = |seen: &Seen| match seen.spread[..] {
            // like 1/m or faster; below a millionth it is rounding
            [_, a, b, c] => c < 1e-6 || c < 0.2 && c < 0.6 * b && b < 0.6 * a,
            _ => false,
        };
        let never = |seen: &Seen| match seen.spread[..] {
            [_, a, b, c] => c > 0.3 && c > 0.9 * b && b > 0.9 * a,
            _ => false,
        };
        let once = |seen: &Seen| seen.winding.is_some_and(|number| number.abs() == 1);
        let twice = |seen: &Seen| settles(seen) && seen.winding.is_some_and(|number| number.abs() != 1);
        let holds = self.seen.iter().all(|seen| settles(seen) && once(seen)) && self.truth("dominant") == Truth::Holds;
        let third = self
            .others
            .get(2)
            .map_or(0.0, |other| other.value.norm() / self.radius());
        let decided = !(SLOW..1.0 - 0.1 * APART).contains(&third);
        let never = self.seen.iter().all(|seen| never(seen) || twice(seen)) && decided;
        let fails = never || self.truth("dominant") == Truth::Fails;
        let spread: Vec<String> = self
            .seen
            .iter()
            .map(|seen| format!("{:.4?} ({:?})", seen.spread, seen.winding))
            .collect();
        self.say(
            "c1",
            holds,
            fails,
            format!("normals of irregular data spread (winding): {}", spread.join(", ")),
        );
    }

    fn second_order(&mut self, blocks: &[Block]) {
        if self.truth("subdominant") == Truth::Fails || !self.affine() || self.leading(APART).len() != 2 {
            return;
        }
        let lambda = self.radius();
        let square = lambda * lambda;
        let rest = &self.others[2..];
        let Some(next) = rest.first() else {
            return;
        };
        let ratio = next.value.norm() / square;
        let tie: Vec<Other> = rest
            .iter()
            .filter(|o| (o.value.norm() / square - 1.0).abs() < APART)
            .copied()
            .collect();
        let defects: Vec<Option<bool>> = tie.iter().map(|other| defective(blocks, other, square)).collect();
        let plain = self.local.denominator <= PLAIN;
        let jordan = defects.contains(&Some(true)) && plain;
        let simple = defects.iter().all(|&defect| defect == Some(false));
        let why = format!("largest other / lambda^2 = {ratio}, Jordan block there: {jordan}");
        let holds = ratio < 1.0 - APART || ratio < 1.0 + 0.1 * EQUAL && simple && plain;
        let fails = ratio > 1.0 + APART || jordan;
        self.ratio = Some(ratio);
        self.say("bounded_curvature", holds && self.has_patches(), fails, why);
        if self.local.rotation {
            self.further(blocks, square);
        }
    }

    /// `non_degenerate` and `strict`, which speak of Fourier indices.
    fn further(&mut self, blocks: &[Block], square: f64) {
        let n = self.local.model.n;
        let wanted = [
            (0, 1),
            if n == 3 {
                (1, 1)
            } else {
                (2, if n == 4 { 2 } else { 1 })
            },
        ];
        let (mut all_equal, mut some_apart, mut mu, mut chosen) = (true, false, f64::INFINITY, Vec::new());
        let mut why = Vec::new();
        for (index, count) in wanted {
            let in_block = |fourier: usize| {
                let others = self
                    .others
                    .iter()
                    .enumerate()
                    .filter(move |(_, other)| other.fourier == Some(fourier));
                // each of index 1..(n-1)/2 is listed twice
                let copies = blocks
                    .iter()
                    .find(|block| block.fourier == Some(fourier))
                    .map_or(1, |block| block.copies);
                others
                    .step_by(copies)
                    .map(|(position, other)| (position, other.value))
                    .collect::<Vec<_>>()
            };
            let skip = usize::from(index == 1);
            let values: Vec<(usize, c64)> = in_block(index).into_iter().skip(skip).collect();
            let distance = |value: c64| (value - c64::new(square, 0.0)).norm() / square;
            let equal = |within: f64| values.iter().filter(|(_, value)| distance(*value) < within).count();
            all_equal &= equal(1e-11) >= count && self.local.denominator <= PLAIN;
            some_apart |= equal(APART) < count;
            let copies = if index == 0 || 2 * index == n { 1 } else { 2 };
            for &(position, value) in values.iter().take(count) {
                mu = mu.min(value.norm());
                chosen.extend(position..position + copies);
                why.push(format!("{:.9} lambda^2 in index {index}", value / square));
            }
        }
        self.say("non_degenerate", all_equal, some_apart, why.join(", "));
        let after = self
            .others
            .iter()
            .enumerate()
            .skip(2)
            .find(|(position, _)| !chosen.contains(position));
        let after = after.map_or(0.0, |(_, other)| other.value.norm());
        let why = format!("the next eigenvalue is {:.9} mu", after / mu);
        self.say("strict", after < mu * (1.0 - APART), after > mu * (1.0 + APART), why);
    }

    /// The angle at F between V and E, at most `pi/2 - pi/(2 n)` (Ma, Wang and Ma 2023, section 4.3).
    fn corner(&mut self, map: &[[f64; 2]]) {
        let at = |x, y| self.local.index.get(&(0, x, y)).map(|&place| map[place]);
        let (Some(e), Some(f), true) = (at(2, 0), at(2, 2), self.local.rotation) else {
            return;
        };
        let (to_v, to_e) = ([-f[0], -f[1]], [e[0] - f[0], e[1] - f[1]]);
        let inner = to_v[0] * to_e[0] + to_v[1] * to_e[1];
        let outer = to_v[0] * to_e[1] - to_v[1] * to_e[0];
        let slack = PI / 2.0 - PI / (2.0 * self.local.model.n as f64) - outer.abs().atan2(inner);
        self.say(
            "corner",
            slack > APART,
            slack < -APART,
            format!("the angle has a slack of {slack}"),
        );
    }
}

/// All eigenvalues but that 1 which is nearest to 1, by falling modulus.
fn others(blocks: &[Block]) -> Vec<Other> {
    let mut others: Vec<Other> = Vec::new();
    let one = c64::new(1.0, 0.0);
    for block in blocks {
        let mut values = block.values.clone();
        if matches!(block.fourier, None | Some(0)) {
            let nearest =
                (0..values.len()).min_by(|&i, &j| (values[i] - one).norm().total_cmp(&(values[j] - one).norm()));
            nearest.map(|nearest| values.remove(nearest));
        }
        let listed = |value: c64| {
            std::iter::repeat_n(
                Other {
                    value,
                    fourier: block.fourier,
                },
                block.copies,
            )
        };
        others.extend(values.into_iter().flat_map(listed));
    }
    // stable: the copies of one eigenvalue stay together
    others.sort_by(|a, b| b.value.norm().total_cmp(&a.value.norm()));
    others
}

/// Whether an eigenvalue of a modulus near the square has a Jordan block; `None` if that cannot be told.
fn defective(blocks: &[Block], other: &Other, square: f64) -> Option<bool> {
    let block = blocks.iter().find(|block| block.fourier == other.fourier)?;
    let near = |value: &&c64| (**value - other.value).norm() < APART * square;
    let cluster: Vec<c64> = block.values.iter().filter(near).copied().collect();
    // the mean of a defective cluster is far more accurate than its members
    let mean = cluster.iter().sum::<c64>() / cluster.len() as f64;
    let (sizes, _) = block.singular(mean)?;
    let vectors = sizes.iter().filter(|&&size| size < 1e-11).count();
    // anything small but not zero may be a near miss
    if sizes.iter().any(|&size| (1e-11..1e-6).contains(&size)) || vectors == 0 {
        return None;
    }
    Some(vectors < cluster.len())
}

/// Two real vectors that span what two complex ones span.
fn real_basis(rows: Vec<[c64; 2]>) -> Vec<[f64; 2]> {
    let column = |part: &dyn Fn(&[c64; 2]) -> f64| rows.iter().map(part).collect::<Vec<f64>>();
    let candidates = [
        column(&|r| r[0].re),
        column(&|r| r[0].im),
        column(&|r| r[1].re),
        column(&|r| r[1].im),
    ];
    let inner = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let longest = |list: &[Vec<f64>]| {
        let by_length = list.iter().max_by(|a, b| inner(a, a).total_cmp(&inner(b, b)));
        let longest = by_length.expect("four candidates").clone();
        let size = inner(&longest, &longest).sqrt();
        longest.iter().map(|x| x / size).collect::<Vec<f64>>()
    };
    let first = longest(&candidates);
    let without = candidates.map(|c| {
        let along = inner(&c, &first);
        c.iter().zip(&first).map(|(c, f)| c - along * f).collect::<Vec<f64>>()
    });
    let second = longest(&without);
    first.into_iter().zip(second).map(|(x, y)| [x, y]).collect()
}
