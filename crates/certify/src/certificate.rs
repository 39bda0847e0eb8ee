//! Certificates: making, checking, storing and checking again.
//!
//! A [`Certificate`] says of one exact scheme at one valence what was proven, refuted or left open, and keeps
//! the evidence: the approximate eigenvectors and the subdivisions with which the proofs go through.
//! [`certify`] makes one in two steps that share nothing but the problem: a search ([`find`](crate::find),
//! [`map::find`](crate::map::find)), in doubles, and the checks, in intervals and exact arithmetic.
//! [`recheck`] runs the checks alone, on a stored certificate, and compares what they say with what is
//! claimed.
//!
//! The digest in a file shows that it was changed after it was written. It is no protection, and none is
//! needed: every claim is proven anew from the scheme. Someone who changes claim and digest is told that the
//! claim does not hold; someone who changes the scheme has the certificate of another scheme, which says so.

use crate::conditions::{self, Facts, Subdominant};
use crate::document::{Document, tool};
use crate::levels::levels;
use crate::map::{self, CurvatureEvidence, Heights, JacobianEvidence, PlaneNet, Sign, WindingEvidence};
use crate::rows;
use crate::spectral::{self, Block, Spectrum};
use crate::{Check, Error, Input, Interval, Statement, Status, Subject, Witness, find};
use eigenring_scheme::Lattice;
use eigenring_spectral::Annulus;
use serde::{Deserialize, Serialize};
use std::slice;

/// The format that this version reads and writes.
pub const CERTIFICATE_VERSION: u32 = 2;

/// What is known of a scheme at a valence, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Version of the format, [`CERTIFICATE_VERSION`].
    pub version: u32,
    /// Version of the tool.
    pub tool: String,
    /// The exact scheme.
    pub input: Input,
    /// The valence.
    pub valence: usize,
    /// The degree of the B-splines that the regular rules were found to refine.
    pub degree: Option<usize>,
    /// How the weights of a file were balanced; absent where nothing was to be balanced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub balanced: Option<Balanced>,
    /// What was found.
    pub evidence: Evidence,
    /// What is claimed.
    pub checks: Vec<Check>,
    /// FNV-1a hash of everything else.
    pub digest: String,
}

/// Rounded weights that were [balanced](eigenring_scheme::user::Reading).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Balanced {
    /// How many stencils were changed.
    pub rows: usize,
    /// The largest change of a weight.
    pub largest: f64,
}

/// What a search found. None of it is believed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    /// For the eigenvalues.
    pub spectrum: spectral::Evidence,
    /// For the Jacobian of the characteristic map.
    pub jacobian: Option<JacobianEvidence>,
    /// For its winding number.
    pub winding: Option<WindingEvidence>,
    /// For the Gauss curvatures of the second-order maps: cup, then saddles.
    pub curvature: Vec<CurvatureEvidence>,
}

/// Makes a certificate.
///
/// # Errors
/// Those of the input; an open question is no error.
pub fn certify(input: Input, valence: usize) -> Result<Certificate, Error> {
    let subject = input.subject(valence)?;
    let mut evidence = Evidence::default();
    let checks = match patches(&subject)? {
        Err(checks) => checks,
        Ok((annulus, blocks)) => {
            evidence.spectrum = find::evidence(&blocks);
            let proof = Proof::new(&subject, annulus, blocks, &evidence.spectrum)?;
            if let Some(net) = &proof.net {
                let limits = map::find::Limits::default();
                evidence.jacobian = Some(map::find::jacobian(net, limits));
                evidence.winding = Some(map::find::boundary(net, limits));
                for (heights, sign) in &proof.heights {
                    let found = map::find::curvature(net, heights, *sign, limits);
                    evidence.curvature.push(found);
                }
            }
            proof.finish(&evidence)
        }
    };
    Ok(Certificate::new(input, &subject, evidence, checks))
}

/// Runs the checks alone.
///
/// # Errors
/// Those of the input.
pub fn check(input: &Input, valence: usize, evidence: &Evidence) -> Result<Vec<Check>, Error> {
    check_subject(&input.subject(valence)?, evidence)
}

