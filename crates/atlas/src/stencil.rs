//! One member of the lambda-scheme: its weights, and how good they are.

use crate::error::Error;
use crate::table::{Record, Table};
use eigenring_scheme::lambda::Member;
use eigenring_tune::objective::{Objective, Settings};

/// Valence, lambda, mu and s, the nine weights, those of the generalised Catmull-Clark form, and where they
/// come from.
pub fn weights(member: &Member) -> Record {
    let stencil = member.plane.stencil(member.f2, member.f3);
    let mut record = Record::default()
        .with("valence", member.plane.valence)
        .with("lambda", member.plane.lambda)
        .with("mu", member.plane.mu())
        .with("s", member.plane.s);
    for (name, weight) in stencil.weights.named() {
        record = record.with(name, weight);
    }
    record
        .with("g1", stencil.g1)
        .with("g2", stencil.g2)
        .with("g3", stencil.g3)
        .with("source", member.source.name())
}

/// The objective E with K_m, and its parts map by map: value, integrals a, b and c, and the extremes of
/// `z_xx z_yy - z_xy^2` over the Gauss points, unsigned.
///
/// # Errors
/// Those of the settings, and [`Error::Objective`] where the maps do not exist.
pub fn objective(member: &Member, settings: Settings) -> Result<(Record, Table), Error> {
    let parts = Objective::new(member.plane, settings)?.parts(member.f2, member.f3)?;
    let head = Record::default()
        .with("valence", member.plane.valence)
        .with("lambda", member.plane.lambda)
        .with("s", member.plane.s)
        .with("f2", member.f2)
        .with("f3", member.f3)
        .with("total", parts.total())
        .with("sign_change", parts.sign_change());
    let mut table = Table::new(["map", "value", "a", "b", "c", "gauss_min", "gauss_max"]);
    for (name, part) in [
        ("cup", parts.cup),
        ("saddle_re", parts.saddle_re),
        ("saddle_im", parts.saddle_im),
    ] {
        let numbers = [part.value, part.a, part.b, part.c, part.gauss_min, part.gauss_max];
        let cells = std::iter::once(name.into()).chain(numbers.map(Into::into));
        table.push(cells.collect());
    }
    Ok((head, table))
}
