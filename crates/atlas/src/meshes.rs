//! Mesh files, what they hold, and their refinement by a scheme of any name.

use crate::error::{Accepted, Error};
use crate::on_mesh::OnMesh;
use crate::schemes::{SchemeName, Tuner};
use crate::table::short;
use eigenring_scheme::lambda::Splines;
use eigenring_scheme::user::Reading;
use eigenring_scheme::{Definition, Spec};
use eigenring_surface::io::{Format, MeshFile};
use eigenring_surface::{Facts, Mesh, Point3, Rules, Topology, Workers};
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Work on the threads of the current pool.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pool;

impl Workers for Pool {
    fn points(&self, parts: Vec<&mut [Point3<f64>]>, work: &(dyn Fn(usize, &mut [Point3<f64>]) + Sync)) {
        parts
            .into_par_iter()
            .enumerate()
            .for_each(|(index, part)| work(index, part));
    }

    fn indices(&self, parts: Vec<&mut [u32]>, work: &(dyn Fn(usize, &mut [u32]) + Sync)) {
        parts
            .into_par_iter()
            .enumerate()
            .for_each(|(index, part)| work(index, part));
    }
}

fn format_of(path: &Path, accepted: &'static str, fits: impl Fn(Format) -> bool) -> Result<Format, Error> {
    let extension = path
        .extension()
        .map(|extension| extension.to_string_lossy().into_owned());
    let format = extension
        .as_deref()
        .and_then(Format::of_extension)
        .filter(|&format| fits(format));
    format.ok_or_else(|| {
        let what = match extension {
            Some(extension) => format!("'.{extension}' is no mesh format here"),
            None => "a mesh file's name ends with its format".to_owned(),
        };
        Error::refused(what, Accepted::Are(accepted.to_owned())).in_file(path)
    })
}

/// The format that a file of this name is written in.
///
/// # Errors
/// [`Error::InFile`] for another extension.
pub fn written_format(path: &Path) -> Result<Format, Error> {
    format_of(path, ".obj, .ply, .off, .vtk and .glb", |_| true)
}

/// Reads a mesh file, whatever is wrong with the mesh in it.
///
/// # Errors
/// [`Error::Read`], and [`Error::InFile`] with the line for what is no file of its format.
pub fn read(path: &Path) -> Result<MeshFile, Error> {
    let failed = |source| Error::Read {
        path: path.to_owned(),
        source,
    };
    let data = std::fs::metadata(path).map_err(failed)?;
    if data.is_dir() {
        let accepted = Accepted::Are("files that end with .obj, .off or .ply".to_owned());
        return Err(Error::refused("it is a folder", accepted).in_file(path));
    }
    let format = format_of(path, ".obj, .off and .ply", Format::is_read)?;
    let file = std::fs::File::open(path).map_err(failed)?;
    eigenring_surface::io::read(file, format).map_err(|error| Error::from(error).in_file(path))
}

/// Reads a mesh that is a surface.
///
/// # Errors
/// As [`read`]; [`Error::InFile`] with the defects of what is no surface.
pub fn read_surface(path: &Path) -> Result<(Mesh, Vec<String>), Error> {
    let mut file = read(path)?;
    let mut notices = std::mem::take(&mut file.notices);
    let mesh = file.surface().map_err(|error| Error::from(error).in_file(path))?;
    if mesh.weights().is_some() {
        notices.push(
            "vertices have a fourth coordinate, which only schemes with knot intervals use; it is kept".to_owned(),
        );
    }
    notices.extend(remarks(&mesh));
    Ok((mesh, notices))
}

/// Reads a mesh whose marks are knot intervals, which are for the scheme to judge, as are fourth coordinates.
///
/// # Errors
/// As [`read_surface`].
pub fn read_with_intervals(path: &Path) -> Result<(Mesh, Vec<String>), Error> {
    let mut file = read(path)?;
    let knots = std::mem::take(&mut file.mesh.features.knots);
    let mut notices = std::mem::take(&mut file.notices);
    let mut mesh = file.surface().map_err(|error| Error::from(error).in_file(path))?;
    notices.extend(remarks(&mesh));
    mesh.features.knots = knots;
    Ok((mesh, notices))
}