fn check_subject(subject: &Subject, evidence: &Evidence) -> Result<Vec<Check>, Error> {
    match patches(subject)? {
        Err(checks) => Ok(checks),
        Ok((annulus, blocks)) => Ok(Proof::new(subject, annulus, blocks, &evidence.spectrum)?.finish(evidence)),
    }
}

/// The patches and the blocks of the matrix that determines them; or, where the regular rules are those of no
/// B-spline, all that can be said without patches.
type Patches = Result<(Annulus, Vec<Block>), Vec<Check>>;

fn patches(subject: &Subject) -> Result<Patches, Error> {
    match subject.scheme.degree() {
        Some(2..) => return Ok(Ok(spectral::problem(&subject.scheme)?)),
        Some(_) => {
            let reason = "patches of degree 1 have kinks between them: the regular surface is not C1";
            let (row_sums, hull) = (rows::row_sums(subject)?, rows::hull(subject)?);
            return Ok(Err(without_patches(subject, row_sums, hull, reason)));
        }
        None => {}
    }
    let mask = subject.scheme.regular_mask().map(|mask| {
        let weights: Vec<String> = mask.values().map(|weight| format!("{}", weight.mid())).collect();
        format!(" ({})", weights.join(", "))
    });
    let reason = match mask {
        Some(mask) => format!(
            "the lines of all passes together{mask} are no uniform B-spline's mask, so that the regular surface is not known"
        ),
        None => "rules change across a spoke or from sector to sector also far from the centre".to_owned(),
    };
    let (row_sums, hull) = (rows::row_sums(subject)?, rows::hull(subject)?);
    Ok(Err(without_patches(subject, row_sums, hull, &reason)))
}

/// What is said where nothing but rows can be looked at.
fn without_patches(subject: &Subject, row_sums: Check, hull: Check, reason: &str) -> Vec<Check> {
    let mut checks = vec![row_sums, hull];
    let others = Statement::ALL.into_iter().filter(|statement| match statement {
        Statement::RowSums | Statement::Hull => false,
        Statement::Levels => !subject.scheme.leading().is_empty(),
        Statement::Corner => subject.scheme.lattice() == Lattice::Vertex,
        _ => true,
    });
    checks.extend(others.map(|statement| Check::undecided(statement, reason)));
    checks
}

/// The checks, up to the point where the characteristic map is known.
struct Proof<'a> {
    subject: &'a Subject,
    checks: Vec<Check>,
    lambda: Option<Subdominant>,
    net: Option<PlaneNet<Interval>>,
    heights: Vec<(Heights<Interval>, Sign)>,
}

impl<'a> Proof<'a> {
    fn new(
        subject: &'a Subject,
        annulus: Annulus,
        blocks: Vec<Block>,
        evidence: &spectral::Evidence,
    ) -> Result<Self, Error> {
        let row_sums = rows::row_sums(subject)?;
        let affine = matches!(row_sums.status, Status::Proven | Status::Numerical);
        let hull = rows::hull(subject)?;
        if !affine {
            // block 0 was divided by a vector that is then no eigenvector, and what is left says nothing of
            // the scheme
            let reason = "rows are not known to sum to 1";
            let checks = without_patches(subject, row_sums, hull, reason);
            return Ok(Proof {
                subject,
                checks,
                lambda: None,
                net: None,
                heights: Vec::new(),
            });
        }
        let spectrum = Spectrum::new(annulus, blocks, evidence);
        if !subject.scheme.limit().is_rotation_symmetric() {
            return Ok(Proof::of_different_sectors(subject, vec![row_sums, hull], &spectrum));
        }
        let mut facts = Facts::new(subject);
        let dominant = conditions::dominant(&spectrum);
        let (subdominant, lambda) = conditions::subdominant(subject, &spectrum, &mut facts);
        let mut checks = vec![row_sums, hull, dominant, subdominant];
        checks.extend(levels(
            subject,
            lambda.as_ref().map(|lambda| slice::from_ref(&lambda.value)),
        ));
        let (mut net, mut heights) = (None, Vec::new());
        match &lambda {
            None => {
                for name in [Statement::BoundedCurvature, Statement::NonDegenerate, Statement::Strict] {
                    checks.push(Check::undecided(name, "no subdominant eigenvalue was proven"));
                }
            }
            Some(lambda) => {
                checks.extend(conditions::second_order(subject, &spectrum, lambda, &mut facts));
                net = characteristic(&spectrum, lambda);
                if let Some(net) = &net {
                    heights = second_order_maps(&spectrum, lambda, net);
                }
            }
        }
        Ok(Proof {
            subject,
            checks,
            lambda,
            net,
            heights,
        })
    }

