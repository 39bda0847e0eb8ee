//! Certificates held against the facts.

use super::facts::{Fact, Facts, ROUNDED, Truth};
use super::number::double;
use eigenring_certify::{Check, Error, Input, Requirement, Status, certify};
use eigenring_scheme::user::Reading;

/// The text of a scheme file as the input of a certificate: the one place that knows how that is said.
pub fn input(text: &str) -> Input {
    Input::Toml {
        text: text.to_owned(),
        name: "case".to_owned(),
        reading: Reading::Balanced,
        parameters: Default::default(),
    }
}

/// The checks of a file's certificate.
///
/// # Errors
/// Those of [`certify`].
pub fn checks(text: &str, valence: usize) -> Result<Vec<Check>, Error> {
    certify(input(text), valence).map(|certificate| certificate.checks)
}

/// The status of a check, undecided if it is not listed.
pub fn status(checks: &[Check], name: &str) -> Status {
    checks
        .iter()
        .find(|check| check.name.name() == name)
        .map_or(Status::Undecided, |check| check.status)
}

/// What is claimed of C1 as a whole.
pub fn c1(checks: &[Check]) -> Status {
    Requirement::C1.verdict(checks).1
}

/// Statements about polynomial patches: nothing can be proven of them where there are none.
const OF_PATCHES: [&str; 7] = [
    "regular",
    "injective",
    "bounded_curvature",
    "non_degenerate",
    "strict",
    "corner",
    "gauss",
];

impl Facts {
    /// The first status that the facts contradict, with the reason.
    ///
    /// Three kinds: a status against the truth of its own statement; C1 as a whole against what refinement
    /// shows; and a number that is not the one of the independent model.
    pub fn contradicts(&self, checks: &[Check]) -> Option<String> {
        let single = checks.iter().find_map(|check| self.contradicts_one(check));
        single.or_else(|| self.contradicts_c1(checks))
    }

    fn contradicts_one(&self, check: &Check) -> Option<String> {
        let Fact { truth, why } = self.of(check.name.name());
        let name = check.name.name();
        let claimed = match check.status {
            Status::Proven => true,
            Status::Numerical => check.holds,
            Status::Refuted => false,
            Status::Undecided => return None,
        };
        match (claimed, truth) {
            (true, Truth::Fails) => return Some(format!("{name} is {}, but it fails: {why}", check.status)),
            (false, Truth::Holds) => return Some(format!("{name} is refuted, but it holds: {why}")),
            _ => {}
        }
        let without_patches = claimed || ["regular", "injective", "corner", "gauss"].contains(&name);
        if !self.has_patches() && without_patches && OF_PATCHES.contains(&name) {
            return Some(format!(
                "{name} is {} without patches: {:?}",
                check.status, self.local.regular
            ));
        }
        claimed.then(|| self.contradicts_number(check)).flatten()
    }

    /// Enclosures and margins of what is proven, within a millionth.
    fn contradicts_number(&self, check: &Check) -> Option<String> {
        const SLACK: f64 = 1e-6;
        let [low, high] = check.enclosure.map(|found| [found.lo(), found.hi()])?;
        let outside = |value: f64| !(value >= low - SLACK && value <= high + SLACK);
        let differs = |what: &str, value: f64| {
            Some(format!(
                "{}: {what} is {value}, enclosed in [{low}, {high}]",
                check.name
            ))
        };
        let lead = self.others.first()?.value;
        match check.name.name() {
            // points that do not act may have larger ones
            "dominant" if high < lead.norm() - SLACK => differs("the largest modulus", lead.norm()),
            "subdominant" if outside(lead.re) || lead.im.abs() > SLACK => {
                let next = self.others.get(1).map(|other| other.value);
                Some(format!(
                    "subdominant: enclosed in [{low}, {high}], but the leading pair is {lead}, {next:?}"
                ))
            }
            "bounded_curvature" => self
                .ratio
                .filter(|&ratio| high < ratio - SLACK)
                .and_then(|r| differs("the ratio", r)),
            "hull" => {
                let least = double(&self.local.smallest.0);
                (low > least + ROUNDED)
                    .then(|| differs("the smallest weight", least))
                    .flatten()
            }
            _ => None,
        }
    }

    fn contradicts_c1(&self, checks: &[Check]) -> Option<String> {
        let Fact { truth, why } = self.of("c1");
        match (c1(checks), truth) {
            (Status::Proven | Status::Numerical, Truth::Fails) => Some(format!("c1 is proven, but {why}")),
            (Status::Refuted, Truth::Holds) if status(checks, "row_sums") != Status::Refuted => {
                Some(format!("c1 is refuted, but {why}"))
            }
            _ => None,
        }
    }
}
