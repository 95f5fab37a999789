/// How a cloud is judged. Lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Cells along a side; an even number from 2 to 1024.
    pub side: usize,
    /// Length of a cell.
    pub cell: f32,
    /// What is lower than this is floor.
    pub clearance: f32,
    /// What is higher than this is passed under.
    pub height: f32,
    /// What is lower than this below the floor is no floor.
    pub drop: f32,
    /// How much wider the floor's band becomes with each metre of distance.
    pub slope: f32,
    /// A ray that passes no higher than this over a cell shows that it is free.
    pub low_ray: f32,
    /// How many points make an obstacle at one metre. Fewer do at a distance, by its square.
    pub near_points: f32,
    /// How many points make an obstacle at any distance.
    pub least_points: f32,
    /// An obstacle counts once a second cloud has it in the same or a neighbouring cell.
    pub confirm: bool,
}

impl Settings {
    /// Whether a grid can be made with them.
    #[must_use]
    pub fn are_valid(&self) -> bool {
        let lengths = [self.height, self.drop, self.low_ray];
        (2..=1024).contains(&self.side)
            && self.side.is_multiple_of(2)
            && self.cell.is_finite()
            && self.cell >= 0.001
            && lengths.iter().all(|length| length.is_finite() && *length > 0.0)
            && (0.0..self.height).contains(&self.clearance)
            && (0.0..=1.0).contains(&self.slope)
            && self.least_points >= 1.0
            && self.near_points >= self.least_points
            && self.near_points.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Settings = Settings {
        side: 160,
        cell: 0.05,
        clearance: 0.04,
        height: 1.1,
        drop: 0.15,
        slope: 0.01,
        low_ray: 0.15,
        near_points: 10.0,
        least_points: 2.0,
        confirm: false,
    };

    #[test]
    fn refuses_what_makes_no_grid() {
        assert!(GOOD.are_valid());
        let bad = [
            Settings { side: 0, ..GOOD },
            Settings { side: 161, ..GOOD },
            Settings { side: 2000, ..GOOD },
            Settings { cell: f32::NAN, ..GOOD },
            Settings { cell: 0.0, ..GOOD },
            Settings { clearance: 2.0, ..GOOD },
            Settings { clearance: f32::NAN, ..GOOD },
            Settings { height: f32::INFINITY, ..GOOD },
            Settings { drop: 0.0, ..GOOD },
            Settings { slope: -1.0, ..GOOD },
            Settings { least_points: 0.0, ..GOOD },
            Settings { near_points: 1.0, ..GOOD },
            Settings { near_points: f32::INFINITY, ..GOOD },
        ];
        for settings in bad {
            assert!(!settings.are_valid(), "{settings:?}");
        }
    }
}
