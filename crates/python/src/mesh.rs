//! Control meshes and their surfaces.

use crate::failure::Failure;
use crate::figure::Picture;
use crate::foreign;
use crate::limit_points::Limits;
use crate::scheme::Scheme;
use crate::solve::Asked;
use crate::values;
use crate::work;
use eigenring_atlas::analysis::Basis;
use eigenring_atlas::curvature::{centre_table, curvatures, euler_of_smooth, summary};
use eigenring_atlas::memory::excess;
use eigenring_atlas::on_mesh::OnMesh;
use eigenring_atlas::render::{Settings, Show, Subject, render};
use eigenring_atlas::schemes::{SchemeName, Tuner};
use eigenring_atlas::{files, limits, meshes};
use eigenring_nonuniform::Outside;
use eigenring_surface::{self as surface, Boundary, Place, Point3, Refiner, Rules, Surface, features};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// A control mesh of polygons.
///
/// ``vertices`` is a float64 array of shape (n, 3), or a list; ``faces`` an integer array of shape (m, k), or
/// a list of faces of any sizes, counter-clockwise from outside. ``creases`` maps pairs of vertices to
/// sharpness, ``corners`` vertices; ``boundary`` is ``"edge"``, ``"corner"`` or ``"shrink"``.
///
/// ``Mesh(object)`` takes the mesh of another library: an object with ``vertices`` and ``faces`` as trimesh
/// has them, or with ``points`` and ``cells`` as meshio has them.
///
/// >>> import eigenring
/// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
/// >>> square.subdivide("catmull-clark", 2)
/// <Mesh of 25 vertices, 16 faces>
#[pyclass(frozen, module = "eigenring")]
#[derive(Debug)]
pub struct Mesh {
    mesh: Arc<surface::Mesh>,
}

/// A scheme, or its name.
#[derive(FromPyObject)]
pub enum Named<'py> {
    Scheme(Bound<'py, Scheme>),
    Name(Bound<'py, PyAny>),
}

impl Named<'_> {
    /// The scheme, kept as long as it is needed.
    ///
    /// # Errors
    /// Those of the name.
    pub fn scheme(&self, py: Python<'_>) -> Result<Py<Scheme>, Failure> {
        Ok(match self {
            Named::Scheme(scheme) => scheme.clone().unbind(),
            Named::Name(name) => Py::new(py, Scheme::new(name)?)?,
        })
    }

    /// The scheme on a mesh, whose name may say in how many smoothing steps creases act.
    fn on_mesh(&self, py: Python<'_>) -> Result<(Option<Py<Scheme>>, OnMesh), Failure> {
        if let Named::Name(name) = self
            && let Ok(text) = name.extract::<String>()
            && let Ok(scheme) = text.parse()
        {
            return Ok((None, scheme));
        }
        let scheme = self.scheme(py)?;
        let name = scheme.get().name()?.clone();
        Ok((Some(scheme), name.into()))
    }
}

/// Refuses what does not fit into memory.
fn check(bytes: f64, what: &str) -> Result<(), Failure> {
    match excess(bytes) {
        None => Ok(()),
        Some([available, accepted]) => {
            let gigabytes = |bytes: f64| format!("{:.3e} GB", bytes / 1e9);
            let message = format!(
                "{what} would take {} of {} of memory",
                gigabytes(bytes),
                gigabytes(available)
            );
            Err(Failure::usage(message, format!("up to {}", gigabytes(accepted))))
        }
    }
}

impl Mesh {
    fn of(mesh: surface::Mesh) -> Self {
        Mesh { mesh: Arc::new(mesh) }
    }

    /// Runs work on the surface of a scheme, without the interpreter's lock.
    fn on_surface<T: Send + 'static>(
        &self,
        py: Python<'_>,
        scheme: &Named<'_>,
        progress: Option<Py<PyAny>>,
        work: impl FnOnce(&Surface<'_>) -> Result<T, Failure> + Send + 'static,
    ) -> Result<T, Failure> {
        let (scheme, name) = scheme.on_mesh(py)?;
        let mesh = Arc::clone(&self.mesh);
        work::run(py, progress, move |reporter| {
            let _kept = scheme;
            check(mesh.corners().len() as f64 * 16.0 * 400.0, "the surface")?;
            let tuner = Tuner {
                progress: reporter,
                ..Tuner::default()
            };
            let rules: Rules = meshes::rules(&name, &mesh, &[], &tuner)?;
            work(&Surface::new(&mesh, &rules)?)
        })
    }
}

