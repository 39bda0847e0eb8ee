//! Which unknowns depend on which.

/// The strongly connected components of the graph on `0..size` with the edges `edge(i, j)` ("i reads j"), in
/// an order in which each reads only itself and earlier ones; and for each component which others it reads,
/// directly or not.
///
/// By the transitive closure (Warshall 1962) on rows of bits: simple, and fast enough for blocks of some
/// hundred unknowns.
pub fn components(size: usize, edge: impl Fn(usize, usize) -> bool) -> (Vec<Vec<usize>>, Vec<Vec<usize>>) {
    let words = size.div_ceil(64);
    let bit = |row: &[u64], j: usize| row[j / 64] >> (j % 64) & 1 == 1;
    let mut reach = vec![vec![0_u64; words]; size];
    for (i, row) in reach.iter_mut().enumerate() {
        for j in (0..size).filter(|&j| i == j || edge(i, j)) {
            row[j / 64] |= 1 << (j % 64);
        }
    }
    for k in 0..size {
        let through = reach[k].clone();
        for row in reach.iter_mut().filter(|row| bit(row, k)) {
            for (word, more) in row.iter_mut().zip(&through) {
                *word |= more;
            }
        }
    }
    let mut components: Vec<Vec<usize>> = Vec::new();
    let mut seen = vec![false; size];
    for i in 0..size {
        if !seen[i] {
            let members: Vec<usize> = (i..size).filter(|&j| bit(&reach[i], j) && bit(&reach[j], i)).collect();
            members.iter().for_each(|&j| seen[j] = true);
            components.push(members);
        }
    }
    // what is read reaches fewer unknowns than what reads it
    let count = |members: &Vec<usize>| reach[members[0]].iter().map(|word| word.count_ones()).sum::<u32>();
    components.sort_by_key(|members| (count(members), members[0]));
    let reads = components
        .iter()
        .enumerate()
        .map(|(own, members)| {
            let reads = |&other: &usize| other != own && bit(&reach[members[0]], components[other][0]);
            (0..components.len()).filter(reads).collect()
        })
        .collect();
    (components, reads)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn components_come_after_what_they_read(edges in proptest::collection::vec(any::<bool>(), 64)) {
            let edge = |i: usize, j: usize| edges[8 * i + j] && edges[8 * j + (i + j) % 8];
            let (components, reads) = components(8, edge);
            let place = |i: usize| components.iter().position(|c| c.contains(&i)).unwrap();
            prop_assert_eq!(components.iter().map(Vec::len).sum::<usize>(), 8);
            for i in 0..8 {
                for j in 0..8 {
                    if edge(i, j) && i != j {
                        prop_assert!(place(j) <= place(i));
                        prop_assert!(place(i) == place(j) || reads[place(i)].contains(&place(j)));
                    }
                }
            }
            for (own, reads) in reads.iter().enumerate() {
                prop_assert!(reads.iter().all(|&other| other < own));
            }
        }
    }
}
