//! Pictures of surfaces, pixel by pixel, several side by side.
//!
//! Each face is sampled on a grid about as fine as the pixels, with exact normals and curvatures; colours are
//! found at every pixel of a picture three times as fine and averaged. Stripes narrower than a pixel fade
//! into their mean: what is drawn is their average over the pixel.

use crate::error::Error;
use eigenring_figure::{Colour, ColourScale, Pixels};
use eigenring_surface::lines::Lights;
use eigenring_surface::raster::{Camera, Corner, Raster};
use eigenring_surface::{Mesh, Place, Point3, Surface, Vector3};
use rayon::prelude::*;

/// What is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Show {
    /// Diffuse light.
    Shaded,
    /// Diffuse light and the lines of parameters.
    Wireframe,
    /// Gauss curvature in colours.
    Gauss,
    /// Mean curvature in colours.
    Mean,
    /// Highlight lines.
    Highlight,
    /// Reflection lines.
    Reflection,
    /// Lines of equal brightness.
    Isophotes,
}

/// What is drawn.
#[derive(Debug)]
pub enum Subject<'a> {
    /// The limit surface.
    Surface(Box<Surface<'a>>),
    /// The faces of a mesh, flat, with their edges.
    Faces(Mesh),
    /// A mesh fine enough to pass for a smooth surface.
    Fine(Mesh),
    /// The same with the normals at its points, where they are known.
    Limits(Mesh, Vec<Option<Vector3<f64>>>),
}

/// How a picture is taken.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// What is shown.
    pub show: Show,
    /// Azimuth and elevation of the eye in degrees, and the enlargement.
    pub view: [f64; 3],
    /// Azimuth and elevation of the light in degrees, relative to the eye.
    pub light: [f64; 2],
    /// The number of stripes over the size of the surface, or over the range of brightness.
    pub stripes: f64,
    /// Whether y points upwards on the mesh, and not z.
    pub y_up: bool,
    /// Pixels of a picture's sides.
    pub size: usize,
    /// How many pictures stand side by side.
    pub columns: usize,
}

/// Pixels are averaged over squares of so many.
const FINER: usize = 3;
const CAPTION: usize = 34;

/// Triangles of one face.
struct Sheet {
    corners: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
    /// Whether its edges are drawn: the second parameter is the distance from them.
    edges: bool,
}

fn turned(v: Vector3<f64>, y_up: bool) -> Vector3<f64> {
    // z forwards becomes -y, so that what looks towards z looks at the eye
    if y_up { Vector3::new(v.z, v.x, v.y) } else { v }
}

/// The quads of a face, or of the quarters of one, by face and sub.
fn pieces(mesh: &Mesh) -> Vec<(u32, u32)> {
    let faces = (0..).zip(mesh.faces());
    faces
        .flat_map(|(face, corners)| {
            let subs = if corners.len() == 4 { 1 } else { corners.len() as u32 };
            (0..subs).map(move |sub| (face, sub))
        })
        .collect()
}

impl Subject<'_> {
    /// What a picture of so many pixels consists of.
    fn sheets(&self, settings: &Settings) -> Result<Vec<Sheet>, Error> {
        match self {
            Subject::Surface(surface) => {
                let pieces = pieces(surface.control());
                // a face covers about size^2/faces pixels; two samples for each of three pixels in a row
                let n = (2.0 * settings.size as f64 / (pieces.len() as f64).sqrt()).clamp(6.0, 160.0) as usize;
                let found = pieces
                    .par_iter()
                    .map(|&(face, sub)| sampled(surface, face, sub, settings, n));
                Ok(found.collect::<Result<_, eigenring_surface::Error>>()?)
            }
            Subject::Faces(mesh) => Ok(flat(mesh, settings)),
            Subject::Fine(mesh) => Ok(vec![smooth(mesh, &[], settings)]),
            Subject::Limits(mesh, normals) => Ok(vec![smooth(mesh, normals, settings)]),
        }
    }
}