    /// The same for rules that differ from sector to sector: the statements about C1 alone.
    fn of_different_sectors(subject: &'a Subject, mut checks: Vec<Check>, spectrum: &Spectrum) -> Self {
        let (subdominant, pair) = conditions::distinct_pair(spectrum);
        checks.extend([conditions::dominant(spectrum), subdominant]);
        let values = pair.map(|pair| pair.map(|entry| entry.value));
        checks.extend(levels(subject, values.as_ref().map(|values| &values[..])));
        let reason = match pair {
            None => "no subdominant eigenvalues were proven",
            Some(_) => "stated of a double subdominant eigenvalue, and there are two different ones",
        };
        for name in [Statement::BoundedCurvature, Statement::NonDegenerate, Statement::Strict] {
            checks.push(Check::undecided(name, reason));
        }
        let vector = |entry: Subdominant| spectrum.points(&spectrum.entries[entry.position]);
        let net = pair
            .and_then(|[larger, smaller]| PlaneNet::whole(spectrum.annulus, [vector(larger)?, vector(smaller)?]).ok());
        Proof {
            subject,
            checks,
            lambda: pair.map(|[larger, _]| larger),
            net,
            heights: Vec::new(),
        }
    }

    fn finish(mut self, evidence: &Evidence) -> Vec<Check> {
        // where rows do not sum to 1 every statement has been spoken of
        if self.checks.iter().all(|check| check.name != Statement::Regular) {
            self.checks.extend(self.map_checks(evidence));
        }
        if self.subject.floating {
            self.checks = self.checks.into_iter().map(Check::of_rounded_numbers).collect();
        }
        self.of_the_limit_level();
        self.checks.sort_by_key(|check| check.name);
        self.checks
    }

    /// Where levels differ, what refutes a statement about the limit level refutes one about the surface only
    /// if some net shows it after the leading levels: the tangents do if `levels` is proven, and of other
    /// modes nothing is known.
    fn of_the_limit_level(&mut self) {
        if self.subject.scheme.leading().is_empty() {
            return;
        }
        let shown = self
            .checks
            .iter()
            .any(|check| check.name == Statement::Levels && check.status == Status::Proven);
        for check in &mut self.checks {
            let of_limit = match check.name {
                Statement::Regular | Statement::Injective => !shown,
                Statement::Dominant | Statement::Subdominant | Statement::BoundedCurvature => true,
                _ => false,
            };
            if of_limit && check.status == Status::Refuted {
                let text = check.witness.as_ref().map_or("", |witness| witness.text.as_str());
                let reason = format!("of the limit level: {text}; the leading levels may leave no net that shows it");
                *check = Check::undecided(check.name, reason);
            }
        }
    }

    fn map_checks(&self, evidence: &Evidence) -> Vec<Check> {
        let Some(net) = &self.net else {
            let reason = match &self.lambda {
                None => "no subdominant eigenvalue was proven",
                Some(_) => "the characteristic map could not be enclosed",
            };
            return [
                Statement::Regular,
                Statement::Injective,
                Statement::Corner,
                Statement::Gauss,
            ]
            .map(|name| Check::undecided(name, reason))
            .into();
        };
        let (regular, injective) = (regular(net, evidence), injective(net, evidence));
        // the winding number decides for regular maps
        let injective = if injective.status == Status::Proven && regular.status != Status::Proven {
            Check::undecided(
                Statement::Injective,
                "the boundary winds once, but the map is not proven regular",
            )
        } else {
            injective
        };
        let mut checks = vec![regular, injective];
        checks.extend(corner(net));
        checks.push(self.gauss(net, evidence));
        checks
    }

