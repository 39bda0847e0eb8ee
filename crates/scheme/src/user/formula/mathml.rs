//! From trees to presentation MathML (W3C, MathML Core), in exact numbers.
//!
//! Fractions stand above each other, products without a sign unless two numbers meet; brackets only where the
//! tree would be read as another one without them.

use super::{Kind, Node, Symbol};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};

/// Multiplication that is understood, and a function that is applied.
const TIMES: &str = "<mo>&#x2062;</mo>";
const APPLY: &str = "<mo>&#x2061;</mo>";
const MINUS: &str = "<mo>\u{2212}</mo>";

/// Numerators and denominators beyond this are written as decimals.
const LONG: u32 = 1_000_000;

/// What the names of a formula are called.
pub(in crate::user) struct Typesetter<'a> {
    pub parameters: Vec<&'a str>,
    pub names: Vec<&'a str>,
    /// How many sums are around what is set.
    pub depth: usize,
}

/// How tightly the outermost operation binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Tie {
    Sum,
    Product,
    /// A fraction binds like a product where a power is taken, and needs no brackets within one.
    Fraction,
    Atom,
}

/// A name: letters of the Greek alphabet as such, digits at its end and what follows `_` as an index.
pub(in crate::user) fn identifier(name: &str) -> String {
    let (base, index) = match name.split_once('_') {
        Some((base, index)) if !base.is_empty() && !index.is_empty() => (base, index),
        _ => {
            let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
            name.split_at(if base.is_empty() { name.len() } else { base.len() })
        }
    };
    let base = format!("<mi>{}</mi>", greek(base).unwrap_or(base));
    match index {
        "" => base,
        index if index.bytes().all(|b| b.is_ascii_digit()) => format!("<msub>{base}<mn>{index}</mn></msub>"),
        index => format!("<msub>{base}<mi>{}</mi></msub>", greek(index).unwrap_or(index)),
    }
}

fn greek(name: &str) -> Option<&'static str> {
    const LETTERS: [(&str, &str); 17] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("delta", "δ"),
        ("epsilon", "ε"),
        ("eta", "η"),
        ("theta", "θ"),
        ("kappa", "κ"),
        ("lambda", "λ"),
        ("mu", "μ"),
        ("nu", "ν"),
        ("rho", "ρ"),
        ("sigma", "σ"),
        ("tau", "τ"),
        ("phi", "φ"),
        ("psi", "ψ"),
        ("omega", "ω"),
    ];
    LETTERS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, letter)| *letter)
}

fn row(inner: &str) -> String {
    format!("<mrow>{inner}</mrow>")
}

fn bracketed(inner: &str) -> String {
    format!("<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>")
}

/// A number that is not negative.
fn magnitude(number: &BigRational) -> (String, Tie) {
    let long = |part: &BigInt| part.magnitude() > &LONG.into();
    if number.denom().is_one() {
        return (format!("<mn>{}</mn>", number.numer()), Tie::Atom);
    }
    if long(number.numer()) || long(number.denom()) {
        // a decimal that a program has written
        let value = number.to_f64().unwrap_or(f64::NAN);
        return (format!("<mn>{value}</mn>"), Tie::Atom);
    }
    let fraction = format!("<mfrac><mn>{}</mn><mn>{}</mn></mfrac>", number.numer(), number.denom());
    (fraction, Tie::Fraction)
}

