//! PLY: any elements and properties, of which the coordinates of `vertex` and the index list of `face` are
//! used; text, and binary in both byte orders.

use super::{MeshFile, shown, syntax};
use crate::{Error, Mesh};
use nalgebra::Point3;
use std::io::Write;

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// As text.
    Text,
    /// Binary, least significant byte first.
    LittleEndian,
    /// Binary, most significant byte first.
    BigEndian,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Signed(usize),
    Unsigned(usize),
    Float(usize),
}

impl Kind {
    fn parse(word: &str) -> Option<Kind> {
        Some(match word {
            "char" | "int8" => Kind::Signed(1),
            "uchar" | "uint8" => Kind::Unsigned(1),
            "short" | "int16" => Kind::Signed(2),
            "ushort" | "uint16" => Kind::Unsigned(2),
            "int" | "int32" => Kind::Signed(4),
            "uint" | "uint32" => Kind::Unsigned(4),
            "float" | "float32" => Kind::Float(4),
            "double" | "float64" => Kind::Float(8),
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Kind::Signed(size) | Kind::Unsigned(size) | Kind::Float(size) => size,
        }
    }
}

struct Property {
    name: String,
    /// Of the length, for lists.
    list: Option<Kind>,
    kind: Kind,
}

struct Announced {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

const HEADER: &str = "is a PLY header: ply, format, element and property lines, end_header";

/// Numbers one after the other, wherever they come from.
struct Source<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
    encoding: Encoding,
    element: String,
}

impl Source<'_> {
    fn refuse(&self, what: String, accepted: &'static str) -> Error {
        let line = (self.encoding == Encoding::Text).then_some(self.line);
        syntax(line, format!("{}: {what}", self.element), accepted)
    }

    /// The next number as a double, which holds every integer of up to 32 bits.
    fn number(&mut self, kind: Kind) -> Result<f64, Error> {
        if self.encoding == Encoding::Text {
            while self.at < self.bytes.len() && self.bytes[self.at].is_ascii_whitespace() {
                self.line += u32::from(self.bytes[self.at] == b'\n');
                self.at += 1;
            }
            let rest = &self.bytes[self.at..];
            let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
            let word = String::from_utf8_lossy(&rest[..length]).into_owned();
            if word.is_empty() {
                return Err(self.refuse("the file ends here".to_owned(), "are as many elements as announced"));
            }
            self.at += length;
            return word
                .parse()
                .map_err(|_| self.refuse(format!("{} is no number", shown(&word)), "are numbers"));
        }
        let size = kind.size();
        let Some(bytes) = self.bytes.get(self.at..self.at + size) else {
            let what = format!("the file ends here, after {} bytes", self.bytes.len());
            return Err(self.refuse(what, "are as many elements as announced"));
        };
        self.at += size;
        let mut little = [0_u8; 8];
        little[..size].copy_from_slice(bytes);
        if self.encoding == Encoding::BigEndian {
            little[..size].reverse();
        }
        let whole = u64::from_le_bytes(little);
        Ok(match kind {
            Kind::Unsigned(_) => whole as f64,
            Kind::Signed(size) => {
                let shift = 64 - 8 * size;
                ((whole << shift) as i64 >> shift) as f64
            }
            Kind::Float(4) => f64::from(f32::from_bits(whole as u32)),
            Kind::Float(_) => f64::from_bits(whole),
        })
    }
}