#[pymethods]
impl Mesh {
    #[new]
    #[pyo3(signature = (vertices, faces = None, *, creases = None, corners = None, boundary = None))]
    fn new(
        vertices: &Bound<'_, PyAny>,
        faces: Option<&Bound<'_, PyAny>>,
        creases: Option<BTreeMap<(u32, u32), f64>>,
        corners: Option<BTreeMap<u32, f64>>,
        boundary: Option<&str>,
    ) -> Result<Self, Failure> {
        let mut mesh = match (vertices.cast::<Mesh>(), faces) {
            (Ok(mesh), None) => (*mesh.get().mesh).clone(),
            (_, faces) => {
                let (entries, faces) = match faces {
                    Some(faces) => (
                        values::rows(vertices, "vertices", Some(3))?.0,
                        foreign::faces_of(faces)?,
                    ),
                    None => foreign::arrays(vertices)?,
                };
                let points = entries.chunks_exact(3).map(|p| Point3::new(p[0], p[1], p[2])).collect();
                surface::Mesh::new(points, faces)?
            }
        };
        let sharpness = |value: f64| match value {
            value if value >= 0.0 => Ok(value),
            value => Err(Failure::usage(format!("the sharpness is {value}"), "0 and above")),
        };
        for ((a, b), value) in creases.unwrap_or_default() {
            mesh.features.creases.insert(features::edge(a, b), sharpness(value)?);
        }
        for (vertex, value) in corners.unwrap_or_default() {
            mesh.features.corners.insert(vertex, sharpness(value)?);
        }
        mesh.features.boundary = match boundary {
            None => mesh.features.boundary,
            Some("edge") => Some(Boundary::Edge),
            Some("corner") => Some(Boundary::Corner),
            Some("shrink") => Some(Boundary::Shrink),
            Some(other) => {
                return Err(Failure::usage(
                    format!("unknown boundary '{other}'"),
                    "edge, corner, shrink",
                ));
            }
        };
        let defects: Vec<_> = mesh.defects().into_iter().map(|defect| (defect, None)).collect();
        if !defects.is_empty() {
            return Err(surface::Error::Defects(defects).into());
        }
        Ok(Mesh::of(mesh))
    }

    /// Reads an OBJ, OFF or PLY file with its marks.
    ///
    /// >>> import eigenring, os, tempfile
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     path = os.path.join(folder, "square.obj")
    /// ...     square.write(path)
    /// ...     eigenring.Mesh.read(path)
    /// <Mesh of 4 vertices, 1 faces>
    #[staticmethod]
    fn read(path: PathBuf) -> Result<Self, Failure> {
        Ok(Mesh::of(meshes::read_surface(&path)?.0))
    }

    /// Writes a file in the format that its extension names: obj, ply, off, vtk, glb.
    ///
    /// >>> import eigenring, os, tempfile
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     square.write(os.path.join(folder, "square.ply"))
    fn write(&self, path: PathBuf) -> Result<(), Failure> {
        let format = meshes::written_format(&path)?;
        let mut bytes = Vec::new();
        surface::io::write(&self.mesh, &mut bytes, format)?;
        Ok(files::write(&path, &bytes)?)
    }