/// Adds knot intervals to those of a mesh: three columns, two vertices and the interval of their edge, with
/// or without a header.
///
/// # Errors
/// [`Error::Read`], [`Error::InFile`] with the line; two values for one edge, here or in the mesh.
pub fn read_intervals(path: &Path, mesh: &mut Mesh) -> Result<(), Error> {
    let text = crate::files::read(path)?;
    for (index, line) in text.lines().enumerate() {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if line.trim().is_empty() || (index == 0 && cells[0].parse::<f64>().is_err()) {
            continue;
        }
        let refuse = |what: String, accepted: &str| {
            let accepted = Accepted::Are(accepted.to_owned());
            Error::refused(format!("line {}: {what}", index + 1), accepted).in_file(path)
        };
        let (Some([a, b]), Some(value)) = (
            cells
                .get(..2)
                .and_then(|pair| Some([pair[0].parse().ok()?, pair[1].parse().ok()?])),
            cells
                .get(2)
                .and_then(|cell| cell.parse::<f64>().ok())
                .filter(|_| cells.len() == 3),
        ) else {
            return Err(refuse(
                format!("'{line}'"),
                "three columns: two vertices from 0, and the interval of their edge",
            ));
        };
        if !(value.is_finite() && value >= 0.0) {
            return Err(refuse(
                format!("the knot interval of edge {a}-{b} is {value}"),
                "finite numbers from 0",
            ));
        }
        let pair = eigenring_surface::features::edge(a, b);
        if let Some(before) = mesh
            .features
            .knots
            .insert(pair, value)
            .filter(|before| *before != value)
        {
            return Err(refuse(
                format!("edge {a}-{b} has the knot intervals {before} and {value}"),
                "one value for an edge",
            ));
        }
    }
    Ok(())
}

/// Remarks on a surface that are no defects.
fn remarks(mesh: &Mesh) -> Vec<String> {
    let topology = match Topology::new(mesh) {
        Ok(topology) => topology,
        Err(_) => return Vec::new(),
    };
    let mut remarks = Vec::new();
    let unused = mesh.unused();
    if let Some(first) = unused.first() {
        let more = unused.len() - 1;
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        remarks.push(format!("vertex {first}{more} belongs to no face and is left out"));
    }
    let valences = topology.valences();
    let two = valences
        .iter()
        .position(|&(valence, boundary)| valence == 2 && !boundary);
    if let Some(vertex) = two {
        remarks.push(format!(
            "inner vertex {vertex} has valence 2: its point is computed, but the surface has no normal there"
        ));
    }
    let (_, components) = topology.components();
    if components > 1 {
        remarks.push(format!("the mesh has {components} components"));
    }
    remarks
}

