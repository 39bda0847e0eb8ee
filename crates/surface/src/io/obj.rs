//! Wavefront OBJ with the tag lines of OpenSubdiv.

use super::{Lines, MeshFile, coordinate, shown, syntax, text_lines};
use crate::features::{Boundary, edge};
use crate::{Error, Mesh};
use nalgebra::Point3;
use std::io::Write;

/// A tag as it stands in the file: its name, integers and numbers.
struct Tag<'a> {
    line: u32,
    name: &'a str,
    integers: Vec<u32>,
    numbers: Vec<&'a str>,
}

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, Error> {
    let mut file = MeshFile::default();
    let mut faces: Vec<(u32, Vec<i64>)> = Vec::new();
    let (mut weights, mut weighted, mut coloured) = (Vec::new(), false, false);
    let mut carried = String::new();
    let mut tags: Vec<(u32, String)> = Vec::new();
    for (line, text) in text_lines(bytes) {
        // a backslash at its end continues a line
        let text = text.trim_end();
        if let Some(begun) = text.strip_suffix('\\') {
            carried.push_str(begun);
            carried.push(' ');
            continue;
        }
        let whole = std::mem::take(&mut carried) + text;
        let content = whole.split('#').next().unwrap_or_default();
        let mut words = content.split_whitespace();
        match words.next() {
            Some("v") => {
                let words: Vec<&str> = words.collect();
                if words.len() < 3 {
                    return Err(syntax(
                        Some(line),
                        format!("vertex {} has {} coordinates", file.mesh.points().len(), words.len()),
                        "are three, or four with a weight",
                    ));
                }
                let what = format!("vertex {}", file.mesh.points().len());
                let [x, y, z] = [0, 1, 2].map(|i| coordinate(words[i], line, &what));
                file.mesh.push_point(Point3::new(x?, y?, z?));
                file.lines.vertices.push(line);
                weights.push(match words.len() {
                    4 => {
                        weighted = true;
                        coordinate(words[3], line, &what)?
                    }
                    _ => 1.0,
                });
                coloured |= words.len() > 4;
            }
            Some("f") => {
                let points = file.mesh.points().len() as i64;
                let corner = |word: &str| -> Result<i64, Error> {
                    let index = word.split('/').next().unwrap_or_default();
                    let number: i64 = index.parse().map_err(|_| {
                        syntax(
                            Some(line),
                            format!("face {}: {} is no index", faces.len(), shown(word)),
                            "are whole numbers, from 1 or relative below 0",
                        )
                    })?;
                    // negative indices count back from the last vertex before the face
                    Ok(if number < 0 { points + number } else { number - 1 })
                };
                let corners: Vec<i64> = words.map(corner).collect::<Result<_, _>>()?;
                faces.push((line, corners));
            }
            Some("t") => tags.push((line, content.to_owned())),
            // names, groups, materials, normals, texture coordinates, lines: nothing that rules use
            _ => {}
        }
    }
    let points = file.mesh.points().len();
    for (line, corners) in faces {
        if let Some(bad) = corners.iter().find(|&&index| index < 0 || index >= points as i64) {
            return Err(syntax(
                Some(line),
                format!(
                    "face {} names vertex {}, and there are {points}",
                    file.mesh.face_count(),
                    bad + 1
                ),
                "are 1 to the number of vertices, or relative from -1 down",
            ));
        }
        let corners: Vec<u32> = corners.into_iter().map(|index| index as u32).collect();
        if corners.len() < 3 {
            return Err(syntax(
                Some(line),
                format!("face {} has {} corners", file.mesh.face_count(), corners.len()),
                "are three or more",
            ));
        }
        file.mesh.push_face(&corners)?;
        file.lines.faces.push(line);
    }
    for (line, text) in &tags {
        let tag = Tag::parse(*line, text)?;
        tag.apply(&mut file.mesh, &mut file.lines)?;
    }
    if weighted {
        file.mesh.set_weights(weights);
    }
    if coloured {
        file.notices
            .push("numbers beyond the fourth of vertices are left out".to_owned());
    }
    Ok(file)
}

const COUNTS: &str = "is 't NAME integers/numbers/words values ..'";

impl<'a> Tag<'a> {
    fn parse(line: u32, text: &'a str) -> Result<Self, Error> {
        let mut words = text.split_whitespace().skip(1);
        let refuse = |what: String| syntax(Some(line), what, COUNTS);
        let name = words.next().ok_or_else(|| refuse("a tag without a name".to_owned()))?;
        let counts = words.next().unwrap_or_default();
        let counts: Vec<usize> = counts.split('/').filter_map(|count| count.parse().ok()).collect();
        let &[integers, numbers, _] = counts.as_slice() else {
            return Err(refuse(format!("tag {name} without its three counts")));
        };
        let words: Vec<&str> = words.collect();
        if integers > words.len() || numbers > words.len() - integers {
            return Err(refuse(format!(
                "tag {name} announces {integers} integers and {numbers} numbers, and has {} values",
                words.len()
            )));
        }
        let parse = |word: &&str| {
            word.parse()
                .map_err(|_| refuse(format!("tag {name}: {} is no vertex number", shown(word))))
        };
        Ok(Tag {
            line,
            name,
            integers: words[..integers].iter().map(parse).collect::<Result<_, _>>()?,
            numbers: words[integers..integers + numbers].to_vec(),
        })
    }