    fn gauss(&self, net: &PlaneNet<Interval>, evidence: &Evidence) -> Check {
        const NAME: Statement = Statement::Gauss;
        if self.heights.len() != evidence.curvature.len() || self.heights.is_empty() {
            return Check::undecided(NAME, "the second-order maps could not be enclosed");
        }
        let mut ranges = Vec::new();
        for ((heights, sign), claim) in self.heights.iter().zip(&evidence.curvature) {
            let Some(found) = map::curvature(net, heights, *sign, claim) else {
                return Check::undecided(NAME, "the evidence does not fit");
            };
            ranges.extend(found.into_iter().map(|range| (range, *sign)));
        }
        let text = |sign: &Sign| match sign {
            Sign::Positive => "cup: smallest Gauss curvature",
            Sign::Negative => "saddle: largest Gauss curvature",
        };
        let wrong = ranges.iter().find(|(range, _)| range.status == Status::Refuted);
        if let Some((range, sign)) = wrong {
            let mut witness =
                Witness::new(format!("{} is {}", text(sign), range.extreme.mid())).with("extreme", range.extreme);
            if let Some(place) = range.place {
                witness = located(witness, "", place);
            }
            return Check::refuted(NAME, witness).enclosing(range.extreme);
        }
        if ranges.iter().all(|(range, _)| range.status == Status::Proven) {
            let margin = ranges
                .iter()
                .map(|(range, _)| range.extreme.mig())
                .fold(f64::INFINITY, f64::min);
            return Check::proven(NAME).margin(margin);
        }
        Check::undecided(NAME, "a sign is open")
    }
}

fn parts(net: spectral::Net) -> [Vec<Interval>; 2] {
    let (x, y) = net.into_iter().unzip();
    [x, y]
}

fn characteristic(spectrum: &Spectrum, lambda: &Subdominant) -> Option<PlaneNet<Interval>> {
    let entry = &spectrum.entries[lambda.position];
    let net = spectrum.net(entry, lambda.value)?;
    PlaneNet::new(spectrum.annulus, 1, true, parts(net)).ok()
}

/// The maps of the largest further eigenvalues of the blocks 0 and 2 (N = 3: of block 1 once more; N = 4: two
/// of block 2).
fn second_order_maps(
    spectrum: &Spectrum,
    lambda: &Subdominant,
    net: &PlaneNet<Interval>,
) -> Vec<(Heights<Interval>, Sign)> {
    let n = net.sectors();
    let largest = |index: usize, count: usize| {
        let mut of_block: Vec<usize> = (0..spectrum.entries.len())
            .filter(|&position| position != lambda.position && spectrum.entries[position].index == index)
            .collect();
        let modulus = |position: usize| spectrum.entries[position].value.modulus().mid();
        of_block.sort_by(|&a, &b| modulus(b).total_cmp(&modulus(a)));
        // a map is that of the largest eigenvalue only if nothing else in the block may be as large
        let enclosed = |position: usize| spectrum.entries[position].value.modulus();
        let rest = of_block.iter().skip(count).map(|&position| enclosed(position).hi());
        let rest = rest.fold(0.0, f64::max);
        of_block.truncate(count);
        if of_block.iter().any(|&position| enclosed(position).lo() <= rest) {
            of_block.clear();
        }
        // one that is only bounded may be the one that is looked for
        let smallest = of_block
            .iter()
            .map(|&position| spectrum.entries[position].value.modulus().lo());
        let smallest = smallest.fold(f64::INFINITY, f64::min);
        let mut bounds = spectrum.bounds.iter().filter(|bound| bound.index == index);
        if bounds.any(|bound| bound.radius >= smallest) {
            of_block.clear();
        }
        of_block
    };
    let heights = |position: usize, sign: Sign| {
        let entry = &spectrum.entries[position];
        let [re, im] = parts(spectrum.net(entry, entry.value.re)?);
        let zero = |part: &Vec<Interval>| part.iter().all(|z| z.is_zero());
        let parts = match 2 * entry.index == n || entry.index == 0 {
            // a mode of one sign pattern is real or imaginary as a whole
            true if zero(&im) => vec![re],
            true if zero(&re) => vec![im],
            true => return None,
            false => vec![re, im],
        };
        Some((Heights::new(net, entry.index, parts).ok()?, sign))
    };
    let saddles = match n {
        3 => largest(1, 1),
        4 => largest(2, 2),
        _ => largest(2, 1),
    };
    let wanted = if n == 4 { 3 } else { 2 };
    let found: Vec<_> = largest(0, 1)
        .into_iter()
        .filter_map(|position| heights(position, Sign::Positive))
        .chain(
            saddles
                .into_iter()
                .filter_map(|position| heights(position, Sign::Negative)),
        )
        .collect();
    if found.len() == wanted { found } else { Vec::new() }
}

