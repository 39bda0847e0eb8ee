//! Control meshes and their surfaces.

use crate::failure::Failure;
use crate::figure::Picture;
use crate::foreign;
use crate::input::{self, Indices, Real, Text, Whole};
use crate::limit_points::Limits;
use crate::pickle::{self, Reduced};
use crate::scheme::Scheme;
use crate::solve::Asked;
use crate::values;
use crate::work::{self, check};
use eigenring_atlas::analysis::Basis;
use eigenring_atlas::curvature::{centre_table, curvatures, euler_of_smooth, summary};
use eigenring_atlas::on_mesh::OnMesh;
use eigenring_atlas::render::{Settings, Show, Subject, render};
use eigenring_atlas::schemes::{SchemeName, Tuner};
use eigenring_atlas::{files, limits, meshes};
use eigenring_nonuniform::Outside;
use eigenring_surface::{self as surface, Boundary, Place, Point3, Refiner, Rules, Surface, features};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
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

/// What is marked, and how sharp it is.
///
/// # Errors
/// What is no mapping to numbers from 0 on, of which one may be infinite.
fn marks<'py>(given: Option<&Bound<'py, PyAny>>, what: &str) -> Result<Vec<(Bound<'py, PyAny>, f64)>, Failure> {
    let Some(given) = given else {
        return Ok(Vec::new());
    };
    let refuse = |_| Failure::usage(format!("{what} is {}", input::shown(given)), "a dict of sharpness");
    let items = given.call_method0("items").map_err(refuse)?;
    let mark = |item: PyResult<Bound<'py, PyAny>>| {
        let (place, sharpness): (Bound<'py, PyAny>, Real) = item?.extract()?;
        let holds = |value| value >= 0.0;
        let sharpness = sharpness.such("the sharpness", "0 and above", holds)?;
        // files of meshes have finite numbers, of which the larger ones mean the same
        let finite = if sharpness.is_finite() {
            sharpness
        } else {
            features::INFINITE
        };
        Ok((place, finite))
    };
    items.try_iter()?.map(mark).collect()
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
        creases: Option<&Bound<'_, PyAny>>,
        corners: Option<&Bound<'_, PyAny>>,
        boundary: Option<Text>,
    ) -> Result<Self, Failure> {
        let mut mesh = match (vertices.cast::<Mesh>(), faces) {
            (Ok(mesh), None) => (*mesh.get().mesh).clone(),
            (_, faces) => {
                let (entries, faces) = match faces {
                    Some(faces) => (input::rows(vertices, "vertices", Some(3))?.0, foreign::faces_of(faces)?),
                    None => foreign::arrays(vertices)?,
                };
                let points = entries.chunks_exact(3).map(|p| Point3::new(p[0], p[1], p[2])).collect();
                surface::Mesh::new(points, faces)?
            }
        };
        for (edge, sharpness) in marks(creases, "creases")? {
            let ends = input::indices(&edge, "an edge in creases")?;
            let &[a, b] = ends.as_slice() else {
                let message = format!("an edge in creases is {}", input::shown(&edge));
                return Err(Failure::usage(message, "pairs of vertices"));
            };
            mesh.features.creases.insert(features::edge(a, b), sharpness);
        }
        for (vertex, sharpness) in marks(corners, "corners")? {
            let vertex = vertex.extract::<Whole>()?.count("a vertex in corners")?;
            mesh.features.corners.insert(vertex as u32, sharpness);
        }
        let boundaries = [
            ("edge", Boundary::Edge),
            ("corner", Boundary::Corner),
            ("shrink", Boundary::Shrink),
        ];
        if let Some(boundary) = input::text(boundary, "boundary")? {
            mesh.features.boundary = Some(input::word("boundary", &boundary, &boundaries)?);
        }
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
    fn read(path: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        let path = input::path(path, "the file")?;
        Ok(Mesh::of(meshes::read_surface(&path)?.0))
    }

    /// Writes a file in the format that its extension names: obj, ply, off, vtk, glb.
    ///
    /// >>> import eigenring, os, tempfile
    /// >>> square = eigenring.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    /// >>> with tempfile.TemporaryDirectory() as folder:
    /// ...     square.write(os.path.join(folder, "square.ply"))
    fn write(&self, path: &Bound<'_, PyAny>) -> Result<(), Failure> {
        let path = input::path(path, "the file")?;
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
    #[pyo3(signature = (scheme, levels = Whole::of(1), *, progress = None), text_signature = "($self, scheme, levels=1, *, progress=None)")]
    fn subdivide(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        levels: Whole,
        progress: Option<Py<PyAny>>,
    ) -> Result<Mesh, Failure> {
        let levels = levels.count("levels")?;
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
        let (u, v) = (input::numbers(u, "u")?, input::numbers(v, "v")?);
        let faces = input::whole_or_many(face, "face")?;
        let subs = match sub {
            Some(sub) => input::whole_or_many(sub, "sub")?,
            None => Indices::One(0),
        };
        let many = |indices: &Indices| indices.count().is_none_or(|count| count == u.len());
        if v.len() != u.len() || !many(&faces) || !many(&subs) {
            let several = |indices: &Indices| indices.count().unwrap_or(1);
            let counts = [several(&faces), several(&subs), u.len(), v.len()];
            let [faces, subs, u, v] = counts;
            let message = format!("{faces} of face, {subs} of sub, {u} of u and {v} of v");
            return Err(Failure::usage(message, "as many of each, or one face and sub for all"));
        }
        check(u.len() as f64 * 600.0, &format!("{} points", u.len()))?;
        let columns = self.on_surface(py, &scheme, progress, move |surface| {
            let place = |i: usize| Place {
                face: faces.at(i),
                sub: subs.at(i),
                corner: 0,
                s: u[i],
                t: v[i],
            };
            Ok(limits::columns(surface, u.len(), place)?)
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
    #[pyo3(signature = (scheme, n = Whole::of(8), *, progress = None), text_signature = "($self, scheme, n=8, *, progress=None)")]
    fn limit_mesh(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        n: Whole,
        progress: Option<Py<PyAny>>,
    ) -> Result<Mesh, Failure> {
        let n = n.count("n")?;
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
    #[pyo3(signature = (scheme, *, per_face = Whole::of(8), radii = None, progress = None), text_signature = "($self, scheme, *, per_face=8, radii=(1e-1, 1e-3, 1e-6, 1e-9, 1e-12), progress=None)")]
    fn curvature<'py>(
        &self,
        py: Python<'py>,
        scheme: Named<'_>,
        per_face: Whole,
        radii: Option<&Bound<'py, PyAny>>,
        progress: Option<Py<PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let per_face = per_face.count("per_face")?;
        let radii = match radii {
            Some(radii) => input::numbers(radii, "radii")?,
            None => vec![1e-1, 1e-3, 1e-6, 1e-9, 1e-12],
        };
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
    #[pyo3(signature = (scheme, problem = Text::of("poisson"), *, solution = Text::of("exp"), levels = Whole::of(4), bc = None, boundary = Text::of("open"), dirichlet = None, gauss = Whole::of(4), depth = None, tail = Text::of("drop"), solver = None, sphere = false, count = None, progress = None), text_signature = "($self, scheme, problem='poisson', *, solution='exp', levels=4, bc=None, boundary='open', dirichlet=None, gauss=4, depth=None, tail='drop', solver=None, sphere=False, count=None, progress=None)")]
    #[allow(clippy::too_many_arguments)]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        scheme: Named<'_>,
        problem: Text,
        solution: Text,
        levels: Whole,
        bc: Option<Text>,
        boundary: Text,
        dirichlet: Option<Text>,
        gauss: Whole,
        depth: Option<Whole>,
        tail: Text,
        solver: Option<Text>,
        sphere: bool,
        count: Option<Whole>,
        progress: Option<Py<PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let levels = levels.count("levels")?;
        let asked = Asked {
            problem: problem.get("problem")?,
            solution: solution.get("solution")?,
            levels,
            bc: input::text(bc, "bc")?,
            boundary: boundary.get("boundary")?,
            dirichlet: input::text(dirichlet, "dirichlet")?,
            gauss: gauss.count("gauss")?,
            depth: input::count(depth, "depth")?,
            tail: tail.get("tail")?,
            solver: input::text(solver, "solver")?,
            sphere,
            count: input::count(count, "count")?,
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
    #[pyo3(signature = (scheme, show = Text::of("shaded"), *, view = None, light = None, stripes = Real::of(6.0), size = Whole::of(480), up = Text::of("z"), progress = None), text_signature = "($self, scheme, show='shaded', *, view=(-60.0, 28.0, 1.0), light=(-25.0, 25.0), stripes=6.0, size=480, up='z', progress=None)")]
    #[allow(clippy::too_many_arguments)]
    fn render(
        &self,
        py: Python<'_>,
        scheme: Named<'_>,
        show: Text,
        view: Option<&Bound<'_, PyAny>>,
        light: Option<&Bound<'_, PyAny>>,
        stripes: Real,
        size: Whole,
        up: Text,
        progress: Option<Py<PyAny>>,
    ) -> Result<Picture, Failure> {
        let pictures = [
            ("shaded", Show::Shaded),
            ("wireframe", Show::Wireframe),
            ("gauss", Show::Gauss),
            ("mean", Show::Mean),
            ("highlight", Show::Highlight),
            ("reflection", Show::Reflection),
            ("isophotes", Show::Isophotes),
        ];
        let show = input::word("show", &show.get("show")?, &pictures)?;
        let view = match view {
            Some(view) => input::exactly(view, "view")?,
            None => [-60.0, 28.0, 1.0],
        };
        if view[2] <= 0.0 {
            let accepted = "azimuth, elevation, zoom with a zoom above 0";
            return Err(Failure::usage(format!("the zoom is {}", view[2]), accepted));
        }
        let light = match light {
            Some(light) => input::exactly(light, "light")?,
            None => [-25.0, 25.0],
        };
        let within = |stripes| stripes > 0.0 && stripes <= 1000.0;
        let stripes = stripes.such("stripes", "0 < stripes <= 1000", within)?;
        let size = size.count("size")?;
        if !(32..=4096).contains(&size) {
            return Err(Failure::usage(format!("size is {size}"), "32 to 4096"));
        }
        let y_up = input::word("up", &up.get("up")?, &[("y", true), ("z", false)])?;
        let settings = Settings {
            show,
            view,
            light,
            stripes,
            y_up,
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

    #[staticmethod]
    fn _of_obj(text: &[u8], levels: u32) -> Result<Self, Failure> {
        let mut mesh = surface::io::read(text, surface::io::Format::Obj)?.mesh;
        mesh.features.levels = levels;
        Ok(Mesh::of(mesh))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>, Failure> {
        let mut text = Vec::new();
        surface::io::write(&self.mesh, &mut text, surface::io::Format::Obj)?;
        let arguments = (PyBytes::new(py, &text), self.mesh.features.levels);
        Ok(pickle::reduced(py, "mesh", arguments)?)
    }

    fn __repr__(&self) -> String {
        format!(
            "<Mesh of {} vertices, {} faces>",
            self.mesh.points().len(),
            self.mesh.face_count()
        )
    }
}
