//! The characteristic map and the second-order maps, sampled.

use crate::failure::Failure;
use crate::input::Whole;
use crate::pickle::{self, Reduced};
use crate::{values, work};
use eigenring_spectral::{Annulus, Graph, Maps, Natural, PatchIndex};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

/// Samples of all patches: a request for more is refused before memory is asked for.
const MAX_SAMPLES: usize = 50_000_000;

fn patches(annulus: &Annulus, valence: usize) -> Vec<PatchIndex> {
    (0..valence)
        .flat_map(|sector| annulus.patches(sector).collect::<Vec<_>>())
        .collect()
}

/// All patches at all pairs of n parameters from 0 to 1, in parallel, for one of so many maps; `on` makes of
/// a patch what is evaluated.
fn sampled<T: Send, F: Fn(f64, f64) -> T>(
    patches: &[PatchIndex],
    n: usize,
    maps: f64,
    on: impl Fn(PatchIndex) -> F + Sync,
) -> Result<Vec<T>, Failure> {
    let count = n.checked_mul(n).and_then(|square| square.checked_mul(patches.len()));
    if n < 2 || count.is_none_or(|count| count > MAX_SAMPLES) {
        let most = (MAX_SAMPLES as f64 / patches.len() as f64).sqrt() as usize;
        return Err(Failure::usage(
            format!("{n} samples along an edge"),
            format!("2 to {most}"),
        ));
    }
    // values of parts and of the whole, and arrays
    let bytes = maps * count.unwrap_or(0) as f64 * (2 * size_of::<T>() + 8 * 8) as f64;
    work::check(bytes, &format!("{n} samples along an edge"))?;
    let parameter = |i: usize| i as f64 / (n - 1) as f64;
    let at_patch = |patch: &PatchIndex| -> Vec<T> {
        let at = on(*patch);
        (0..n * n)
            .map(|place| at(parameter(place / n), parameter(place % n)))
            .collect()
    };
    Ok(patches.par_iter().flat_map_iter(at_patch).collect())
}

/// Samples of the patches of an annulus: arrays with first the patch, then the steps along u and v.
///
/// >>> import eigenring
/// >>> sample = eigenring.Scheme("catmull-clark").at(3).characteristic_map().sample(4)
/// >>> sample.jacobians.shape, sample.sectors.tolist()
/// ((9, 4, 4), [0, 0, 0, 1, 1, 1, 2, 2, 2])
#[pyclass(frozen, get_all, module = "eigenring")]
#[derive(Debug)]
pub struct Sample {
    /// float64 of shape (patches, n, n, 2): x and y.
    points: Py<PyArrayDyn<f64>>,
    /// float64 of shape (patches, n, n): x_u y_v - x_v y_u.
    jacobians: Py<PyArrayDyn<f64>>,
    /// int64 of shape (patches,): the sector of each patch.
    sectors: Py<PyArray1<i64>>,
}

#[pymethods]
impl Sample {
    #[staticmethod]
    fn _of(points: Py<PyArrayDyn<f64>>, jacobians: Py<PyArrayDyn<f64>>, sectors: Py<PyArray1<i64>>) -> Self {
        Sample {
            points,
            jacobians,
            sectors,
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        pickle::reduced(py, "sample", (&self.points, &self.jacobians, &self.sectors))
    }
}

fn sample(py: Python<'_>, patches: &[PatchIndex], n: usize, graphs: &[Graph]) -> Result<Sample, Failure> {
    let points = graphs.iter().flat_map(|graph| [graph.x, graph.y]).collect();
    let jacobians = graphs.iter().map(|graph| graph.jacobian).collect();
    let sectors = patches.iter().map(|patch| patch.sector as i64).collect();
    Ok(Sample {
        points: values::shaped(py, points, &[patches.len(), n, n, 2])?.unbind(),
        jacobians: values::shaped(py, jacobians, &[patches.len(), n, n])?.unbind(),
        sectors: PyArray1::from_vec(py, sectors).unbind(),
    })
}

/// The characteristic map: the surface of the natural configuration in the plane.
///
/// >>> import eigenring
/// >>> chi = eigenring.Scheme("catmull-clark").at(5).characteristic_map()
/// >>> chi.degree, chi.patches
/// (3, 15)
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct CharacteristicMap {
    annulus: Annulus,
    natural: Natural,
    patches: Vec<PatchIndex>,
}

impl CharacteristicMap {
    /// The map on an annulus.
    pub fn new(annulus: Annulus, natural: Natural, valence: usize) -> Self {
        CharacteristicMap {
            patches: patches(&annulus, valence),
            annulus,
            natural,
        }
    }
}

#[pymethods]
impl CharacteristicMap {
    /// The degree of the patches in each variable.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).characteristic_map().degree
    /// 3
    #[getter]
    fn degree(&self) -> usize {
        self.annulus.degree
    }

