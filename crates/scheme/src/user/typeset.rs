//! A scheme file for people: its rules with formulas as MathML.
//!
//! Texts are the inside of a `math` element; names and numbers of files are letters, digits and `_`, so that
//! nothing in them is markup.

use super::UserScheme;
use super::formula::{Formula, Typesetter, identifier};
use super::rules::{Form, PassForm, Sectors, SpecialForm, TermForm};
use crate::Lattice;

/// What a scheme file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Typeset {
    /// The names of the parameters, in their order.
    pub parameters: Vec<String>,
    /// The tension of the first refinement.
    pub tension: Option<String>,
    /// Named weights and what they stand for.
    pub names: Vec<[String; 2]>,
    /// The rules: that for a range of valences first.
    pub rules: Vec<TypesetRule>,
}

/// The rules of the valences from `first` to `last`.
#[derive(Clone, Debug, PartialEq)]
pub struct TypesetRule {
    /// The first valence.
    pub first: usize,
    /// The last valence, if there is one.
    pub last: Option<usize>,
    /// What holds there.
    pub form: TypesetForm,
}

/// Rules of one of the two kinds.
#[derive(Clone, Debug, PartialEq)]
pub enum TypesetForm {
    /// The weights of [`OneRing`](crate::OneRing), with their names.
    OneRing(Vec<[String; 2]>),
    /// Passes in order.
    Passes(Vec<TypesetPass>),
}

/// A pass.
#[derive(Clone, Debug, PartialEq)]
pub struct TypesetPass {
    /// The net that is read.
    pub from: Lattice,
    /// The net that is made.
    pub to: Lattice,
    /// For each class of target points offsets in half steps and weights.
    pub line: Vec<Vec<(i32, String)>>,
    /// Points with a stencil of their own.
    pub special: Vec<TypesetStencil>,
}

/// A point with a stencil of its own, in half steps.
#[derive(Clone, Debug, PartialEq)]
pub struct TypesetStencil {
    /// Its coordinates.
    pub at: [i32; 2],
    /// Its sector.
    pub sector: i64,
    /// What it is made of.
    pub terms: Vec<TypesetTerm>,
}

/// A term of a stencil.
#[derive(Clone, Debug, PartialEq)]
pub struct TypesetTerm {
    /// The coordinates of the point that is read.
    pub at: [i32; 2],
    /// Its sector.
    pub sectors: TypesetSectors,
    /// Its weight.
    pub weight: String,
}

/// In which sectors a term stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TypesetSectors {
    /// In one.
    One(i64),
    /// In all, with the same weight.
    All,
    /// In all, with a weight that depends on the sector's number k; terms of [`TypesetSectors::One`] that
    /// follow take the place of their sector's.
    Each,
}

impl UserScheme {
    /// The rules for people.
    pub fn typeset(&self) -> Typeset {
        let contents = &self.contents;
        let mut names: Vec<&str> = contents.names.iter().map(|(name, _)| name.as_str()).collect();
        if let Some(Form::OneRing(weights)) = contents.forms().next() {
            names.extend(weights.each().map(|(name, _)| name));
        }
        let set = Typesetter {
            parameters: self.parameters().iter().map(|known| known.name.as_str()).collect(),
            names,
            depth: 0,
        };
        let formula = |formula: &Formula| set.formula(&formula.root);
        let rule = contents.rule.iter().map(|rule| TypesetRule {
            first: rule.first,
            last: rule.last,
            form: form(&rule.form, &set),
        });
        let listed = contents.valences.iter().map(|(n, rules)| TypesetRule {
            first: *n,
            last: Some(*n),
            form: form(rules, &set),
        });
        let definitions = contents.names.iter();
        Typeset {
            parameters: set.parameters.iter().map(|name| identifier(name)).collect(),
            tension: contents.tension.as_ref().map(formula),
            names: definitions
                .map(|(name, value)| [identifier(name), formula(value)])
                .collect(),
            rules: rule.chain(listed).collect(),
        }
    }
}

fn form(form: &Form, set: &Typesetter) -> TypesetForm {
    match form {
        Form::OneRing(weights) => {
            let weights = weights.each();
            let weight = |(name, formula): &(&str, &Formula)| [identifier(name), set.formula(&formula.root)];
            TypesetForm::OneRing(weights.iter().map(weight).collect())
        }
        Form::Passes(passes) => TypesetForm::Passes(passes.iter().map(|rules| pass(rules, set)).collect()),
    }
}

fn pass(pass: &PassForm, set: &Typesetter) -> TypesetPass {
    let tap = |(offset, weight): &(i32, Formula)| (*offset, set.formula(&weight.root));
    TypesetPass {
        from: pass.from,
        to: pass.to,
        line: pass.line.iter().map(|taps| taps.iter().map(tap).collect()).collect(),
        special: pass.special.iter().map(|point| stencil(point, set)).collect(),
    }
}

