//! The tables of the generalised tension scheme: `results/tension`.
//!
//! Fang, Ma and Wang, *A generalized surface subdivision scheme of arbitrary order with a tension parameter*,
//! section 5: the eigenvalues of the local matrices over valences, orders, tensions and levels, their Table 2
//! and the characteristic meshes of their Fig. 10; all of it for odd orders as well.
//!
//! **Levels.** Level l refines with `u_l`, where `u_{l+1} = sqrt((1+u_l)/2)`: level 0 is the first refinement
//! and uses the given `u_0`. The paper lists levels 1 to 10; its Algorithm 3 passes `u_l` to level l, so
//! these are levels 1 to 10 here.
//!
//! **Order of the eigenvalues.** By falling modulus, each as often as its multiplicity in the whole local
//! matrix: 1, lambda_1, lambda_2, lambda_3. The matrices are those of the smallest closed set of rings;
//! `outer` is the largest modulus that rings further out add, `2^-(k-2)/(1+u)`.

mod meshes;
mod sweep;

use crate::error::Error;
use crate::progress::{Progress, each};
use crate::results::tool;
use crate::table::{Cell, Format, Table};
use serde::{Deserialize, Serialize};
use sweep::{Case, Row, rows};

/// The folder below the output folder.
pub const FOLDER: &str = "tension";

/// Everything that results depend on, as it is recorded with them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// The valences of the sweep.
    pub valences: Vec<usize>,
    /// Even and odd orders of the sweep.
    pub orders: [Vec<usize>; 2],
    /// The initial tensions.
    pub tensions: Vec<f64>,
    /// The levels, first and last.
    pub levels: [usize; 2],
    /// Table 2: orders, valences and levels, and the initial tension.
    pub table: (Vec<usize>, Vec<usize>, Vec<usize>, f64),
    /// Characteristic meshes: even and odd orders, valences, level and initial tension.
    pub meshes: ([Vec<usize>; 2], Vec<usize>, usize, f64),
}

impl Parameters {
    /// The paper's, restricted to the given valences.
    pub fn new(valences: Vec<usize>) -> Self {
        let among = |list: &[usize]| list.iter().copied().filter(|n| valences.contains(n)).collect();
        Parameters {
            orders: [(4..=22).step_by(2).collect(), (3..=21).step_by(2).collect()],
            tensions: vec![0.01, 0.5, 1.0, 2.0, 50.0],
            levels: [1, 10],
            table: ((4..=16).step_by(2).collect(), among(&[3, 5, 6, 7]), vec![1, 9], 2.0),
            meshes: (
                [vec![4, 8, 12, 16, 22], vec![3, 7, 11, 15, 21]],
                among(&[3, 6, 13, 20]),
                1,
                0.01,
            ),
            valences,
        }
    }
}

/// All tables.
pub struct Results {
    parameters: Parameters,
    even: Vec<Row>,
    odd: Vec<Row>,
    table: Vec<Row>,
    meshes: [Table; 2],
}

impl Results {
    /// Computes everything, in parallel; the result does not depend on the number of threads.
    ///
    /// # Errors
    /// [`Error::Scheme`] for a valence below 3; none is expected of the paper's parameters.
    pub fn new(parameters: Parameters, progress: &dyn Progress) -> Result<Self, Error> {
        let p = &parameters;
        let [even, odd] = &p.orders;
        let levels: Vec<Option<usize>> = (p.levels[0]..=p.levels[1]).map(Some).collect();
        let sweep = |title: &str, orders: &[usize]| -> Result<Vec<Row>, Error> {
            let cases = Case::all(orders, &p.valences, &p.tensions);
            Ok(each(progress, title, &cases, |case| rows(case, &levels))?.concat())
        };
        let (orders, valences, two_levels, u0) = &p.table;
        // the limit level stands beside the paper's two: it is Stam's scheme
        let three: Vec<Option<usize>> = two_levels.iter().copied().map(Some).chain([None]).collect();
        let table = Case::all(orders, valences, &[*u0]);
        let table = each(progress, "table 2", &table, |case| rows(case, &three))?.concat();
        let (mesh_orders, valences, level, u0) = &p.meshes;
        let mesh = |orders: &[usize]| -> Result<Table, Error> {
            let cases = Case::all(orders, valences, &[*u0]);
            let points = each(progress, "characteristic meshes", &cases, |case| {
                meshes::points(case, *level)
            })?;
            Ok(meshes::table(points.into_iter().flatten()))
        };
        Ok(Results {
            even: sweep("even orders", even)?,
            odd: sweep("odd orders", odd)?,
            table,
            meshes: [mesh(&mesh_orders[0])?, mesh(&mesh_orders[1])?],
            parameters,
        })
    }

