//! What a scheme file says, read anew: passes on a fan of `n` sectors, and the rows that they compose to.
//!
//! The file's format is that of the pages for users; nothing here is taken from the library. A point is
//! `(sector, x, y)` in half steps. A special stencil that is given for sector 0 alone holds in every sector,
//! rotated; the centre is one point, and its stencil is what it is: a centre that reads the sectors unequally
//! breaks the symmetry, whatever the file's form.

use super::number::{self, Q};
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use toml::de::{DeArray, DeTable, DeValue};

/// A point of the fan: sector, and half steps along its two spokes; the centre is `(0, 0, 0)`.
pub type Point = (usize, i64, i64);

/// The centre.
pub const CENTRE: Point = (0, 0, 0);

/// The weights of the points that another one is made of.
pub type Row = BTreeMap<Point, Q>;

/// One pass: a rule for regular points, and the points with a stencil of their own in all sectors.
#[derive(Clone, Debug)]
pub struct Pass {
    /// Parity of the coordinates that are made: 0 around a vertex, 1 around a face.
    pub to: i64,
    /// Taps of each class of target points.
    pub line: Vec<Vec<(i64, Q)>>,
    /// Stencils of special points.
    pub special: BTreeMap<Point, Row>,
}

/// A scheme at one valence.
#[derive(Clone, Debug)]
pub struct Model {
    /// The number of sectors.
    pub n: usize,
    /// Parity of the coordinates of the net: 0 around a vertex, 1 around a face.
    pub parity: i64,
    /// The degree that the file states.
    pub stated: usize,
    /// The passes in order.
    pub passes: Vec<Pass>,
}

/// The ring of a point.
pub fn ring(point: Point) -> i64 {
    point.1.max(point.2) / 2
}

type Table<'a> = DeTable<'a>;

fn get<'t, 'a>(table: &'t Table<'a>, key: &str) -> Option<&'t DeValue<'a>> {
    table
        .iter()
        .find(|(name, _)| name.get_ref() == key)
        .map(|(_, value)| value.get_ref())
}

fn text_of(value: &DeValue) -> Option<String> {
    match value {
        DeValue::Integer(i) if i.radix() == 10 => Some(i.as_str().to_owned()),
        DeValue::Float(x) => Some(x.as_str().to_owned()),
        DeValue::String(s) => Some(s.to_string()),
        _ => None,
    }
}

fn weight(value: Option<&DeValue>, what: &str) -> Result<Q, String> {
    let text = value.and_then(text_of).ok_or(format!("{what}: no number"))?;
    number::parse(&text).ok_or(format!("{what}: {text} is no number"))
}

fn integer(value: Option<&DeValue>) -> Option<i64> {
    match value? {
        DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix()).ok(),
        _ => None,
    }
}

fn array<'t, 'a>(table: &'t Table<'a>, key: &str) -> Result<&'t DeArray<'a>, String> {
    get(table, key)
        .and_then(DeValue::as_array)
        .ok_or(format!("{key} is no list"))
}

fn tables<'t, 'a>(table: &'t Table<'a>, key: &str) -> Result<Vec<&'t Table<'a>>, String> {
    let tables = array(table, key)?.iter().map(|value| value.get_ref().as_table());
    tables
        .collect::<Option<_>>()
        .ok_or(format!("{key} is no list of tables"))
}

fn place(table: &Table) -> Result<(i64, i64), String> {
    let at = array(table, "at")?;
    match (
        integer(at.first().map(|v| v.get_ref())),
        integer(at.get(1).map(|v| v.get_ref())),
    ) {
        (Some(x), Some(y)) if at.len() == 2 => Ok((x, y)),
        _ => Err("at is no pair".into()),
    }
}

impl Model {
    /// Reads the rules of valence `n` from the text of a file.
    ///
    /// # Errors
    /// A sentence that says what is not understood.
    pub fn parse(text: &str, n: usize) -> Result<Model, String> {
        let file = DeTable::parse(text).map_err(|error| error.message().to_owned())?;
        let file = file.get_ref();
        let valences = tables(file, "valence")?;
        let of_n = valences
            .into_iter()
            .find(|table| integer(get(table, "n")) == Some(n as i64));
        let table = of_n.ok_or(format!("no valence {n}"))?;
        match get(file, "kind").and_then(DeValue::as_str) {
            Some("one-ring") => one_ring(table, n),
            Some("stencils") => {
                let stated = integer(get(file, "degree")).and_then(|degree| usize::try_from(degree).ok());
                passes(table, n, stated.unwrap_or(3))
            }
            other => Err(format!("kind {other:?}")),
        }
    }

    /// The canonical name of `(x, y)` in the coordinates of a sector. The two rays of the opposite quadrant
    /// continue the neighbours' far spokes; its inside has a meaning only where four sectors meet.
    pub fn fold(&self, sector: usize, x: i64, y: i64) -> Option<Point> {
        let turn = |by: usize| (sector + by) % self.n;
        Some(match (x, y) {
            (0, 0) => CENTRE,
            (1.., 0..) => (turn(0), x, y),
            (..=0, 1..) => (turn(1), y, -x),
            (0.., ..=-1) => (turn(self.n - 1), -y, x),
            (..=-1, 0) => (turn(2), -x, 0),
            _ if self.n == 4 => (turn(2), -x, -y),
            _ => return None,
        })
    }

