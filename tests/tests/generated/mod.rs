//! Scheme files as text, from exact weights.

pub mod kinds;

use num_rational::BigRational;
use num_traits::{One, Zero};

type Q = BigRational;

/// `p/q`.
pub fn q(p: i64, q: i64) -> Q {
    Q::new(p.into(), q.into())
}

/// A point with a stencil of its own: in all sectors alike if no sector is given.
#[derive(Clone, Debug)]
pub struct Special {
    /// Its place in the sector.
    pub at: (i64, i64),
    /// Its sector.
    pub sector: Option<i64>,
    /// Place, sector and weight.
    pub terms: Vec<((i64, i64), i64, Q)>,
}

impl Special {
    /// One without terms.
    pub fn new(at: (i64, i64), sector: Option<i64>) -> Self {
        Special {
            at,
            sector,
            terms: Vec::new(),
        }
    }

    /// Adds a term; a place that comes twice gets the sum.
    pub fn add(&mut self, at: (i64, i64), sector: i64, weight: Q) -> &mut Self {
        match self.terms.iter_mut().find(|term| (term.0, term.1) == (at, sector)) {
            Some(known) => known.2 += weight,
            None => self.terms.push((at, sector, weight)),
        }
        self
    }
}

/// One pass.
#[derive(Clone, Debug)]
pub struct Pass {
    /// The net that is read.
    pub from: &'static str,
    /// The net that is made.
    pub to: &'static str,
    /// Taps by class.
    pub line: Vec<Vec<(i64, Q)>>,
    /// Special points.
    pub special: Vec<Special>,
}

impl Pass {
    /// A pass between vertex nets.
    pub fn vertex(line: Vec<Vec<(i64, Q)>>) -> Self {
        Pass {
            from: "vertex",
            to: "vertex",
            line,
            special: Vec::new(),
        }
    }
}

/// A file.
#[derive(Clone, Debug)]
pub struct File {
    /// The degree that it states.
    pub degree: usize,
    /// The valence.
    pub n: usize,
    /// The passes.
    pub passes: Vec<Pass>,
}

fn weight(w: &Q) -> String {
    format!("\"{}/{}\"", w.numer(), w.denom())
}

impl File {
    /// The text. Sectors are written from 0 to `n - 1`, and terms that fall together are added up.
    pub fn text(&self) -> String {
        let (n, mut text) = (self.n as i64, String::new());
        text += &format!(
            "kind = \"stencils\"\nname = \"generated\"\ndegree = {}\n\n[[valence]]\nn = {n}\n",
            self.degree
        );
        for pass in &self.passes {
            let tap = |(offset, w): &(i64, Q)| format!("[{offset}, {}]", weight(w));
            let class = |class: &Vec<(i64, Q)>| format!("[{}]", class.iter().map(tap).collect::<Vec<_>>().join(", "));
            let line: Vec<String> = pass.line.iter().map(class).collect();
            text += &format!(
                "\n[[valence.pass]]\nfrom = \"{}\"\nto = \"{}\"\nline = [{}]\n",
                pass.from,
                pass.to,
                line.join(", ")
            );
            for special in &pass.special {
                text += &format!(
                    "\n[[valence.pass.special]]\nat = [{}, {}]\n",
                    special.at.0, special.at.1
                );
                if let Some(sector) = special.sector {
                    text += &format!("sector = {}\n", sector.rem_euclid(n));
                }
                let mut terms = Special::new(special.at, None);
                for (at, sector, w) in &special.terms {
                    let sector = if *at == (0, 0) { 0 } else { sector.rem_euclid(n) };
                    terms.add(*at, sector, w.clone());
                }
                text += "stencil = [\n";
                for ((x, y), sector, w) in &terms.terms {
                    text += &format!(
                        "    {{ at = [{x}, {y}], sector = {sector}, weight = {} }},\n",
                        weight(w)
                    );
                }
                text += "]\n";
            }
        }
        text
    }
}

/// Refinement of cubic B-splines.
pub fn cubic() -> Vec<Vec<(i64, Q)>> {
    vec![
        vec![(-4, q(1, 8)), (0, q(3, 4)), (4, q(1, 8))],
        vec![(-2, q(1, 2)), (2, q(1, 2))],
    ]
}

/// The centre's stencil with total weights `alpha` of the edge and `beta` of the face neighbours.
pub fn centre(n: usize, alpha: &Q, beta: &Q) -> Vec<Special> {
    let mut centre = Special::new((0, 0), None);
    centre.add((0, 0), 0, Q::one() - alpha - beta);
    for i in 0..n as i64 {
        centre
            .add((2, 0), i, alpha / q(n as i64, 1))
            .add((2, 2), i, beta / q(n as i64, 1));
    }
    vec![centre]
}

