use wide::f32x4;

use crate::bins::{Bins, Rule, valid_depths, valid_ranges};
use crate::lens::View;
use crate::{Class, Lens, Point, SensorPose, Settings};

/// Heights are told in steps of so much, metres.
pub const HEIGHT_STEP: f32 = 0.02;
/// So much of an obstacle's lowest part must be seen to be gone, metres, or all of one that is lower.
const LOWEST_PART: f32 = 0.2;

/// How many cells a cloud left in each class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// Free cells.
    pub free: u32,
    /// Occupied cells.
    pub occupied: u32,
    /// Cells without a floor.
    pub drop_offs: u32,
}

/// The grid. Cell (i, j) is at `classes()[j * side + i]` and begins at x = (i − side / 2) · cell, y = (j − side / 2) ·
/// cell.
pub struct ObstacleGrid {
    settings: Settings,
    bins: Bins,
    classes: Vec<u8>,
    heights: Vec<u8>,
    /// Where the last cloud had enough points for an obstacle, confirmed or not, and the one before it.
    candidates: Vec<u8>,
    before: Vec<u8>,
    first: bool,
}

impl ObstacleGrid {
    /// `None` where the settings are not valid.
    #[must_use]
    pub fn new(settings: Settings) -> Option<Self> {
        let cells = settings.side * settings.side;
        settings.are_valid().then(|| Self {
            settings,
            bins: Bins::new(settings.side),
            classes: vec![0; cells],
            heights: vec![0; cells],
            candidates: vec![0; cells],
            before: vec![0; cells],
            first: true,
        })
    }

    /// The class of each cell, as numbers.
    #[must_use]
    pub fn classes(&self) -> &[u8] {
        &self.classes
    }

    /// In steps of [`HEIGHT_STEP`]. Of an occupied cell: up to where it must be seen to be empty, from the floor on, before
    /// its obstacle is gone. Of a free cell: up to where it was in view. An obstacle whose top is all that was seen does not
    /// go away because the camera sees the floor below it.
    #[must_use]
    pub fn heights(&self) -> &[u8] {
        &self.heights
    }

    /// Judges a depth camera's image: metres along the optical axis, row by row. Pixels without depth are 0, negative or
    /// not finite. `shift`: by how many cells the grid has moved along x and y since the last cloud.
    ///
    /// # Panics
    /// If the image is not as large as the lens says.
    pub fn look_at_image(&mut self, depth: &[f32], lens: &Lens, pose: &SensorPose, shift: [i32; 2]) -> Seen {
        assert_eq!(depth.len(), lens.pixels());
        self.bins.clear();
        let rule = Rule::new(&self.settings, pose);
        let [r00, r01, r02, r10, r11, r12, r20, r21, r22] = pose.rotation;
        let position = pose.position.map(f32x4::splat);
        let across = [r00, r10, r20].map(f32x4::splat);
        for (row, line) in lens.rows().iter().zip(depth.chunks_exact(lens.width())) {
            let ahead = [r01 * row + r02, r11 * row + r12, r21 * row + r22].map(f32x4::splat);
            let (fours, rest) = line.as_chunks::<4>();
            let mut last = [0.0; 4];
            last[..rest.len()].copy_from_slice(rest);
            let fours = fours.iter().chain((!rest.is_empty()).then_some(&last));
            for (four, column) in fours.zip(lens.columns()) {
                let z = f32x4::from(*four);
                let on = |axis: usize| (across[axis] * *column + ahead[axis]) * z + position[axis];
                let height = on(2);
                let low = rule.low_enough(height, valid_depths(z));
                if low.to_bitmask() != 0 {
                    self.bins.add(&rule, [on(0), on(1), height], low);
                }
            }
        }
        self.judge(Some(&lens.view_from(pose)), pose, shift)
    }

    /// Judges a cloud of points.
    pub fn look_at_points(&mut self, points: &[Point], pose: &SensorPose, shift: [i32; 2]) -> Seen {
        self.bins.clear();
        let rule = Rule::new(&self.settings, pose);
        let turn = pose.rotation.map(f32x4::splat);
        let position = pose.position.map(f32x4::splat);
        let (fours, rest) = points.as_chunks::<4>();
        let mut last = [[0.0; 4]; 4];
        last[..rest.len()].copy_from_slice(rest);
        for four in fours.iter().chain((!rest.is_empty()).then_some(&last)) {
            let [x, y, z, _] = f32x4::transpose(four.map(f32x4::from));
            let on = |axis: usize| {
                turn[axis * 3] * x + turn[axis * 3 + 1] * y + turn[axis * 3 + 2] * z + position[axis]
            };
            let height = on(2);
            let low = rule.low_enough(height, valid_ranges(x * x + y * y + z * z));
            if low.to_bitmask() != 0 {
                self.bins.add(&rule, [on(0), on(1), height], low);
            }
        }
        self.judge(None, pose, shift)
    }

