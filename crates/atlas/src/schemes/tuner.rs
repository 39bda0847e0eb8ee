//! Members of the lambda-scheme with weights of users, and those that are tuned on demand.

use crate::cache::Cache;
use crate::error::Error;
use crate::progress::{Progress, Silent};
use crate::run::minima_over_lambda;
use crate::table::short;
use eigenring_scheme::Spec;
use eigenring_scheme::lambda::{Bounds, Domain, Member, Plane, Source, Splines, Untabulated};
use eigenring_tune::sweep::{Options, Problem};
use serde::{Deserialize, Serialize};

/// Weights given by users may miss a bound by this much: they are often printed to seven digits.
const FEASIBILITY_TOLERANCE: f64 = 1e-6;

/// A member of the lambda-scheme with weights that must be feasible, up to 1e-6. At valence 4, where f3 is
/// mu, it is set to mu exactly.
///
/// `s` is that of the rule if not given; `phi` is the ratio alpha / beta, 6 in the paper.
///
/// # Errors
/// Those of [`Member::given`], of [`Domain::new`] for phi, and of [`Domain::check`] for the weights.
pub fn feasible(valence: usize, lambda: f64, s: Option<f64>, phi: f64, [f2, f3]: [f64; 2]) -> Result<Member, Error> {
    let mut member = Member::given(valence, lambda, s, [f2, f3])?;
    member.plane.phi = phi;
    Domain::new(member.plane, Bounds::Sharp, 0.0)?.check(f2, f3, FEASIBILITY_TOLERANCE)?;
    if valence == 4 {
        member.f3 = member.plane.mu();
    }
    Ok(member)
}

/// Finds members of the lambda-scheme that the embedded table does not hold: in a cache, or by tuning with
/// the default [`Options`].
#[derive(Clone, Debug)]
pub struct Tuner<'a> {
    /// Where tuned members are remembered.
    pub cache: Cache,
    /// Who is told of the tuning.
    pub progress: &'a dyn Progress,
}

impl Default for Tuner<'_> {
    /// Nothing is remembered, and nobody told.
    fn default() -> Self {
        Tuner {
            cache: Cache::default(),
            progress: &Silent,
        }
    }
}

/// A tuned stencil as it is remembered.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Tuned {
    lambda: f64,
    s: f64,
    f2: f64,
    f3: f64,
    total: f64,
}

impl Tuner<'_> {
    /// The member at lambda: that of the table where it reaches and s is that of the rule, else a tuned one.
    ///
    /// # Errors
    /// Those of the plane, and of the tuning.
    pub fn at(&self, valence: usize, lambda: f64, s: Option<f64>) -> Result<Member, Error> {
        Member::at(valence, lambda, s, Splines::Paper, |wanted| self.tune(wanted, s))
    }

    /// The globally optimal member of a valence.
    ///
    /// # Errors
    /// A valence below 3, or one for which the rule for s has no solution; those of the tuning.
    pub fn optimal(&self, valence: usize) -> Result<Member, Error> {
        Member::optimal(valence, |wanted| self.tune(wanted, None))
    }

    /// The member that a spec names, if it names one.
    ///
    /// # Errors
    /// As [`Tuner::at`] and [`Tuner::optimal`].
    pub fn member(&self, spec: &Spec, valence: usize) -> Result<Option<Member>, Error> {
        let given = match spec {
            Spec::Lambda { s, .. } => *s,
            _ => None,
        };
        spec.member(valence, |wanted| self.tune(wanted, given))
    }

    /// What the table does not hold; `given` is the s that was asked for, if one was.
    fn tune(&self, wanted: Untabulated, given: Option<f64>) -> Result<Member, Error> {
        let options = Options::default();
        let tuned = match wanted {
            Untabulated::Optimal { valence } => {
                let key = format!("N{valence}-optimal");
                self.remembered(&key, &format!("the optimal stencil of N = {valence}"), || {
                    let (found, _) = minima_over_lambda(valence, &options, self.progress)?;
                    let best = found.optimum();
                    Ok(Tuned {
                        lambda: best.lambda,
                        s: best.s,
                        f2: best.minimum.f2,
                        f3: best.minimum.f3,
                        total: best.minimum.total,
                    })
                })?
            }
            Untabulated::At { plane } => {
                let Plane { valence, lambda, s, .. } = plane;
                let key = format!("N{valence}-lambda{lambda}-s{s}");
                let given = given.map_or(String::new(), |s| format!(", s = {s}"));
                self.remembered(&key, &format!("N = {valence}, lambda = {lambda}{given}"), || {
                    let found = Problem::on_plane(plane, &options)?.search(options.starts)?;
                    let best = found.lowest();
                    Ok(Tuned {
                        lambda,
                        s,
                        f2: best.f2,
                        f3: best.f3,
                        total: best.total,
                    })
                })?
            }
        };
        let plane = match wanted {
            Untabulated::Optimal { valence } => Plane::new(valence, tuned.lambda, tuned.s)?,
            Untabulated::At { plane } => plane,
        };
        Ok(Member {
            plane,
            f2: tuned.f2,
            f3: tuned.f3,
            source: Source::Tuned,
        })
    }

    fn remembered(&self, key: &str, what: &str, tune: impl FnOnce() -> Result<Tuned, Error>) -> Result<Tuned, Error> {
        if let Some(tuned) = self.cache.get::<Tuned>(key) {
            self.progress.note(&format!(
                "{what} is not tabulated; remembered from an earlier run, E = {}",
                short(tuned.total)
            ));
            return Ok(tuned);
        }
        let tuned = tune()?;
        let kept = self.cache.put(key, &tuned);
        let place = kept.map_or("not kept: no cache folder can be written".to_owned(), |path| {
            format!("kept in {}", path.display())
        });
        self.progress.note(&format!(
            "{what} is not tabulated; tuned now, E = {} ({place})",
            short(tuned.total)
        ));
        Ok(tuned)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_users_must_be_feasible() {
        assert!(feasible(6, 0.55, None, 6.0, [0.25, 0.2]).is_ok());
        let error = feasible(6, 0.55, None, 6.0, [0.9, 0.1]).unwrap_err();
        assert!(
            error.to_string().contains("f1") && error.accepted().is_some(),
            "{error}"
        );
        assert!(feasible(6, f64::NAN, None, 6.0, [0.25, 0.2]).is_err());
        assert!(feasible(6, 0.55, None, 6.0, [f64::NAN, 0.2]).is_err());
        // valence 4: f3 must be mu, and is set to it exactly
        let member = feasible(4, 0.5, None, 6.0, [0.25, 0.25 + 1e-8]).unwrap();
        assert_eq!(member.f3, 0.25);
        assert!(feasible(4, 0.5, None, 6.0, [0.25, 0.26]).is_err());
    }
}
