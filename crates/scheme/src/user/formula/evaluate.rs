//! From trees to weights at a valence.

use super::{Fault, Kind, Node, Residual, Symbol};
use crate::{Exact, Scalar};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

/// The most work of all formulas of a scheme at one valence, in products of machine words, more or less: less
/// than a second.
const MAX_WORK: usize = 1_000_000;

/// The most terms of one sum.
const MAX_SUM: i64 = 100_000;

/// What names stand for at a valence.
#[derive(Clone, Debug)]
pub(in crate::user) struct Context {
    pub valence: usize,
    /// The sector of the term, in a stencil over all sectors.
    pub sector: i64,
    pub tension: Residual,
    pub parameters: Vec<Residual>,
    /// The named weights that were evaluated so far.
    pub names: Vec<Option<Residual>>,
    /// Work done so far.
    work: usize,
    locals: Vec<i64>,
}

/// A sum on the way: its number, and what is none.
struct Terms {
    number: Residual,
    rest: Vec<Residual>,
}

impl Default for Terms {
    fn default() -> Self {
        Terms {
            number: Residual::Value(Exact::zero()),
            rest: Vec::new(),
        }
    }
}

impl Terms {
    fn add(&mut self, term: Residual) {
        if let (Residual::Value(sum), Residual::Value(term)) = (&self.number, &term) {
            let next = sum.clone() + term.clone();
            if next.has_value() {
                self.number = Residual::Value(next);
                return;
            }
        }
        self.rest.push(term);
    }

    fn residual(mut self) -> Residual {
        self.rest.insert(0, self.number);
        Residual::sum(self.rest)
    }
}

/// `plain + turns 2 pi`.
struct Angle {
    plain: BigRational,
    turns: BigRational,
}

impl Context {
    pub(in crate::user) fn new(
        valence: usize,
        tension: Residual,
        parameters: Vec<Residual>,
        names: Vec<Option<Residual>>,
    ) -> Self {
        Context {
            valence,
            sector: 0,
            tension,
            parameters,
            names,
            work: 0,
            locals: Vec::new(),
        }
    }

    fn spend(&mut self, work: usize, at: usize) -> Result<(), Fault> {
        self.work = self.work.saturating_add(work);
        if self.work > MAX_WORK {
            return Err(Fault::new(
                at,
                "the formulas take too much work: accepted are fewer or shorter sums and products",
            ));
        }
        Ok(())
    }

    /// The value of a formula, or what remains of it.
    ///
    /// # Errors
    /// A division by zero, the root of a negative number, `pi` outside of an angle, a sum that is too long.
    pub(in crate::user) fn evaluate(&mut self, node: &Node) -> Result<Residual, Fault> {
        let at = node.at;
        self.spend(1, at)?;
        let whole = |value: i64| Residual::Value(Exact::ratio(value, 1));
        Ok(match &node.kind {
            Kind::Number(value) => Residual::Value(Exact::rational(value)),
            Kind::Pi => return Err(Fault::new(at, "pi alone: accepted is pi within cos(..) and sin(..)")),
            Kind::Symbol(symbol) => match *symbol {
                Symbol::Valence => whole(self.valence as i64),
                Symbol::Sector => whole(self.sector),
                Symbol::Local(index) => whole(self.locals.get(index).copied().unwrap_or(0)),
                Symbol::Tension => self.tension.clone(),
                Symbol::Parameter(index) => self.parameters[index].clone(),
                Symbol::Name(index) => match &self.names[index] {
                    Some(Residual::Value(value)) => Residual::Value(value.clone()),
                    _ => Residual::Name(index),
                },
            },
            Kind::Sum(parts) => {
                let mut sum = Terms::default();
                for (negative, part) in parts {
                    let term = self.evaluate(part)?;
                    let term = match negative {
                        true => Residual::product(vec![whole(-1), term]),
                        false => term,
                    };
                    self.spend(sum.number.work(&term)[0], at)?;
                    sum.add(term);
                }
                sum.residual()
            }
            Kind::Product(parts) => {
                let mut product = Residual::Value(Exact::one());
                for (divides, part) in parts {
                    let factor = self.evaluate(part)?;
                    self.spend(product.work(&factor)[1], at)?;
                    product = match divides {
                        true => {
                            self.refuse_zero(&factor, part.at)?;
                            Residual::quotient(product, factor)
                        }
                        false => Residual::product(vec![product, factor]),
                    };
                }
                product
            }
            Kind::Power(base, power) => {
                let base = self.evaluate(base)?;
                let mut product = Residual::Value(Exact::one());
                for _ in 0..*power {
                    self.spend(product.work(&base)[1], at)?;
                    product = Residual::product(vec![product, base.clone()]);
                }
                product
            }
            Kind::Cos(angle) => Residual::Value(self.cosine(angle, false)?),
            Kind::Sin(angle) => Residual::Value(self.cosine(angle, true)?),
            Kind::Sqrt(inner) => {
                let square = self.evaluate(inner)?;
                self.spend(square.work(&square)[1], at)?;
                if let Some(value) = square.exact().and_then(Exact::to::<f64>)
                    && value < 0.0
                    && square.exact().and_then(Exact::is_zero) == Some(false)
                {
                    let n = self.valence;
                    return Err(Fault::new(
                        at,
                        format!("the square root of {value} at n = {n}: accepted are numbers that are not negative"),
                    ));
                }
                Residual::sqrt(square)
            }
            Kind::Sectors { bounds, body } => {
                let [from, to] = match bounds {
                    None => [0, self.valence as i64 - 1],
                    Some(bounds) => [self.integer(&bounds[0])?, self.integer(&bounds[1])?],
                };
                if to.saturating_sub(from) >= MAX_SUM {
                    return Err(Fault::new(
                        at,
                        format!("a sum from {from} to {to}: accepted are up to {MAX_SUM} terms"),
                    ));
                }
                let mut sum = Terms::default();
                for index in from..=to {
                    self.locals.push(index);
                    let term = self.evaluate(body)?;
                    self.locals.pop();
                    self.spend(sum.number.work(&term)[0], at)?;
                    sum.add(term);
                }
                sum.residual()
            }
        })
    }