    fn apply(&self, mesh: &mut Mesh, lines: &mut Lines) -> Result<(), Error> {
        let &Tag { line, name, .. } = self;
        let refuse = |what: String, accepted| Err(syntax(Some(line), format!("tag {name}: {what}"), accepted));
        let points = mesh.points().len();
        if !matches!(name, "interpolateboundary" | "levels") {
            // an integer beyond the first two of 'steps' is the number of steps
            let count = if name == "steps" {
                self.integers.len().saturating_sub(1)
            } else {
                self.integers.len()
            };
            if let Some(bad) = self.integers[..count].iter().find(|&&v| v as usize >= points) {
                return refuse(
                    format!("there is no vertex {bad}, there are {points}"),
                    "are vertex numbers from 0",
                );
            }
        }
        let sharpness = || -> Result<f64, Error> {
            let value = coordinate(self.numbers[0], line, &format!("tag {name}"))?;
            if value < 0.0 {
                let what = format!("tag {name}: {value} is negative");
                return Err(syntax(Some(line), what, "are 0 and above"));
            }
            Ok(value)
        };
        let features = &mut mesh.features;
        match (name, self.integers.as_slice(), self.numbers.len()) {
            ("crease", &[a, b], 1) => {
                lines.edge_marks.insert(edge(a, b), line);
                features.creases.insert(edge(a, b), sharpness()?);
            }
            ("corner", &[v], 1) => {
                lines.vertex_marks.insert(v, line);
                features.corners.insert(v, sharpness()?);
            }
            ("knot", &[a, b], 1) => {
                lines.edge_marks.insert(edge(a, b), line);
                let value = sharpness()?;
                if let Some(before) = features
                    .knots
                    .insert(edge(a, b), value)
                    .filter(|before| *before != value)
                {
                    return refuse(
                        format!("edge {a}-{b} has the intervals {before} and {value}"),
                        "is one value for an edge",
                    );
                }
            }
            ("interpolateboundary", &[mode], _) => {
                features.boundary = Some(match mode {
                    0 => Boundary::Shrink,
                    1 => Boundary::Corner,
                    2 => Boundary::Edge,
                    _ => return refuse(format!("there is no mode {mode}"), "are 0, 1 and 2"),
                });
            }
            ("steps", &[a, b], 1) => {
                lines.edge_marks.insert(edge(a, b), line);
                features.edge_steps.insert(edge(a, b), self.steps(self.numbers[0])?);
            }
            ("steps", &[a, b, steps], 0) => {
                lines.edge_marks.insert(edge(a, b), line);
                features.edge_steps.insert(edge(a, b), steps);
            }
            ("steps", &[v], 1) => {
                lines.vertex_marks.insert(v, line);
                features.vertex_steps.insert(v, self.steps(self.numbers[0])?);
            }
            ("steps", &[v, steps], 0) => {
                lines.vertex_marks.insert(v, line);
                features.vertex_steps.insert(v, steps);
            }
            ("extraordinary", &[v], _) => {
                lines.vertex_marks.insert(v, line);
                features.extraordinary.insert(v);
            }
            ("levels", &[levels], _) => features.levels = levels,
            ("crease" | "corner" | "knot" | "steps" | "extraordinary" | "levels" | "interpolateboundary", ..) => {
                return refuse(
                    format!("{} integers and {} numbers", self.integers.len(), self.numbers.len()),
                    "are crease 2/1/0, corner 1/1/0, knot 2/1/0, steps 2/1/0 or 1/1/0, extraordinary 1/0/0, levels 1/0/0, interpolateboundary 1/0/0",
                );
            }
            // tags of other rules of OpenSubdiv, such as face-varying data
            _ => {}
        }
        Ok(())
    }

    fn steps(&self, word: &str) -> Result<u32, Error> {
        let whole = word
            .parse::<f64>()
            .ok()
            .filter(|x| *x >= 0.0 && x.fract() == 0.0 && *x < 1e6);
        whole.map(|x| x as u32).ok_or_else(|| {
            syntax(
                Some(self.line),
                format!("tag steps: {} is no number of steps", shown(word)),
                "are whole numbers from 0",
            )
        })
    }
}

pub(super) fn write(mesh: &Mesh, to: &mut impl Write) -> Result<(), Error> {
    for (index, point) in mesh.points().iter().enumerate() {
        match mesh.weights() {
            Some(weights) => writeln!(to, "v {:?} {:?} {:?} {:?}", point.x, point.y, point.z, weights[index])?,
            None => writeln!(to, "v {:?} {:?} {:?}", point.x, point.y, point.z)?,
        }
    }
    for face in mesh.faces() {
        write!(to, "f")?;
        for corner in face {
            write!(to, " {}", corner + 1)?;
        }
        writeln!(to)?;
    }
    let features = &mesh.features;
    for ([a, b], s) in &features.creases {
        writeln!(to, "t crease 2/1/0 {a} {b} {s:?}")?;
    }
    for (v, s) in &features.corners {
        writeln!(to, "t corner 1/1/0 {v} {s:?}")?;
    }
    for ([a, b], steps) in &features.edge_steps {
        writeln!(to, "t steps 2/1/0 {a} {b} {steps}")?;
    }
    for (v, steps) in &features.vertex_steps {
        writeln!(to, "t steps 1/1/0 {v} {steps}")?;
    }
    for ([a, b], d) in &features.knots {
        writeln!(to, "t knot 2/1/0 {a} {b} {d:?}")?;
    }
    for v in &features.extraordinary {
        writeln!(to, "t extraordinary 1/0/0 {v}")?;
    }
    if features.levels > 0 {
        writeln!(to, "t levels 1/0/0 {}", features.levels)?;
    }
    let mode = features.boundary.map(|boundary| match boundary {
        Boundary::Shrink => 0,
        Boundary::Corner => 1,
        Boundary::Edge => 2,
    });
    if let Some(mode) = mode {
        writeln!(to, "t interpolateboundary 1/0/0 {mode}")?;
    }
    Ok(())
}