/// Catmull-Clark's stencils: of the centre alone, or of edge and face points too.
pub fn cubic_centre(n: usize, stencils: usize) -> Vec<Special> {
    let mut special = centre(n, &q(3, 2 * n as i64), &q(1, 4 * n as i64));
    if stencils > 1 {
        let (quarter, eighths, sixteenth) = (q(1, 4), q(3, 8), q(1, 16));
        let mut edge = Special::new((2, 0), None);
        edge.add((0, 0), 0, eighths.clone()).add((2, 0), 0, eighths);
        for i in [1, -1] {
            edge.add((2, 0), i, sixteenth.clone());
        }
        edge.add((2, 2), 0, sixteenth.clone()).add((2, 2), -1, sixteenth);
        let mut face = Special::new((2, 2), None);
        face.add((0, 0), 0, quarter.clone()).add((2, 0), 0, quarter.clone());
        face.add((2, 0), 1, quarter.clone()).add((2, 2), 0, quarter);
        special.extend([edge, face]);
    }
    special
}

/// A one-ring scheme, f1, f2, f3, d1, d2, e1, e2, alpha, beta, as a pass.
pub fn one_ring(n: usize, [f1, f2, f3, d1, d2, e1, e2, alpha, beta]: &[Q; 9]) -> Pass {
    let mut pass = Pass::vertex(cubic());
    let mut edge = Special::new((2, 0), None);
    edge.add((0, 0), 0, d1.clone()).add((2, 0), 0, d2.clone());
    edge.add((2, 0), 1, e1.clone()).add((2, 0), -1, e1.clone());
    edge.add((2, 2), 0, e2.clone()).add((2, 2), -1, e2.clone());
    let mut face = Special::new((2, 2), None);
    face.add((0, 0), 0, f1.clone()).add((2, 0), 0, f2.clone());
    face.add((2, 0), 1, f2.clone()).add((2, 2), 0, f3.clone());
    pass.special = centre(n, alpha, beta);
    pass.special.extend([edge, face]);
    pass
}

/// Midpoints and then smoothings (1, 2, 1)/4, the last of them disturbed by some fortieths: degree `1 + 2
/// count` if by none.
pub fn smoothings(n: usize, count: usize, by: i64) -> Vec<Pass> {
    let valence = n as i64;
    let mut passes = vec![Pass::vertex(vec![
        vec![(0, Q::one())],
        vec![(-2, q(1, 2)), (2, q(1, 2))],
    ])];
    for index in 0..count {
        let side = q(1, 4) + if index + 1 == count { q(by, 40) } else { Q::zero() };
        let middle = Q::one() - &side - &side;
        let mut pass = Pass::vertex(vec![vec![(-2, side.clone()), (0, middle), (2, side)]]);
        // the mean over the faces of the mean of their corners, twice around: (n - 3)/n, 2/n^2 and 1/n^2
        // (Fang, Ma and Wang)
        pass.special = centre(n, &q(2, valence), &q(1, valence));
        passes.push(pass);
    }
    passes
}

/// A shift of all points by half steps along both spokes, and the shift back.
pub fn shift_and_back(n: usize, by: i64) -> [Pass; 2] {
    let [there, mut back] = [by, -by].map(|offset| Pass::vertex(vec![vec![(offset, Q::one())]]));
    back.special = centre(n, &q(1, 2), &q(1, 2));
    [there, back]
}

/// Corner cutting, and then pairs of centroids from the face net to the vertex net and back: degree `2 + 2
/// pairs`. The last way back leans by some fortieths.
pub fn repeated_averaging(n: usize, pairs: usize, by: i64) -> Vec<Pass> {
    let half = || vec![vec![(-1, q(1, 2)), (1, q(1, 2))]];
    let centroid = || {
        let mut centre = Special::new((0, 0), None);
        for i in 0..n as i64 {
            centre.add((1, 1), i, q(1, n as i64));
        }
        vec![centre]
    };
    let step = |from, to, line, special| Pass {
        from,
        to,
        line,
        special,
    };
    // points and midpoints, as a net of half the step around the vertex in the middle of the face
    let mut passes = vec![
        step(
            "face",
            "vertex",
            vec![vec![(-2, q(1, 2)), (2, q(1, 2))], vec![(0, Q::one())]],
            centroid(),
        ),
        step("vertex", "face", half(), Vec::new()),
    ];
    for pair in 0..pairs {
        let lean = if pair + 1 == pairs { q(by, 40) } else { Q::zero() };
        let line = vec![vec![(-1, q(1, 2) + &lean), (1, q(1, 2) - lean)]];
        passes.push(step("face", "vertex", half(), centroid()));
        passes.push(step("vertex", "face", line, Vec::new()));
    }
    passes
}

/// Doo-Sabin's rule with the cosines in double precision.
pub fn doo_sabin(n: usize) -> Pass {
    let line = vec![vec![(1, q(3, 4)), (-3, q(1, 4))], vec![(-1, q(3, 4)), (3, q(1, 4))]];
    let mut corner = Special::new((1, 1), None);
    for i in 0..n {
        let cosine = (std::f64::consts::TAU * i as f64 / n as f64).cos();
        let own = if i == 0 {
            0.25 + 1.25 / n as f64
        } else {
            (3.0 + 2.0 * cosine) / (4.0 * n as f64)
        };
        corner.add((1, 1), i as i64, Q::from_float(own).expect("a finite number"));
    }
    Pass {
        from: "face",
        to: "face",
        line,
        special: vec![corner],
    }
}

/// The nearest decimal with some digits after the point.
pub fn rounded(w: &Q, digits: usize) -> Q {
    let scale = num_traits::pow(q(10, 1), digits);
    (w * &scale).round() / scale
}
