//! Legacy VTK, as text: polygons with double coordinates.

use crate::{Error, Mesh};
use std::io::Write;

pub(super) fn write(mesh: &Mesh, to: &mut impl Write) -> Result<(), Error> {
    writeln!(
        to,
        "# vtk DataFile Version 3.0\neigenring surface\nASCII\nDATASET POLYDATA\nPOINTS {} double",
        mesh.points().len()
    )?;
    for point in mesh.points() {
        writeln!(to, "{:?} {:?} {:?}", point.x, point.y, point.z)?;
    }
    let faces = mesh.face_count();
    writeln!(to, "POLYGONS {faces} {}", faces + mesh.corners().len())?;
    for face in mesh.faces() {
        write!(to, "{}", face.len())?;
        for corner in face {
            write!(to, " {corner}")?;
        }
        writeln!(to)?;
    }
    Ok(())
}