    fn judge(&mut self, view: Option<&View>, pose: &SensorPose, shift: [i32; 2]) -> Seen {
        let Settings { side, cell, near_points, least_points, confirm, .. } = self.settings;
        let [sx, sy, _] = pose.position;
        let centre = |i: usize| (i as f32 + 0.5 - side as f32 / 2.0) * cell;
        std::mem::swap(&mut self.candidates, &mut self.before);
        self.candidates.fill(0);
        self.classes.fill(Class::Unknown as u8);
        let mut seen = Seen::default();
        for row in 0..side {
            let y = centre(row) - sy;
            for column in 0..side {
                let at = row * side + column;
                // Of most cells nothing was seen.
                if self.bins.is_empty(at) {
                    continue;
                }
                let (obstacle, floor, holes) = self.bins.of(at);
                let mut class = if floor > 0 { Class::Free } else { Class::Unknown };
                if obstacle > 0 || holes > 0 {
                    let x = centre(column) - sx;
                    let enough = (near_points / (x * x + y * y).max(1.0)).max(least_points);
                    if obstacle as f32 >= enough {
                        self.candidates[at] = 1;
                        if !confirm || self.first || self.had_neighbour(column, row, shift) {
                            class = Class::Occupied;
                        }
                    } else if holes as f32 >= enough && holes > floor {
                        class = Class::DropOff;
                    }
                }
                match class {
                    Class::Unknown => {}
                    Class::Free => seen.free += 1,
                    Class::Occupied => seen.occupied += 1,
                    Class::DropOff => seen.drop_offs += 1,
                }
                self.classes[at] = class as u8;
            }
        }
        self.first = false;
        seen.free += self.follow_low_rays(pose);
        self.measure(view);
        seen
    }

    fn measure(&mut self, view: Option<&View>) {
        let Settings { side, cell, low_ray, .. } = self.settings;
        let centre = |i: usize| (i as f32 + 0.5 - side as f32 / 2.0) * cell;
        for at in 0..side * side {
            let height = if self.classes[at] == Class::Occupied as u8 {
                let [low, high] = self.bins.span_of(at, &self.settings);
                ((low + LOWEST_PART).min(high) / HEIGHT_STEP).ceil()
            } else if self.classes[at] == Class::Free as u8 {
                let [low, high] =
                    view.map_or([0.0, f32::INFINITY], |view| view.over(centre(at % side), centre(at / side)));
                if low <= low_ray { high / HEIGHT_STEP } else { 0.0 }
            } else {
                continue;
            };
            // Numbers out of range become the nearest in range.
            self.heights[at] = height as u8;
        }
    }

    /// Whether the cloud before had an obstacle in this cell or next to it.
    fn had_neighbour(&self, column: usize, row: usize, [dx, dy]: [i32; 2]) -> bool {
        let side = self.settings.side as i64;
        let (x, y) = (column as i64 + i64::from(dx), row as i64 + i64::from(dy));
        (y - 1..=y + 1)
            .flat_map(|j| (x - 1..=x + 1).map(move |i| (i, j)))
            .filter(|(i, j)| (0..side).contains(i) && (0..side).contains(j))
            .any(|(i, j)| self.before[(j * side + i) as usize] != 0)
    }

    /// A ray that meets the floor passes low over the cells before it: where nothing was seen in them, they are free.
    fn follow_low_rays(&mut self, pose: &SensorPose) -> u32 {
        let Settings { side, cell, low_ray, .. } = self.settings;
        let [sx, sy, sz] = pose.position;
        if sz <= 0.0 {
            return 0;
        }
        let share = (low_ray / sz).min(1.0);
        let half = side as f32 / 2.0;
        let foot = [sx / cell + half, sy / cell + half];
        let mut added = 0;
        for row in 0..side {
            for column in 0..side {
                if self.bins.of(row * side + column).1 == 0 {
                    continue;
                }
                let from = [column as f32 + 0.5, row as f32 + 0.5];
                let way = [foot[0] - from[0], foot[1] - from[1]];
                let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
                if !(length > 1.0 && length < 1e6) {
                    continue;
                }
                let step = way.map(|part| part / length);
                for i in 1..=(length * share) as usize {
                    let [x, y] = [0, 1].map(|axis| from[axis] + step[axis] * i as f32);
                    // Towards the sensor, which may be outside the grid.
                    if !(x >= 0.0 && x < side as f32 && y >= 0.0 && y < side as f32) {
                        break;
                    }
                    let at = y as usize * side + x as usize;
                    // Any other cell that was seen has rays of its own.
                    if self.classes[at] != Class::Unknown as u8 {
                        break;
                    }
                    self.classes[at] = Class::Free as u8;
                    added += 1;
                }
            }
        }
        added
    }
}
