//! Rigid transforms as twelve numbers: a rotation matrix, row by row, then a translation.

use crate::scene::dot;

pub const POSE_LENGTH: usize = 12;

/// Takes a point of the child frame to the parent frame: `rotation · point + translation`.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    pub rotation: [[f64; 3]; 3],
    pub translation: [f64; 3],
}

impl Pose {
    /// Panics when `numbers` has fewer than twelve elements.
    pub fn read(numbers: &[f64]) -> Self {
        let n = &numbers[..POSE_LENGTH];
        Self {
            rotation: [[n[0], n[1], n[2]], [n[3], n[4], n[5]], [n[6], n[7], n[8]]],
            translation: [n[9], n[10], n[11]],
        }
    }

    pub fn rotate(&self, v: [f64; 3]) -> [f64; 3] {
        self.rotation.map(|row| dot(row, v))
    }

    pub fn apply(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = self.rotate(point);
        core::array::from_fn(|i| turned[i] + self.translation[i])
    }

    pub fn inverse(&self) -> Self {
        let r = &self.rotation;
        let rotation: [[f64; 3]; 3] = core::array::from_fn(|i| [r[0][i], r[1][i], r[2][i]]);
        let translation = rotation.map(|row| -dot(row, self.translation));
        Self { rotation, translation }
    }

    /// First `inner`, then `self`.
    pub fn after(&self, inner: &Self) -> Self {
        let column = |i: usize| [inner.rotation[0][i], inner.rotation[1][i], inner.rotation[2][i]];
        let rotation = self.rotation.map(|row| core::array::from_fn(|i| dot(row, column(i))));
        Self { rotation, translation: self.apply(inner.translation) }
    }
}