fn stencil(point: &SpecialForm, set: &Typesetter) -> TypesetStencil {
    TypesetStencil {
        at: point.at,
        sector: point.sector,
        terms: point.terms.iter().flat_map(|one| terms(one, set)).collect(),
    }
}

fn terms(term: &TermForm, set: &Typesetter) -> Vec<TypesetTerm> {
    let one = |sectors, weight: &Formula| TypesetTerm {
        at: term.at,
        sectors,
        weight: set.formula(&weight.root),
    };
    match &term.weights {
        Sectors::One(sector, weight) => vec![one(TypesetSectors::One(*sector), weight)],
        Sectors::All(weight) => vec![one(TypesetSectors::All, weight)],
        Sectors::Each { weight, except } => std::iter::once(one(TypesetSectors::Each, weight))
            .chain(
                except
                    .iter()
                    .map(|(sector, weight)| one(TypesetSectors::One(*sector), weight)),
            )
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::user::{Reading, starters};

    const TIMES: &str = "<mo>&#x2062;</mo>";
    const MINUS: &str = "<mo>\u{2212}</mo>";

    fn one_ring(alpha: &str) -> String {
        let text = format!(
            "kind = \"one-ring\"\n[parameters]\nc_1 = {{ default = \"1\" }}\n[rule]\nf1 = 0\nf2 = 0\nf3 = 0\nd1 = 0\nd2 = 0\n\
             e1 = 0\ne2 = 0\nbeta = 1\nalpha = \"{alpha}\""
        );
        let file = UserScheme::parse(&text, "x", Reading::Exact).unwrap();
        let TypesetForm::OneRing(weights) = file.typeset().rules.remove(0).form else {
            unreachable!("the file is of one-ring kind")
        };
        weights[7][1].clone()
    }

    #[test]
    fn formulas_keep_their_meaning() {
        let n = "<mi>n</mi>";
        for (formula, inside) in [
            // a fraction needs no brackets around its parts, and a factor that is a sum does
            (
                "(1 + n)/(4*n)",
                format!("<mfrac><mrow><mn>1</mn><mo>+</mo>{n}</mrow><mrow><mn>4</mn>{TIMES}{n}</mrow></mfrac>"),
            ),
            (
                "(1 + n)*n",
                format!("<mrow><mo>(</mo><mn>1</mn><mo>+</mo>{n}<mo>)</mo></mrow>{TIMES}{n}"),
            ),
            (
                "1 - (n - 2)",
                format!("<mn>1</mn>{MINUS}<mrow><mo>(</mo>{n}{MINUS}<mn>2</mn><mo>)</mo></mrow>"),
            ),
            (
                "(1/n)^2",
                format!(
                    "<msup><mrow><mrow><mo>(</mo><mfrac><mrow><mn>1</mn></mrow><mrow>{n}</mrow></mfrac><mo>)</mo></mrow></mrow><mn>2</mn></msup>"
                ),
            ),
            ("-n^2", format!("{MINUS}<msup><mrow>{n}</mrow><mn>2</mn></msup>")),
            ("2*3", "<mn>2</mn><mo>·</mo><mn>3</mn>".to_owned()),
            ("0.25", "<mfrac><mn>1</mn><mn>4</mn></mfrac>".to_owned()),
            (
                "beta*c_1",
                format!("<mi>β</mi>{TIMES}<msub><mi>c</mi><mn>1</mn></msub>"),
            ),
            ("sqrt(n)", format!("<msqrt>{n}</msqrt>")),
        ] {
            assert_eq!(one_ring(formula), format!("<mrow>{inside}</mrow>"), "{formula}");
        }
        // each sum has a variable of its own, whatever the file calls it
        let sums = one_ring("sum(k, sum(l, 1, n, cos(2*pi*k*l/n)))");
        let (outer, inner) = ("<mi>j</mi>", "<msub><mi>j</mi><mn>2</mn></msub>");
        assert!(sums.contains(&format!("{outer}<mo>=</mo><mn>0</mn>")), "{sums}");
        assert!(sums.contains(&format!("{inner}<mo>=</mo><mn>1</mn>")), "{sums}");
        assert!(sums.contains(&format!("{outer}{TIMES}{inner}")), "{sums}");
    }

    /// Every tag that is opened is closed, in every file that one can start from.
    #[test]
    fn markup_is_well_formed() {
        for starter in starters() {
            let file = UserScheme::parse(starter.text, "x", Reading::Exact).unwrap();
            let text = format!("{:?}", file.typeset());
            let mut open: Vec<&str> = Vec::new();
            for tag in text.split('<').skip(1) {
                let tag = &tag[..tag.find('>').unwrap()];
                match tag.strip_prefix('/') {
                    Some(name) => assert_eq!(open.pop(), Some(name), "{}", starter.like),
                    None => open.push(tag),
                }
            }
            assert!(open.is_empty() && text.contains("mfrac"), "{}", starter.like);
        }
    }
}