fn header(bytes: &[u8]) -> Result<(Encoding, Vec<Announced>, usize, u32), Error> {
    let (mut at, mut line) = (0, 0);
    let mut encoding = None;
    let mut elements: Vec<Announced> = Vec::new();
    loop {
        let rest = &bytes[at..];
        let Some(length) = rest.iter().position(|&byte| byte == b'\n') else {
            return Err(syntax(Some(line + 1), "the header has no end", HEADER));
        };
        line += 1;
        at += length + 1;
        let text = String::from_utf8_lossy(&rest[..length]).trim().to_owned();
        let words: Vec<&str> = text.split_whitespace().collect();
        let refuse = || syntax(Some(line), format!("header line {}", shown(&text)), HEADER);
        match words.as_slice() {
            ["ply"] if line == 1 => {}
            _ if line == 1 => return Err(refuse()),
            ["format", format, _] => {
                encoding = Some(match *format {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => return Err(refuse()),
                });
            }
            ["comment", ..] | ["obj_info", ..] | [] => {}
            ["element", name, count] => elements.push(Announced {
                name: (*name).to_owned(),
                count: count.parse().map_err(|_| refuse())?,
                properties: Vec::new(),
            }),
            ["property", "list", count, kind, name] => {
                let element = elements.last_mut().ok_or_else(refuse)?;
                element.properties.push(Property {
                    name: (*name).to_owned(),
                    list: Some(Kind::parse(count).ok_or_else(refuse)?),
                    kind: Kind::parse(kind).ok_or_else(refuse)?,
                });
            }
            ["property", kind, name] => {
                let element = elements.last_mut().ok_or_else(refuse)?;
                element.properties.push(Property {
                    name: (*name).to_owned(),
                    list: None,
                    kind: Kind::parse(kind).ok_or_else(refuse)?,
                });
            }
            ["end_header"] => {
                let encoding = encoding.ok_or_else(|| syntax(Some(line), "there is no format line", HEADER))?;
                return Ok((encoding, elements, at, line));
            }
            _ => return Err(refuse()),
        }
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, Error> {
    let (encoding, elements, at, line) = header(bytes)?;
    let mut source = Source {
        bytes,
        at,
        line: line + 1,
        encoding,
        element: String::new(),
    };
    let mut file = MeshFile::default();
    for element in &elements {
        if element.properties.is_empty() {
            // elements without properties have no bytes, however many are announced
            continue;
        }
        let coordinate = |name| {
            element
                .properties
                .iter()
                .position(|p| p.name == name && p.list.is_none())
        };
        let axes = ["x", "y", "z"].map(coordinate);
        let is_vertex = element.name == "vertex";
        if is_vertex && axes.contains(&None) {
            return Err(syntax(None, "vertices lack x, y or z", "are three coordinates"));
        }
        let list = element
            .properties
            .iter()
            .position(|p| p.list.is_some() && matches!(p.name.as_str(), "vertex_indices" | "vertex_index"));
        let is_face = element.name == "face";
        if is_face && list.is_none() {
            return Err(syntax(None, "faces lack their list vertex_indices", "is that list"));
        }
        for index in 0..element.count {
            source.element = format!("{} {index} of {}", element.name, element.count);
            let mut point = [0.0; 3];
            let mut face = Vec::new();
            for (place, property) in element.properties.iter().enumerate() {
                let Some(counted) = property.list else {
                    let value = source.number(property.kind)?;
                    if let Some(axis) = axes.iter().position(|&axis| is_vertex && axis == Some(place)) {
                        if !value.is_finite() {
                            let what = format!("coordinate {} is {value}", property.name);
                            return Err(source.refuse(what, "are finite numbers"));
                        }
                        point[axis] = value;
                    }
                    continue;
                };
                let length = source.number(counted)?;
                if !(length >= 0.0 && length.fract() == 0.0) {
                    return Err(source.refuse(format!("a list of {length} entries"), "are whole lengths from 0"));
                }
                for _ in 0..length as u64 {
                    let value = source.number(property.kind)?;
                    if is_face && Some(place) == list {
                        let points = file.mesh.points().len();
                        if !(value >= 0.0 && value.fract() == 0.0 && value < points as f64) {
                            let what = format!("there is no vertex {value}, there are {points}");
                            return Err(source.refuse(what, "are vertex numbers from 0"));
                        }
                        face.push(value as u32);
                    }
                }
            }
            if is_vertex {
                file.mesh.push_point(Point3::from(point));
                if encoding == Encoding::Text {
                    file.lines.vertices.push(source.line);
                }
            } else if is_face {
                if face.len() < 3 {
                    return Err(source.refuse(format!("{} corners", face.len()), "are three or more"));
                }
                file.mesh.push_face(&face)?;
                if encoding == Encoding::Text {
                    file.lines.faces.push(source.line);
                }
            }
        }
    }
    Ok(file)
}

pub(super) fn write(mesh: &Mesh, to: &mut impl Write, encoding: Encoding) -> Result<(), Error> {
    let name = match encoding {
        Encoding::Text => "ascii",
        Encoding::LittleEndian => "binary_little_endian",
        Encoding::BigEndian => "binary_big_endian",
    };
    // faces of more than 255 corners need a wider length
    let wide = mesh.faces().any(|face| face.len() > 255);
    writeln!(
        to,
        "ply\nformat {name} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list {} uint vertex_indices\nend_header",
        mesh.points().len(),
        mesh.face_count(),
        if wide { "uint" } else { "uchar" }
    )?;
    let big = encoding == Encoding::BigEndian;
    for point in mesh.points() {
        if encoding == Encoding::Text {
            writeln!(to, "{:?} {:?} {:?}", point.x, point.y, point.z)?;
            continue;
        }
        for x in point.iter() {
            to.write_all(&if big { x.to_be_bytes() } else { x.to_le_bytes() })?;
        }
    }
    for face in mesh.faces() {
        if encoding == Encoding::Text {
            write!(to, "{}", face.len())?;
            for corner in face {
                write!(to, " {corner}")?;
            }
            writeln!(to)?;
            continue;
        }
        let word = |value: u32| if big { value.to_be_bytes() } else { value.to_le_bytes() };
        if wide {
            to.write_all(&word(face.len() as u32))?;
        } else {
            to.write_all(&[face.len() as u8])?;
        }
        for &corner in face {
            to.write_all(&word(corner))?;
        }
    }
    Ok(())
}