impl Typesetter<'_> {
    /// The formula, as one element.
    pub(in crate::user) fn formula(&self, node: &Node) -> String {
        row(&self.set(node).0)
    }

    /// The formula, in brackets if it ties less than it must.
    fn tied(&self, node: &Node, least: Tie) -> String {
        let (text, tie) = self.set(node);
        if tie < least { bracketed(&text) } else { text }
    }

    fn set(&self, node: &Node) -> (String, Tie) {
        match &node.kind {
            Kind::Number(number) if number.is_negative() => {
                (format!("{MINUS}{}", magnitude(&number.abs()).0), Tie::Sum)
            }
            Kind::Number(number) => magnitude(number),
            Kind::Pi => ("<mi>π</mi>".to_owned(), Tie::Atom),
            Kind::Symbol(symbol) => (self.symbol(*symbol), Tie::Atom),
            Kind::Sum(terms) => (self.sum(terms), Tie::Sum),
            Kind::Product(factors) => self.product(factors),
            Kind::Power(base, power) => {
                let base = row(&self.tied(base, Tie::Atom));
                (format!("<msup>{base}<mn>{power}</mn></msup>"), Tie::Product)
            }
            Kind::Cos(inner) => (self.function("cos", inner), Tie::Product),
            Kind::Sin(inner) => (self.function("sin", inner), Tie::Product),
            Kind::Sqrt(inner) => (format!("<msqrt>{}</msqrt>", self.set(inner).0), Tie::Atom),
            Kind::Sectors { bounds, body } => {
                let variable = self.symbol(Symbol::Local(self.depth));
                let within = Typesetter {
                    parameters: self.parameters.clone(),
                    names: self.names.clone(),
                    depth: self.depth + 1,
                };
                let [from, to] = match bounds {
                    Some(bounds) => bounds.each_ref().map(|bound| self.set(bound).0),
                    None => ["<mn>0</mn>".to_owned(), format!("<mi>n</mi>{MINUS}<mn>1</mn>")],
                };
                let below = row(&format!("{variable}<mo>=</mo>{from}"));
                let sign = format!("<munderover><mo>∑</mo>{below}{}</munderover>", row(&to));
                (format!("{sign}{}", within.tied(body, Tie::Product)), Tie::Sum)
            }
        }
    }

    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Valence => "<mi>n</mi>".to_owned(),
            Symbol::Sector => "<mi>k</mi>".to_owned(),
            Symbol::Tension => "<mi>u</mi>".to_owned(),
            Symbol::Local(0) => "<mi>j</mi>".to_owned(),
            Symbol::Local(depth) => format!("<msub><mi>j</mi><mn>{}</mn></msub>", depth + 1),
            Symbol::Parameter(index) => identifier(self.parameters[index]),
            Symbol::Name(index) => identifier(self.names[index]),
        }
    }

    fn function(&self, name: &str, inner: &Node) -> String {
        format!("<mi>{name}</mi>{APPLY}{}", bracketed(&self.set(inner).0))
    }

    fn sum(&self, terms: &[(bool, Node)]) -> String {
        let mut text = String::new();
        for (index, (subtracted, term)) in terms.iter().enumerate() {
            match (subtracted, index) {
                (true, _) => text.push_str(MINUS),
                (false, 0) => {}
                (false, _) => text.push_str("<mo>+</mo>"),
            }
            let least = if index == 0 && !subtracted {
                Tie::Sum
            } else {
                Tie::Product
            };
            text.push_str(&self.tied(term, least));
        }
        text
    }

    fn product(&self, factors: &[(bool, Node)]) -> (String, Tie) {
        let part = |inverse: bool| {
            factors
                .iter()
                .filter(move |(divides, _)| *divides == inverse)
                .map(|(_, node)| node)
        };
        let below: Vec<&Node> = part(true).collect();
        let above: Vec<&Node> = part(false).collect();
        if below.is_empty() {
            return (self.factors(&above), Tie::Product);
        }
        let fraction = format!(
            "<mfrac>{}{}</mfrac>",
            row(&self.factors(&above)),
            row(&self.factors(&below))
        );
        (fraction, Tie::Fraction)
    }

    fn factors(&self, factors: &[&Node]) -> String {
        if let [one] = factors {
            return self.set(one).0;
        }
        let mut text = String::new();
        for (index, factor) in factors.iter().enumerate() {
            if index > 0 {
                // digits that meet would be read as one number
                let digits = matches!(factor.kind, Kind::Number(_));
                text.push_str(if digits { "<mo>·</mo>" } else { TIMES });
            }
            text.push_str(&self.tied(factor, Tie::Product));
        }
        text
    }
}
