//! Boundaries that the characteristic map does not see.
//!
//! At a boundary with many faces the two leading modes vanish on the boundary itself, whose curve is made of
//! its own points alone and shrinks faster. The Jacobian of the map is zero there, and more is true:
//!
//! **Theorem.** Let `lambda_1 > lambda_2` be simple, real, and larger than all other eigenvalues, with
//! eigenvectors x and y. Let B be a set of points that read each other only, among them all that a piece of
//! the first spoke's curve reads; let x and y vanish on B, and let mu, real, simple and with the eigenvector
//! f, lead the eigenvalues of B but the constants' 1. If at a point e of that piece f has a derivative along
//! the spoke and x one across it, and the Jacobian of (x, y) is not zero at some other point, the surface is
//! not C1 for almost all data.
//!
//! *Why.* Along the spoke the ring of level m has the derivative `mu^m (t f_u(e) + o(1))`, across it
//! `lambda_1^m (p x_v(e) + o(1))`: its normal at e tends to the direction of `t x p`. At the other point
//! normals tend to that of `p x q`. The vectors p, q, t are what data have of x, y, f: by left eigenvectors
//! of three different eigenvalues (that of mu on B, continued by zero, is one, as B reads nothing else),
//! which are linearly independent. For almost all data p, q, t are so as well, and the two limits differ.

use crate::conditions::differing::Leading;
use crate::interval::digits;
use crate::spectral::{EnclosedSpectrum, Place, eigenvector_within};
use crate::{Check, Interval, Statement, Witness};
use eigenring_spectral::PatchIndex;
use eigenring_spline::bernstein::Polynomial;
use eigenring_spline::uniform::to_bernstein;

/// A refutation of `regular` by the first spoke of an open fan, if the theorem applies.
pub fn unseen(spectrum: &EnclosedSpectrum, leading: &Leading) -> Option<Check> {
    let patches = &spectrum.patches;
    let numbering = patches.numbering();
    let [x, y] = leading.vectors.as_ref()?;
    let block = spectrum.blocks.first().filter(|block| block.place == Place::Points)?;
    if numbering.fan.is_closed() || !patches.first_edge_is_spoke() {
        return None;
    }
    // the components of the spoke's points, all that these read, and the centre, which was divided out
    let on_spoke = |unknown: usize| block.sites[unknown].sector == 0 && block.sites[unknown].y == 0;
    let mut members: Vec<usize> = (0..block.components.len())
        .filter(|&c| block.components[c].iter().any(|&i| on_spoke(block.kept[i])))
        .collect();
    let read: Vec<usize> = members.iter().flat_map(|&c| block.reads[c].iter().copied()).collect();
    members.extend(read);
    members.sort_unstable();
    members.dedup();
    let pivot = block.divided.as_ref()?.pivot;
    if !on_spoke(pivot) || block.sites[pivot].x != 0 {
        return None;
    }
    let points = members
        .iter()
        .flat_map(|&c| &block.components[c])
        .map(|&i| block.kept[i]);
    let closed: Vec<usize> = points.chain([pivot]).collect();
    // what the centre reads takes part too
    let reads_out = block.divided.as_ref()?.row.iter().zip(&block.kept);
    if reads_out
        .clone()
        .any(|(weight, point)| !weight.is_zero() && !closed.contains(point))
    {
        return None;
    }
    if closed.iter().any(|&point| !(x[point].is_zero() && y[point].is_zero())) {
        return None;
    }
    let own = || {
        spectrum
            .entries
            .iter()
            .filter(|entry| members.contains(&entry.component))
    };
    let lead = own().max_by(|a, b| a.value.modulus().mid().total_cmp(&b.value.modulus().mid()))?;
    let mu = lead.value.modulus();
    let others = own()
        .filter(|entry| !std::ptr::eq(*entry, lead))
        .map(|entry| entry.value.modulus().hi());
    let bounds = spectrum
        .bounds
        .iter()
        .filter(|bound| members.contains(&bound.component));
    let largest = others.chain(bounds.map(|bound| bound.radius)).fold(0.0, f64::max);
    if !(lead.value.is_real() && largest < mu.lo()) {
        return None;
    }
    // elsewhere mu may be an eigenvalue once more
    let f = eigenvector_within(block, lead, &members)?;
    let conversion = to_bernstein::<Interval>(patches.annulus.degree);
    let edge = PatchIndex {
        sector: 0,
        p: patches.annulus.inner,
        q: 0,
    };
    let (middle, zero) = (Interval::point(0.5), Interval::point(0.0));
    let form = |values: &[Interval], patch: PatchIndex| patches.polynomial(values, patch, &conversion);
    let along = form(&f, edge).by_u().value(middle, zero);
    let across = form(x, edge).by_v().value(middle, zero);
    let jacobian = |patch: PatchIndex| {
        let slopes = |g: Polynomial<Interval>| [g.by_u(), g.by_v()].map(|slope| slope.value(middle, middle));
        let ([xu, xv], [yu, yv]) = (slopes(form(x, patch)), slopes(form(y, patch)));
        xu * yv - xv * yu
    };
    let mut all = (0..numbering.fan.sectors()).flat_map(|sector| patches.annulus.patches(sector));
    let regular = all.any(|patch| jacobian(patch).certainly_nonzero());
    if !(along.certainly_nonzero() && across.certainly_nonzero() && regular) {
        return None;
    }
    let text = format!(
        "both modes vanish on the boundary, whose tangent shrinks like {}^m: normals there tend to another direction than inside",
        digits(mu.mid())
    );
    let witness = Witness::new(text)
        .with("mu", lead.value.re)
        .with("along", along)
        .with("across", across);
    Some(Check::refuted(Statement::Regular, witness))
}
