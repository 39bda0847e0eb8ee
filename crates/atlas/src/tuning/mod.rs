//! The best values for the parameters of a scheme file, valence by valence.
//!
//! What is minimised is a [`Goal`], a sum of the measures that `compare` and `objective` print, under
//! [`Condition`]s. At each valence the free parameters run over their declared ranges: the search
//! ([`eigenring_tune::minimise`]) looks at points that a seed shifts, descends from the best of them, from
//! the declared values and from where a swarm of particles leads, and takes the best that it finds. The
//! result is the file with the numbers filled in, and a certificate for each valence: the search judges by
//! doubles, the certificate alone says what holds.

mod family;
mod goal;
mod measured;
mod output;

pub use goal::{Condition, Goal, Measure, Own};

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::schemes::SchemeFile;
use crate::table::short;
use eigenring_certify::{Certificate, Input, certify};
use eigenring_scheme::Number;
use eigenring_scheme::user::{Reading, UserScheme};
use eigenring_tune::minimise::{Found, Problem, Worth, best, descend, polish, samples, starts, swarm};
use family::{Family, Free, free};
use measured::Measured;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::BTreeMap;

/// What is to be tuned, and how.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The file; parameters that it sets are not tuned.
    pub scheme: SchemeFile,
    /// Parameters that keep their values, or get these.
    pub fixed: Vec<(String, Option<Number>)>,
    /// What is minimised.
    pub goal: Goal,
    /// Under which conditions.
    pub conditions: Vec<Condition>,
    /// How far, relatively, moduli stay below those that bound them.
    pub margin: f64,
    /// Shifts the points that are looked at first.
    pub seed: u64,
    /// From how many of them the search descends.
    pub descents: usize,
}

/// What a descent has found, as it is kept for an interrupted run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Descent {
    /// The valence.
    pub valence: usize,
    /// Which of its starts.
    pub start: usize,
    /// Where it ended, in the unit cube of the ranges.
    pub point: Vec<f64>,
    /// How many schemes it measured.
    pub evaluations: usize,
}

/// Where descents are kept as they end.
pub trait Kept: Sync {
    /// The descent from a start, if it is kept.
    fn get(&self, valence: usize, start: usize) -> Option<Descent>;

    /// Keeps a descent.
    ///
    /// # Errors
    /// Whatever prevents it, which ends the run.
    fn add(&self, descent: &Descent) -> Result<(), Error>;
}

/// Nothing is kept.
impl Kept for () {
    fn get(&self, _: usize, _: usize) -> Option<Descent> {
        None
    }

    fn add(&self, _: &Descent) -> Result<(), Error> {
        Ok(())
    }
}

/// What was found at a valence.
#[derive(Clone, Debug)]
pub struct Row {
    /// The valence.
    pub valence: usize,
    /// What is minimised, with the values that the parameters had; absent where it is not defined.
    pub before: Option<f64>,
    /// The same with the values that were found.
    pub after: Option<f64>,
    /// These values, in the order of the file.
    pub parameters: Vec<(String, f64)>,
    /// Conditions that are met without room, and parameters at an end of their range.
    pub active: Vec<String>,
    /// How many schemes were measured.
    pub evaluations: usize,
    /// What is proven of the result.
    pub certificate: Certificate,
}

/// A tuned file.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// What the file was called before.
    pub scheme: String,
    /// Its text, with the values that were found.
    pub text: String,
    /// What was found, valence by valence.
    pub rows: Vec<Row>,
}

impl Plan {
    /// The file, with what is set and fixed.
    fn base(&self) -> Result<UserScheme, Error> {
        let scheme = self.scheme.read(Reading::default())?;
        let fixed = self.fixed.iter();
        let values: Vec<(&String, Number)> = fixed.filter_map(|(name, value)| Some((name, value.clone()?))).collect();
        let refuse = |error: eigenring_scheme::Error| Error::from(error).in_file(&self.scheme.path);
        // a name that is unknown is refused, with or without a value
        let names: Vec<&String> = self.fixed.iter().map(|(name, _)| name).collect();
        scheme.freeing(&names).map_err(refuse)?;
        scheme.with(&values).map_err(refuse)
    }

    /// Everything that descents depend on, on one line.
    ///
    /// # Errors
    /// Those of reading the file.
    pub fn key(&self) -> Result<String, Error> {
        let shown = |(name, value): &(String, Number)| (name.clone(), value.to_string());
        let fixed = |(name, value): &(String, Option<Number>)| (name.clone(), value.as_ref().map(Number::to_string));
        Ok(json!({
            "tuning": env!("CARGO_PKG_VERSION"),
            "file": crate::files::read(&self.scheme.path)?,
            "set": self.scheme.values.iter().map(shown).collect::<Vec<_>>(),
            "fixed": self.fixed.iter().map(fixed).collect::<Vec<_>>(),
            "minimise": self.goal.to_string(),
            "subject_to": self.conditions.iter().map(|condition| condition.name()).collect::<Vec<_>>(),
            "margin": self.margin,
            "seed": self.seed,
            "descents": self.descents,
        })
        .to_string())
    }

