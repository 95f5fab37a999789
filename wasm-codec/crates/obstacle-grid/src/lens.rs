use wide::f32x4;

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
}
