//! Where searches begin.

use super::Worth;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

/// Bases of the Halton sequence; coordinates beyond them are the generator's.
const PRIMES: [u32; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

/// `count` points of the unit cube: those of the Halton sequence (Halton 1960), shifted as a whole by the
/// seed, modulo 1.
pub fn samples(dimension: usize, count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut uniform = || (generator.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let shift: Vec<f64> = (0..dimension).map(|_| uniform()).collect();
    (1..=count as u32)
        .map(|index| {
            let coordinate = |(axis, shift): (usize, &f64)| match PRIMES.get(axis) {
                Some(&base) => (radical_inverse(index, base) + shift).fract(),
                None => uniform(),
            };
            shift.iter().enumerate().map(coordinate).collect()
        })
        .collect()
}

/// The digits of `index` in a base, behind the point in reverse order.
fn radical_inverse(mut index: u32, base: u32) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while index > 0 {
        digit /= f64::from(base);
        value += digit * f64::from(index % base);
        index /= base;
    }
    value
}

/// The indices of at most `count` points, the best first, each farther from the better ones than the samples
/// lie from each other.
pub fn starts(points: &[Vec<f64>], worths: &[Worth], count: usize) -> Vec<usize> {
    let dimension = points.first().map_or(1, Vec::len);
    let apart = 0.7 * (points.len() as f64).powf(-1.0 / dimension as f64);
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| worths[a].merit().total_cmp(&worths[b].merit()));
    let mut taken: Vec<usize> = Vec::new();
    for index in order {
        if taken.len() < count
            && taken
                .iter()
                .all(|&other| distance(&points[index], &points[other]) > apart)
        {
            taken.push(index);
        }
    }
    taken
}
