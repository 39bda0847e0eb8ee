//! Pictures of surfaces, pixel by pixel, several schemes side by side.
//!
//! Each face is sampled on a grid about as fine as the pixels, with exact normals and curvatures; colours are
//! found at every pixel of a picture three times as fine and averaged.

use crate::error::Error;
use eigenring_figure::{Colour, ColourScale, Pixels};
use eigenring_surface::lines::Lights;
use eigenring_surface::raster::{Camera, Corner, Raster};
use eigenring_surface::{Place, Point3, Surface, Vector3};
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
}

/// Pixels are averaged over squares of so many.
const FINER: usize = 3;
const CAPTION: usize = 34;

/// Samples of one face, a grid of `n + 1` points a side.
struct Patch {
    n: usize,
    corners: Vec<Corner>,
}

fn turned(v: Vector3<f64>, y_up: bool) -> Vector3<f64> {
    // z forwards becomes -y, so that what looks towards z looks at the eye
    if y_up { Vector3::new(v.z, v.x, v.y) } else { v }
}

/// The samples of all faces, and for each the value that is shown.
fn patches(surface: &Surface<'_>, settings: &Settings, n: usize) -> Result<Vec<Patch>, Error> {
    let control = surface.control();
    let pieces: Vec<(u32, u32)> = control
        .faces()
        .enumerate()
        .flat_map(|(face, corners)| {
            let subs = if corners.len() == 4 { 1 } else { corners.len() };
            (0..subs).map(move |sub| (face as u32, sub as u32))
        })
        .collect();
    let found: Result<Vec<Patch>, eigenring_surface::Error> = pieces
        .par_iter()
        .map(|&(face, sub)| {
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
            Ok(Patch { n, corners })
        })
        .collect();
    Ok(found?)
}

fn rgb(colour: Colour) -> [f32; 3] {
    [colour.0, colour.1, colour.2].map(|x| f32::from(x) / 255.0)
}

/// The camera moved and widened so that everything is in the picture, with a margin.
fn framed(mut camera: Camera, all: &[Vec<Patch>], zoom: f64) -> Camera {
    let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for corner in all.iter().flatten().flat_map(|patch| &patch.corners) {
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

/// Pictures of surfaces in a row, each with its caption; colours mean the same in all of them.
///
/// # Errors
/// Those of [`Surface::at`]; a caption with characters that the font lacks.
pub fn render(surfaces: &[(String, Surface<'_>)], settings: &Settings) -> Result<Pixels, Error> {
    let Some((_, first)) = surfaces.first() else {
        return Err(Error::content("there is no surface to be drawn"));
    };
    let faces: usize = first
        .control()
        .faces()
        .map(|f| if f.len() == 4 { 1 } else { f.len() })
        .sum();
    // a face covers about size^2/faces pixels; two samples for each of three pixels in a row
    let n = (2.0 * settings.size as f64 / (faces as f64).sqrt()).clamp(6.0, 160.0) as usize;
    let all: Vec<Vec<Patch>> = surfaces
        .iter()
        .map(|(_, surface)| patches(surface, settings, n))
        .collect::<Result<_, _>>()?;
    let (low, high) = all.iter().flatten().flat_map(|patch| &patch.corners).fold(
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
    let scale = scale_of(&all);
    let mut page = Pixels::new(
        settings.size * surfaces.len(),
        settings.size + CAPTION,
        Colour(255, 255, 255),
    );
    for (index, ((name, _), patches)) in surfaces.iter().zip(&all).enumerate() {
        let mut raster = Raster::new(FINER * settings.size, FINER * settings.size, [1.0; 3]);
        let shade = shade(settings, &camera, light, diameter, &scale);
        for patch in patches {
            let at = |i: usize, j: usize| &patch.corners[j * (patch.n + 1) + i];
            for (j, i) in (0..patch.n).flat_map(|j| (0..patch.n).map(move |i| (j, i))) {
                raster.triangle(&camera, [at(i, j), at(i + 1, j), at(i + 1, j + 1)], &shade);
                raster.triangle(&camera, [at(i, j), at(i + 1, j + 1), at(i, j + 1)], &shade);
            }
        }
        let (width, height, rgb) = raster.averaged(FINER);
        page.put(&Pixels { width, height, rgb }, index * settings.size, 0);
        let range = match settings.show {
            Show::Gauss => format!(
                ", K from {:.3} (blue) to {:.3} (red), beyond: black",
                -scale.range.1, scale.range.1
            ),
            Show::Mean => format!(
                ", H from {:.3} (blue) to {:.3} (red), beyond: black",
                -scale.range.1, scale.range.1
            ),
            _ => String::new(),
        };
        let caption = format!("{name}{range}").replace('$', "");
        let baseline = settings.size as f64 + 22.0;
        // a caption as wide as its picture at most
        let size = (settings.size as f64 * 1.6 / caption.chars().count().max(1) as f64).min(15.0);
        page.text(
            &caption,
            (index * settings.size) as f64 + 10.0,
            baseline,
            size,
            Colour(40, 40, 40),
        )?;
    }
    Ok(page)
}

/// The colours of all pictures: nine tenths of all values lie within.
fn scale_of(all: &[Vec<Patch>]) -> ColourScale {
    let corners = all.iter().flatten().flat_map(|patch| &patch.corners);
    let mut sizes: Vec<f64> = corners
        .map(|corner| corner.value.abs())
        .filter(|x| x.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let largest = sizes
        .get(sizes.len() * 9 / 10)
        .copied()
        .filter(|x| *x > 0.0)
        .unwrap_or(1.0);
    ColourScale::signed(largest, "")
}

fn shade<'a>(
    settings: &'a Settings,
    camera: &'a Camera,
    light: Vector3<f64>,
    diameter: f64,
    scale: &'a ColourScale,
) -> impl Fn(&Corner) -> [f32; 3] + 'a {
    let lights = Lights {
        origin: camera.centre + camera.axes[2] * diameter,
        direction: camera.axes[1],
        spacing: camera.axes[0] * (diameter / settings.stripes),
    };
    move |corner: &Corner| {
        let eye = camera.axes[2];
        // the inside of an open surface is seen from its back
        let normal = if corner.normal.dot(&eye) < 0.0 {
            -corner.normal
        } else {
            corner.normal
        };
        let diffuse = 0.25 + 0.75 * normal.dot(&light).max(0.0);
        let striped = |c: f64| {
            let dark = c.is_finite() && c.rem_euclid(1.0) < 0.5;
            let base = if dark { [0.15, 0.2, 0.3] } else { [0.93, 0.93, 0.9] };
            shaded(base, 0.6 + 0.4 * diffuse)
        };
        let clay = [0.78, 0.77, 0.74];
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
                    [0.1, 0.15, 0.3]
                } else if fine {
                    [0.5, 0.52, 0.58]
                } else {
                    clay
                };
                shaded(base, diffuse)
            }
            Show::Gauss | Show::Mean => {
                if corner.value.abs() > scale.range.1 {
                    return shaded([0.12; 3], 0.4 + 0.6 * diffuse);
                }
                shaded(rgb(scale.colour(corner.value)), 0.55 + 0.45 * diffuse)
            }
            Show::Highlight => striped(lights.highlight(&corner.position, &normal)),
            Show::Reflection => striped(lights.reflection(&corner.position, &normal, &eye)),
            Show::Isophotes => striped(normal.dot(&light) * settings.stripes / 2.0),
        }
    }
}
