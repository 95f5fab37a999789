//! From metres to the grid, and from colours and intensities to the coded attribute.

use crate::Point;

/// Coordinates beyond ±this are not sent, metres.
pub const MAX_RANGE_M: f32 = 500.0;

/// What the fourth word of a point holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attribute {
    /// Nothing that is sent.
    None,
    /// Bytes R, G, B, A from the lowest on; sent as 5-6-5 bits.
    Colour,
    /// The low 8 bits.
    Intensity8,
    /// The low 16 bits; sent as 8.
    Intensity16,
}

/// Why points were not sent; each counts once, under the first reason that holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rejected {
    /// A coordinate is NaN or infinite.
    pub not_finite: usize,
    /// A coordinate is beyond ±500 m.
    pub out_of_range: usize,
}

/// A point on the grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GridPoint {
    /// In grid steps.
    pub at: [i32; 3],
    /// 5-6-5 colour (R highest), intensity level, or 0.
    pub attribute: u16,
}

/// Appends the points that can be sent, rounded to the grid.
pub fn quantise(frame: &[Point], attribute: Attribute, step_mm: u8, points: &mut Vec<GridPoint>) -> Rejected {
    let scale = 1000.0 / f64::from(step_mm);
    let mut rejected = Rejected::default();
    for [x, y, z, word] in frame {
        let largest = x.abs().max(y.abs()).max(z.abs());
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            rejected.not_finite += 1;
        } else if largest > MAX_RANGE_M {
            rejected.out_of_range += 1;
        } else {
            let at = [x, y, z].map(|metres| (f64::from(*metres) * scale + 0.5).floor() as i32);
            points.push(GridPoint { at, attribute: attribute_of(word.to_bits(), attribute) });
        }
    }
    rejected
}

fn attribute_of(word: u32, attribute: Attribute) -> u16 {
    match attribute {
        Attribute::None => 0,
        Attribute::Colour => colour_565(word),
        Attribute::Intensity8 => (word & 0xff) as u16,
        Attribute::Intensity16 => (((word & 0xffff) * 255 + 32_767) / 65_535) as u16,
    }
}

/// Bytes R, G, B, A (R lowest) to 5-6-5 bits, R highest, each to the nearest.
pub fn colour_565(rgba: u32) -> u16 {
    let nearest = |byte: u32, top: u32| ((byte & 0xff) * top + 127) / 255;
    (nearest(rgba, 31) << 11 | nearest(rgba >> 8, 63) << 5 | nearest(rgba >> 16, 31)) as u16
}

/// Replaces intensities 0…255 by levels 0…top where fewer levels say the same (sensors that count in hundredths), without
/// loss: the level k stands for ⌊(255·k + ⌊top/2⌋) / top⌋. Where that was a half, the value below is taken for it too: as
/// floats, hundredths come out on either side.
pub fn find_levels(points: &mut [GridPoint]) -> u8 {
    let mut used = [false; 256];
    for point in points.iter() {
        used[usize::from(point.attribute & 0xff)] = true;
    }
    let top = (1..128_u32).find(|top| {
        let mut level_of = [false; 256];
        for level in 0..=*top {
            level_of[level_value(level, *top) as usize] = true;
            level_of[below_half(level, *top) as usize] = true;
        }
        used.iter().zip(level_of).all(|(used, has)| !used || has)
    });
    let Some(top) = top else { return 255 };
    let mut levels = [0; 256];
    for level in 0..=top {
        levels[below_half(level, top) as usize] = level as u16;
    }
    for level in 0..=top {
        levels[level_value(level, top) as usize] = level as u16;
    }
    for point in points {
        point.attribute = levels[usize::from(point.attribute & 0xff)];
    }
    top as u8
}

/// The intensity, 0…255, that a level stands for.
pub const fn level_value(level: u32, top: u32) -> u32 {
    (255 * level + top / 2) / top
}

/// The value below, where rounding to [`level_value`] took a half up.
const fn below_half(level: u32, top: u32) -> u32 {
    level_value(level, top) - (2 * (255 * level % top) == top) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rejects_what_cannot_be_sent_and_counts_it() {
        let frame = [
            [f32::NAN, 0.0, 0.0, 0.0],
            [0.0, f32::NEG_INFINITY, f32::INFINITY, 0.0],
            [0.0, 0.0, -500.1, 0.0],
            [-500.0, 0.004, 0.006, 0.0],
        ];
        let mut points = Vec::new();
        let rejected = quantise(&frame, Attribute::None, 10, &mut points);
        assert_eq!(rejected, Rejected { not_finite: 2, out_of_range: 1 });
        assert_eq!(points, [GridPoint { at: [-50_000, 0, 1], attribute: 0 }]);
    }

    #[test]
    fn finds_hundredths_among_eight_bits_without_loss() {
        let values: Vec<u16> =
            (0..=99).map(|hundredth| (f64::from(hundredth) * 2.55).round() as u16).collect();
        let mut points: Vec<GridPoint> =
            values.iter().map(|value| GridPoint { at: [0; 3], attribute: *value }).collect();
        let top = find_levels(&mut points);
        assert_eq!(top, 100);
        for (point, value) in points.iter().zip(values) {
            let decoded = level_value(u32::from(point.attribute), u32::from(top));
            assert!(decoded == u32::from(value) || decoded == u32::from(value) + 1);
        }
    }

    #[test]
    fn keeps_all_levels_where_all_are_used() {
        let mut points: Vec<GridPoint> = (0..256).map(|v| GridPoint { at: [0; 3], attribute: v }).collect();
        assert_eq!(find_levels(&mut points), 255);
        assert_eq!(points[77].attribute, 77);
    }
}
