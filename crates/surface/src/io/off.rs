//! OFF: counts, points, faces.

use super::{MeshFile, coordinate, shown, syntax, text_lines};
use crate::{Error, Mesh};
use nalgebra::Point3;
use std::io::Write;

const HEAD: &str = "is 'OFF', then the numbers of vertices, faces and edges";

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, Error> {
    let mut lines = text_lines(bytes)
        .map(|(line, text)| (line, text.split('#').next().unwrap_or_default().trim().to_owned()))
        .filter(|(_, text)| !text.is_empty());
    let (line, head) = lines.next().ok_or_else(|| syntax(Some(1), "the file is empty", HEAD))?;
    let counts = head
        .strip_prefix("OFF")
        .ok_or_else(|| syntax(Some(line), format!("the file begins with {}", shown(&head)), HEAD))?
        .trim()
        .to_owned();
    let (line, counts) = if counts.is_empty() {
        lines
            .next()
            .ok_or_else(|| syntax(Some(line), "there are no counts", HEAD))?
    } else {
        (line, counts)
    };
    let numbers: Vec<u64> = counts.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let (vertices, faces) = match numbers.as_slice() {
        [vertices, faces] | [vertices, faces, _] => (*vertices, *faces),
        _ => return Err(syntax(Some(line), format!("counts {}", shown(&counts)), HEAD)),
    };
    let mut file = MeshFile::default();
    let mut last = line;
    let ended = |last, what: &str, found: usize, announced| {
        syntax(
            Some(last),
            format!("the file ends after {found} of {announced} {what}"),
            "are as many as announced",
        )
    };
    for index in 0..vertices {
        let (line, text) = lines
            .next()
            .ok_or_else(|| ended(last, "vertices", index as usize, vertices))?;
        let words: Vec<&str> = text.split_whitespace().collect();
        if words.len() < 3 {
            return Err(syntax(
                Some(line),
                format!("vertex {index} has {} coordinates", words.len()),
                "are three",
            ));
        }
        let what = format!("vertex {index}");
        let [x, y, z] = [0, 1, 2].map(|i| coordinate(words[i], line, &what));
        file.mesh.push_point(Point3::new(x?, y?, z?));
        file.lines.vertices.push(line);
        last = line;
    }
    for index in 0..faces {
        let (line, text) = lines
            .next()
            .ok_or_else(|| ended(last, "faces", index as usize, faces))?;
        let mut words = text.split_whitespace();
        let count = words.next().unwrap_or_default();
        let refuse = |what: String| {
            syntax(
                Some(line),
                format!("face {index}: {what}"),
                "are the number of corners, then as many vertex numbers from 0 to the number of vertices less 1",
            )
        };
        let size: usize = count
            .parse()
            .map_err(|_| refuse(format!("{} is no number of corners", shown(count))))?;
        let indices: Vec<u32> = words
            .take(size)
            .map(|word| {
                let number = word.parse().ok().filter(|&v: &u32| u64::from(v) < vertices);
                number.ok_or_else(|| refuse(format!("there is no vertex {}", shown(word))))
            })
            .collect::<Result<_, _>>()?;
        if indices.len() < size || size < 3 {
            return Err(refuse(format!("{} of {size} corners", indices.len())));
        }
        file.mesh.push_face(&indices)?;
        file.lines.faces.push(line);
        last = line;
    }
    Ok(file)
}

pub(super) fn write(mesh: &Mesh, to: &mut impl Write) -> Result<(), Error> {
    writeln!(to, "OFF\n{} {} 0", mesh.points().len(), mesh.face_count())?;
    for point in mesh.points() {
        writeln!(to, "{:?} {:?} {:?}", point.x, point.y, point.z)?;
    }
    for face in mesh.faces() {
        write!(to, "{}", face.len())?;
        for corner in face {
            write!(to, " {corner}")?;
        }
        writeln!(to)?;
    }
    Ok(())
}