/// What a file holds, in the fields of `eigenring mesh`. Fields that a mesh with defects does not have are
/// null.
pub fn facts(file: &MeshFile) -> Fields {
    let mesh = &file.mesh;
    let sizes = |counts: &BTreeMap<usize, usize>| -> Value {
        counts
            .iter()
            .map(|(size, count)| (size.to_string(), json!(count)))
            .collect::<Map<_, _>>()
            .into()
    };
    let defects = file.defects();
    let listed: Vec<Value> = defects
        .iter()
        .map(
            |(defect, line)| json!({ "kind": defect.kind.name(), "element": defect.element.to_string(), "line": line }),
        )
        .collect();
    let facts = Topology::new(mesh).ok().map(|topology| Facts::of(mesh, &topology));
    let mut fields = Fields::default();
    let mut put = |name, value: Value| fields.0.push((name, value));
    let edges: BTreeSet<[u32; 2]> = mesh
        .faces()
        .flat_map(|face| face.iter().zip(face.iter().cycle().skip(1)))
        .map(|(&a, &b)| eigenring_surface::features::edge(a, b))
        .collect();
    put("vertices", json!(mesh.points().len()));
    put("faces", json!(mesh.face_count()));
    put("edges", json!(edges.len()));
    put("faces_by_size", sizes(&mesh.faces_by_size()));
    put("euler", json!(facts.as_ref().map(|f| f.euler)));
    put("genus", json!(facts.as_ref().map(|f| f.genus)));
    put("components", json!(facts.as_ref().map(|f| f.components)));
    put("boundary_loops", json!(facts.as_ref().map(|f| f.boundary_loops.len())));
    put(
        "boundary_lengths",
        json!(facts.as_ref().map(|f| f.boundary_loops.clone())),
    );
    put("valences", facts.as_ref().map_or(Value::Null, |f| sizes(&f.valences)));
    put(
        "boundary_valences",
        facts.as_ref().map_or(Value::Null, |f| sizes(&f.boundary_valences)),
    );
    let features = facts.as_ref().map_or(Value::Null, |f| {
        json!({
            "sharp_edges": f.features.sharp_edges,
            "semi_sharp_edges": f.features.semi_sharp_edges,
            "corners": f.features.corners,
            "knots": f.features.knots,
            "extraordinary": f.features.extraordinary,
        })
    });
    put("features", features);
    put("isolation", json!(facts.as_ref().map(|f| f.isolation)));
    put("unused_vertices", json!(mesh.unused().len()));
    put("defects", Value::Array(listed));
    fields
}

/// What a refined mesh is, in the fields of `eigenring subdivide`.
pub fn summary(mesh: &Mesh, levels: usize) -> Fields {
    let sizes: Map<String, Value> = mesh
        .faces_by_size()
        .into_iter()
        .map(|(size, count)| (size.to_string(), json!(count)))
        .collect();
    let triple = |p: Point3<f64>| json!([p.x, p.y, p.z]);
    let sum = mesh
        .points()
        .iter()
        .fold(Point3::origin(), |sum: Point3<f64>, point| sum + point.coords);
    let bounds = mesh.bounds().map(|[low, high]| json!([triple(low), triple(high)]));
    Fields(vec![
        ("vertices", json!(mesh.points().len())),
        ("faces", json!(mesh.face_count())),
        ("faces_by_size", Value::Object(sizes)),
        ("levels", json!(levels)),
        ("bounds", json!(bounds)),
        ("position_sum", triple(sum)),
    ])
}

/// Named values in an order for people.
#[derive(Clone, Debug, Default)]
pub struct Fields(pub Vec<(&'static str, Value)>);

impl Fields {
    /// One JSON object.
    pub fn json(&self) -> Value {
        let pairs = self.0.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
        Value::Object(pairs.collect())
    }

    /// Names and values below each other.
    pub fn text(&self) -> String {
        let width = self.0.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let line = |(name, value): &(&str, Value)| format!("{name:<width$}  {}\n", shown(value));
        self.0.iter().map(line).collect()
    }
}

/// A value in words, numbers with as many digits as in tables.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => number.as_f64().map_or(String::new(), short),
        // a value and where it is: face, sub, s, t
        Value::Object(map) if map.contains_key("value") => {
            let part = |name: &str| map.get(name).map_or(String::new(), shown);
            let sub = match map.get("sub").and_then(Value::as_u64) {
                Some(0) | None => String::new(),
                Some(sub) => format!(".{sub}"),
            };
            format!(
                "{} at ({}, {}) of face {}{sub}",
                part("value"),
                part("s"),
                part("t"),
                part("face")
            )
        }
        Value::Object(map) if map.is_empty() => "none".to_owned(),
        Value::Object(map) => {
            let pairs: Vec<String> = map
                .iter()
                .map(|(key, value)| format!("{key}: {}", shown(value)))
                .collect();
            pairs.join(", ")
        }
        Value::Array(list) if list.is_empty() => "none".to_owned(),
        other => other.to_string(),
    }
}

