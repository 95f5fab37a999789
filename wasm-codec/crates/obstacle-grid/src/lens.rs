use wide::f32x4;

use crate::SensorPose;

/// A pinhole camera: pixel (u, v) sees along ((u − cx) / fx, (v − cy) / fy, 1).
#[derive(Clone, Debug)]
pub struct Lens {
    width: usize,
    /// Four columns each; those beyond the width see nothing.
    columns: Vec<f32x4>,
    rows: Vec<f32>,
}

impl Lens {
    /// `None` where there is no camera with such numbers, or it has more than 2²⁴ pixels.
    #[must_use]
    pub fn new(width: usize, height: usize, [fx, fy, cx, cy]: [f64; 4]) -> Option<Self> {
        let pixels = width.checked_mul(height)?;
        if pixels == 0 || pixels > 1 << 24 {
            return None;
        }
        let rays = |count: usize, focal: f64, centre: f64| -> Vec<f32> {
            (0..count).map(|i| ((i as f64 - centre) / focal) as f32).collect()
        };
        let (mut columns, rows) = (rays(width, fx, cx), rays(height, fy, cy));
        if !columns.iter().chain(&rows).all(|ray| ray.is_finite()) {
            return None;
        }
        columns.resize(width.next_multiple_of(4), f32::NAN);
        let columns = columns.as_chunks::<4>().0.iter().map(|four| f32x4::from(*four)).collect();
        Some(Self { width, columns, rows })
    }

    /// How many pixels there are.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width * self.rows.len()
    }

    /// Pixels of a row.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    pub(crate) fn columns(&self) -> &[f32x4] {
        &self.columns
    }

    pub(crate) fn rows(&self) -> &[f32] {
        &self.rows
    }

    /// What the camera has in view from there.
    pub(crate) fn view_from(&self, pose: &SensorPose) -> View {
        let column = |i: usize| self.columns[i / 4].to_array()[i % 4];
        let (left, right) = (column(0), column(self.width - 1));
        let (top, bottom) = (self.rows[0], self.rows[self.rows.len() - 1]);
        let sides = [
            [1.0, 0.0, -left.min(right)],
            [-1.0, 0.0, left.max(right)],
            [0.0, 1.0, -top.min(bottom)],
            [0.0, -1.0, top.max(bottom)],
            [0.0, 0.0, 1.0],
        ];
        let r = &pose.rotation;
        let turned = |[x, y, z]: [f32; 3]| [0, 3, 6].map(|row| r[row] * x + r[row + 1] * y + r[row + 2] * z);
        View { inwards: sides.map(turned), position: pose.position }
    }
}

/// The space that a camera has in view: inside of all of its sides.
pub(crate) struct View {
    inwards: [[f32; 3]; 5],
    position: [f32; 3],
}

impl View {
    /// The lowest and the highest point in view over a place on the floor, metres; the lowest is higher if there is none.
    pub(crate) fn over(&self, x: f32, y: f32) -> [f32; 2] {
        let [dx, dy] = [x - self.position[0], y - self.position[1]];
        let (mut low, mut high) = (f32::NEG_INFINITY, f32::INFINITY);
        for [nx, ny, nz] in self.inwards {
            let on = nx * dx + ny * dy;
            if nz.abs() < 1e-6 {
                if on < 0.0 {
                    return [f32::INFINITY, f32::NEG_INFINITY];
                }
                continue;
            }
            let at = self.position[2] - on / nz;
            if nz > 0.0 { low = low.max(at) } else { high = high.min(at) }
        }
        [low, high]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_is_no_camera() {
        assert_eq!(Lens::new(5, 3, [2.0, 2.0, 2.0, 1.0]).unwrap().pixels(), 15);
        assert!(Lens::new(0, 3, [2.0, 2.0, 2.0, 1.0]).is_none());
        assert!(Lens::new(5, 3, [0.0, 2.0, 2.0, 1.0]).is_none());
        assert!(Lens::new(5, 3, [2.0, 2.0, f64::NAN, 1.0]).is_none());
        assert!(Lens::new(usize::MAX, 2, [2.0, 2.0, 2.0, 1.0]).is_none());
    }

    #[test]
    fn has_in_view_what_its_pixels_look_at() {
        // 45° to each side, 1 m high, level, looking along x.
        let lens = Lens::new(101, 101, [50.0, 50.0, 50.0, 50.0]).unwrap();
        let ahead = [0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0];
        let view = lens.view_from(&SensorPose::new(ahead, [0.0, 0.0, 1.0]).unwrap());
        let near = |[low, high]: [f32; 2], expected: [f32; 2]| {
            assert!((low - expected[0]).abs() < 1e-4 && (high - expected[1]).abs() < 1e-4, "{low} {high}");
        };
        near(view.over(0.5, 0.0), [0.5, 1.5]);
        near(view.over(2.0, 1.9), [-1.0, 3.0]);
        let [low, high] = view.over(2.0, 2.1);
        assert!(low > high);
        let [low, high] = view.over(-1.0, 0.0);
        assert!(low > high);
    }
}
