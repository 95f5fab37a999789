//! The camera's pinhole grid: what a frame must lie on, and how it is found where a source does not tell.

use crate::Point;

/// A pinhole camera: pixel (u, v) sees along ((u − cx) / fx, (v − cy) / fy, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intrinsics {
    /// Focal length across, pixels.
    pub fx: f32,
    /// Focal length down, pixels.
    pub fy: f32,
    /// Column of the optical axis.
    pub cx: f32,
    /// Row of the optical axis.
    pub cy: f32,
}

impl Intrinsics {
    /// True where the focal lengths are positive and nothing is beyond reason.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let focal = |focal: f32| (1.0..=1e6).contains(&focal);
        focal(self.fx) && focal(self.fy) && self.cx.abs() <= 1e6 && self.cy.abs() <= 1e6
    }

    /// The x of each column's pixels at 1 m.
    pub fn columns(&self, width: usize) -> impl Iterator<Item = f32> + use<> {
        let (f, c) = (f64::from(self.fx), f64::from(self.cx));
        (0..width).map(move |u| ((u as f64 - c) / f) as f32)
    }

    /// The y of each row's pixels at 1 m.
    pub fn rows(&self, height: usize) -> impl Iterator<Item = f32> + use<> {
        let (f, c) = (f64::from(self.fy), f64::from(self.cy));
        (0..height).map(move |v| ((v as f64 - c) / f) as f32)
    }
}

/// Why a frame is not taken for a depth camera's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Misfit {
    /// A single row or column, or not `width` × `height` points.
    Shape,
    /// Too few valid points to tell, or all in one column or row.
    TooFew,
    /// The points give a focal length that no camera has.
    Focal,
    /// A point lies beside its pixel's ray, by so many pixels; the worst one.
    OffGrid {
        /// Pixels.
        pixels: f32,
    },
}

/// Farther beside its ray than this no point may lie: pixels, and 1 mm for sources that round their coordinates.
const TOLERANCE_PIXELS: f32 = 0.1;
const TOLERANCE_METRES: f32 = 0.001;

fn is_seen(point: &Point) -> bool {
    let [x, y, z, _] = *point;
    z > 0.0 && z < f32::INFINITY && x.is_finite() && y.is_finite()
}

/// Whether every valid point of a frame lies on its pixel's ray.
///
/// # Errors
/// `Shape`, `TooFew` where there is no valid point, `OffGrid`.
pub fn check_grid(points: &[Point], width: usize, height: usize, camera: &Intrinsics) -> Result<(), Misfit> {
    if width < 2 || height < 2 || points.len() != width * height {
        return Err(Misfit::Shape);
    }
    let columns: Vec<f32> = camera.columns(width).collect();
    let mut worst = 0.0_f32;
    let mut seen = 0_usize;
    for (row, ray_y) in points.chunks_exact(width).zip(camera.rows(height)) {
        for (point, ray_x) in row.iter().zip(&columns) {
            if !is_seen(point) {
                continue;
            }
            seen += 1;
            let [x, y, z, _] = *point;
            let beside = |off: f32, focal: f32| ((off.abs() - TOLERANCE_METRES) / z * focal).max(0.0);
            worst = worst.max(beside(x - ray_x * z, camera.fx)).max(beside(y - ray_y * z, camera.fy));
        }
    }
    match seen {
        0 => Err(Misfit::TooFew),
        _ if worst > TOLERANCE_PIXELS => Err(Misfit::OffGrid { pixels: worst }),
        _ => Ok(()),
    }
}

/// The camera that fits a frame's points best: least squares of x/z over columns and y/z over rows, weighted by depth (a
/// rounded coordinate misplaces near points more), a second time without the points that lie far from the first line. Then
/// as [`check_grid`].
///
/// # Errors
/// See [`Misfit`].
pub fn estimate_intrinsics(points: &[Point], width: usize, height: usize) -> Result<Intrinsics, Misfit> {
    if width < 2 || height < 2 || points.len() != width * height {
        return Err(Misfit::Shape);
    }
    let across = fit(points, |i| i % width, 0)?;
    let down = fit(points, |i| i / width, 1)?;
    let camera = Intrinsics { fx: across.0, fy: down.0, cx: across.1, cy: down.1 };
    if !camera.is_valid() {
        return Err(Misfit::Focal);
    }
    check_grid(points, width, height, &camera)?;
    Ok(camera)
}

