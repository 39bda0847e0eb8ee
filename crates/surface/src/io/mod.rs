//! Mesh files: OBJ, OFF and PLY in and out, legacy VTK and binary glTF out.
//!
//! Readers take any [`Read`], and remember on which line of the file each element stands. Writers print the
//! shortest decimals that are read back as the same doubles (17 digits where they are needed); glTF stores
//! single precision, as its format demands. Marks are kept in OBJ only, where they are OpenSubdiv's tag
//! lines.

mod glb;
mod obj;
mod off;
mod ply;
mod vtk;

use crate::{Defect, Element, Error, Mesh};
use std::io::{Read, Write};

pub use ply::Encoding;

/// The format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront, with OpenSubdiv's tags.
    Obj,
    /// Geomview's object file format.
    Off,
    /// Stanford polygons, text or binary.
    Ply,
    /// Legacy VTK polygon data; written only.
    Vtk,
    /// Binary glTF 2.0; written only.
    Glb,
}

impl Format {
    /// The format of a file's extension.
    pub fn of_extension(extension: &str) -> Option<Format> {
        match extension.to_ascii_lowercase().as_str() {
            "obj" => Some(Format::Obj),
            "off" => Some(Format::Off),
            "ply" => Some(Format::Ply),
            "vtk" => Some(Format::Vtk),
            "glb" => Some(Format::Glb),
            _ => None,
        }
    }

    /// Whether it can be read.
    pub fn is_read(self) -> bool {
        matches!(self, Format::Obj | Format::Off | Format::Ply)
    }
}

/// A mesh as it was read.
#[derive(Clone, Debug, Default)]
pub struct MeshFile {
    /// The mesh.
    pub mesh: Mesh,
    /// Remarks on what is in the file and not used, in sentences.
    pub notices: Vec<String>,
    pub(crate) lines: Lines,
}

/// On which line each element stands; empty for binary files.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines {
    pub vertices: Vec<u32>,
    pub faces: Vec<u32>,
    pub edge_marks: std::collections::BTreeMap<[u32; 2], u32>,
    pub vertex_marks: std::collections::BTreeMap<u32, u32>,
}

impl MeshFile {
    /// The line of the file, from 1, on which the cause of a defect stands: the mark, the face, the last face
    /// that takes part, or the vertex.
    pub fn line(&self, defect: &Defect) -> Option<u32> {
        use crate::DefectKind::{BadMark, NoSuchEdge};
        let marks = matches!(defect.kind, NoSuchEdge | BadMark);
        match defect.element {
            Element::Edge(pair) if marks => self.lines.edge_marks.get(&pair).copied(),
            Element::Vertex(vertex) if marks => self.lines.vertex_marks.get(&vertex).copied(),
            Element::Face(face) => self.lines.faces.get(face as usize).copied(),
            Element::Edge(_) => {
                let last = defect.faces.iter().max()?;
                self.lines.faces.get(*last as usize).copied()
            }
            Element::Vertex(vertex) => self.lines.vertices.get(vertex as usize).copied(),
        }
    }

    /// The defects of the mesh with their lines.
    pub fn defects(&self) -> Vec<(Defect, Option<u32>)> {
        let defects = self.mesh.defects().into_iter();
        defects.map(|defect| (defect.clone(), self.line(&defect))).collect()
    }

    /// The mesh, if it is a surface.
    ///
    /// # Errors
    /// [`Error::Empty`], [`Error::Defects`].
    pub fn surface(self) -> Result<Mesh, Error> {
        if self.mesh.face_count() == 0 {
            return Err(Error::Empty);
        }
        match self.defects() {
            defects if defects.is_empty() => Ok(self.mesh),
            defects => Err(Error::Defects(defects)),
        }
    }
}

/// Reads a mesh.
///
/// # Errors
/// [`Error::Syntax`] for what is no file of this format, with the line; [`Error::Io`].
pub fn read(mut from: impl Read, format: Format) -> Result<MeshFile, Error> {
    let mut bytes = Vec::new();
    from.read_to_end(&mut bytes)?;
    match format {
        Format::Obj => obj::read(&bytes),
        Format::Off => off::read(&bytes),
        Format::Ply => ply::read(&bytes),
        Format::Vtk | Format::Glb => Err(syntax(None, "this format is written only", "are obj, off and ply")),
    }
}

/// Writes a mesh; PLY as little-endian doubles.
///
/// # Errors
/// [`Error::Io`].
pub fn write(mesh: &Mesh, to: &mut impl Write, format: Format) -> Result<(), Error> {
    let mut to = std::io::BufWriter::with_capacity(1 << 16, to);
    match format {
        Format::Obj => obj::write(mesh, &mut to)?,
        Format::Off => off::write(mesh, &mut to)?,
        Format::Ply => ply::write(mesh, &mut to, Encoding::LittleEndian)?,
        Format::Vtk => vtk::write(mesh, &mut to)?,
        Format::Glb => glb::write(mesh, &mut to)?,
    }
    to.flush()?;
    Ok(())
}

/// Writes a mesh as PLY in an encoding.
///
/// # Errors
/// [`Error::Io`].
pub fn write_ply(mesh: &Mesh, to: &mut impl Write, encoding: Encoding) -> Result<(), Error> {
    let mut to = std::io::BufWriter::with_capacity(1 << 16, to);
    ply::write(mesh, &mut to, encoding)?;
    to.flush()?;
    Ok(())
}

fn syntax(line: Option<u32>, what: impl Into<String>, accepted: &'static str) -> Error {
    Error::Syntax {
        line,
        what: what.into(),
        accepted,
    }
}

/// What a message shows of a word that is refused.
fn shown(word: &str) -> String {
    let short: String = word.chars().take(40).collect();
    if short.len() < word.len() {
        format!("'{short}..'")
    } else {
        format!("'{short}'")
    }
}

/// A finite coordinate.
fn coordinate(word: &str, line: u32, what: &str) -> Result<f64, Error> {
    match word.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        Ok(_) => Err(syntax(
            Some(line),
            format!("{what}: {} is no finite number", shown(word)),
            "are finite numbers",
        )),
        Err(_) => Err(syntax(
            Some(line),
            format!("{what}: {} is no number", shown(word)),
            "are finite numbers",
        )),
    }
}

fn text_lines(bytes: &[u8]) -> impl Iterator<Item = (u32, std::borrow::Cow<'_, str>)> {
    let lines = bytes.split(|&byte| byte == b'\n').enumerate();
    lines.map(|(index, line)| (index as u32 + 1, String::from_utf8_lossy(line)))
}
