//! Binary glTF 2.0: one mesh of triangles, faces cut into fans from their first corner.

use crate::{Error, Mesh};
use serde_json::json;
use std::io::Write;

/// glTF counts the bytes of a file in 32 bits.
const MOST: usize = u32::MAX as usize - 4096;

pub(super) fn write(mesh: &Mesh, to: &mut impl Write) -> Result<(), Error> {
    let triangles: usize = mesh.faces().map(|face| face.len().saturating_sub(2)).sum();
    let (points, indices) = (12 * mesh.points().len(), 12 * triangles);
    let binary = points + indices;
    if binary > MOST {
        return Err(Error::TooLarge {
            what: "bytes of a glTF file",
            count: binary,
        });
    }
    // the bounds are those of the stored single-precision numbers
    let stored = |x: f64| f64::from(x as f32);
    let [low, high] = mesh.bounds().unwrap_or_default();
    let corner = |point: nalgebra::Point3<f64>| [stored(point.x), stored(point.y), stored(point.z)];
    let document = json!({
        "asset": { "version": "2.0", "generator": "eigenring" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "mode": 4 }] }],
        "buffers": [{ "byteLength": binary }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": points, "target": 34962 },
            { "buffer": 0, "byteOffset": points, "byteLength": indices, "target": 34963 },
        ],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": mesh.points().len(), "type": "VEC3",
                "min": corner(low), "max": corner(high),
            },
            { "bufferView": 1, "componentType": 5125, "count": 3 * triangles, "type": "SCALAR" },
        ],
    });
    let mut text = document.to_string().into_bytes();
    while !text.len().is_multiple_of(4) {
        text.push(b' ');
    }
    let word = |value: usize| (value as u32).to_le_bytes();
    to.write_all(b"glTF")?;
    to.write_all(&word(2))?;
    to.write_all(&word(12 + 8 + text.len() + 8 + binary))?;
    to.write_all(&word(text.len()))?;
    to.write_all(b"JSON")?;
    to.write_all(&text)?;
    to.write_all(&word(binary))?;
    to.write_all(b"BIN\0")?;
    for point in mesh.points() {
        for &x in point.iter() {
            to.write_all(&(x as f32).to_le_bytes())?;
        }
    }
    for face in mesh.faces() {
        for pair in face.windows(2).skip(1) {
            for corner in [face[0], pair[0], pair[1]] {
                to.write_all(&corner.to_le_bytes())?;
            }
        }
    }
    Ok(())
}