fn located(witness: Witness, prefix: &str, place: map::Place) -> Witness {
    let number = |x: usize| Interval::point(x as f64);
    witness
        .with(&format!("{prefix}sector"), number(place.sector))
        .with(&format!("{prefix}p"), number(place.p))
        .with(&format!("{prefix}q"), number(place.q))
        .with(&format!("{prefix}u"), Interval::point(place.u))
        .with(&format!("{prefix}v"), Interval::point(place.v))
}

fn regular(net: &PlaneNet<Interval>, evidence: &Evidence) -> Check {
    const NAME: Statement = Statement::Regular;
    let Some(claim) = &evidence.jacobian else {
        return Check::undecided(NAME, "no evidence");
    };
    let found = map::regular(net, claim);
    let [smallest, largest] = found.jacobian;
    match found.status {
        Status::Proven => {
            Check::proven(NAME)
                .margin(found.margin())
                .enclosing(if found.positive { smallest } else { largest })
        }
        Status::Refuted => {
            let text = format!("the Jacobian takes the values {} and {}", smallest.mid(), largest.mid());
            let mut witness = Witness::new(text).with("smallest", smallest).with("largest", largest);
            if let Some([low, high]) = found.fold {
                witness = located(located(witness, "smallest_", low), "largest_", high);
            }
            Check::refuted(NAME, witness).enclosing(smallest)
        }
        _ => Check::undecided(NAME, format!("{} parts, depth {}", found.cells, found.depth)),
    }
}

fn injective(net: &PlaneNet<Interval>, evidence: &Evidence) -> Check {
    const NAME: Statement = Statement::Injective;
    let Some(claim) = &evidence.winding else {
        return Check::undecided(NAME, "no evidence");
    };
    let found = map::winding(net, claim);
    match (found.status, found.number) {
        (Status::Proven, _) => Check::proven(NAME).remark("the outer boundary winds once round the centre"),
        (Status::Refuted, Some(number)) => {
            let witness = Witness::new(format!("the outer boundary winds {number} times round the centre"));
            Check::refuted(NAME, witness.with("winding", Interval::point(number as f64)))
        }
        _ => Check::undecided(NAME, format!("winding number open after {} parts", found.parts)),
    }
}

fn corner(net: &PlaneNet<Interval>) -> Option<Check> {
    const NAME: Statement = Statement::Corner;
    let found = map::corner(net)?;
    let check = match found.within {
        Status::Proven => Check::proven(NAME).margin((found.bound - found.theta).lo()),
        Status::Refuted => {
            let text = format!("theta is {}, its bound {}", found.theta.mid(), found.bound.mid());
            Check::refuted(
                NAME,
                Witness::new(text).with("theta", found.theta).with("bound", found.bound),
            )
        }
        _ => Check::undecided(NAME, format!("theta is {}, its bound {}", found.theta, found.bound)),
    };
    Some(check.enclosing(found.theta))
}

impl Document for Certificate {
    const VERSION: u32 = CERTIFICATE_VERSION;

    fn digest(&mut self) -> &mut String {
        &mut self.digest
    }
}

impl Certificate {
    fn new(input: Input, subject: &Subject, evidence: Evidence, checks: Vec<Check>) -> Self {
        let balance = subject.balance;
        let certificate = Certificate {
            version: CERTIFICATE_VERSION,
            tool: tool(),
            input,
            valence: subject.scheme.valence(),
            degree: subject.scheme.degree(),
            balanced: (balance.rows > 0).then_some(Balanced {
                rows: balance.rows,
                largest: balance.largest,
            }),
            evidence,
            checks,
            digest: String::new(),
        };
        certificate.signed()
    }