    /// float64 of shape (n, 3).
    ///
    /// >>> import eigenring
    /// >>> eigenring.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).vertices.shape
    /// (3, 3)
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let points = self.mesh.points();
        let entries = points.iter().flat_map(|p| [p.x, p.y, p.z]).collect();
        values::shaped(py, entries, &[points.len(), 3])
    }

    /// Faces: int64 of shape (m, 4) if all are quads, else a list of lists.
    ///
    /// >>> import eigenring
    /// >>> eigenring.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).faces
    /// [[0, 1, 2]]
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        if self.mesh.is_quads() {
            let corners = self.mesh.corners().iter().map(|&corner| i64::from(corner)).collect();
            return Ok(values::shaped::<i64>(py, corners, &[self.mesh.face_count(), 4])?.into_any());
        }
        let faces: Vec<Vec<u32>> = self.mesh.faces().map(<[u32]>::to_vec).collect();
        Ok(faces.into_pyobject(py)?.into_any())
    }

    /// The refined mesh after so many levels of a scheme.
    ///
    /// >>> import eigenring
    /// >>> triangle = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    /// >>> triangle.subdivide("catmull-clark").faces.shape
    /// (3, 4)
    #[pyo3(signature = (scheme, levels = 1, *, progress = None))]
    fn subdivide(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        levels: usize,
        progress: Option<Py<PyAny>>,
    ) -> Result<Mesh, Failure> {
        let (scheme, name) = scheme.on_mesh(py)?;
        let mesh = Arc::clone(&self.mesh);
        let refined = work::run(py, progress, move |reporter| {
            let _kept = scheme;
            if let SchemeName::NonUniform(scheme) = name.name {
                check(
                    mesh.corners().len() as f64 * 4_f64.powf(levels as f64) * 620.0,
                    &format!("{levels} levels"),
                )?;
                let outside = eigenring_nonuniform::Outside::Error;
                let found = eigenring_nonuniform::refined(&mesh, scheme, levels, outside);
                return Ok(found.map_err(eigenring_atlas::Error::from)?.mesh);
            }
            let tuner = Tuner {
                progress: reporter,
                ..Tuner::default()
            };
            let rules = meshes::rules(&name, &mesh, &[], &tuner)?;
            let mut refiner = Refiner::new(&rules);
            refiner.workers = &meshes::Pool;
            let (points, faces) = refiner.size(&mesh, levels);
            check(30.0 * points + 20.0 * faces, &format!("{levels} levels"))?;
            Ok(refiner.refined(&mesh, levels)?)
        })?;
        Ok(Mesh::of(refined))
    }

    /// Limit points with derivatives and curvatures, at parameters of faces.
    ///
    /// ``face``, ``u``, ``v`` are numbers or arrays of one length: u runs along the edge that leaves the
    /// face's first corner, v along the edge that ends there, both from 0 to 1. A face that is no quad has a
    /// piece for each corner, chosen by ``sub``.
    ///
    /// >>> import eigenring
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> square.limit("catmull-clark", 0, 0.5, 0.5).points.round(12).tolist()
    /// [[0.5, 0.5, 0.0]]
    #[pyo3(signature = (scheme, face, u, v, *, sub = None, progress = None))]
    #[allow(clippy::too_many_arguments)]
    fn limit(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        face: &Bound<'_, PyAny>,
        u: &Bound<'_, PyAny>,
        v: &Bound<'_, PyAny>,
        sub: Option<&Bound<'_, PyAny>>,
        progress: Option<Py<PyAny>>,
    ) -> Result<Limits, Failure> {
        let (u, v) = (values::numbers(u, "u")?, values::numbers(v, "v")?);
        let faces = values::whole_or_many(face, "face", u.len())?;
        let subs = match sub {
            Some(sub) => values::whole_or_many(sub, "sub", u.len())?,
            None => vec![0; u.len()],
        };
        if [v.len(), faces.len(), subs.len()]
            .iter()
            .any(|&length| length != u.len())
        {
            let message = format!("{} faces, {} u and {} v", faces.len(), u.len(), v.len());
            return Err(Failure::usage(message, "as many of each"));
        }
        let place = |i: usize| Place {
            face: faces[i],
            sub: subs[i],
            corner: 0,
            s: u[i],
            t: v[i],
        };
        let places: Vec<Place> = (0..u.len()).map(place).collect();
        check(places.len() as f64 * 600.0, &format!("{} points", places.len()))?;
        let columns = self.on_surface(py, &scheme, progress, move |surface| {
            Ok(limits::columns(surface, &places)?)
        })?;
        Limits::new(py, columns)
    }

    /// The limit surface as a mesh of n x n quads for each quad, and for each corner of other faces. Points
    /// that pieces share stand in it once for each.
    ///
    /// >>> import eigenring
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> square.limit_mesh("catmull-clark", 8)
    /// <Mesh of 81 vertices, 64 faces>
    #[pyo3(signature = (scheme, n = 8, *, progress = None))]
    fn limit_mesh(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        n: usize,
        progress: Option<Py<PyAny>>,
    ) -> Result<Mesh, Failure> {
        if !(1..=10_000).contains(&n) {
            return Err(Failure::usage(format!("{n} pieces of an edge"), "1 to 10000"));
        }
        let pieces = |face: &[u32]| if face.len() == 4 { 1 } else { face.len() as u32 };
        let all: u64 = self.mesh.faces().map(|face| u64::from(pieces(face))).sum();
        let count = all as f64 * ((n + 1) * (n + 1)) as f64;
        check(count * 600.0, &format!("{count} points"))?;
        let refined = self.on_surface(py, &scheme, progress, move |surface| {
            let at = |i: usize| i as f64 / n as f64;
            let mut places = Vec::new();
            for (face, corners) in surface.control().faces().enumerate() {
                for sub in 0..pieces(corners) {
                    let grid = (0..(n + 1) * (n + 1)).map(|k| (at(k % (n + 1)), at(k / (n + 1))));
                    places.extend(grid.map(|(s, t)| Place {
                        face: face as u32,
                        sub,
                        corner: 0,
                        s,
                        t,
                    }));
                }
            }
            let samples = limits::samples(surface, &places)?;
            let row = n as u32 + 1;
            let quad = |first: u32, k: u32| {
                let corner = first + (k / n as u32) * row + k % n as u32;
                [corner, corner + 1, corner + row + 1, corner + row]
            };
            let firsts = (0..places.len() as u32).step_by((row * row) as usize);
            let quads = firsts.flat_map(|first| (0..(n * n) as u32).map(move |k| quad(first, k)));
            Ok(surface::Mesh::new(
                samples.iter().map(|sample| sample.position).collect(),
                quads,
            )?)
        })?;
        Ok(Mesh::of(refined))
    }

    /// Area, integrals and extremes of the curvature, and what it is like at irregular vertices: the dict
    /// that ``eigenring curvature --format json`` prints.
    ///
    /// >>> import eigenring
    /// >>> cube = eigenring.Mesh(
    /// ...     [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
    /// ...     [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    /// >>> found = cube.curvature("catmull-clark")
    /// >>> abs(found["total_gauss"] / found["two_pi_chi"] - 1) < 1e-3
    /// True
    #[pyo3(signature = (scheme, *, per_face = 8, radii = vec![1e-1, 1e-3, 1e-6, 1e-9, 1e-12], progress = None))]
    fn curvature<'py>(
        &self,
        py: Python<'py>,
        scheme: Named<'_>,
        per_face: usize,
        radii: Vec<f64>,
        progress: Option<Py<PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        if !(1..=1000).contains(&per_face) {
            return Err(Failure::usage(format!("per_face is {per_face}"), "1 to 1000"));
        }
        if let Some(radius) = radii.iter().find(|radius| !(**radius > 1e-290 && **radius <= 1.0)) {
            return Err(Failure::usage(format!("a radius is {radius}"), "0 < r <= 1"));
        }
        let euler = euler_of_smooth(&self.mesh)?;
        let json = self.on_surface(py, &scheme, progress, move |surface| {
            let found = curvatures(surface, per_face, euler)?;
            let mut object = summary(&found).json();
            object["centres"] = centre_table(surface, &found, &radii)?.json();
            Ok(object)
        })?;
        Ok(values::object(py, &json)?)
    }

    /// Solves a model problem on the scheme's basis functions, and measures the errors on each level: the
    /// dict that ``eigenring iga PROBLEM --format json`` prints.
    ///
    /// ``problem`` is ``"poisson"``, ``"l2"``, ``"biharmonic"`` or ``"patch-test"``, with the ``solution``
    /// ``"sin"``, ``"exp"``, ``"mix"``, ``"lin"`` or ``"quadratic"`` of x and y; or ``"spectrum"``, the
    /// ``count`` lowest eigenvalues of the Laplacian. The mesh is of quads, planar with z = 0 or closed.
    /// ``bc`` is ``"dirichlet"``, ``"neumann"`` or ``"closed"``, the latter with ``sphere=True`` on the unit
    /// sphere; ``boundary`` ``"open"`` or ``"natural"``; ``dirichlet`` ``"projection"`` or ``"nitsche"``;
    /// ``gauss`` points of an element in each direction; ``depth`` annuli at extraordinary vertices; ``tail``
    /// ``"drop"`` or ``"scaled"``; ``solver`` ``"cholesky"`` or ``"multigrid"``. Errors L2, H1, H2 and Linf
    /// are absolute; ``levels`` 0 to ``levels - 1``, each with half the width.
    ///
    /// >>> import eigenring
    /// >>> points = [[x, y, 0] for y in range(3) for x in range(3)]
    /// >>> grid = eigenring.Mesh(points, [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    /// >>> found = grid.solve("catmull-clark", "poisson", solution="sin", levels=3)
    /// >>> errors = [level["L2"] for level in found["levels"]]
    /// >>> errors[0] > 8 * errors[1] > 64 * errors[2]
    /// True
    #[pyo3(signature = (scheme, problem = "poisson", *, solution = "exp", levels = 4, bc = None, boundary = "open", dirichlet = None, gauss = 4, depth = None, tail = "drop", solver = None, sphere = false, count = None, progress = None))]
    #[allow(clippy::too_many_arguments)]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        scheme: Named<'_>,
        problem: &str,
        solution: &str,
        levels: usize,
        bc: Option<&str>,
        boundary: &str,
        dirichlet: Option<&str>,
        gauss: usize,
        depth: Option<usize>,
        tail: &str,
        solver: Option<&str>,
        sphere: bool,
        count: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let asked = Asked {
            problem,
            solution,
            levels,
            bc,
            boundary,
            dirichlet,
            gauss,
            depth,
            tail,
            solver,
            sphere,
            count,
        };
        let question = asked.question()?;
        let (owner, name) = scheme.on_mesh(py)?;
        let mesh = Arc::clone(&self.mesh);
        let json = work::run(py, progress, move |reporter| {
            let _kept = owner;
            let tuner = Tuner {
                progress: reporter,
                ..Tuner::default()
            };
            let basis = Basis::new(&name, &mesh, Outside::Error, &tuner)?;
            question.answer(
                &mesh,
                &basis,
                |bytes| check(bytes, &format!("{levels} levels")),
                reporter,
            )
        })?;
        Ok(values::object(py, &json)?)
    }

    /// A picture of the surface: ``"shaded"``, ``"wireframe"``, ``"gauss"``, ``"mean"``, ``"highlight"``,
    /// ``"reflection"`` or ``"isophotes"``; ``view`` is azimuth, elevation in degrees and zoom.
    ///
    /// >>> import eigenring
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> square.render("catmull-clark", "highlight", size=64).png()[1:4]
    /// b'PNG'
    #[pyo3(signature = (scheme, show = "shaded", *, view = (-60.0, 28.0, 1.0), light = (-25.0, 25.0), stripes = 6.0, size = 480, up = "z", progress = None))]
    #[allow(clippy::too_many_arguments)]
    fn render(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        show: &str,
        view: (f64, f64, f64),
        light: (f64, f64),
        stripes: f64,
        size: usize,
        up: &str,
        progress: Option<Py<PyAny>>,
    ) -> Result<Picture, Failure> {
        let show = match show {
            "shaded" => Show::Shaded,
            "wireframe" => Show::Wireframe,
            "gauss" => Show::Gauss,
            "mean" => Show::Mean,
            "highlight" => Show::Highlight,
            "reflection" => Show::Reflection,
            "isophotes" => Show::Isophotes,
            other => {
                let accepted = "shaded, wireframe, gauss, mean, highlight, reflection, isophotes";
                return Err(Failure::usage(format!("unknown picture '{other}'"), accepted));
            }
        };
        let finite = [view.0, view.1, view.2, light.0, light.1].iter().all(|x| x.is_finite());
        if !finite || view.2 <= 0.0 {
            return Err(Failure::usage(
                "the view has other numbers",
                "azimuth, elevation, zoom with a zoom above 0",
            ));
        }
        if !(stripes > 0.0 && stripes <= 1000.0) {
            return Err(Failure::usage(format!("stripes is {stripes}"), "0 < stripes <= 1000"));
        }
        if !(32..=4096).contains(&size) {
            return Err(Failure::usage(format!("size is {size}"), "32 to 4096"));
        }
        if !matches!(up, "y" | "z") {
            return Err(Failure::usage(format!("up is '{up}'"), "y, z"));
        }
        let settings = Settings {
            show,
            view: [view.0, view.1, view.2],
            light: [light.0, light.1],
            stripes,
            y_up: up == "y",
            size,
            columns: 1,
        };
        let (owner, name) = scheme.on_mesh(py)?;
        let mesh = Arc::clone(&self.mesh);
        let bytes = work::run(py, progress, move |reporter| {
            let _kept = owner;
            let tuner = Tuner {
                progress: reporter,
                ..Tuner::default()
            };
            let rules = meshes::rules(&name, &mesh, &[], &tuner)?;
            let surface = Surface::new(&mesh, &rules)?;
            let title = name.called(&rules.definition().name());
            let page = render(&[(title, Subject::Surface(Box::new(surface)))], &settings)?;
            Ok(page.png().map_err(eigenring_atlas::Error::from)?)
        })?;
        Ok(Picture { bytes })
    }

    fn __repr__(&self) -> String {
        format!(
            "<Mesh of {} vertices, {} faces>",
            self.mesh.points().len(),
            self.mesh.face_count()
        )
    }
}
