//! What is coded for a point, in which contexts. One walk serves encoder and decoder: a [`Port`] either writes the value
//! it is given, or gives the value it reads.

use crate::contexts::{
    ERRORS, FIRST, GEOMETRY, GREEN, GREEN_BASE, GREEN_ERRORS, INTENSITY, INTENSITY_BASE, OTHER, RED_BLUE,
    RED_BLUE_BASE,
};
use crate::predictor::{Mode, Predictor};
use crate::quantise::GridPoint;
use crate::start::{AttributeKind, Start};

/// Where values go to or come from.
pub trait Port {
    /// What can go wrong.
    type Error;
    /// Writes `value` with a table and returns it, or returns the value read.
    fn code(&mut self, table: usize, value: u32) -> Result<u32, Self::Error>;
    /// The value read cannot be.
    fn impossible(&self) -> Self::Error;
}

/// Sixteen times the usual size of a value, kept as an integer.
#[derive(Clone, Copy)]
struct Usual(u32);

impl Usual {
    #[inline]
    fn learn(&mut self, size: u32) {
        self.0 = self.0 - (self.0 >> 2) + (size.min(1 << 14) << 2);
    }

    /// By octaves: 0 for a quarter or less.
    #[inline]
    fn octave(self, contexts: usize) -> usize {
        (32 - self.0.leading_zeros()).saturating_sub(2).min(contexts as u32 - 1) as usize
    }
}

/// The coder's state within one packet.
pub struct Model {
    mode: Mode,
    kind: AttributeKind,
    /// Highest intensity level.
    top: u8,
    origin: [i32; 3],
    predictor: Predictor,
    usual: [Usual; 3],
    attribute: AttributeModel,
}

struct AttributeModel {
    /// Mean intensity × 256.
    mean: i32,
    /// Colour before, 5-6-5.
    colour: u16,
    usual: [Usual; 3],
}

impl Model {
    /// The state after the first point.
    pub fn new(Start { mode, kind, top, first }: Start) -> Self {
        let origin = mode.turn(first.at);
        Self {
            mode,
            kind,
            top,
            origin,
            predictor: Predictor::new(mode, origin),
            usual: [Usual(64); 3],
            attribute: AttributeModel {
                mean: i32::from(first.attribute) << 8,
                colour: first.attribute,
                usual: [Usual(64); 3],
            },
        }
    }

    /// Codes one point; what the encoder gives comes back, what the decoder gives is not looked at.
    #[inline]
    pub fn code<P: Port>(&mut self, port: &mut P, point: GridPoint) -> Result<GridPoint, P::Error> {
        let geometry = if self.mode == Mode::Step { 0 } else { GEOMETRY };
        let actual = self.mode.turn(point.at);
        let mut known = [0; 3];

        let (main, expected) = self.predictor.first();
        let table = geometry + self.usual[0].octave(FIRST);
        let (value, error) = self.coordinate(port, table, 0, main, expected, actual[main])?;
        known[main] = value;
        let after = geometry + FIRST + error_class(error);

        let other = 1 - main;
        let expected = self.predictor.second(main, value);
        let table = after + self.usual[1].octave(OTHER) * ERRORS;
        (known[other], _) = self.coordinate(port, table, 1, other, expected, actual[other])?;

        let expected = self.predictor.third(known);
        let table = after + (OTHER + self.usual[2].octave(OTHER)) * ERRORS;
        (known[2], _) = self.coordinate(port, table, 2, 2, expected, actual[2])?;
        self.predictor.advance(known);

        let attribute = match self.kind {
            AttributeKind::None => 0,
            AttributeKind::Intensity => self.attribute.intensity(port, point.attribute, self.top)?,
            AttributeKind::Colour => self.attribute.colour(port, point.attribute)?,
        };
        Ok(GridPoint { at: self.mode.turn_back(known), attribute })
    }

    /// One coordinate and the size of its error.
    #[inline]
    fn coordinate<P: Port>(
        &mut self,
        port: &mut P,
        table: usize,
        usual: usize,
        axis: usize,
        expected: i32,
        actual: i32,
    ) -> Result<(i32, u32), P::Error> {
        let origin = self.origin[axis];
        let expected = expected.clamp(origin - 32_768, origin + 32_767);
        let error = unfold(port.code(table, fold(actual.wrapping_sub(expected)))?);
        let value = expected + error;
        if i16::try_from(value - origin).is_err() {
            return Err(port.impossible());
        }
        let size = error.unsigned_abs();
        self.usual[usual].learn(size);
        Ok((value, size))
    }
}

