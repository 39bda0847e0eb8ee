//! Strongly connected components of a matrix: its eigenvalues without the accidents of its nilpotent parts.
//!
//! Local matrices are full of structure: refined points of outer rings depend on inner ones only, so that, in
//! a suitable order, the matrix is block triangular with many zero diagonal blocks. A QR iteration on the
//! whole matrix does not see this and scatters a defective eigenvalue 0 of index m over a disc of radius
//! `eps^(1/m)`. The eigenvalues of a matrix are those of the diagonal blocks that belong to the strongly
//! connected components of its directed graph (entry (i, j) != 0 is an edge from i to j); an exact zero then
//! is an exact zero.

/// The strongly connected components of the graph on `0..size` with the edges `edge(i, j)`, each sorted, in
/// order of their smallest element. Tarjan's algorithm (R. Tarjan, *Depth-first search and linear graph
/// algorithms*, 1972), without recursion.
pub(crate) fn strong_components(size: usize, edge: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    const UNSEEN: usize = usize::MAX;
    let mut order = vec![UNSEEN; size];
    let mut low = vec![UNSEEN; size];
    let mut on_path = vec![false; size];
    let (mut path, mut components, mut count) = (Vec::new(), Vec::new(), 0);
    for root in 0..size {
        if order[root] != UNSEEN {
            continue;
        }
        // (node, next neighbour to look at)
        let mut work = vec![(root, 0)];
        while let Some((node, next)) = work.pop() {
            if next == 0 {
                order[node] = count;
                low[node] = count;
                count += 1;
                path.push(node);
                on_path[node] = true;
            }
            let mut descended = false;
            for neighbour in next..size {
                if !edge(node, neighbour) {
                    continue;
                }
                if order[neighbour] == UNSEEN {
                    work.push((node, neighbour + 1));
                    work.push((neighbour, 0));
                    descended = true;
                    break;
                }
                if on_path[neighbour] {
                    low[node] = low[node].min(order[neighbour]);
                }
            }
            if descended {
                continue;
            }
            if let Some(&(parent, _)) = work.last() {
                low[parent] = low[parent].min(low[node]);
            }
            if low[node] == order[node] {
                let start = path
                    .iter()
                    .rposition(|&n| n == node)
                    .expect("a node is on the path until its component is cut off");
                let mut component = path.split_off(start);
                for &member in &component {
                    on_path[member] = false;
                }
                component.sort_unstable();
                components.push(component);
            }
        }
    }
    components.sort_by_key(|component| component[0]);
    components
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        // Warshall's closure is plainest with indices
        #[allow(clippy::needless_range_loop)]
        #[test]
        fn components_are_the_classes_of_mutual_reachability(edges in proptest::collection::vec(any::<bool>(), 49)) {
            let size = 7;
            let edge = |i: usize, j: usize| edges[i * size + j];
            let mut reach = vec![vec![false; size]; size];
            for i in 0..size {
                for j in 0..size {
                    reach[i][j] = i == j || edge(i, j);
                }
            }
            for k in 0..size {
                for i in 0..size {
                    for j in 0..size {
                        reach[i][j] |= reach[i][k] && reach[k][j];
                    }
                }
            }
            let components = strong_components(size, edge);
            let mut seen = vec![0; size];
            for component in &components {
                for &i in component {
                    seen[i] += 1;
                    for j in 0..size {
                        prop_assert_eq!(reach[i][j] && reach[j][i], component.contains(&j));
                    }
                }
            }
            prop_assert!(seen.iter().all(|&times| times == 1));
        }
    }
}