    /// How many patches the annulus has.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).characteristic_map().patches
    /// 15
    #[getter]
    fn patches(&self) -> usize {
        self.patches.len()
    }

    /// Points and Jacobians at n x n parameters of each patch, ends included.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(5).characteristic_map().sample(2).points.shape
    /// (15, 2, 2, 2)
    fn sample(slf: &Bound<'_, Self>, n: Whole) -> Result<Sample, Failure> {
        let n = n.count("n")?;
        let this = slf.clone().unbind();
        let graphs = work::run(slf.py(), None, move |_| {
            let map = this.get();
            sampled(&map.patches, n, 1.0, |patch| {
                let [x, y] = [0, 1].map(|axis| map.annulus.patch(&map.natural.points[axis], patch));
                move |u, v| {
                    let [x, y] = [x.jet(u, v), y.jet(u, v)];
                    Graph::new(&x, &y, &x)
                }
            })
        })?;
        sample(slf.py(), &slf.get().patches, n, &graphs)
    }
}

/// The second-order maps: heights over the characteristic map, 0 the cup, 1 and 2 the saddles.
///
/// >>> import eigenring
/// >>> maps = eigenring.Scheme("catmull-clark").at(5).second_order_maps()
/// >>> cup = maps.sample(3)["gauss"][0]
/// >>> cup.shape, bool((cup > 0).all())
/// ((15, 3, 3), True)
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct SecondOrderMaps {
    maps: Maps,
    patches: Vec<PatchIndex>,
}

impl SecondOrderMaps {
    /// The maps of a valence.
    pub fn new(maps: Maps, valence: usize) -> Self {
        SecondOrderMaps {
            patches: patches(&maps.annulus, valence),
            maps,
        }
    }
}

#[pymethods]
impl SecondOrderMaps {
    /// lambda.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).second_order_maps().value
    /// 0.5
    #[getter]
    fn value(&self) -> f64 {
        self.maps.lambda
    }

    /// float64 of shape (3,): the eigenvalues of cup and saddles.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Scheme("catmull-clark").at(4).second_order_maps().mu.round(12).tolist()
    /// [0.25, 0.25, 0.25]
    #[getter]
    fn mu<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.maps.mu)
    }

    /// Heights, gradients, second derivatives and Gauss curvatures as functions of x and y, at n x n
    /// parameters of each patch: a dict of ``points`` (patches, n, n, 2), ``heights`` and ``gauss`` (3,
    /// patches, n, n), ``hessians`` (3, patches, n, n, 3) for xx, xy, yy.
    ///
    /// >>> import eigenring
    /// >>> sorted(eigenring.Scheme("catmull-clark").at(5).second_order_maps().sample(2))
    /// ['gauss', 'heights', 'hessians', 'points']
    fn sample<'py>(slf: &Bound<'py, Self>, n: Whole) -> Result<Bound<'py, PyDict>, Failure> {
        let n = n.count("n")?;
        let (py, this) = (slf.py(), slf.clone().unbind());
        let graphs = work::run(py, None, move |_| {
            let SecondOrderMaps { maps, patches } = this.get();
            let one = |which: usize| sampled(patches, n, 3.0, |patch| move |u, v| maps.graph(which, patch, u, v));
            Ok([one(0)?, one(1)?, one(2)?])
        })?;
        let patches = &slf.get().patches;
        let all = || graphs.iter().flatten();
        let shape = [3, patches.len(), n, n];
        let found = PyDict::new(py);
        let plane = sample(py, patches, n, &graphs[0])?;
        found.set_item("points", plane.points)?;
        found.set_item(
            "heights",
            values::shaped(py, all().map(|graph| graph.z).collect(), &shape)?,
        )?;
        found.set_item("gauss", values::shaped(py, all().map(Graph::gauss).collect(), &shape)?)?;
        let hessians = all().flat_map(|graph| graph.hessian).collect();
        found.set_item("hessians", values::shaped(py, hessians, &[3, patches.len(), n, n, 3])?)?;
        Ok(found)
    }
}
