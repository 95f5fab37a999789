//! Where the next point is expected: as far as the one before it, along the next ray of a spinning sensor at the origin
//! (*ray*), or where the one before it is (*step*). Only +, −, ×, ÷ and √ of 64-bit floats: every decoder gets the same.

/// The axis about which a sensor spins, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The point before is the prediction.
    Step,
    /// Rays about the x axis (0), y axis (1) or z axis (2).
    Ray(u8),
}

impl Mode {
    /// All modes, in the order of their numbers in a packet.
    pub const ALL: [Mode; 4] = [Mode::Step, Mode::Ray(0), Mode::Ray(1), Mode::Ray(2)];

    /// Its number in a packet.
    pub const fn number(self) -> u8 {
        match self {
            Mode::Step => 0,
            Mode::Ray(axis) => axis + 1,
        }
    }

    /// The coordinates turned so that the axis comes last.
    #[inline]
    pub const fn turn(self, [x, y, z]: [i32; 3]) -> [i32; 3] {
        match self {
            Mode::Ray(0) => [y, z, x],
            Mode::Ray(1) => [z, x, y],
            _ => [x, y, z],
        }
    }

    /// Undoes [`Mode::turn`].
    #[inline]
    pub const fn turn_back(self, [a, b, c]: [i32; 3]) -> [i32; 3] {
        match self {
            Mode::Ray(0) => [c, a, b],
            Mode::Ray(1) => [b, c, a],
            _ => [a, b, c],
        }
    }
}

/// Turns larger than this (its sine) are jumps and say nothing about the next one.
const MAX_TURN: f64 = 0.02;
/// An elevation that differs by more than this many grid steps is another ring's.
const SAME_RING: f64 = 3.0;

/// The state between two points, in turned coordinates.
pub struct Predictor {
    ray: bool,
    previous: [i32; 3],
    /// Distance of the previous point from the axis, and its inverse.
    distance: f64,
    inverse: f64,
    /// Sine of the usual turn from a point to the next, and how many turns it is the mean of.
    turn: f64,
    turns: u32,
    /// Usual elevation over distance.
    slope: f64,
    direction: [f64; 2],
}

impl Predictor {
    /// Begins at a packet's first point.
    pub fn new(mode: Mode, first: [i32; 3]) -> Self {
        let mut predictor = Self {
            ray: mode != Mode::Step,
            previous: first,
            distance: 1.0,
            inverse: 1.0,
            turn: 0.0,
            turns: 0,
            slope: 0.0,
            direction: [1.0, 0.0],
        };
        if predictor.ray {
            (predictor.distance, predictor.inverse) = distance_of(first);
            predictor.slope = f64::from(first[2]) * predictor.inverse;
        }
        predictor
    }

    /// The coordinate that is coded first (0 or 1), and what it should be.
    #[inline]
    pub fn first(&mut self) -> (usize, i32) {
        let [a, b, _] = self.previous;
        if !self.ray {
            return (0, a);
        }
        let (x, y) = (f64::from(a) * self.inverse, f64::from(b) * self.inverse);
        let cosine = 1.0 - self.turn * self.turn * 0.5;
        self.direction = [x * cosine - y * self.turn, y * cosine + x * self.turn];
        let main = usize::from(a.abs() < b.abs());
        (main, round(self.direction[main] * self.distance))
    }

    /// What the other of coordinates 0 and 1 should be, once the first is known.
    #[inline]
    pub fn second(&self, main: usize, known: i32) -> i32 {
        if !self.ray {
            return self.previous[1];
        }
        let along = self.direction[main];
        // Only where the point before lies on the axis.
        if along == 0.0 {
            self.previous[1 - main]
        } else {
            round(f64::from(known) / along * self.direction[1 - main])
        }
    }

    /// What coordinate 2 should be. `point` has the two others; [`Predictor::advance`] must follow.
    #[inline]
    pub fn third(&mut self, point: [i32; 3]) -> i32 {
        if !self.ray {
            return self.previous[2];
        }
        let (distance, inverse) = distance_of(point);
        let [a, b] = [f64::from(self.previous[0]), f64::from(self.previous[1])];
        let sine = (a * f64::from(point[1]) - b * f64::from(point[0])) * (self.inverse * inverse);
        if sine.abs() < MAX_TURN {
            self.turns = (self.turns + 1).min(16);
            self.turn += (sine - self.turn) / f64::from(self.turns);
        }
        (self.distance, self.inverse) = (distance, inverse);
        round(distance * self.slope)
    }

    /// Goes on to the point that is known now.
    #[inline]
    pub fn advance(&mut self, point: [i32; 3]) {
        self.previous = point;
        if self.ray {
            let slope = f64::from(point[2]) * self.inverse;
            let change = slope - self.slope;
            self.slope =
                if (change * self.distance).abs() > SAME_RING { slope } else { self.slope + change * 0.25 };
        }
    }
}

/// Distance from the axis, at least one grid step, and its inverse.
#[inline]
fn distance_of([a, b, _]: [i32; 3]) -> (f64, f64) {
    let (a, b) = (f64::from(a), f64::from(b));
    let square = a * a + b * b;
    let distance = if square < 1.0 { 1.0 } else { square.sqrt() };
    (distance, 1.0 / distance)
}

/// To the nearest, halves up. Far values are cut by the caller; the cast saturates.
#[inline]
fn round(value: f64) -> i32 {
    (value + 0.5).floor() as i32
}