impl AttributeModel {
    #[inline]
    fn intensity<P: Port>(&mut self, port: &mut P, actual: u16, top: u8) -> Result<u16, P::Error> {
        let top = i32::from(top);
        let expected = (self.mean + 128) >> 8;
        let table = INTENSITY_BASE + self.usual[0].octave(INTENSITY);
        let value = within(port.code(table, fold_within(i32::from(actual), expected, top))?, expected, top)
            .ok_or_else(|| port.impossible())?;
        self.usual[0].learn((value - expected).unsigned_abs());
        self.mean += (((value << 8) - self.mean) * 77) >> 8;
        Ok(value as u16)
    }

    #[inline]
    fn colour<P: Port>(&mut self, port: &mut P, actual: u16) -> Result<u16, P::Error> {
        let [r, g, b] = channels(self.colour);
        let [actual_r, actual_g, actual_b] = channels(actual);
        let table = GREEN_BASE + self.usual[0].octave(GREEN);
        let green = within(port.code(table, fold_within(actual_g, g, 63))?, g, 63)
            .ok_or_else(|| port.impossible())?;
        let change = green - g;
        self.usual[0].learn(change.unsigned_abs());
        let class = match change.unsigned_abs() {
            0 => 0,
            1..=3 => 1,
            _ => 2,
        };
        let mut rest = [0; 2];
        for (channel, (before, actual)) in [(r, actual_r), (b, actual_b)].into_iter().enumerate() {
            let expected = (before + (change >> 1)).clamp(0, 31);
            let usual = &mut self.usual[1 + channel];
            let table = RED_BLUE_BASE + usual.octave(RED_BLUE) * GREEN_ERRORS + class;
            let value = within(port.code(table, fold_within(actual, expected, 31))?, expected, 31)
                .ok_or_else(|| port.impossible())?;
            usual.learn((value - expected).unsigned_abs());
            rest[channel] = value;
        }
        self.colour = (rest[0] << 11 | green << 5 | rest[1]) as u16;
        Ok(self.colour)
    }
}

#[inline]
fn channels(colour: u16) -> [i32; 3] {
    [i32::from(colour >> 11), i32::from(colour >> 5 & 63), i32::from(colour & 31)]
}

#[inline]
const fn error_class(error: u32) -> usize {
    match error {
        0..=1 => 0,
        2..=7 => 1,
        8..=63 => 2,
        _ => 3,
    }
}

/// 0, −1, 1, −2, 2 … to 0, 1, 2, 3, 4 …
#[inline]
const fn fold(value: i32) -> u32 {
    (value << 1 ^ value >> 31) as u32
}

#[inline]
const fn unfold(value: u32) -> i32 {
    (value >> 1) as i32 ^ -((value & 1) as i32)
}

/// Like [`fold`] for a value 0…top: beyond the nearer end of that range only one sign is left.
#[inline]
fn fold_within(value: i32, expected: i32, top: i32) -> u32 {
    let error = value - expected;
    let both = expected.min(top - expected);
    if error.abs() <= both { fold(error) } else { (both + error.abs()) as u32 }
}

/// Undoes [`fold_within`]; `None` where no value 0…top has that number.
#[inline]
fn within(folded: u32, expected: i32, top: i32) -> Option<i32> {
    let both = expected.min(top - expected);
    let value = if folded <= 2 * both as u32 {
        expected + unfold(folded)
    } else {
        let size = i32::try_from(folded).ok()? - both;
        if expected < top - expected { expected + size } else { expected - size }
    };
    (0..=top).contains(&value).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folding_within_a_range_loses_nothing_and_wastes_nothing() {
        for top in [1, 31, 63, 100, 255] {
            for expected in 0..=top {
                let mut seen = vec![false; top as usize + 1];
                for value in 0..=top {
                    let folded = fold_within(value, expected, top);
                    assert_eq!(within(folded, expected, top), Some(value));
                    seen[folded as usize] = true;
                }
                assert!(seen.iter().all(|seen| *seen));
                assert_eq!(within(top as u32 + 1, expected, top), None);
            }
        }
    }

    #[test]
    fn folding_is_undone() {
        for value in [-65_535, -1, 0, 1, 65_535] {
            assert_eq!(unfold(fold(value)), value);
        }
    }
}