    /// The same point `by` sectors further on.
    pub fn turned(&self, (sector, x, y): Point, by: usize) -> Point {
        if (x, y) == (0, 0) {
            CENTRE
        } else {
            ((sector + by) % self.n, x, y)
        }
    }

    /// The image under reflection in spoke 0.
    pub fn reflected(&self, (sector, x, y): Point) -> Point {
        match (x, y) {
            (0, 0) => CENTRE,
            (_, 0) => ((self.n - sector) % self.n, x, 0),
            _ => ((2 * self.n - sector - 1) % self.n, y, x),
        }
    }

    /// How a pass makes a point of its target net.
    ///
    /// # Errors
    /// If the rule reads across the centre.
    pub fn stencil(&self, pass: usize, point: Point) -> Result<Row, String> {
        match self.passes[pass].special.get(&point) {
            Some(row) => Ok(row.clone()),
            None => self.tensor(&self.passes[pass].line, point),
        }
    }

    fn tensor(&self, line: &[Vec<(i64, Q)>], point: Point) -> Result<Row, String> {
        let (sector, x, y) = point;
        let scale = line.len() as i64;
        let taps = |x: i64| {
            let class = &line[x.div_euclid(2).rem_euclid(scale) as usize];
            class
                .iter()
                .map(move |(offset, weight)| ((x + offset).div_euclid(scale), weight))
        };
        let mut row = Row::new();
        for (u, in_u) in taps(x) {
            for (v, in_v) in taps(y) {
                let source = self.fold(sector, u, v);
                let source = source.ok_or(format!("the rule of {point:?} reads ({u}, {v})"))?;
                add(&mut row, source, in_u * in_v);
            }
        }
        Ok(row)
    }

    /// The weights of control points in a refined point, all passes together.
    ///
    /// # Errors
    /// If a rule reads across the centre.
    pub fn row(&self, point: Point) -> Result<Row, String> {
        let mut row = Row::from([(point, Q::one())]);
        for pass in (0..self.passes.len()).rev() {
            let mut next = Row::new();
            for (&source, weight) in &row {
                for (from, inner) in self.stencil(pass, source)? {
                    add(&mut next, from, weight * inner);
                }
            }
            row = next;
        }
        row.retain(|_, weight| !weight.is_zero());
        Ok(row)
    }

    /// Whether the special stencils of every pass are the same in all sectors, so that rows turn with their
    /// points.
    pub fn turns(&self) -> bool {
        self.passes.iter().all(|pass| {
            pass.special.iter().all(|(&point, row)| {
                let turned: Row = row
                    .iter()
                    .map(|(&source, weight)| (self.turned(source, 1), weight.clone()))
                    .collect();
                pass.special.get(&self.turned(point, 1)) == Some(&turned)
            })
        })
    }

    /// What the row would be by a line alone.
    pub fn regular_row(&self, line: &[Vec<(i64, Q)>], point: Point) -> Option<Row> {
        let mut row = self.tensor(line, point).ok()?;
        row.retain(|_, weight| !weight.is_zero());
        Some(row)
    }

    /// The points of a ring.
    pub fn ring(&self, r: i64) -> Vec<Point> {
        let mut points = Vec::new();
        if self.parity == 0 && r == 0 {
            return vec![CENTRE];
        }
        for sector in 0..self.n {
            let own = (0..=r).map(|b| (sector, 2 * r + self.parity, 2 * b + self.parity));
            let back = (1 - self.parity..r).rev();
            points.extend(own.chain(back.map(|a| (sector, 2 * a + self.parity, 2 * r + self.parity))));
        }
        points
    }

    /// A ring beyond which no special stencil takes part in anything, and no pass comes round the centre.
    pub fn bound(&self) -> i64 {
        let mut bound = 0;
        for (index, pass) in self.passes.iter().enumerate() {
            // what an earlier pass did is carried outwards
            if index > 0 {
                let reach = pass
                    .line
                    .iter()
                    .flatten()
                    .map(|(offset, _)| offset.abs())
                    .max()
                    .unwrap_or(0);
                bound = (bound * pass.line.len() as i64 + reach / 2 + 1).min(1000);
            }
            bound = pass.special.keys().map(|&point| ring(point)).fold(bound, i64::max);
        }
        bound
    }
}

fn add(row: &mut Row, point: Point, weight: Q) {
    *row.entry(point).or_insert_with(Q::zero) += weight;
}

