//! Triangles on pixels: orthographic projection with a depth buffer.

use nalgebra::{Point3, Vector3};

/// Where a scene is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// To the right, upwards, and towards the eye, each of unit length.
    pub axes: [Vector3<f64>; 3],
    /// What is in the middle of the picture.
    pub centre: Point3<f64>,
    /// Length units that fill the smaller side of the picture.
    pub extent: f64,
}

impl Camera {
    /// A camera from azimuth and elevation in degrees, around the upward direction z.
    pub fn new(azimuth: f64, elevation: f64, centre: Point3<f64>, extent: f64) -> Self {
        let ((sa, ca), (se, ce)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
        Camera {
            axes: [
                Vector3::new(-sa, ca, 0.0),
                Vector3::new(-se * ca, -se * sa, ce),
                Vector3::new(ce * ca, ce * sa, se),
            ],
            centre,
            extent,
        }
    }
}

/// A point of a triangle with what shading needs.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// The point.
    pub position: Point3<f64>,
    /// The unit normal.
    pub normal: Vector3<f64>,
    /// Any value, such as a curvature.
    pub value: f64,
    /// Parameters on the face.
    pub parameters: [f64; 2],
}

/// A picture in the making.
#[derive(Clone, Debug)]
pub struct Raster {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green, blue between 0 and 1, row by row from the top.
    pub colours: Vec<[f32; 3]>,
    depths: Vec<f64>,
}

impl Raster {
    /// An empty picture.
    pub fn new(width: usize, height: usize, background: [f32; 3]) -> Self {
        Raster {
            width,
            height,
            colours: vec![background; width * height],
            depths: vec![f64::NEG_INFINITY; width * height],
        }
    }

    /// Draws a triangle where nothing nearer is; `shade` gives the colour of a point, also from how much its
    /// value changes from one pixel to the next.
    pub fn triangle(&mut self, camera: &Camera, corners: [&Corner; 3], shade: &dyn Fn(&Corner, f64) -> [f32; 3]) {
        let scale = self.width.min(self.height) as f64 / camera.extent;
        let seen = corners.map(|corner| {
            let d = corner.position - camera.centre;
            let [x, y, z] = camera.axes.map(|axis| axis.dot(&d));
            [
                self.width as f64 / 2.0 + scale * x,
                self.height as f64 / 2.0 - scale * y,
                z,
            ]
        });
        let [a, b, c] = seen;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if !(area.abs() > 1e-12) {
            return;
        }
        let [va, vb, vc] = corners.map(|corner| corner.value);
        let slope_x = ((vb - va) * (c[1] - a[1]) - (vc - va) * (b[1] - a[1])) / area;
        let slope_y = ((vc - va) * (b[0] - a[0]) - (vb - va) * (c[0] - a[0])) / area;
        let slope = slope_x.abs() + slope_y.abs();
        let range = |k: usize, most: usize| {
            let (low, high) = seen.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                (low.min(p[k]), high.max(p[k]))
            });
            (low.floor().max(0.0) as usize)..(high.ceil().min(most as f64).max(0.0) as usize)
        };
        let (columns, rows) = (range(0, self.width), range(1, self.height));
        for row in rows {
            for column in columns.clone() {
                let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
                let u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area;
                let v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area;
                let w = 1.0 - u - v;
                // neighbours overlap by a hair, so that no pixel between them stays empty
                if u < -1e-9 || v < -1e-9 || w < -1e-9 {
                    continue;
                }
                let depth = u * a[2] + v * b[2] + w * c[2];
                let at = row * self.width + column;
                if depth <= self.depths[at] {
                    continue;
                }
                self.depths[at] = depth;
                let mixed = |f: &dyn Fn(&Corner) -> f64| u * f(corners[0]) + v * f(corners[1]) + w * f(corners[2]);
                let normal = corners[0].normal * u + corners[1].normal * v + corners[2].normal * w;
                let here = Corner {
                    position: Point3::from(
                        corners[0].position.coords * u
                            + corners[1].position.coords * v
                            + corners[2].position.coords * w,
                    ),
                    normal: normal.try_normalize(0.0).unwrap_or(normal),
                    value: mixed(&|corner| corner.value),
                    parameters: [
                        mixed(&|corner| corner.parameters[0]),
                        mixed(&|corner| corner.parameters[1]),
                    ],
                };
                self.colours[at] = shade(&here, slope);
            }
        }
    }

    /// The picture with squares of `n x n` pixels averaged, in bytes.
    pub fn averaged(&self, n: usize) -> (usize, usize, Vec<u8>) {
        let (width, height) = (self.width / n, self.height / n);
        let mut bytes = Vec::with_capacity(3 * width * height);
        for row in 0..height {
            for column in 0..width {
                let mut sum = [0.0_f32; 3];
                for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
                    let colour = self.colours[(row * n + j) * self.width + column * n + i];
                    (0..3).for_each(|k| sum[k] += colour[k]);
                }
                bytes.extend(sum.map(|x| (255.0 * x / (n * n) as f32).round().clamp(0.0, 255.0) as u8));
            }
        }
        (width, height, bytes)
    }
}