    /// Tunes the file at all valences; `name` is what it is called then.
    ///
    /// # Errors
    /// [`Error::Usage`] if no parameter is free, one has no range, or no values satisfy the conditions; those
    /// of the file and of keeping descents.
    pub fn run(
        &self,
        valences: &[usize],
        name: &str,
        kept: &dyn Kept,
        progress: &dyn Progress,
    ) -> Result<Tuned, Error> {
        let base = self.base()?;
        let fixed: Vec<String> = self.fixed.iter().map(|(name, _)| name.clone()).collect();
        let free = free(&base, &fixed).map_err(|error| error.in_file(&self.scheme.path))?;
        let count = 32 << (free.len() - 1).min(3);
        let families = each(progress, "valences", valences, |&valence| {
            let points = samples(free.len(), count, self.seed.wrapping_add(valence as u64));
            let goal = (&self.goal, self.conditions.as_slice(), self.margin);
            let family = Family::new(&base, valence, &free, goal, &points);
            let family = family.map_err(|error| error.in_file(&self.scheme.path))?;
            // the declared values are looked at first
            let points: Vec<Vec<f64>> = std::iter::once(family.start()).chain(points).collect();
            Ok::<_, Error>((family, points))
        })?;
        let pairs: Vec<(usize, usize)> = (0..families.len())
            .flat_map(|family| (0..=count).map(move |point| (family, point)))
            .collect();
        let worths = each(progress, "samples", &pairs, |&(family, point)| {
            let (family, points) = &families[family];
            Ok::<Worth, Error>(family.worth(&points[point]))
        })?;
        let worths: Vec<&[Worth]> = worths.chunks(count + 1).collect();
        // `None` is the swarm
        let mut tasks: Vec<(usize, usize, Option<usize>)> = Vec::new();
        for (index, (_, points)) in families.iter().enumerate() {
            let mut chosen = starts(points, worths[index], self.descents);
            if !chosen.contains(&0) {
                chosen.push(0);
            }
            let chosen = chosen.into_iter().map(Some).chain([None]).enumerate();
            tasks.extend(chosen.map(|(start, point)| (index, start, point)));
        }
        // what is kept is not searched again
        let keep = |family: &Family<'_>, start: usize, search: &dyn Fn() -> Found| {
            let known = kept.get(family.valence, start);
            if let Some(known) = known.filter(|known| known.point.len() == free.len()) {
                return Ok(Found {
                    worth: family.worth(&known.point),
                    point: known.point,
                    evaluations: known.evaluations,
                });
            }
            let found = search();
            kept.add(&Descent {
                valence: family.valence,
                start,
                point: found.point.clone(),
                evaluations: found.evaluations,
            })?;
            Ok::<Found, Error>(found)
        };
        let found = each(progress, "descents", &tasks, |&(index, start, point)| {
            let (family, points) = &families[index];
            keep(family, start, &|| match point {
                Some(point) => descend(family, &points[point]),
                None => {
                    let swarm = swarm(family, self.seed.wrapping_add(family.valence as u64));
                    let found = descend(family, &swarm.point);
                    Found {
                        evaluations: found.evaluations + swarm.evaluations,
                        ..found
                    }
                }
            })
        })?;
        let numbers: Vec<usize> = (0..families.len()).collect();
        let minima = each(progress, "minima", &numbers, |&index| {
            let family = &families[index].0;
            let own = tasks.iter().zip(&found).filter(|((family, ..), _)| *family == index);
            let own: Vec<Found> = own.map(|(_, found)| found.clone()).collect();
            let evaluations = count + 1 + own.iter().map(|found| found.evaluations).sum::<usize>();
            let lowest = best(&own).map_or_else(|| family.start(), |lowest| lowest.point.clone());
            let lowest = keep(family, own.len(), &|| polish(family, &lowest))?;
            if !lowest.worth.is_feasible() {
                return Err(self.infeasible(family, worths[index]));
            }
            Ok((tidy(family, &lowest), evaluations + lowest.evaluations))
        })?;
        let text = self.text(&base, name, valences, &free, &minima)?;
        let tuned = UserScheme::parse(&text, name, Reading::default())?;
        let rows = each(progress, "certificates", &numbers, |&index| {
            let (family, (found, evaluations)) = (&families[index].0, &minima[index]);
            let valence = family.valence;
            let input = Input::Toml {
                text: text.clone(),
                name: name.to_owned(),
                reading: Reading::default(),
                parameters: BTreeMap::new(),
            };
            let value = |scheme: &UserScheme| -> Result<Option<f64>, Error> {
                let value = Measured::full(&scheme.scheme(valence)?, &scheme.scheme(valence)?).value(&self.goal);
                Ok(Some(value).filter(|value| value.is_finite()))
            };
            let values = free.iter().zip(&found.point);
            Ok::<Row, Error>(Row {
                valence,
                before: value(&base)?,
                after: value(&tuned)?,
                parameters: values.map(|(free, &x)| (free.name.clone(), free.value(x))).collect(),
                active: self.active(&free, found),
                evaluations: *evaluations,
                certificate: certify(input, valence)?,
            })
        })?;
        Ok(Tuned {
            scheme: base.name(),
            text,
            rows,
        })
    }

    /// The file with what was found, and what was set and fixed, at each valence.
    fn text(
        &self,
        base: &UserScheme,
        name: &str,
        valences: &[usize],
        free: &[Free],
        minima: &[(Found, usize)],
    ) -> Result<String, Error> {
        let mut values: BTreeMap<String, BTreeMap<usize, String>> = BTreeMap::new();
        let mut put = |name: &str, valence, value| values.entry(name.to_owned()).or_default().insert(valence, value);
        for (&valence, (found, _)) in valences.iter().zip(minima) {
            for (free, &x) in free.iter().zip(&found.point) {
                put(&free.name, valence, free.written(free.value(x)));
            }
            for parameter in base.parameters() {
                if let Some(set) = parameter.changed() {
                    put(&parameter.name, valence, set.to_string());
                }
            }
        }
        let text = base.tuned(name, &values)?;
        let conditions: Vec<&str> = self.conditions.iter().map(|condition| condition.name()).collect();
        let subject = match conditions.is_empty() {
            true => String::new(),
            false => format!(" --subject-to {}", conditions.join(",")),
        };
        let (goal, scheme) = (&self.goal, base.name());
        Ok(format!(
            "# {scheme:?}, tuned by 'eigenring tune --minimise {goal}{subject}':\n# the values found for single valences stand under 'except' of each parameter\n{text}"
        ))
    }

    /// Conditions without room, and parameters at an end of their range.
    fn active(&self, free: &[Free], found: &Found) -> Vec<String> {
        const NEAR: f64 = 1e-7;
        let conditions = self.conditions.iter().zip(&found.worth.slacks);
        let conditions = conditions.filter(|(_, slack)| **slack < NEAR);
        let conditions = conditions.map(|(condition, _)| condition.name().to_owned());
        let ends = free.iter().zip(&found.point).filter_map(|(free, &x)| match x {
            x if x <= 0.0 => Some(format!("{} = {}", free.name, free.written(free.range[0]))),
            x if x >= 1.0 => Some(format!("{} = {}", free.name, free.written(free.range[1]))),
            _ => None,
        });
        conditions.chain(ends).collect()
    }

    /// Which condition fails everywhere.
    fn infeasible(&self, family: &Family<'_>, worths: &[Worth]) -> Error {
        let total = worths.len();
        let mut reasons = Vec::new();
        for (index, condition) in self.conditions.iter().enumerate() {
            let slacks = worths.iter().map(|worth| worth.slacks[index]);
            let holds = slacks.clone().filter(|slack| *slack >= 0.0).count();
            if holds < total {
                let judged = slacks.clone().filter(|slack| !slack.is_nan()).reduce(f64::max);
                let best = judged.filter(|_| holds == 0);
                let best = best.map_or(String::new(), |slack| format!(" (by {} at best)", short(-slack)));
                let name = condition.name();
                reasons.push(match holds {
                    0 => format!("{name} fails at all of {total} samples{best}"),
                    _ => format!("{name} holds at {holds} of {total} samples"),
                });
            }
        }
        let allowed = worths
            .iter()
            .filter(|worth| worth.slacks.iter().all(|slack| *slack >= 0.0));
        let allowed: Vec<&Worth> = allowed.collect();
        if !allowed.is_empty() && allowed.iter().all(|worth| !worth.is_feasible()) {
            reasons.push(format!(
                "{} is not defined at any of {} samples",
                self.goal,
                allowed.len()
            ));
        }
        Error::Usage {
            message: format!(
                "no values within the ranges are feasible at N = {}: {}",
                family.valence,
                reasons.join(", ")
            ),
            accepted: "wider ranges in the file, other conditions, or another objective".to_owned(),
        }
    }
}

/// The same minimum in fewer digits, and with the declared values of parameters that do not matter, as far as
/// neither makes it worse.
fn tidy(family: &Family<'_>, found: &Found) -> Found {
    let mut tidy = found.clone();
    let take = |tidy: &mut Found, point: Vec<f64>| {
        let worth = family.worth(&point);
        let better = worth.merit() <= tidy.worth.merit();
        if better {
            tidy.point = point;
            tidy.worth = worth;
        }
        better
    };
    for (axis, declared) in family.start().into_iter().enumerate() {
        let mut point = tidy.point.clone();
        point[axis] = declared;
        take(&mut tidy, point);
    }
    for digits in [2, 4, 6, 8, 10, 12, 14] {
        let rounded = |(free, &x): (&Free, &f64)| {
            let value = free.value(x);
            let text = format!("{value:.*e}", digits - 1);
            let rounded = text.parse().unwrap_or(value);
            free.coordinate(rounded)
        };
        let point = family.free.iter().zip(&tidy.point).map(rounded).collect();
        if take(&mut tidy, point) {
            break;
        }
    }
    tidy
}

#[cfg(test)]
mod tests;