    fn refuse_zero(&self, divisor: &Residual, at: usize) -> Result<(), Fault> {
        if divisor.exact().and_then(Exact::is_zero) == Some(true) {
            let n = self.valence;
            return Err(Fault::new(
                at,
                format!("division by zero at n = {n}: accepted are divisors that are not zero"),
            ));
        }
        Ok(())
    }

    fn integer(&mut self, node: &Node) -> Result<i64, Fault> {
        let value = self.evaluate(node)?.exact().and_then(Exact::as_rational);
        let whole = value.filter(BigRational::is_integer).and_then(|value| value.to_i64());
        whole.ok_or_else(|| {
            Fault::new(
                node.at,
                "the bound of a sum: accepted are integers made of numbers and n",
            )
        })
    }

    /// The cosine or sine of an angle, which is a rational turn.
    fn cosine(&mut self, node: &Node, sine: bool) -> Result<Exact, Fault> {
        let Angle { plain, turns } = self.angle(node)?;
        if !plain.is_zero() {
            return Err(Fault::new(
                node.at,
                "an angle that is no multiple of pi: accepted are rational multiples, such as 2*pi*k/n",
            ));
        }
        let whole = turns.fract();
        let parts = whole.numer().to_i64().zip(whole.denom().to_i64());
        let cosine = parts.map(|(k, n)| match sine {
            true if n <= i64::MAX / 8 => Exact::cos_turn(4 * k - n, 4 * n),
            true => Exact::exact(f64::NAN),
            false => Exact::cos_turn(k, n),
        });
        cosine.filter(Exact::has_value).ok_or_else(|| {
            Fault::new(
                node.at,
                "an angle of too fine a fraction of a turn: accepted are denominators up to 8192 (sines: 2048)",
            )
        })
    }

    fn angle(&mut self, node: &Node) -> Result<Angle, Fault> {
        let at = node.at;
        let refuse = || {
            Fault::new(
                at,
                "in an angle: accepted are rational multiples of pi, made of numbers, n, k and pi",
            )
        };
        self.spend(1, at)?;
        let plain = |value: BigRational| Angle {
            plain: value,
            turns: BigRational::zero(),
        };
        Ok(match &node.kind {
            Kind::Pi => Angle {
                plain: BigRational::zero(),
                turns: BigRational::new(1.into(), 2.into()),
            },
            Kind::Sum(parts) => {
                let mut sum = plain(BigRational::zero());
                for (negative, part) in parts {
                    let Angle { plain, turns } = self.angle(part)?;
                    if *negative {
                        sum.plain -= plain;
                        sum.turns -= turns;
                    } else {
                        sum.plain += plain;
                        sum.turns += turns;
                    }
                }
                sum
            }
            Kind::Product(parts) => {
                let mut product = plain(BigRational::from_integer(1.into()));
                for (divides, part) in parts {
                    let mut factor = self.angle(part)?;
                    if *divides {
                        if !factor.turns.is_zero() {
                            return Err(refuse());
                        }
                        self.refuse_zero(&Residual::Value(Exact::rational(&factor.plain)), part.at)?;
                        factor.plain = factor.plain.recip();
                    }
                    // one of both is a plain number
                    product = match (product.turns.is_zero(), factor.turns.is_zero()) {
                        (_, true) => Angle {
                            plain: product.plain * &factor.plain,
                            turns: product.turns * factor.plain,
                        },
                        (true, _) => Angle {
                            plain: &product.plain * factor.plain,
                            turns: product.plain * factor.turns,
                        },
                        _ => return Err(refuse()),
                    };
                }
                product
            }
            Kind::Number(_) | Kind::Symbol(Symbol::Valence | Symbol::Sector | Symbol::Local(_)) | Kind::Power(..) => {
                let value = self.evaluate(node)?;
                plain(value.exact().and_then(Exact::as_rational).ok_or_else(refuse)?)
            }
            _ => return Err(refuse()),
        })
    }
}
