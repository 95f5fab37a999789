//! The order in which a frame's points are sent.

use crate::{DepthMeasure, Point};

/// The bands end at 1, 2, 4, 8 and 16 m; the last has no end.
const BANDS: usize = 6;

/// Puts the points nearest to the sensor first: by bands whose far edge doubles (below 1 m, 2 m, 4 m, 8 m, 16 m, beyond),
/// and inside a band in the order in which they came. A frame that is cut short loses its farthest points, and a link that
/// fills slowly shows first what the robot would run into first. Neighbours of the picture stay neighbours.
///
/// `chosen` are indices into `frame` of points with a positive depth; `ordered` gets the same indices.
///
/// # Panics
/// If an index is outside the frame.
pub fn near_first(frame: &[Point], chosen: &[u32], depth_measure: DepthMeasure, ordered: &mut Vec<u32>) {
    match depth_measure {
        DepthMeasure::Z => sort(frame, chosen, |[_, _, z, _]| exponent(z), ordered),
        // The square's exponent is twice the distance's, and one more from the square root of 2 on.
        DepthMeasure::Range => {
            sort(frame, chosen, |[x, y, z, _]| exponent(x * x + y * y + z * z) >> 1, ordered);
        }
    }
}

/// floor(log₂ value) of a positive number.
fn exponent(value: f32) -> i32 {
    (value.to_bits() >> 23) as i32 - 127
}

/// A counting sort: stable.
fn sort(frame: &[Point], chosen: &[u32], log2: impl Fn(Point) -> i32, ordered: &mut Vec<u32>) {
    let band = |index: u32| (log2(frame[index as usize]) + 1).clamp(0, BANDS as i32 - 1) as usize;
    let mut ends = [0; BANDS];
    for index in chosen {
        ends[band(*index)] += 1;
    }
    let mut next = [0; BANDS];
    for i in 1..BANDS {
        next[i] = next[i - 1] + ends[i - 1];
    }
    ordered.clear();
    ordered.resize(chosen.len(), 0);
    for index in chosen {
        let at = &mut next[band(*index)];
        ordered[*at] = *index;
        *at += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The bands' far edges, as the documentation has them.
    fn band_of(depth: f64) -> usize {
        [1.0, 2.0, 4.0, 8.0, 16.0].iter().filter(|edge| depth >= **edge).count()
    }

    #[test]
    fn edges_belong_to_the_band_behind_them() {
        let frame: Vec<Point> =
            [16.0, 0.99, 1.0, 8.0, 1.99, 4.0, 2.0, 0.001, 30.0].map(|z| [5.0, 0.0, z, 0.0]).into();
        let chosen: Vec<u32> = (0..frame.len() as u32).collect();
        let mut ordered = Vec::new();
        near_first(&frame, &chosen, DepthMeasure::Z, &mut ordered);
        assert_eq!(ordered, [1, 7, 2, 4, 6, 5, 3, 0, 8]);
    }

    proptest! {
        #[test]
        fn near_bands_come_first_and_keep_their_order(
            points in prop::collection::vec((-32.0_f32..32.0, -32.0_f32..32.0, 0.001_f32..32.0), 0..300),
            range: bool,
        ) {
            let frame: Vec<Point> = points.iter().map(|(x, y, z)| [*x, *y, *z, f32::NAN]).collect();
            let chosen: Vec<u32> = (0..frame.len() as u32).filter(|i| i % 3 != 0).collect();
            let measure = if range { DepthMeasure::Range } else { DepthMeasure::Z };
            let mut ordered = vec![7; 3];
            near_first(&frame, &chosen, measure, &mut ordered);

            let depth = |index: &u32| {
                let [x, y, z, _] = frame[*index as usize];
                f64::from(if range { (x * x + y * y + z * z).sqrt() } else { z })
            };
            let mut expected = chosen.clone();
            expected.sort_by_key(|index| band_of(depth(index)));
            // A square root that rounds up to an edge is the only way to differ.
            let near_edge = |index: &u32| [1.0, 2.0, 4.0, 8.0, 16.0].iter().any(|e| (depth(index) - e).abs() < 1e-5);
            if !chosen.iter().any(near_edge) {
                prop_assert_eq!(ordered, expected);
            }
        }
    }
}
