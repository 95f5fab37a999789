/// Where a sensor is in the grid's frame: a point p of its optical frame is at `rotation` · p + `position`.
#[derive(Clone, Copy, Debug)]
pub struct SensorPose {
    /// Row by row.
    pub rotation: [f32; 9],
    /// Metres.
    pub position: [f32; 3],
}

impl SensorPose {
    /// `None` where a number is not finite, or the matrix turns nothing.
    #[must_use]
    pub fn new(rotation: [f32; 9], position: [f32; 3]) -> Option<Self> {
        let finite = rotation.iter().chain(&position).all(|number| number.is_finite());
        let unit = rotation
            .chunks_exact(3)
            .all(|row| (row.iter().map(|number| number * number).sum::<f32>() - 1.0).abs() < 0.02);
        (finite && unit).then_some(Self { rotation, position })
    }
}