/// The rules of a scheme on a mesh. Members of the lambda-scheme that are not tabulated are tuned;
/// `lambdas` gives single vertices a lambda of their own.
///
/// # Errors
/// Those of reading a scheme file and of tuning; [`Error::Usage`] for a map under another scheme.
pub fn rules(scheme: &OnMesh, mesh: &Mesh, lambdas: &[(u32, f64)], tuner: &Tuner<'_>) -> Result<Rules, Error> {
    let name = &scheme.name;
    let mut rules = Rules::new(name.definition(Reading::default())?);
    rules.steps = scheme.steps;
    let SchemeName::Spec(spec) = name else {
        return if lambdas.is_empty() { Ok(rules) } else { Err(no_map()) };
    };
    let weighted = matches!(spec, Spec::Lambda { weights: Some(_), .. });
    let splines = match spec {
        Spec::Lambda { splines, .. } => *splines,
        _ => Splines::Paper,
    };
    let is_lambda = matches!(spec, Spec::LambdaOptimal | Spec::Lambda { .. });
    if !is_lambda {
        return if lambdas.is_empty() { Ok(rules) } else { Err(no_map()) };
    }
    let found = |spec: &Spec, valence: usize| -> Result<Option<Definition>, Error> {
        if spec.scheme::<f64>(valence).is_ok() {
            return Ok(None);
        }
        let member = tuner.member(spec, valence)?;
        Ok(member.map(|member| {
            Definition::Family(Spec::Lambda {
                lambda: member.plane.lambda,
                s: Some(member.plane.s),
                weights: Some((member.f2, member.f3)),
                splines,
            })
        }))
    };
    let valences = Topology::unchecked_valences(mesh);
    let faces = mesh.faces_by_size().into_keys();
    let inner = valences
        .iter()
        .filter(|(valence, boundary)| !boundary && *valence > 2)
        .map(|(valence, _)| *valence);
    let irregular: BTreeSet<usize> = inner.chain(faces).filter(|&n| n != 4).collect();
    if !weighted {
        for valence in irregular {
            if let Some(definition) = found(spec, valence)? {
                rules = rules.with_valence(valence, definition);
            }
        }
    }
    for &(vertex, lambda) in lambdas {
        let Some(&(valence, _)) = valences.get(vertex as usize).filter(|(valence, _)| *valence > 2) else {
            return Err(Error::Range {
                what: "vertex",
                given: vertex.to_string(),
                accepted: "a vertex of the mesh with three edges or more, counted from 0".to_owned(),
            });
        };
        let own = Spec::Lambda {
            lambda,
            s: None,
            weights: None,
            splines,
        };
        let definition = found(&own, valence)?.unwrap_or(Definition::Family(own));
        rules = rules.with_vertex(vertex, definition);
    }
    Ok(rules)
}

fn no_map() -> Error {
    Error::Usage {
        message: "a map of lambdas belongs to the lambda-scheme".to_owned(),
        accepted: "--scheme lambda:optimal or lambda:lambda=L with it".to_owned(),
    }
}

/// Reads a map of lambdas: two columns, a vertex and its lambda, with or without a header.
///
/// # Errors
/// [`Error::Read`], [`Error::InFile`] with the line.
pub fn read_lambdas(path: &Path) -> Result<Vec<(u32, f64)>, Error> {
    let text = crate::files::read(path)?;
    let mut lambdas = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if line.trim().is_empty() || (index == 0 && cells[0].parse::<f64>().is_err()) {
            continue;
        }
        match cells.as_slice() {
            [vertex, lambda] if vertex.parse::<u32>().is_ok() && lambda.parse::<f64>().is_ok_and(f64::is_finite) => {
                lambdas.push((vertex.parse().unwrap_or(0), lambda.parse().unwrap_or(0.0)));
            }
            _ => {
                let accepted = Accepted::Are("two columns: a vertex from 0, and its lambda".to_owned());
                return Err(Error::refused(format!("line {}: '{line}'", index + 1), accepted).in_file(path));
            }
        }
    }
    Ok(lambdas)
}