/// Focal length and centre along one axis.
fn fit(points: &[Point], pixel: impl Fn(usize) -> usize, axis: usize) -> Result<(f32, f32), Misfit> {
    const LEAST: usize = 16;
    let mut line: Option<(f64, f64)> = None;
    let mut limit = f64::INFINITY;
    for _ in 0..3 {
        let [mut w, mut u, mut r, mut uu, mut ur] = [0.0_f64; 5];
        let mut count = 0_usize;
        for (i, point) in points.iter().enumerate().filter(|(_, point)| is_seen(point)) {
            let (at, ray) = (pixel(i) as f64, f64::from(point[axis]) / f64::from(point[2]));
            if let Some((slope, start)) = line
                && beside(ray, at, slope, start) > limit
            {
                continue;
            }
            let weight = f64::from(point[2].min(10.0)).powi(2);
            count += 1;
            w += weight;
            u += weight * at;
            r += weight * ray;
            uu += weight * at * at;
            ur += weight * at * ray;
        }
        let spread = w * uu - u * u;
        if count < LEAST || spread <= 1e-9 * w * uu {
            return Err(Misfit::TooFew);
        }
        let slope = (w * ur - u * r) / spread;
        let start = (r - slope * u) / w;
        line = Some((slope, start));
        // Three times the mean distance of those that were fitted.
        let (mut sum, mut count) = (0.0, 0.0);
        for (i, point) in points.iter().enumerate().filter(|(_, point)| is_seen(point)) {
            let off = beside(f64::from(point[axis]) / f64::from(point[2]), pixel(i) as f64, slope, start);
            if off <= limit {
                sum += off;
                count += 1.0;
            }
        }
        limit = 3.0 * sum / f64::max(count, 1.0) + 1e-6;
    }
    let Some((slope, start)) = line else { return Err(Misfit::TooFew) };
    if slope.is_nan() || slope <= 1e-7 {
        return Err(Misfit::Focal);
    }
    Ok(((1.0 / slope) as f32, (-start / slope) as f32))
}

/// Pixels between a point and the line.
fn beside(ray: f64, at: f64, slope: f64, start: f64) -> f64 {
    (ray - slope * at - start).abs() / slope.abs().max(1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Intrinsics = Intrinsics { fx: 525.0, fy: 520.0, cx: 31.0, cy: 22.5 };

    fn frame(width: usize, height: usize) -> Vec<Point> {
        let columns: Vec<f32> = CAMERA.columns(width).collect();
        let rows: Vec<f32> = CAMERA.rows(height).collect();
        (0..width * height)
            .map(|i| {
                let z = 0.6 + (i % 37) as f32 * 0.05 + (i % 11) as f32 * 0.2;
                if i % 7 == 0 { [f32::NAN; 4] } else { [columns[i % width] * z, rows[i / width] * z, z, 0.0] }
            })
            .collect()
    }

    #[test]
    fn the_camera_is_found_and_its_frames_lie_on_its_grid() {
        let points = frame(64, 48);
        let found = estimate_intrinsics(&points, 64, 48).expect("a camera");
        assert!((found.fx - CAMERA.fx).abs() < 0.01 && (found.fy - CAMERA.fy).abs() < 0.01, "{found:?}");
        assert!((found.cx - CAMERA.cx).abs() < 0.01 && (found.cy - CAMERA.cy).abs() < 0.01, "{found:?}");
        assert_eq!(check_grid(&points, 64, 48, &CAMERA), Ok(()));
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let mut points = frame(64, 48);
        assert_eq!(estimate_intrinsics(&points, 64 * 48, 1), Err(Misfit::Shape));
        assert_eq!(estimate_intrinsics(&points, 64, 47), Err(Misfit::Shape));
        // One point out of its place; the camera is still found by the others.
        points[1000][0] += 0.02;
        let Err(Misfit::OffGrid { pixels }) = estimate_intrinsics(&points, 64, 48) else {
            panic!("on the grid")
        };
        assert!(pixels > 1.0 && pixels < 40.0, "{pixels}");
        assert!(matches!(check_grid(&points, 64, 48, &CAMERA), Err(Misfit::OffGrid { .. })));
        for point in &mut points {
            point[2] = -1.0;
        }
        assert_eq!(estimate_intrinsics(&points, 64, 48), Err(Misfit::TooFew));
        // A scanner's sweep: x and y do not follow the pixel.
        let sweep: Vec<Point> = (0..64 * 48)
            .map(|i| {
                let (s, c) = (i as f32 * 0.37).sin_cos();
                [s * 3.0, c * 3.0, 1.0 + (i % 5) as f32, 0.0]
            })
            .collect();
        assert!(estimate_intrinsics(&sweep, 64, 48).is_err());
    }
}