    /// The digest of everything but the digest.
    pub fn content_digest(&self) -> String {
        self.computed_digest()
    }

    /// The certificate as indented JSON.
    ///
    /// # Errors
    /// [`Error::Syntax`] if a number is not finite, which no certificate of this crate has.
    pub fn to_json(&self) -> Result<String, Error> {
        self.written()
    }

    /// The certificate as JSON on one line, a third as long.
    ///
    /// # Errors
    /// As [`Certificate::to_json`].
    pub fn to_line(&self) -> Result<String, Error> {
        self.on_one_line()
    }

    /// Reads a certificate. Its digest is not looked at here: [`recheck`] reports it.
    ///
    /// # Errors
    /// [`Error::Version`] or [`Error::Syntax`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Certificate::read(text)
    }

    /// What is claimed of a statement.
    pub fn check(&self, statement: Statement) -> Option<&Check> {
        self.checks.iter().find(|check| check.name == statement)
    }
}

/// What checking a stored certificate again has shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recheck {
    /// Whether the digest is that of the content.
    pub intact: bool,
    /// What the checks say now.
    pub checks: Vec<Check>,
    /// Claims that the checks do not confirm, and other things in which the certificate is not what they
    /// would make.
    pub differences: Vec<Difference>,
}

/// Something that was not confirmed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// What it is about: a statement, or `degree`, `balanced`, `checks`, `text`.
    pub name: String,
    /// What the certificate says, if it is about a statement.
    pub claimed: Option<Status>,
    /// What the checks say.
    pub found: Option<Status>,
    /// What differs: the status, or a number or sentence beside it.
    pub what: String,
}

impl Difference {
    fn about(name: &str, what: impl Into<String>) -> Self {
        Difference {
            name: name.to_owned(),
            claimed: None,
            found: None,
            what: what.into(),
        }
    }
}

impl Recheck {
    /// Whether the certificate is unchanged and everything it claims was confirmed.
    pub fn confirmed(&self) -> bool {
        self.intact && self.differences.is_empty()
    }
}

/// Checks the text of a stored certificate again: its scheme and its evidence, with the checks alone. The
/// text must be exactly what is written for the certificate that it holds, so that nothing is in it that was
/// not looked at.
///
/// # Errors
/// Those of reading it, and of the input.
pub fn recheck_text(text: &str) -> Result<(Certificate, Recheck), Error> {
    let certificate = Certificate::from_json(text)?;
    let mut found = recheck(&certificate)?;
    if !certificate.is_text(text)? {
        let what = "the text is not what is written for the certificate that it holds";
        found.differences.push(Difference::about("text", what));
    }
    Ok((certificate, found))
}

/// Checks a certificate again: its scheme and its evidence, with the checks alone.
///
/// # Errors
/// Those of the input.
pub fn recheck(certificate: &Certificate) -> Result<Recheck, Error> {
    let subject = certificate.input.subject(certificate.valence)?;
    let checks = check_subject(&subject, &certificate.evidence)?;
    let named = |list: &[Check], statement: Statement| list.iter().find(|check| check.name == statement).cloned();
    let mut differences = Vec::new();
    for statement in Statement::ALL {
        let (claimed, found) = (named(&certificate.checks, statement), named(&checks, statement));
        if claimed == found {
            continue;
        }
        let status = |check: &Option<Check>| check.as_ref().map(|check| check.status);
        let what = if status(&claimed) == status(&found) {
            "details"
        } else {
            "status"
        };
        differences.push(Difference {
            name: statement.name().to_owned(),
            claimed: status(&claimed),
            found: status(&found),
            what: what.to_owned(),
        });
    }
    if differences.is_empty() && certificate.checks != checks {
        let what = "a statement occurs twice, or they are in another order";
        differences.push(Difference::about("checks", what));
    }
    let made = Certificate::new(certificate.input.clone(), &subject, Evidence::default(), Vec::new());
    if certificate.degree != made.degree {
        differences.push(Difference::about("degree", "not that of the rules"));
    }
    if certificate.balanced != made.balanced {
        differences.push(Difference::about("balanced", "not what is balanced"));
    }
    Ok(Recheck {
        intact: certificate.digest == certificate.content_digest(),
        checks,
        differences,
    })
}
