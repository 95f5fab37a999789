//! The camera's pinhole grid.

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