fn one_ring(table: &Table, n: usize) -> Result<Model, String> {
    let w = |name: &str| weight(get(table, name), name);
    let (f1, f2, f3, d1, d2) = (w("f1")?, w("f2")?, w("f3")?, w("d1")?, w("d2")?);
    let (e1, e2, alpha, beta) = (w("e1")?, w("e2")?, w("alpha")?, w("beta")?);
    let count = number::ratio(n as i64, 1);
    let mut special: BTreeMap<Point, Row> = BTreeMap::new();
    let mut put =
        |point: Point, source: Point, weight: &Q| add(special.entry(point).or_default(), source, weight.clone());
    put(CENTRE, CENTRE, &(Q::one() - &alpha - &beta));
    for i in 0..n {
        let (next, last) = ((i + 1) % n, (i + n - 1) % n);
        put(CENTRE, (i, 2, 0), &(&alpha / &count));
        put(CENTRE, (i, 2, 2), &(&beta / &count));
        let edge = [
            (CENTRE, &d1),
            ((i, 2, 0), &d2),
            ((next, 2, 0), &e1),
            ((last, 2, 0), &e1),
        ];
        edge.into_iter()
            .chain([((i, 2, 2), &e2), ((last, 2, 2), &e2)])
            .for_each(|(p, w)| put((i, 2, 0), p, w));
        let face = [(CENTRE, &f1), ((i, 2, 0), &f2), ((next, 2, 0), &f2), ((i, 2, 2), &f3)];
        face.into_iter().for_each(|(p, w)| put((i, 2, 2), p, w));
    }
    let r = number::ratio;
    let line = vec![
        vec![(-4, r(1, 8)), (0, r(3, 4)), (4, r(1, 8))],
        vec![(-2, r(1, 2)), (2, r(1, 2))],
    ];
    let passes = vec![Pass { to: 0, line, special }];
    Ok(Model {
        n,
        parity: 0,
        stated: 3,
        passes,
    })
}

fn passes(table: &Table, n: usize, stated: usize) -> Result<Model, String> {
    let listed = tables(table, "pass")?;
    let parity = |table: &Table, key: &str| match get(table, key).and_then(DeValue::as_str) {
        Some("vertex") => Ok(0),
        Some("face") => Ok(1),
        other => Err(format!("{key} = {other:?}")),
    };
    let specials = |table: &'_ Table| -> bool {
        let specials = tables(table, "special").unwrap_or_default();
        specials
            .iter()
            .all(|special| integer(get(special, "sector")).unwrap_or(0).rem_euclid(n as i64) == 0)
    };
    let everywhere = listed.iter().all(|table| specials(table));
    let mut model = Model {
        n,
        parity: 0,
        stated,
        passes: Vec::new(),
    };
    let mut net = None;
    for table in listed {
        let (from, to) = (parity(table, "from")?, parity(table, "to")?);
        if net.is_some_and(|net| net != from) {
            return Err("a pass reads another net than is made".into());
        }
        if net.is_none() {
            model.parity = from;
        }
        net = Some(to);
        let line = array(table, "line")?
            .iter()
            .map(|class| taps(class.get_ref()))
            .collect::<Result<Vec<_>, _>>()?;
        let mut pass = Pass {
            to,
            line,
            special: BTreeMap::new(),
        };
        for special in tables(table, "special").unwrap_or_default() {
            let ((x, y), sector) = (place(special)?, integer(get(special, "sector")).unwrap_or(0));
            let rotations = if everywhere && (x, y) != (0, 0) { n } else { 1 };
            for by in 0..rotations {
                let mut row = Row::new();
                for term in tables(special, "stencil")? {
                    let ((a, b), w) = (place(term)?, weight(get(term, "weight"), "weight")?);
                    let sectors = match get(term, "sector") {
                        Some(DeValue::String(word)) if word == "all" => (0..n as i64).collect(),
                        Some(DeValue::String(word)) => return Err(format!("sector {word}")),
                        other => vec![integer(other).unwrap_or(0)],
                    };
                    for sector in sectors {
                        let source = if (a, b) == (0, 0) {
                            CENTRE
                        } else {
                            (sector.rem_euclid(n as i64) as usize, a, b)
                        };
                        add(&mut row, model.turned(source, by), w.clone());
                    }
                }
                let target = if (x, y) == (0, 0) {
                    CENTRE
                } else {
                    (sector.rem_euclid(n as i64) as usize, x, y)
                };
                pass.special.insert(model.turned(target, by), row);
            }
        }
        model.passes.push(pass);
    }
    let scale: usize = model.passes.iter().map(|pass| pass.line.len()).product();
    if scale != 2 || net != Some(model.parity) {
        return Err("the passes do not refine two-fold".into());
    }
    Ok(model)
}

fn taps(class: &DeValue) -> Result<Vec<(i64, Q)>, String> {
    let class = class.as_array().ok_or("line is no list of lists")?;
    let tap = |tap: &DeValue| {
        let tap = tap.as_array().filter(|tap| tap.len() == 2).ok_or("a tap is no pair")?;
        let offset = integer(tap.first().map(|v| v.get_ref())).ok_or("an offset is no integer")?;
        Ok((offset, weight(tap.get(1).map(|v| v.get_ref()), "line")?))
    };
    class.iter().map(|value| tap(value.get_ref())).collect()
}
