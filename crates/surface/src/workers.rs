//! Who does work that falls into parts.

use nalgebra::Point3;

/// Runs the same work on parts of an array, in any order and on any number of threads: parts do not depend on
/// each other, so that the result has the same bits. This crate has no threads of its own.
pub trait Workers: Sync {
    /// Work on parts of points; the work is told the number of its part.
    fn points(&self, parts: Vec<&mut [Point3<f64>]>, work: &(dyn Fn(usize, &mut [Point3<f64>]) + Sync));

    /// Work on parts of indices.
    fn indices(&self, parts: Vec<&mut [u32]>, work: &(dyn Fn(usize, &mut [u32]) + Sync));
}

/// One part after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Serial;

impl Workers for Serial {
    fn points(&self, parts: Vec<&mut [Point3<f64>]>, work: &(dyn Fn(usize, &mut [Point3<f64>]) + Sync)) {
        for (index, part) in parts.into_iter().enumerate() {
            work(index, part);
        }
    }

    fn indices(&self, parts: Vec<&mut [u32]>, work: &(dyn Fn(usize, &mut [u32]) + Sync)) {
        for (index, part) in parts.into_iter().enumerate() {
            work(index, part);
        }
    }
}