/// The samples of a face, a grid of `n + 1` points a side.
fn sampled(
    surface: &Surface<'_>,
    face: u32,
    sub: u32,
    settings: &Settings,
    n: usize,
) -> Result<Sheet, eigenring_surface::Error> {
    let mut evaluator = surface.evaluator(face)?;
    let mut corners = Vec::with_capacity((n + 1) * (n + 1));
    for (j, i) in (0..=n).flat_map(|j| (0..=n).map(move |i| (j, i))) {
        let [s, t] = [i, j].map(|k| k as f64 / n as f64);
        let place = |s: f64, t: f64| Place {
            face,
            sub,
            corner: 0,
            s,
            t,
        };
        let sample = evaluator.at(place(s, t))?;
        // normals and curvatures beside a centre that has none
        let inside = |x: f64| x.clamp(1e-6, 1.0 - 1e-6);
        let shown = match (sample.normal, sample.gauss) {
            (Some(_), Some(_)) => sample,
            _ => evaluator.at(place(inside(s), inside(t)))?,
        };
        let value = match settings.show {
            Show::Gauss => shown.gauss,
            Show::Mean => shown.mean,
            _ => None,
        };
        corners.push(Corner {
            position: Point3::from(turned(sample.position.coords, settings.y_up)),
            normal: turned(shown.normal.unwrap_or_else(Vector3::z), settings.y_up),
            value: value.unwrap_or(f64::NAN),
            parameters: [s, t],
        });
    }
    let at = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        [
            [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
            [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
        ]
    });
    Ok(Sheet {
        corners,
        triangles: triangles.collect(),
        edges: false,
    })
}

/// The sum of the cross products around a polygon: its normal, as long as its area is large.
fn area(points: &[Vector3<f64>]) -> Vector3<f64> {
    let next = points.iter().cycle().skip(1);
    points
        .iter()
        .zip(next)
        .map(|(a, b)| (a - points[0]).cross(&(b - points[0])))
        .sum()
}

/// The faces of a mesh, each as triangles around its middle.
fn flat(mesh: &Mesh, settings: &Settings) -> Vec<Sheet> {
    let faces = mesh.faces().map(|face| {
        let points: Vec<Vector3<f64>> = face
            .iter()
            .map(|&v| turned(mesh.points()[v as usize].coords, settings.y_up))
            .collect();
        let normal = area(&points).try_normalize(0.0).unwrap_or_else(Vector3::z);
        let middle = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
        let corner = |at: Vector3<f64>, away: f64| Corner {
            position: Point3::from(at),
            normal,
            value: f64::NAN,
            parameters: [0.5, away],
        };
        let n = points.len() as u32;
        let mut corners: Vec<Corner> = points.iter().map(|&at| corner(at, 0.0)).collect();
        corners.push(corner(middle, 1.0));
        Sheet {
            corners,
            triangles: (0..n).map(|i| [i, (i + 1) % n, n]).collect(),
            edges: true,
        }
    });
    faces.collect()
}

/// A fine mesh with normals at its points: those that are known, else the mean of the normals of the faces
/// around.
fn smooth(mesh: &Mesh, known: &[Option<Vector3<f64>>], settings: &Settings) -> Sheet {
    let points: Vec<Vector3<f64>> = mesh.points().iter().map(|p| turned(p.coords, settings.y_up)).collect();
    let mut normals = vec![Vector3::zeros(); points.len()];
    let mut triangles = Vec::new();
    for face in mesh.faces() {
        let around: Vec<Vector3<f64>> = face.iter().map(|&v| points[v as usize]).collect();
        let normal = area(&around);
        face.iter().for_each(|&v| normals[v as usize] += normal);
        triangles.extend(face.windows(2).skip(1).map(|pair| [face[0], pair[0], pair[1]]));
    }
    for (normal, known) in normals.iter_mut().zip(known) {
        if let Some(known) = known {
            *normal = turned(*known, settings.y_up);
        }
    }
    let corners = points.iter().zip(&normals).map(|(&at, normal)| Corner {
        position: Point3::from(at),
        normal: normal.try_normalize(0.0).unwrap_or_else(Vector3::z),
        value: f64::NAN,
        parameters: [0.5; 2],
    });
    Sheet {
        corners: corners.collect(),
        triangles,
        edges: false,
    }
}

fn rgb(colour: Colour) -> [f32; 3] {
    [colour.0, colour.1, colour.2].map(|x| f32::from(x) / 255.0)
}

/// The camera moved and widened so that everything is in the picture, with a margin.
fn framed(mut camera: Camera, all: &[Vec<Sheet>], zoom: f64) -> Camera {
    let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for corner in all.iter().flatten().flat_map(|sheet| &sheet.corners) {
        let d = corner.position - camera.centre;
        for (end, axis) in ends.iter_mut().zip(&camera.axes) {
            let x = axis.dot(&d);
            *end = [end[0].min(x), end[1].max(x)];
        }
    }
    for (end, axis) in ends.iter().zip(camera.axes) {
        camera.centre += axis * ((end[0] + end[1]) / 2.0);
    }
    let size = ends.iter().fold(0.0, |most: f64, end| most.max(end[1] - end[0]));
    camera.extent = 1.08 * size.max(f64::MIN_POSITIVE) / zoom;
    camera
}

fn shaded(colour: [f32; 3], light: f64) -> [f32; 3] {
    colour.map(|x| x * light as f32)
}