    /// All files with their names.
    pub fn files(&self) -> Vec<(String, String)> {
        let csv = |name: &str, table: &Table| (format!("{name}.csv"), table.render(Format::Csv));
        vec![
            csv("table2", &self.table2()),
            csv("sweep_even", &sweep::table(&self.even)),
            csv("sweep_odd", &sweep::table(&self.odd)),
            csv("smallest_gaps", &self.smallest_gaps()),
            csv("exceptions", &self.exceptions()),
            csv("meshes_even", &self.meshes[0]),
            csv("meshes_odd", &self.meshes[1]),
            ("tables.json".to_owned(), self.json()),
        ]
    }

    /// The table that the paper prints, as LaTeX.
    pub fn latex(&self) -> Vec<(String, String)> {
        vec![("table2.tex".to_owned(), self.table2().render(Format::Latex))]
    }

    fn all(&self) -> impl Iterator<Item = &Row> {
        self.even.iter().chain(&self.odd)
    }

    /// Table 2: lambda, mu and delta = log mu / log lambda.
    fn table2(&self) -> Table {
        let mut table = Table::new(["order", "valence", "level", "u", "lambda", "mu", "delta"]);
        for row in &self.table {
            let [lambda, _, mu] = row.moduli;
            table.push(vec![
                row.case.order.into(),
                row.case.valence.into(),
                row.level.map_or(Cell::from("limit"), Cell::from),
                row.u.into(),
                lambda.into(),
                mu.into(),
                lambda.zip(mu).map(|(lambda, mu)| mu.ln() / lambda.ln()).into(),
            ]);
        }
        table
    }

    /// The smallest gap of each order, and where it is, among the matrices that are no exceptions.
    pub fn smallest_gaps(&self) -> Table {
        let mut table = Table::new([
            "order",
            "matrices",
            "exceptions",
            "gap",
            "valence",
            "u0",
            "level",
            "lambda1",
            "lambda3",
            "outer",
        ]);
        for &order in self.parameters.orders.iter().flatten() {
            let of_order = || self.all().filter(move |row| row.case.order == order);
            let holding = of_order().filter(|row| row.holds());
            let Some(smallest) = holding.min_by(|a, b| a.gap().total_cmp(&b.gap())) else {
                continue;
            };
            table.push(vec![
                order.into(),
                of_order().count().into(),
                of_order().filter(|row| !row.holds()).count().into(),
                smallest.gap().into(),
                smallest.case.valence.into(),
                smallest.case.u0.into(),
                smallest.level.into(),
                smallest.moduli[0].into(),
                smallest.moduli[2].into(),
                smallest.outer.into(),
            ]);
        }
        table
    }

    /// What the gaps say, in sentences.
    pub fn in_words(&self) -> String {
        let count = self.all().count();
        let exceptions = self.all().filter(|row| !row.holds()).count();
        let valences = crate::results::ranges(self.parameters.valences.iter().copied());
        format!(
            "{count} local matrices at N = {valences}: 1 > |lambda_1| = |lambda_2| > |lambda_3| holds for {}, and exceptions.csv has the other {exceptions}.",
            count - exceptions
        )
    }

    /// Every matrix for which 1 > |lambda_1| = |lambda_2| > |lambda_3| does not hold, and why.
    fn exceptions(&self) -> Table {
        let rows: Vec<Row> = self.all().filter(|row| !row.holds()).cloned().collect();
        sweep::table(&rows)
    }

    /// Where the files come from. The numbers are in the CSV files.
    fn json(&self) -> String {
        let count = |rows: &[Row]| rows.iter().filter(|row| !row.holds()).count();
        let valences: Vec<String> = self.parameters.valences.iter().map(usize::to_string).collect();
        let object = serde_json::json!({
            "version": 1,
            "provenance": {
                "tool": tool(),
                "command": format!("eigenring tables --scheme tension --valences {}", valences.join(",")),
                "parameters": self.parameters,
            },
            "matrices": {"even": self.even.len(), "odd": self.odd.len()},
            "exceptions": {"even": count(&self.even), "odd": count(&self.odd)},
        });
        crate::table::pretty(&object)
    }
}
