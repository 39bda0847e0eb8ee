//! Meshes of other Python libraries, known by their attributes: none of these libraries is imported.
//!
//! An object with `vertices` and `faces` is one as trimesh has it, one with `points` and `cells` as meshio
//! has it. Their numbers may be of any real type and in any order of memory, as those libraries please.

use crate::failure::Failure;
use crate::input::{self, shown};
use numpy::{PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;

const ACCEPTED: &str = "vertices and faces; or an object with both, as trimesh has them; or one with points and \
                        cells, as meshio has them";

/// Coordinates of the vertices, three for each, and the faces.
pub type Arrays = (Vec<f64>, Vec<Vec<u32>>);

/// Vertices and faces of the object of another library.
///
/// # Errors
/// What is no mesh of polygons in space.
pub fn arrays(given: &Bound<'_, PyAny>) -> Result<Arrays, Failure> {
    let attribute = |name: &str| given.getattr_opt(name);
    if let (Some(vertices), Some(faces)) = (attribute("vertices")?, attribute("faces")?) {
        return Ok((coordinates(&vertices, "vertices")?, faces_of(&faces)?));
    }
    if let (Some(points), Some(cells)) = (attribute("points")?, attribute("cells")?) {
        let mut faces = Vec::new();
        let refuse = || Failure::usage("the cells of the mesh are no blocks", "blocks with type and data");
        for block in cells.try_iter().map_err(|_| refuse())? {
            let block = block?;
            let (Some(kind), Some(data)) = (block.getattr_opt("type")?, block.getattr_opt("data")?) else {
                return Err(refuse());
            };
            let kind: String = kind.extract().map_err(|_| refuse())?;
            match kind.as_str() {
                "triangle" | "quad" | "polygon" => faces.extend(faces_of(&data)?),
                // what marks parts of a mesh of faces
                "vertex" | "line" => {}
                other => {
                    let accepted = "cells that are triangle, quad or polygon, beside vertex and line";
                    return Err(Failure::usage(format!("the mesh has cells that are {other}"), accepted));
                }
            }
        }
        return Ok((coordinates(&points, "points")?, faces));
    }
    Err(Failure::usage(format!("a mesh is given as {}", shown(given)), ACCEPTED))
}

/// Float64 from what another library holds.
fn coordinates(given: &Bound<'_, PyAny>, what: &str) -> Result<Vec<f64>, Failure> {
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (given,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    // what is complex, text or objects is refused below by its own type
    let array = match kind.as_str() {
        "f" | "i" | "u" => numpy.call_method1("ascontiguousarray", (array, "float64"))?,
        _ => array,
    };
    Ok(input::rows(&array, what, Some(3))?.0)
}

/// Faces of any sizes.
///
/// # Errors
/// What is neither an integer array of shape (m, k) nor a list of faces.
pub fn faces_of(given: &Bound<'_, PyAny>) -> Result<Vec<Vec<u32>>, Failure> {
    let refuse = |reason: String| {
        Failure::usage(
            format!("faces: {reason}"),
            "an integer array of shape (m, k), or a list of faces",
        )
    };
    if let Ok(array) = given.cast::<PyUntypedArray>() {
        let shape = array.shape().to_vec();
        if shape.len() != 2 {
            return Err(refuse(format!("the shape is {shape:?}")));
        }
        let flat = input::indices(&array.call_method0("ravel")?, "faces")?;
        return Ok(match shape[1] {
            0 => vec![Vec::new(); shape[0]],
            corners => flat.chunks(corners).map(<[u32]>::to_vec).collect(),
        });
    }
    let items = given.try_iter().map_err(|_| refuse("no list".to_owned()))?;
    items.map(|face| input::indices(&face?, "faces")).collect()
}