/// Pictures side by side, each with its caption, at one scale; colours mean the same in all of them, and a
/// bar below says what.
///
/// # Errors
/// Those of [`Surface::at`]; a caption with characters that the font lacks.
pub fn render(subjects: &[(String, Subject<'_>)], settings: &Settings) -> Result<Pixels, Error> {
    if subjects.is_empty() {
        return Err(Error::content("there is no surface to be drawn"));
    }
    let mut all: Vec<Vec<Sheet>> = subjects
        .iter()
        .map(|(_, subject)| subject.sheets(settings))
        .collect::<Result<_, _>>()?;
    let (low, high) = all.iter().flatten().flat_map(|sheet| &sheet.corners).fold(
        (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)),
        |(low, high): (Vector3<f64>, Vector3<f64>), corner| {
            (low.inf(&corner.position.coords), high.sup(&corner.position.coords))
        },
    );
    let centre = Point3::from((low + high) / 2.0);
    let diameter = (high - low).norm();
    let [azimuth, elevation, zoom] = settings.view;
    let camera = framed(Camera::new(azimuth, elevation, centre, 1.0), &all, zoom);
    let light = Camera::new(azimuth + settings.light[0], elevation + settings.light[1], centre, 1.0).axes[2];
    let scale = matches!(settings.show, Show::Gauss | Show::Mean).then(|| scale_of(&all));
    number_stripes(&mut all, settings, &camera, light, diameter);
    let (size, columns) = (settings.size, settings.columns.clamp(1, subjects.len()));
    let rows = subjects.len().div_ceil(columns);
    let bar = if scale.is_some() { BAR } else { 0 };
    let mut page = Pixels::new(size * columns, (size + CAPTION) * rows + bar, Colour(255, 255, 255));
    for (index, ((caption, _), sheets)) in subjects.iter().zip(&all).enumerate() {
        let mut raster = Raster::new(FINER * size, FINER * size, [1.0; 3]);
        for sheet in sheets {
            let shade = shade(settings, camera.axes[2], light, scale.as_ref(), sheet.edges);
            for triangle in &sheet.triangles {
                raster.triangle(&camera, triangle.map(|at| &sheet.corners[at as usize]), &shade);
            }
        }
        let (width, height, rgb) = raster.averaged(FINER);
        let (left, top) = (index % columns * size, index / columns * (size + CAPTION));
        page.put(&Pixels { width, height, rgb }, left, top);
        let caption = caption.replace('$', "");
        // a caption as wide as its picture at most
        let letters = (size as f64 * 1.6 / caption.chars().count().max(1) as f64).min(15.0);
        let baseline = (top + size) as f64 + 22.0;
        page.text(&caption, left as f64 + 10.0, baseline, letters, Colour(40, 40, 40))?;
    }
    if let Some(scale) = &scale {
        draw_bar(&mut page, scale, settings.show)?;
    }
    Ok(page)
}

/// The height of the strip with the colour bar.
const BAR: usize = 44;

/// A labelled bar of the colours, at the lower edge.
fn draw_bar(page: &mut Pixels, scale: &ColourScale, show: Show) -> Result<(), Error> {
    let (width, height) = ((page.width / 2).min(320), 12);
    let mut bar = Pixels::new(width, height, Colour(0, 0, 0));
    for column in 0..width {
        let part = (column as f64 + 0.5) / width as f64;
        let Colour(r, g, b) = scale.colour(scale.range.0 + part * (scale.range.1 - scale.range.0));
        for row in 0..height {
            let at = 3 * (row * width + column);
            bar.rgb[at..at + 3].copy_from_slice(&[r, g, b]);
        }
    }
    let top = page.height - BAR + 4;
    page.put(&bar, 10, top);
    let ink = Colour(40, 40, 40);
    let below = (top + height) as f64 + 15.0;
    for (part, value) in [(0.0, scale.range.0), (0.5, 0.0), (1.0, scale.range.1)] {
        let label = if value == 0.0 {
            "0".to_owned()
        } else {
            format!("{value:.3}")
        };
        // letters are about half as wide as high
        let wide = 7.0 * label.len() as f64;
        let at = (10.0 + part * width as f64 - wide / 2.0).max(4.0);
        page.text(&label, at, below, 13.0, ink)?;
    }
    let words = match show {
        Show::Mean => "mean curvature; black: beyond the bar",
        _ => "Gauss curvature; black: beyond the bar",
    };
    let letters = ((page.width - width) as f64 * 1.5 / words.len() as f64).min(14.0);
    page.text(words, width as f64 + 34.0, top as f64 + 11.0, letters, ink)?;
    Ok(())
}

/// Gives corners the number of their stripe, of which black ones are the first halves.
fn number_stripes(all: &mut [Vec<Sheet>], settings: &Settings, camera: &Camera, light: Vector3<f64>, diameter: f64) {
    let eye = camera.axes[2];
    let lights = Lights {
        origin: camera.centre + eye * diameter,
        direction: camera.axes[1],
        spacing: camera.axes[0] * (diameter / settings.stripes),
    };
    for corner in all.iter_mut().flatten().flat_map(|sheet| &mut sheet.corners) {
        let normal = towards(&corner.normal, &eye);
        corner.value = match settings.show {
            Show::Highlight => lights.highlight(&corner.position, &normal),
            Show::Reflection => lights.reflection(&corner.position, &normal, &eye),
            Show::Isophotes => normal.dot(&light) * settings.stripes * 1.5,
            _ => return,
        };
    }
}

/// A normal on the side of the eye: the inside of an open surface is seen from its back.
fn towards(normal: &Vector3<f64>, eye: &Vector3<f64>) -> Vector3<f64> {
    if normal.dot(eye) < 0.0 { -normal } else { *normal }
}

/// How much of the interval of a width around a number is dark.
fn darkness(number: f64, width: f64) -> f64 {
    if !(number.is_finite() && width.is_finite()) || width > 1e3 {
        return 0.5;
    }
    let width = width.max(1e-9);
    // the dark part of everything below a number
    let below = |x: f64| 0.5 * x.floor() + (x - x.floor()).min(0.5);
    ((below(number + width / 2.0) - below(number - width / 2.0)) / width).clamp(0.0, 1.0)
}

/// The colours of all pictures: of 40 values 39 lie within.
fn scale_of(all: &[Vec<Sheet>]) -> ColourScale {
    let corners = all.iter().flatten().flat_map(|sheet| &sheet.corners);
    let mut sizes: Vec<f64> = corners
        .map(|corner| corner.value.abs())
        .filter(|x| x.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let largest = sizes
        .get(sizes.len() * 39 / 40)
        .copied()
        .filter(|x| *x > 0.0)
        .unwrap_or(1.0);
    ColourScale::signed(largest, "")
}

fn shade<'a>(
    settings: &'a Settings,
    eye: Vector3<f64>,
    light: Vector3<f64>,
    scale: Option<&'a ColourScale>,
    edges: bool,
) -> impl Fn(&Corner, f64) -> [f32; 3] + 'a {
    move |corner: &Corner, slope: f64| {
        let normal = towards(&corner.normal, &eye);
        let diffuse = 0.25 + 0.75 * normal.dot(&light).max(0.0);
        let clay = [0.78, 0.77, 0.74];
        let ink = [0.1, 0.15, 0.3];
        if edges {
            return shaded(if corner.parameters[1] < 0.06 { ink } else { clay }, diffuse);
        }
        match settings.show {
            Show::Shaded => shaded(clay, diffuse),
            Show::Wireframe => {
                let near = |x: f64, step: f64, width: f64| {
                    let away = (x / step - (x / step).round()).abs() * step;
                    away < width
                };
                let [s, t] = corner.parameters;
                let edge = near(s, 1.0, 0.02) || near(t, 1.0, 0.02);
                let fine = near(s, 0.25, 0.008) || near(t, 0.25, 0.008);
                let base = if edge {
                    ink
                } else if fine {
                    [0.5, 0.52, 0.58]
                } else {
                    clay
                };
                shaded(base, diffuse)
            }
            Show::Gauss | Show::Mean => match scale {
                Some(scale) if corner.value.abs() <= scale.range.1 => {
                    shaded(rgb(scale.colour(corner.value)), 0.55 + 0.45 * diffuse)
                }
                _ => shaded([0.12; 3], 0.4 + 0.6 * diffuse),
            },
            Show::Highlight | Show::Reflection | Show::Isophotes => {
                let dark = darkness(corner.value, slope) as f32;
                let (ink, paper) = ([0.15, 0.2, 0.3], [0.93, 0.93, 0.9]);
                let mixed = [0, 1, 2].map(|k| dark * ink[k] + (1.0 - dark) * paper[k]);
                shaded(mixed, 0.6 + 0.4 * diffuse)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stripes_fade_where_they_are_narrow() {
        // a quotient of differences, which loses digits where the pixel is small
        assert!((darkness(0.25, 1e-6) - 1.0).abs() < 1e-9);
        assert_eq!(darkness(7.75, 0.1), 0.0);
        assert!((darkness(3.0, 0.2) - 0.5).abs() < 1e-12 && (darkness(0.3, 20.0) - 0.5).abs() < 0.03);
        assert_eq!(darkness(f64::NAN, 0.1), 0.5);
    }
}
